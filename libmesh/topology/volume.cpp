#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/double_double.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace treeform {
namespace {

using detail::base::double_double;

constexpr std::size_t lanes = 2;  // that every 64-bit machine of today has
using lane_doubles [[gnu::vector_size(lanes * sizeof(double))]] = double;

/// Six times the volume between the origin and `lanes` faces, or fewer at the end.
detail::base::doubled<lane_doubles> six_volumes(mesh_view mesh, std::size_t first) {
    std::array<std::array<lane_doubles, 3>, 3> corners{};
    for (std::size_t lane = 0; lane < lanes && first + lane < mesh.faces.size(); ++lane)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                corners[i][k][lane] = mesh.points[mesh.faces[first + lane][i]][k];
    return detail::base::determinant(corners[0], corners[1], corners[2]);
}

}  // namespace

double signed_volume(mesh_view mesh) {
    detail::base::check_faces("signed_volume", mesh.points.size(), mesh.faces);
    static_assert(light_grain % lanes == 0);
    std::vector<double_double> parts(chunk_count(mesh.faces.size(), light_grain));
    for_chunks(mesh.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t c) {
                   detail::base::doubled<lane_doubles> sum;
                   for (std::size_t f = begin; f < end; f += lanes)
                       sum = sum + six_volumes(mesh, f);
                   for (std::size_t lane = 0; lane < lanes; ++lane)
                       parts[c] = parts[c] + double_double{sum.high[lane], sum.low[lane]};
               });
    double_double all;
    for (const double_double& part : parts) all = all + part;
    return all.high / 6.0;
}

}  // namespace treeform
