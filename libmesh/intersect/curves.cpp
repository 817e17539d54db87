#include <libmesh/base/flattened.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/contact_point.hpp>
#include <libmesh/intersect/check_pairs.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/parallel.hpp>

#include <numeric>
#include <utility>

namespace treeform {
namespace {

using segment_ends = std::array<point3, 2>;

void append_common_set(mesh_view mesh, const face_pair& pair, std::vector<segment_ends>& segments) {
    const triangle3 a = detail::base::triangle_of(mesh, pair.a);
    const triangle3 b = detail::base::triangle_of(mesh, pair.b);
    const triangle_contact common = intersect(a, b);
    std::array<point3, 6> ends;
    for (std::size_t i = 0; i < common.count; ++i)
        ends[i] = approximate_point(a, b, common.ends[i]);
    if (common.count == 1) segments.push_back({ends[0], ends[0]});
    if (common.count == 2) segments.push_back({ends[0], ends[1]});
    if (common.count < 3) return;
    for (std::size_t i = 0; i < common.count; ++i)
        segments.push_back({ends[i], ends[(i + 1) % common.count]});
}

}  // namespace

answer_lists<segment_ends> intersection_curves(mesh_view mesh, std::span<const face_pair> pairs) {
    constexpr std::size_t grain = 1 << 7;
    detail::intersect::check_pairs("intersection_curves", mesh, pairs, false);
    std::vector<std::vector<segment_ends>> parts(chunk_count(pairs.size(), grain));
    answer_lists<segment_ends> found{std::vector<std::size_t>(pairs.size() + 1), {}};
    for_chunks(pairs.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t before = parts[chunk].size();
            append_common_set(mesh, pairs[i], parts[chunk]);
            found.begin[i + 1] = parts[chunk].size() - before;
        }
    });
    std::partial_sum(found.begin.begin(), found.begin.end(), found.begin.begin());
    found.answers = detail::base::flattened(std::move(parts));
    return found;
}

}  // namespace treeform
