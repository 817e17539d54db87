#include <libmesh/attributes/scene_parts.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/carry/solid_parts.hpp>
#include <libmesh/topology/select_faces.hpp>
#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/properties.hpp>

#include <utility>

namespace treeform {

std::vector<file_part> split_parts(const carry_source& source) {
    const mesh_file& whole = *source.file;
    std::vector<file_part> parts;
    for (scene_part& of : detail::carry::surface_parts(source)) {
        file_part part{.name = std::move(of.name)};
        part.file.mesh = select_faces(whole.mesh, of.faces);
        part.file.stored_faces = of.faces.size();
        part.file.indexed = whole.indexed;
        part.file.stored_as = whole.stored_as;
        part.file.format = whole.format;
        std::vector<face> kept;
        for (const std::uint32_t f : of.faces) {
            kept.push_back(whole.mesh.faces[f]);
            part.stored_face.push_back(source.stored_face(f));
        }
        carry_sources(source).carry(part.file, of.faces,
                                    detail::base::used_points(whole.mesh.points.size(), kept));
        parts.push_back(std::move(part));
    }
    return parts;
}

}  // namespace treeform
