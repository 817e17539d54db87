#include <libmesh/arrange/arrange_pairs.hpp>
#include <libmesh/arrange/patch_regions.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/manifold_pair.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/region_graph.hpp>
#include <libmesh/boolean/way_out.hpp>
#include <libmesh/boolean/winding_beside.hpp>
#include <treeform/tree/detail/box_in_space.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {
namespace {

using arrange::surface_patches;
using ids = std::vector<std::uint32_t>;

constexpr std::size_t questions_a_chunk = 64;

/// How often both operands wind around places beside their faces.
class pair_windings {
  public:
    struct beside_face {
        bool in_front;  ///< of the face, or behind it
        std::array<std::int64_t, 2> of{};

        /// Those that are not 0: there may be no second operand.
        [[nodiscard]] std::vector<operand_winding> windings() const {
            std::vector<operand_winding> result;
            for (std::uint32_t k = 0; k < 2; ++k)
                if (of[k] != 0) result.push_back({k, of[k]});
            return result;
        }
    };

    explicit pair_windings(const prepared_pair& operands) {
        for (std::size_t k = 0; k < 2; ++k) {
            meshes_[k] = operands[k]->view();
            trees_[k] = &build_face_tree(*operands[k]);
            if (!meshes_[k].faces.empty()) box_.include(box_of_root(*trees_[k]));
        }
    }

    /// On one side of face f of operand k.
    [[nodiscard]] beside_face at(std::size_t k, std::uint32_t f) const {
        const triangle3 whole = base::triangle_of(meshes_[k], f);
        return follow(find_way_out({whole[0], whole[1], whole[2]}, whole, box_));
    }
    /// On one side of a face of an arrangement of `local`.
    [[nodiscard]] beside_face at(mesh_view local, const mesh_arrangement& cut,
                                 std::uint32_t f) const {
        return follow(find_way_out(local, cut, f, box_));
    }

  private:
    [[nodiscard]] beside_face follow(const way_out& out) const {
        const aabb<double, 3> way = way_along(out.line, out.ahead);
        beside_face found{(out.line.faces() > 0) == out.ahead};
        for (std::size_t k = 0; k < 2; ++k)
            found.of[k] = winding_beside(
                *trees_[k], [&](std::uint32_t i) { return base::triangle_of(meshes_[k], i); },
                out.line, way, out.ahead);
        return found;
    }

    std::array<mesh_view, 2> meshes_{};
    std::array<const tree<3>*, 2> trees_{};
    aabb<double, 3> box_{};
};

/// The faces of the arrangement that bound the result; none where one of the operands is open.
std::optional<round::solid_faces> choose_near(const near_faces& near, const mesh_arrangement& cut,
                                              const pair_windings& windings,
                                              const partial_expression& at_nowhere) {
    ids operand_of_face(near.local.faces.size(), 1);
    std::fill_n(operand_of_face.begin(), near.first_of_b, 0U);
    // A face that is cut is near together with all at its edges. So faces are missing only where a
    // whole one ends.
    const auto judge = [](const std::array<std::uint32_t, 2>&,
                          std::span<const arrange::face_side> sides) {
        return sides.size() == 1 ? arrange::edge_use::nothing : arrange::edge_use::all;
    };
    const surface_patches patches = arrange::find_patches(cut, operand_of_face, judge);
    if (patches.open_count > 0) return std::nullopt;
    arrange::patch_regions joined(patches);
    joined.join_about_edges(near.local, cut);
    const region_graph regions(cut, operand_of_face, patches, joined.number());

    const buffer<std::uint32_t> group = regions.groups();
    ids asked;  // the first patch of each group
    std::vector<std::uint8_t> is_asked(regions.size(), 0);
    for (std::uint32_t p = 0; p < patches.count(); ++p)
        if (auto& seen = is_asked[group[regions.patches().front(p)]]; seen == 0) {
            seen = 1;
            asked.push_back(p);
        }
    std::vector<std::uint8_t> inside(regions.size(), 0);
    for_chunks(
        asked.size(), questions_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
            partial_expression state = at_nowhere;
            for (std::size_t i = begin; i < end; ++i) {
                const std::uint32_t p = asked[i];
                const auto found = windings.at(near.local, cut, patches.first_face(p));
                regions.spread(
                    {found.in_front ? regions.patches().front(p) : regions.patches().behind(p),
                     found.windings()},
                    state, inside);
            }
        });
    arrangement_cells cells;
    cells.cell_of_side.resize(cut.faces.size());
    for_chunks(cut.faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f) {
            const std::uint32_t p = patches.patch[f];
            cells.cell_of_side[f] = {regions.patches().front(p), regions.patches().behind(p)};
        }
    });
    return round::faces_around(cut, cells, inside);
}

/// What becomes of faces of operand k as face f, which is not near.
fate fate_of(std::size_t k, std::uint32_t f, const pair_windings& windings,
             partial_expression& state) {
    const auto found = windings.at(k, f);
    const auto operand = static_cast<std::uint32_t>(k);
    const auto add = [&](std::uint32_t which, std::int64_t change) {
        state.add(which, winding_range::only(change));
    };
    const std::vector<operand_winding> around = found.windings();
    const std::int64_t across = found.in_front ? 1 : -1;  // more of k on the other side
    for (const auto& [which, winding] : around) add(which, winding);
    const bool here = *state.value();
    add(operand, across);
    const bool there = *state.value();
    add(operand, -across);
    for (const auto& [which, winding] : around) add(which, -winding);
    if (here == there) return fate::dropped;
    return there == found.in_front ? fate::kept : fate::turned;
}

/// Writes down what becomes of the faces of operand k.
void find_fates(std::size_t k, mesh_view mesh, const face_place* place,
                const pair_windings& windings, const partial_expression& at_nowhere, fate* fates) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    // Where faces that are not near have a common point, no face at the point is cut.
    base::union_find alike(mesh.points.size());
    for_chunks(mesh.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t f = begin; f < end; ++f) {
                       if (place[f] == face_place::near) continue;
                       const auto& [a, b, c] = mesh.faces[f];
                       alike.join(a, b);
                       alike.join(a, c);
                   }
               });
    const buffer<std::uint32_t> root = alike.take_roots();
    ids set_of_root(root.size(), none), first_face;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        if (place[f] == face_place::near) continue;
        std::uint32_t& set = set_of_root[root[mesh.faces[f][0]]];
        if (set != none) continue;
        set = static_cast<std::uint32_t>(first_face.size());
        first_face.push_back(f);
    }
    std::vector<fate> fate_of_set(first_face.size());
    for_chunks(first_face.size(), questions_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   partial_expression state = at_nowhere;
                   for (std::size_t i = begin; i < end; ++i)
                       fate_of_set[i] = fate_of(k, first_face[i], windings, state);
               });
    for_chunks(mesh.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t f = begin; f < end; ++f)
                       fates[f] = place[f] == face_place::near
                                      ? fate::cut
                                      : fate_of_set[set_of_root[root[mesh.faces[f][0]]]];
               });
}

}  // namespace

std::optional<pair_result> boolean_of_manifold_pair(const prepared_pair& operands,
                                                    const own_pairs& own, bool once,
                                                    const boolean_expression& expression,
                                                    const boolean_options& options) {
    if (options.precision == precision::float32 || options.volumes ||
        !can_be_counted_through(operands))
        return std::nullopt;
    pair_result made;
    if (!made.goes_on(options.progress, 0.1)) return made;
    near_faces near = find_near_faces(operands, own, once);
    if (!made.goes_on(options.progress, 0.4)) return made;
    arrange_faces_result arranged = arrange::arrange_pairs(near.local, near.pairs, {}, {});
    if (!made.goes_on(options.progress, 0.5)) return made;
    const pair_windings windings(operands);
    const partial_expression at_nowhere(expression, options.inside);
    auto chosen = choose_near(near, arranged.cut, windings, at_nowhere);
    if (!chosen) return std::nullopt;
    near.local.points = {};
    if (!made.goes_on(options.progress, 0.6)) return made;
    buffer<fate> fates(near.place.size());
    std::size_t first = 0;
    for (std::size_t k = 0; k < 2; ++k) {
        const mesh_view mesh = operands[k]->view();
        find_fates(k, mesh, near.place.data() + first, windings, at_nowhere, fates.data() + first);
        first += mesh.faces.size();
    }
    return surface_of_pair(operands, near, arranged, std::move(*chosen), fates, options);
}

}  // namespace treeform::detail::boolean
