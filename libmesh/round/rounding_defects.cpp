#include <libmesh/base/nearest_float.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace treeform {
namespace {

using pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Ascending; none where stopped, which `end` then says.
pairs meeting_pairs(mesh_view mesh, const progress_callback& progress, status& end) {
    const face_pair_options options{
        .vertices = vertex_identity::by_index,
        .kinds = pair_kinds::all - pair_kind::touching - pair_kind::degenerate,
        .progress = progress};
    const face_pair_result found = self_intersections(mesh, options);
    if (found.status != status::ok) end = found.status;
    pairs result;
    result.reserve(found.pairs.size());
    for (const face_pair& pair : found.pairs) result.emplace_back(pair.a, pair.b);
    return result;
}

/// How many are in `now` that were not in `before`, both ascending.
template <class T>
std::uint64_t count_new(const std::vector<T>& now, const std::vector<T>& before) {
    std::uint64_t count = 0;
    auto known = before.begin();
    for (const T& one : now) {
        known = std::lower_bound(known, before.end(), one);
        count += known == before.end() || *known != one;
    }
    return count;
}

}  // namespace

double coordinate_step(points_view points, precision of) {
    const bool single = of == precision::float32;
    double largest = 0.0;
    for (const point3& p : points)
        for (std::size_t k = 0; k < 3; ++k)
            if (std::isfinite(p[k])) largest = std::max(largest, std::abs(p[k]));
    const double least = single ? 0x1p-149 : std::numeric_limits<double>::denorm_min();
    if (largest == 0.0) return least;
    return std::max(least, std::ldexp(1.0, std::ilogb(largest) - (single ? 23 : 52)));
}

std::vector<point3> rounded(points_view points, precision to) {
    std::vector<point3> result(points.begin(), points.end());
    if (to == precision::float64) return result;
    for (point3& p : result)
        for (std::size_t k = 0; k < 3; ++k) p[k] = detail::base::nearest_float(p[k]);
    return result;
}

rounding_effects find_rounding_defects(mesh_view mesh, points_view placed,
                                       const progress_callback& progress) {
    if (placed.size() != mesh.points.size())
        throw std::invalid_argument(
            "treeform::find_rounding_defects: expected as many points as the mesh has");
    const mesh_view there{placed, mesh.faces};
    rounding_effects harm;
    harm.compared = true;
    const pairs now = meeting_pairs(there, progress, harm.status);
    if (!now.empty() && harm.status != treeform::status::cancelled)
        harm.meeting = count_new(now, meeting_pairs(mesh, progress, harm.status));
    const std::vector<std::uint32_t> flat = find_invalid_faces(there).degenerate_faces;
    if (!flat.empty()) harm.collapsed = count_new(flat, find_invalid_faces(mesh).degenerate_faces);
    return harm;
}

}  // namespace treeform
