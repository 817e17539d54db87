#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/flattened.hpp>
#include <libmesh/base/parallel_invoke.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/round/coarse_grid.hpp>
#include <libmesh/round/near_edges.hpp>
#include <libmesh/round/surface_faults.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

namespace treeform::detail::round {
namespace {

using ids = std::vector<std::uint32_t>;

ids all_of(std::size_t count) {
    ids all(count);
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

void find_turned(mesh_view surface, const near_edges& near, const surface_check& check,
                 surface_faults& result) {
    if (!(check.moved > 0.0) || !result.pairs.empty() || !result.degenerate.empty() || result.open)
        return;
    result.turned = find_turned_faces(surface, near, check.rest);
}

surface_faults all_faults(mesh_view surface, const surface_check& check) {
    surface_faults result;
    face_pair_result found = self_intersections(
        surface, {.vertices = vertex_identity::by_index, .progress = check.progress});
    result.cancelled = found.status == treeform::status::cancelled;
    if (result.cancelled) return result;
    result.pairs = std::move(found.pairs);
    result.degenerate = find_invalid_faces(surface).degenerate_faces;
    result.open = check.solid && find_open_edge(surface).has_value();
    if (!check.solid) return result;
    const ids all = all_of(surface.faces.size());
    find_turned(surface, {surface, all}, check, result);
    return result;
}

std::vector<face> faces_of(mesh_view surface, const ids& which) {
    std::vector<face> faces;
    base::resize_all(which.size(), faces);
    for_chunks(which.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) faces[i] = surface.faces[which[i]];
    });
    return faces;
}

aabb<double, 3> box_of(points_view points, const face& f) {
    aabb<double, 3> box;
    for (const std::uint32_t corner : f) box.include(points[corner]);
    return box;
}

/// `doubted` and the faces whose boxes meet one of theirs, ascending: all others meet none of
/// them, not even in a corner.
ids with_neighbors(mesh_view surface, const ids& doubted, std::span<const std::uint8_t> certified) {
    const std::vector<face> asked = faces_of(surface, doubted);
    const tree<3> tree = build_face_tree({surface.points, asked});
    std::vector<aabb<double, 3>> boxes(chunk_count(asked.size(), light_grain));
    for_chunks(asked.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end; ++i)
            boxes[c].include(box_of(surface.points, asked[i]));
    });
    aabb<double, 3> reach;
    for (const auto& box : boxes) reach.include(box);
    coarse_grid grid(reach);  // tells of nearly all faces
    std::vector<coarse_grid::cell> cell;
    base::resize_all(surface.points.size(), cell);
    for_chunks(cell.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t p = begin; p < end; ++p) cell[p] = grid.cell_of(surface.points[p]);
    });
    for_chunks(asked.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            grid.add(cell[asked[i][0]], cell[asked[i][1]], cell[asked[i][2]]);
    });
    grid.finish();
    const auto is_near = [&](std::size_t f) {
        const auto& [a, b, c] = surface.faces[f];
        if (certified[f] == 0) return true;
        if (!grid.may_meet(cell[a], cell[b], cell[c])) return false;
        const auto box = box_of(surface.points, surface.faces[f]);
        return overlaps(box, reach) && search_any(tree, box, [](std::uint32_t) { return true; });
    };
    std::vector<ids> found(chunk_count(surface.faces.size(), light_grain));
    for_chunks(surface.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t c) {
                   for (std::size_t f = begin; f < end; ++f)
                       if (is_near(f)) found[c].push_back(static_cast<std::uint32_t>(f));
               });
    return base::flattened(std::move(found));
}

/// Whether an edge of a face that is not certified is open. At edges of certified faces alone
/// nothing has changed.
bool is_open(const near_edges& edges, std::span<const std::uint8_t> certified) {
    std::atomic<bool> open{false};
    edges.for_each([&](std::span<const near_edges::use> uses) {
        std::int64_t sum = 0;
        bool doubted = false;
        for (const near_edges::use& use : uses) {
            sum += use.way;
            doubted = doubted || certified[edges.faces()[use.place]] == 0;
        }
        if (doubted && sum != 0) open = true;
    });
    return open;
}

}  // namespace

surface_faults find_faults(mesh_view surface, const surface_check& check) {
    if (check.certified.empty()) return all_faults(surface, check);
    const std::size_t count = surface.faces.size();
    ids doubted;
    base::compact(
        count, [&](std::size_t f) { return check.certified[f] == 0; },
        [&](std::size_t found) { doubted.resize(found); },
        [&](std::size_t f, std::size_t place) { doubted[place] = static_cast<std::uint32_t>(f); });
    surface_faults result;
    if (doubted.empty()) return result;
    const ids near = doubted.size() > count / 2 ? all_of(count)
                                                : with_neighbors(surface, doubted, check.certified);
    const std::vector<face> faces = faces_of(surface, near);
    const mesh_view part{surface.points, faces};
    face_pair_result found;
    std::optional<near_edges> edges;
    base::parallel_invoke(
        [&] {
            found = self_intersections(
                part, {.vertices = vertex_identity::by_index, .progress = check.progress});
        },
        [&] { result.degenerate = find_invalid_faces(part).degenerate_faces; },
        [&] {
            if (check.solid) edges.emplace(surface, near);
        });
    result.cancelled = found.status == treeform::status::cancelled;
    if (result.cancelled) return result;
    for (const face_pair& pair : found.pairs)
        result.pairs.push_back({near[pair.a], near[pair.b], pair.kind});
    for (std::uint32_t& f : result.degenerate) f = near[f];
    if (!check.solid) return result;
    result.open = is_open(*edges, check.certified);
    find_turned(surface, *edges, check, result);
    return result;
}

}  // namespace treeform::detail::round
