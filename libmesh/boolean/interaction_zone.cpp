#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/face_boxes.hpp>
#include <libmesh/base/parallel_sort.hpp>
#include <libmesh/boolean/interaction_zone.hpp>
#include <libmesh/intersect/classify_pair.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search_pair.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <utility>

namespace treeform::detail::boolean {
namespace {

using ids = std::vector<std::uint32_t>;

constexpr std::size_t near_grain = std::size_t{1} << 10;  // faces a chunk
constexpr std::size_t pair_grain = std::size_t{1} << 8;

void mark(std::uint8_t& mark) { std::atomic_ref(mark).store(1, std::memory_order_relaxed); }

/// Marks the faces whose boxes overlap that of a face that meets another one, or of a point without
/// a fan.
void mark_near(const bundles& operands, const std::vector<face_pair>& across,
               interaction_zone& result) {
    std::vector<aabb<double, 3>> reach;
    for (std::size_t k = 0; k < 2; ++k) {
        const mesh_view mesh = operands[k].view();
        std::vector<std::uint8_t> meets(mesh.faces.size(), 0);
        for_chunks(across.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t i = begin; i < end; ++i)
                           mark(meets[k == 0 ? across[i].a : across[i].b]);
                   });
        for (const face_pair& pair : operands[k].pairs) meets[pair.a] = meets[pair.b] = 1;
        const std::size_t first = reach.size();
        base::compact(
            meets.size(), [&](std::size_t f) { return meets[f] != 0; },
            [&](std::size_t count) { reach.resize(first + count); },
            [&](std::size_t f, std::size_t place) {
                reach[first + place] = base::face_boxes(mesh.points)(mesh.faces[f]);
            });
        for (const std::uint32_t p : operands[k].known->without_fan)
            reach.emplace_back().include(mesh.points[p]);
    }
    const tree<3> around = build(reach, [](const aabb<double, 3>& box) { return box; });
    for_chunks(2, 1, [&](std::size_t k, std::size_t, std::size_t) {
        const tree<3>& tree = build_face_tree(*operands[k].mesh);
        result.is_near[k].resize(tree.size(), 0);
        (void)search_broad<int>(tree, around, [&](int&, const candidate_block& block) {
            for (const std::uint32_t place : block.first) mark(result.is_near[k][place]);
        });
    });
}

/// Appends the points of `faces`, ascending, and the faces in their numbers.
void append(mesh_view mesh, const ids& faces, std::uint32_t points_before,
            std::uint32_t faces_before, interaction_zone& result) {
    buffer<std::uint32_t> number(mesh.points.size());
    for_chunks(number.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::fill(number.data() + begin, number.data() + end, 0U);
    });
    for_chunks(faces.size(), near_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            for (const std::uint32_t corner : mesh.faces[faces[i]])
                std::atomic_ref(number[corner]).store(1, std::memory_order_relaxed);
    });
    const std::size_t points = result.local.points.size();
    base::compact(
        number.size(), [&](std::size_t p) { return number[p] != 0; },
        [&](std::size_t count) {
            result.local.points.resize(points + count);
            result.point_of.resize(points + count);
        },
        [&](std::size_t p, std::size_t place) {
            number[p] = static_cast<std::uint32_t>(points + place);
            result.local.points[points + place] = mesh.points[p];
            result.point_of[points + place] = points_before + static_cast<std::uint32_t>(p);
        });
    const std::size_t first = result.local.faces.size();
    result.local.faces.resize(first + faces.size());
    result.face_of.resize(first + faces.size());
    for_chunks(faces.size(), near_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& [a, b, c] = mesh.faces[faces[i]];
            result.local.faces[first + i] = {number[a], number[b], number[c]};
            result.face_of[first + i] = faces_before + faces[i];
        }
    });
}

/// Points of the second operand become those of the first that they are equal to.
void join_equal(interaction_zone& near) {
    mesh& local = near.local;
    const auto equal = weld::few_equal_points(local.points);
    if (!equal) return;
    const std::size_t count = equal->first_of_group.size();
    for (std::size_t p = 0; p < count; ++p) {
        local.points[p] = local.points[equal->first_of_group[p]];
        near.point_of[p] = near.point_of[equal->first_of_group[p]];
    }
    local.points.resize(count);
    near.point_of.resize(count);
    for_chunks(local.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t f = begin; f < end; ++f)
                       for (std::uint32_t& corner : local.faces[f])
                           corner = equal->group_of_point[corner];
               });
}

/// The pairs by local faces, ascending, without those that meet in shared corners only.
void keep_pairs(std::vector<face_pair>&& across, const bundles& operands, interaction_zone& near) {
    const std::size_t faces_of_a = operands[0].view().faces.size();
    const auto local = [&](std::size_t face) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(near.face_of, face) -
                                          near.face_of.begin());
    };
    predicate_counters counters;
    for_chunks(across.size(), pair_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            across[i] = {local(across[i].a), local(faces_of_a + across[i].b), across[i].kind};
    });
    std::size_t left = 0;
    for (face_pair pair : across) {
        const face &f = near.local.faces[pair.a], &g = near.local.faces[pair.b];
        if (std::find_first_of(f.begin(), f.end(), g.begin(), g.end()) != f.end()) {
            const auto kind = intersect::classify_pair(near.local.points, f, g, counters);
            if (!kind) continue;
            pair.kind = *kind;
        }
        across[left++] = pair;
    }
    across.resize(left);
    for (std::size_t k = 0; k < 2; ++k)
        for (const auto& [a, b, kind] : operands[k].pairs)
            across.push_back(
                {local((k == 0 ? 0 : faces_of_a) + a), local((k == 0 ? 0 : faces_of_a) + b), kind});
    if (across.size() > left) base::parallel_sort(across);
    near.pairs = std::move(across);
}

void find_own_pairs_of_second(interaction_zone& near) {
    const std::span<const face> faces = near.local.faces;
    const face_pair_result found =
        self_intersections({near.local.points, faces.subspan(near.first_of_b)},
                           {.vertices = vertex_identity::by_index});
    for (const auto& [a, b, kind] : found.pairs)
        near.pairs.push_back({a + near.first_of_b, b + near.first_of_b, kind});
    std::sort(near.pairs.begin(), near.pairs.end());
}

std::vector<face_pair> pairs_across(const bundles& operands, bool single_use) {
    const prepared_mesh &a = *operands[0].mesh, &b = *operands[1].mesh;
    if (a.indexed_view().faces.empty() || b.indexed_view().faces.empty()) return {};
    if (!single_use) return treeform::mesh_intersections(a, b).pairs;
    return intersect::mesh_intersections(a.indexed_view(), build_face_tree(a), b.indexed_view(),
                                         build_face_tree(b))
        .pairs;
}

}  // namespace

interaction_zone find_interaction_zone(const bundles& operands, bool single_use, bool all) {
    interaction_zone result;
    std::vector<face_pair> across = pairs_across(operands, single_use);
    if (all)
        for (std::size_t k = 0; k < 2; ++k)
            result.is_near[k].resize(operands[k].view().faces.size(), 1);
    else
        mark_near(operands, across, result);
    std::array<ids, 2> near;
    for_chunks(2, 1, [&](std::size_t k, std::size_t, std::size_t) {
        const auto face_at = build_face_tree(*operands[k].mesh).ids();
        base::compact(
            face_at.size(), [&](std::size_t i) { return result.is_near[k][i] != 0; },
            [&](std::size_t count) { near[k].resize(count); },
            [&](std::size_t i, std::size_t place) { near[k][place] = face_at[i]; });
        base::parallel_sort(near[k]);
    });
    std::size_t first_face = 0, first_point = 0;
    for (std::size_t k = 0; k < 2; ++k) {
        const mesh_view mesh = operands[k].view();
        if (k == 1) result.first_of_b = static_cast<std::uint32_t>(result.local.faces.size());
        append(mesh, near[k], static_cast<std::uint32_t>(first_point),
               static_cast<std::uint32_t>(first_face), result);
        first_face += mesh.faces.size();
        first_point += mesh.points.size();
    }
    join_equal(result);
    keep_pairs(std::move(across), operands, result);
    if (!operands[1].has_pairs) find_own_pairs_of_second(result);
    return result;
}

ids numbers_as_given(const bundles& operands, const interaction_zone& near) {
    ids numbers(near.face_of.size());
    const std::size_t faces_of_a = operands[0].view().faces.size();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t k = near.face_of[i] < faces_of_a ? 0 : 1;
        const auto f = static_cast<std::uint32_t>(near.face_of[i] - (k == 0 ? 0 : faces_of_a));
        numbers[i] = operands[k].number_as_given(f);
        if (k == 1) numbers[i] += static_cast<std::uint32_t>(operands[0].count_as_given());
    }
    return numbers;
}

}  // namespace treeform::detail::boolean
