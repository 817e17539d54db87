#include <libmesh/topology/select_faces.hpp>
#include <treeform/mesh/properties.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace treeform {

mesh select_faces(const mesh_ref& given, std::span<const std::uint32_t> faces) {
    const mesh_view mesh = given.view();
    constexpr std::uint32_t unused = 0xffffffffU;
    std::vector<std::uint32_t> new_of_old(mesh.points.size(), unused);
    for (const std::uint32_t f : faces) {
        if (f >= mesh.faces.size())
            throw std::invalid_argument("treeform::select_faces: there is no face " +
                                        std::to_string(f));
        for (const std::uint32_t corner : mesh.faces[f]) {
            if (corner >= mesh.points.size())
                throw std::invalid_argument("treeform::select_faces: face " + std::to_string(f) +
                                            " has a corner out of range");
            new_of_old[corner] = 0;
        }
    }
    treeform::mesh result;
    for (std::size_t i = 0; i < new_of_old.size(); ++i) {
        if (new_of_old[i] == unused) continue;
        new_of_old[i] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(mesh.points[i]);
    }
    result.faces.reserve(faces.size());
    for (const std::uint32_t f : faces) {
        const face& old = mesh.faces[f];
        result.faces.push_back({new_of_old[old[0]], new_of_old[old[1]], new_of_old[old[2]]});
    }
    return result;
}

}  // namespace treeform
