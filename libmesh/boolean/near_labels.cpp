#include <libmesh/arrange/escape_ray.hpp>
#include <libmesh/arrange/patch_regions.hpp>
#include <libmesh/arrange/winding_beside.hpp>
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/near_labels.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/volumes_by_kind.hpp>
#include <treeform/tree/detail/box_in_space.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace treeform::detail::boolean {
namespace {

using arrange::surface_patches;
using ids = std::vector<std::uint32_t>;

constexpr std::size_t labels_a_chunk = 64, ways_a_chunk = 2;

/// How often operands wind around places beside their faces.
class line_windings {
  public:
    line_windings(const bundles& operands, const undecided_part* part)
        : operands_(operands), part_(part) {
        if (part != nullptr) box_ = part->components().box();
        for (std::size_t k = 0; k < 2; ++k) {
            trees_[k] = &build_face_tree(*operands[k].mesh);
            if (!operands[k].view().faces.empty()) box_.include(box_of_root(*trees_[k]));
        }
    }

    struct beside_face {
        bool in_front;                      ///< of the face, or behind it
        std::vector<operand_winding> of{};  ///< those that are not 0
    };
    /// On one side of face f of bundle k.
    [[nodiscard]] beside_face at(std::size_t k, std::uint32_t f) const {
        const triangle3 whole = base::triangle_of(operands_[k].view(), f);
        return follow(arrange::find_escape_ray({whole[0], whole[1], whole[2]}, whole, box_));
    }
    /// On one side of a face of an arrangement of `local`.
    [[nodiscard]] beside_face at(mesh_view local, const mesh_arrangement& cut,
                                 std::uint32_t f) const {
        return follow(arrange::find_escape_ray(local, cut, f, box_));
    }

  private:
    [[nodiscard]] beside_face follow(const arrange::escape_ray& out) const {
        const aabb<double, 3> way = arrange::way_along(out.line, out.ahead);
        beside_face found{(out.line.faces() > 0) == out.ahead};
        if (part_ != nullptr) {
            found.of = part_->components().windings_beside(out.line, out.ahead);
            return found;
        }
        for (std::size_t k = 0; k < 2; ++k) {
            const mesh_view mesh = operands_[k].view();
            arrange::visit_beside(
                *trees_[k], [&](std::uint32_t i) { return base::triangle_of(mesh, i); }, out.line,
                way, out.ahead,
                [&](std::uint32_t i, int change) {
                    add(found.of, operands_[k].operand_of(i), change);
                });
        }
        std::erase_if(found.of, [](const operand_winding& w) { return w.winding == 0; });
        return found;
    }

    static void add(std::vector<operand_winding>& to, std::uint32_t operand, int change) {
        const auto at = std::ranges::lower_bound(to, operand, {}, &operand_winding::operand);
        if (at != to.end() && at->operand == operand)
            at->winding += change;
        else
            to.insert(at, {operand, change});
    }

    const bundles& operands_;
    const undecided_part* part_;
    std::array<const tree<3>*, 2> trees_{};
    aabb<double, 3> box_{};
};

ids operands_of(const bundles& operands, const interaction_zone& near) {
    const std::size_t faces_of_a = operands[0].view().faces.size();
    ids result(near.face_of.size());
    for (std::size_t f = 0; f < result.size(); ++f)
        result[f] = f < near.first_of_b ? operands[0].operand_of(near.face_of[f])
                                        : operands[1].operand_of(near.face_of[f] - faces_of_a);
    return result;
}

/// A face that is cut is near together with all at its edges, and so are all at an edge of other
/// than two. So faces are missing only where a whole one ends, or out of undecided space.
surface_patches patches_of(const mesh_arrangement& cut, const ids& operand_of_face,
                           const undecided_places& places) {
    return arrange::find_closed_patches(
        cut, operand_of_face,
        [&](const std::array<std::uint32_t, 2>& points, std::span<const arrange::face_side> sides) {
            return places.use_of(points, sides);
        });
}

arrange::numbered_sets regions_of(mesh_view local, const mesh_arrangement& cut,
                                  const surface_patches& patches, const undecided_places& places) {
    arrange::patch_regions joined(patches);
    joined.join_about_edges(local, cut, places.is_within());
    return joined.number();
}

}  // namespace

near_labels::near_labels(const bundles& operands, const interaction_zone& near,
                         const mesh_arrangement& cut, std::array<far_faces, 2> far,
                         const undecided_part* part)
    : operands_(operands),
      cut_(cut),
      operand_of_face_(operands_of(operands, near)),
      places_(cut, part == nullptr ? nullptr : &part->space()),
      patches_(patches_of(cut, operand_of_face_, places_)),
      regions_(cut, operand_of_face_, patches_, regions_of(near.local, cut, patches_, places_)),
      is_hidden_(places_.hidden(patches_)),
      far_(std::move(far)) {
    const line_windings windings(operands, part);
    const buffer<std::uint32_t> group = regions_.groups();
    ids asked;  // the first patch of each group
    std::vector<std::uint8_t> is_asked(regions_.size(), 0);
    for (std::uint32_t p = 0; p < patches_.count(); ++p)
        if (is_hidden_[p] == 0 &&
            std::exchange(is_asked[group[regions_.patches().front(p)]], std::uint8_t{1}) == 0)
            asked.push_back(p);
    seeds_.resize(asked.size());
    for_chunks(asked.size(), ways_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t p = asked[i];
            auto [in_front, of] = windings.at(near.local, cut, patches_.first_face(p));
            seeds_[i] = {in_front ? regions_.patches().front(p) : regions_.patches().behind(p),
                         std::move(of)};
        }
    });
    for (std::size_t k = 0; k < 2; ++k) {
        const auto faces = far_[k].faces();
        sides_[k].resize(faces.size());
        for_chunks(
            faces.size(), ways_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
                for (std::size_t i = begin; i < end; ++i) {
                    auto [in_front, of] = windings.at(k, faces[i]);
                    sides_[k][i] = {in_front, operands[k].operand_of(faces[i]), std::move(of)};
                }
            });
    }
}

near_labels::insides near_labels::insides_of(const boolean_expression& expression,
                                             fill_rule rule) const {
    const partial_expression at_nowhere(expression, rule);
    insides result;
    result.regions.resize(regions_.size(), 0);
    for_chunks(seeds_.size(), labels_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        partial_expression state = at_nowhere;
        for (std::size_t i = begin; i < end; ++i) regions_.spread(seeds_[i], state, result.regions);
    });
    for (std::size_t k = 0; k < 2; ++k) {
        result.sets[k].resize(sides_[k].size());
        for_chunks(sides_[k].size(), labels_a_chunk,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       partial_expression state = at_nowhere;
                       for (std::size_t i = begin; i < end; ++i) {
                           const far_side& side = sides_[k][i];
                           const auto add = [&](std::uint32_t operand, std::int64_t change) {
                               state.add(operand, winding_range::only(change));
                           };
                           for (const auto& [operand, winding] : side.windings)
                               add(operand, winding);
                           const bool here = *state.value();
                           const std::int64_t across = side.in_front ? 1 : -1;
                           add(side.operand, across);
                           const bool there = *state.value();
                           add(side.operand, -across);
                           for (const auto& [operand, winding] : side.windings)
                               add(operand, -winding);
                           result.sets[k][i] = {side.in_front ? here : there,
                                                side.in_front ? there : here};
                       }
                   });
    }
    return result;
}

chosen_surface near_labels::choose(const boolean_expression& expression, fill_rule rule) const {
    const insides inside = insides_of(expression, rule);
    chosen_surface result;
    arrangement_cells cells;
    cells.cell_of_side.resize(cut_.faces.size());
    for_chunks(cut_.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t f = begin; f < end; ++f) {
                       const std::uint32_t p = patches_.patch[f];
                       const std::uint32_t front = regions_.patches().front(p);
                       cells.cell_of_side[f] = {
                           front, is_hidden_[p] != 0 ? front : regions_.patches().behind(p)};
                   }
               });
    result.near = round::faces_around(cut_, cells, inside.regions);

    const std::array faces{operands_[0].view().faces.size(), operands_[1].view().faces.size()};
    result.dispositions = buffer<disposition>(faces[0] + faces[1]);
    for_chunks(result.dispositions.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   std::fill(result.dispositions.data() + begin, result.dispositions.data() + end,
                             disposition::cut);
               });
    for (std::size_t k = 0; k < 2; ++k) {
        std::vector<disposition> of_set;
        for (const auto& [front, behind] : inside.sets[k])
            of_set.push_back(front == behind ? disposition::dropped
                             : behind != 0   ? disposition::kept
                                             : disposition::turned);
        far_[k].write(std::span<const disposition>(of_set),
                      result.dispositions.data() + (k == 0 ? 0 : faces[0]));
    }
    return result;
}

operand_volumes near_labels::volumes(fill_rule rule) const {
    const std::array in{insides_of({"a", 2}, rule), insides_of({"b", 2}, rule)};
    volumes_by_kind volumes;
    const auto kind = [&](const auto& is_in) {  // `is_in(k, s)` side s, of a face
        const auto of = [&](std::size_t s) { return std::array{is_in(0, s), is_in(1, s)}; };
        return volumes_by_kind::kind_of(of(0), of(1));
    };
    std::vector<point3> points = cut_.given_points;
    for (const implicit_point& p : cut_.constructed) points.push_back(p.center());
    std::vector<std::uint8_t> of_patch(patches_.count());
    for (std::uint32_t p = 0; p < of_patch.size(); ++p) {
        const std::array regions{regions_.patches().front(p), regions_.patches().behind(p)};
        of_patch[p] = kind([&](std::size_t k, std::size_t s) { return in[k].regions[regions[s]]; });
    }
    volumes.add({points, cut_.faces}, [&](std::size_t f) { return of_patch[patches_.patch[f]]; });
    for (std::size_t k = 0; k < 2; ++k) {
        std::vector<std::uint8_t> of_set(sides_[k].size());
        for (std::size_t i = 0; i < of_set.size(); ++i)
            of_set[i] = kind([&](std::size_t o, std::size_t s) { return in[o].sets[k][i][s]; });
        std::vector<std::uint8_t> of_face(operands_[k].view().faces.size(),
                                          volumes_by_kind::of_nothing);  // where it is near
        far_[k].write(std::span<const std::uint8_t>(of_set), of_face.data());
        volumes.add(operands_[k].view(), [&](std::size_t f) { return of_face[f]; });
    }
    const std::array<double, 3> six = volumes.six();
    operand_volumes result;
    result.first = six[0] / 6.0;
    result.second = six[1] / 6.0;
    result.both = six[2] / 6.0;
    // No smaller than either operand's, so little of it cancels.
    result.either = result.first - result.both + result.second;
    return result;
}

}  // namespace treeform::detail::boolean
