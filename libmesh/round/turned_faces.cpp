#include <libmesh/arrange/escape_ray.hpp>
#include <libmesh/arrange/winding_beside.hpp>
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/round/turned_faces.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/box_in_space.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>

namespace treeform::detail::round {
namespace {

constexpr std::size_t parts_a_chunk = 16;

/// The parts of faces near those that have moved, as far as they are near, without those that have
/// a face that holds them: each face's place, after the lowest of its part; ascending.
///
/// All that are not near hold. Where an edge is one of theirs, no box of a face that has moved
/// meets it, and what is near and has the edge is held there, too: so are both faces at an edge of
/// which others have been left out.
std::vector<std::array<std::uint32_t, 2>> loose_parts(const near_edges& near) {
    const std::size_t count = near.faces().size();
    base::union_find sets(count);
    near.for_each([&](std::span<const near_edges::use> at) {
        if (at.size() == 2) sets.join(at[0].place, at[1].place);
    });
    std::vector<std::uint8_t> held(count, 0);
    near.for_each([&](std::span<const near_edges::use> at) {
        if (at.size() == 1)
            std::atomic_ref(held[sets.root(at[0].place)]).store(1, std::memory_order_relaxed);
    });
    std::vector<std::array<std::uint32_t, 2>> loose;
    for (std::uint32_t i = 0; i < count; ++i)
        if (const std::uint32_t part = sets.root(i); held[part] == 0) loose.push_back({part, i});
    std::sort(loose.begin(), loose.end());
    return loose;
}

}  // namespace

std::vector<std::uint32_t> find_turned_faces(mesh_view surface, const near_edges& near,
                                             const winding_of_rest& rest) {
    const auto loose = loose_parts(near);
    if (loose.empty()) return {};
    std::vector<std::size_t> first;  // of each part
    for (std::size_t i = 0; i < loose.size(); ++i)
        if (i == 0 || loose[i][0] != loose[i - 1][0]) first.push_back(i);
    first.push_back(loose.size());
    const tree<3> tree = build_face_tree(surface);
    const aabb<double, 3> box = box_of_root(tree);
    const auto corners = [&](std::uint32_t f) { return base::triangle_of(surface, f); };
    std::vector<std::uint8_t> is_turned(first.size() - 1, 0);
    for_chunks(
        is_turned.size(), parts_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t part = begin; part < end; ++part) {
                const triangle3 t = corners(near.faces()[loose[first[part]][1]]);
                const auto [line, ahead] = arrange::find_escape_ray({t[0], t[1], t[2]}, t, box);
                std::int64_t winding = arrange::winding_beside(
                    tree, corners, line, arrange::way_along(line, ahead), ahead);
                if (rest) winding += rest(line, ahead);
                const bool in_front = (line.faces() > 0) == ahead;
                is_turned[part] = winding != (in_front ? 0 : 1);
            }
        });
    std::vector<std::uint32_t> turned;
    for (std::size_t part = 0; part < is_turned.size(); ++part)
        for (std::size_t i = first[part]; is_turned[part] != 0 && i < first[part + 1]; ++i)
            turned.push_back(near.faces()[loose[i][1]]);
    std::sort(turned.begin(), turned.end());
    return turned;
}

}  // namespace treeform::detail::round
