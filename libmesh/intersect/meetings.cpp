#include <libmesh/base/compact.hpp>
#include <libmesh/base/flattened.hpp>
#include <libmesh/base/parallel_sort.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/exact/box_around.hpp>
#include <libmesh/geometry/features.hpp>
#include <libmesh/intersect/meetings.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace treeform::detail::intersect {
namespace {

using base::triangle_of;

constexpr std::size_t pair_grain = std::size_t{1} << 7;

std::size_t place_of(triangle_feature f) { return static_cast<std::size_t>(geometry::index_of(f)); }

/// The name of an end that is no corner.
point_name name_of(mesh_view mesh, std::uint32_t a, std::uint32_t b, feature_pair at) {
    if (!geometry::is_edge(at.on_a))
        return {point_name::origin::edge_face, edge_of(mesh.faces[b], place_of(at.on_b)), {a, 0}};
    const edge_name edge = edge_of(mesh.faces[a], place_of(at.on_a));
    if (!geometry::is_edge(at.on_b)) return {point_name::origin::edge_face, edge, {b, 0}};
    const edge_name other = edge_of(mesh.faces[b], place_of(at.on_b));
    return {point_name::origin::edges, std::min(edge, other), std::max(edge, other)};
}

/// An end whose point is to become the number of `name`.
struct open_end {
    point_name name;
    std::size_t meeting;
    std::uint8_t end;
};

implicit_point point_of(mesh_view mesh, const point_name& name) {
    const point3& p = mesh.points[name.edge[0]];
    const point3& q = mesh.points[name.edge[1]];
    if (name.kind == point_name::origin::edges)
        return implicit_point::where_lines_cross(p, q, mesh.points[name.by[0]],
                                                 mesh.points[name.by[1]]);
    const triangle3 t = triangle_of(mesh, name.by[0]);
    return implicit_point::where_line_meets(p, q, {t[0], t[1], t[2]});
}

}  // namespace

mesh_meetings meetings_of(mesh_view mesh, std::span<const face_pair> pairs) {
    mesh_meetings result;
    base::resize_all(pairs.size(), result.meetings);
    std::vector<std::vector<open_end>> open_of(chunk_count(pairs.size(), pair_grain));
    for_chunks(pairs.size(), pair_grain,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   for (std::size_t i = begin; i < end; ++i) {
                       const auto [a, b, kind] = pairs[i];
                       if (kind == pair_kind::degenerate) {
                           result.meetings[i] = {a, b, false, 0, {}};
                           continue;
                       }
                       const triangle_contact common =
                           treeform::intersect(triangle_of(mesh, a), triangle_of(mesh, b));
                       meeting& m = result.meetings[i];
                       m = {a, b, common.coplanar, common.count, {}};
                       for (std::uint8_t k = 0; k < common.count; ++k) {
                           const feature_pair at = common.ends[k];
                           m.ends[k] = {0, at.on_a, at.on_b};
                           if (geometry::is_corner(at.on_a))
                               m.ends[k].point = mesh.faces[a][place_of(at.on_a)];
                           else if (geometry::is_corner(at.on_b))
                               m.ends[k].point = mesh.faces[b][place_of(at.on_b)];
                           else
                               open_of[chunk].push_back({name_of(mesh, a, b, at), i, k});
                       }
                   }
               });

    std::vector<open_end> open = base::flattened(std::move(open_of));
    base::parallel_sort(open, [](const open_end& x, const open_end& y) { return x.name < y.name; });
    std::vector<std::size_t> first;  // of each name
    base::compact(
        open.size(), [&](std::size_t i) { return i == 0 || open[i].name != open[i - 1].name; },
        [&](std::size_t count) { first.resize(count + 1, open.size()); },
        [&](std::size_t i, std::size_t place) { first[place] = i; });
    const std::size_t names = first.size() - 1;
    base::resize_all(names, result.names, result.points);
    for_chunks(names, pair_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t n = begin; n < end; ++n) {
            result.names[n] = open[first[n]].name;
            result.points[n] = point_of(mesh, result.names[n]);
            for (std::size_t i = first[n]; i < first[n + 1]; ++i)
                result.meetings[open[i].meeting].ends[open[i].end].point =
                    static_cast<std::uint32_t>(mesh.points.size() + n);
        }
    });
    return result;
}

aabb<double, 3> box_of_meeting(mesh_view mesh, const face_pair& pair) {
    const triangle_contact common =
        treeform::intersect(triangle_of(mesh, pair.a), triangle_of(mesh, pair.b));
    aabb<double, 3> box;
    for (std::uint8_t k = 0; k < common.count; ++k) {
        const feature_pair at = common.ends[k];
        if (geometry::is_corner(at.on_a))
            box.include(mesh.points[mesh.faces[pair.a][place_of(at.on_a)]]);
        else if (geometry::is_corner(at.on_b))
            box.include(mesh.points[mesh.faces[pair.b][place_of(at.on_b)]]);
        else
            box.include(exact::box_around(point_of(mesh, name_of(mesh, pair.a, pair.b, at))));
    }
    return box;
}

}  // namespace treeform::detail::intersect
