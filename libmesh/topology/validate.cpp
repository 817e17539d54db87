#include <libmesh/base/point_math.hpp>
#include <libmesh/exact/filter.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace treeform {
namespace {

bool degenerate(const point3& a, const point3& b, const point3& c) {
    const int known = detail::exact::collinear_filter(a, b, c);
    return known == detail::exact::undecided ? collinear(a, b, c) : known == 0;
}

using ids = std::vector<std::uint32_t>;

void append(ids& list, const ids& more) { list.insert(list.end(), more.begin(), more.end()); }

ids find_nonfinite_points(points_view points) {
    std::vector<ids> found(chunk_count(points.size(), light_grain));
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end; ++i)
            if (!detail::base::is_finite(points[i]))
                found[c].push_back(static_cast<std::uint32_t>(i));
    });
    ids all;
    for (const ids& part : found) append(all, part);
    return all;
}

void look_at(mesh_view mesh, std::size_t i, invalid_faces& found) {
    const face& f = mesh.faces[i];
    const auto id = static_cast<std::uint32_t>(i);
    if (std::max({f[0], f[1], f[2]}) >= mesh.points.size()) {
        found.out_of_range_faces.push_back(id);
        return;
    }
    const point3& a = mesh.points[f[0]];
    const point3& b = mesh.points[f[1]];
    const point3& c = mesh.points[f[2]];
    if (!(detail::base::is_finite(a) && detail::base::is_finite(b) && detail::base::is_finite(c)))
        found.nonfinite_faces.push_back(id);
    else if (degenerate(a, b, c))
        found.degenerate_faces.push_back(id);
}

}  // namespace

invalid_faces find_invalid_faces(const mesh_ref& given) {
    const mesh_view mesh = given.view();
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
    if (mesh.points.size() > most || mesh.faces.size() > most)
        throw std::invalid_argument(
            "treeform::find_invalid_faces: more than 2^32 - 1 points or faces");
    invalid_faces result;
    result.nonfinite_points = find_nonfinite_points(mesh.points);
    std::vector<invalid_faces> found(chunk_count(mesh.faces.size(), light_grain));
    for_chunks(mesh.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t c) {
                   for (std::size_t i = begin; i < end; ++i) look_at(mesh, i, found[c]);
               });
    for (const invalid_faces& part : found) {
        append(result.nonfinite_faces, part.nonfinite_faces);
        append(result.degenerate_faces, part.degenerate_faces);
        append(result.out_of_range_faces, part.out_of_range_faces);
    }
    return result;
}

}  // namespace treeform
