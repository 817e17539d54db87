#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/double_double.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <vector>

namespace treeform {

double signed_volume(mesh_view mesh) {
    detail::base::check_faces("signed_volume", mesh.points.size(), mesh.faces);
    std::vector<detail::base::double_double> parts(chunk_count(mesh.faces.size(), light_grain));
    for_chunks(mesh.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t c) {
                   for (std::size_t f = begin; f < end; ++f) {
                       const auto [p, q, r] = mesh.faces[f];
                       parts[c] = parts[c] + detail::base::determinant(
                                                 mesh.points[p], mesh.points[q], mesh.points[r]);
                   }
               });
    detail::base::double_double all;
    for (const detail::base::double_double& part : parts) all = all + part;
    return all.high / 6.0;
}

}  // namespace treeform
