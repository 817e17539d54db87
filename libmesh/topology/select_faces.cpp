#include <treeform/mesh/properties.hpp>

#include <cassert>
#include <vector>

namespace treeform {

mesh select_faces(mesh_view mesh, std::span<const std::uint32_t> faces) {
    constexpr std::uint32_t unused = 0xffffffffU;
    std::vector<std::uint32_t> new_of_old(mesh.points.size(), unused);
    for (const std::uint32_t f : faces) {
        assert(f < mesh.faces.size());
        for (const std::uint32_t corner : mesh.faces[f]) new_of_old[corner] = 0;
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
