#include <libmesh/arrange/arrange_pairs.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/double_double.hpp>
#include <libmesh/boolean/near_faces.hpp>
#include <libmesh/boolean/pair_surface.hpp>
#include <libmesh/boolean/propagate_inside.hpp>
#include <libmesh/boolean/sound_pair.hpp>
#include <libmesh/boolean/sum_of_cones.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace treeform::detail::boolean {
namespace {

/// The solid that an expression makes of two.
class choice {
  public:
    explicit choice(const boolean_expression& expression) {
        for (std::size_t i = 0; i < 4; ++i) {
            const std::array<bool, 2> in{(i & 1) != 0, (i & 2) != 0};
            solid_[i] = expression(in);
        }
    }

    /// By the operands that hold what is in front of the face and what is behind it, as bits.
    [[nodiscard]] fate operator()(unsigned front, unsigned behind) const {
        if (solid_[front] == solid_[behind]) return fate::dropped;
        return solid_[behind] ? fate::kept : fate::turned;
    }
    /// Of a face that one operand covers.
    [[nodiscard]] fate of(std::size_t operand, bool in_other) const {
        const unsigned own = 1U << operand;
        const unsigned other = in_other ? 3U - own : 0U;
        return (*this)(other, other | own);
    }

  private:
    std::array<bool, 4> solid_{};
};

face turned_if(bool turn, const face& f) { return turn ? face{f[0], f[2], f[1]} : f; }

fate choice_of(const near_faces& near, const mesh_arrangement& cut, std::size_t f, bool inside,
               const choice& choice) {
    const auto covers = cut.covers_of(f);
    if (covers.size() == 1) return choice.of(near.operand_of(covers[0].face), inside);
    unsigned front = 0, behind = 0;
    for (const covering_face& cover : covers)
        (cover.opposite ? front : behind) |= 1U << near.operand_of(cover.face);
    return choice(front, behind);
}

round::solid_faces choose(const near_faces& near, const mesh_arrangement& cut,
                          const std::vector<std::uint8_t>& inside, const choice& choice) {
    const auto kept_of = [&](std::size_t f) {
        return choice_of(near, cut, f, inside[f] != 0, choice);
    };
    round::solid_faces result;
    base::compact(
        cut.faces.size(), [&](std::size_t f) { return kept_of(f) != fate::dropped; },
        [&](std::size_t count) {
            result.faces.resize(count);
            result.face_of.resize(count);
        },
        [&](std::size_t f, std::size_t place) {
            result.faces[place] = turned_if(kept_of(f) == fate::turned, cut.faces[f]);
            result.face_of[place] = static_cast<std::uint32_t>(f);
        });
    return result;
}

/// The volume in common is summed over the faces around it, from the points as approximated; the
/// union's follows, and is no smaller than either operand's, so little of it cancels.
operand_volumes find_volumes(const prepared_pair& pair, const near_faces& near,
                             const mesh_arrangement& cut, const std::vector<std::uint8_t>& inside) {
    const choice common(boolean_expression::intersection_of(2));
    const auto at = [&](std::uint32_t p) {
        const std::size_t given = cut.given_points.size();
        return p < given ? cut.given_points[p] : cut.constructed[p - given].center();
    };
    operand_volumes volumes;
    base::double_double both = sum_of_cones(cut.faces.size(), [&](std::size_t f) {
        const fate side = choice_of(near, cut, f, inside[f] != 0, common);
        if (side == fate::dropped) return base::double_double{};
        const auto [p, q, r] = turned_if(side == fate::turned, cut.faces[f]);
        return base::determinant(at(p), at(q), at(r));
    });
    std::size_t first = 0;
    for (std::size_t k = 0; k < 2; ++k) {
        const mesh_view mesh = pair[k]->view();
        both = both + sum_of_cones(mesh.faces.size(), [&](std::size_t f) {
                   if (near.place[first + f] != face_place::inside) return base::double_double{};
                   const auto& [p, q, r] = mesh.faces[f];
                   return base::determinant(mesh.points[p], mesh.points[q], mesh.points[r]);
               });
        (k == 0 ? volumes.first : volumes.second) = signed_volume(mesh);
        first += mesh.faces.size();
    }
    volumes.both = both.high / 6.0;
    volumes.either = volumes.first - volumes.both + volumes.second;
    return volumes;
}

/// Of all faces of both operands, counted through.
buffer<fate> fates_of(const near_faces& near, std::size_t faces_of_a, const choice& choice) {
    buffer<fate> fates(near.place.size());
    std::array<std::array<fate, 3>, 2> of_place{};
    for (std::size_t k = 0; k < 2; ++k)
        for (const face_place place : {face_place::outside, face_place::inside})
            of_place[k][static_cast<std::size_t>(place)] =
                choice.of(k, place == face_place::inside);
    for_chunks(fates.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f)
            fates[f] = of_place[f < faces_of_a ? 0 : 1][static_cast<std::size_t>(near.place[f])];
    });
    return fates;
}

}  // namespace

std::optional<pair_result> boolean_of_sound_pair(const prepared_pair& pair, bool once,
                                                 const boolean_expression& expression,
                                                 const boolean_options& options) {
    const std::array operands{pair[0]->view(), pair[1]->view()};
    if (options.precision == precision::float32 || !can_be_counted_through(pair))
        return std::nullopt;
    pair_result made;
    if (!made.goes_on(options.progress, 0.1)) return made;
    near_faces near = find_near_faces(pair, once);
    if (!made.goes_on(options.progress, 0.4)) return made;
    arrange_faces_result arranged = arrange::arrange_pairs(near.local, near.pairs, {}, {});
    mesh_arrangement& cut = arranged.cut;
    auto inside = find_insides(pair, near, cut);
    if (!inside) return std::nullopt;
    std::optional<operand_volumes> volumes;
    if (options.volumes) volumes = find_volumes(pair, near, cut, *inside);
    near.local.points = {};  // as large as the operands, perhaps
    if (!made.goes_on(options.progress, 0.6)) return made;

    const choice choice(expression);
    round::solid_faces chosen = choose(near, cut, *inside, choice);
    inside.reset();
    const buffer<fate> fates = fates_of(near, operands[0].faces.size(), choice);
    auto surface = surface_of_pair(pair, near, arranged, std::move(chosen), fates, options);
    if (surface) surface->result.volumes = volumes;
    return surface;
}

}  // namespace treeform::detail::boolean
