#include <libmesh/arrange/arrange_pairs.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/double_double.hpp>
#include <libmesh/boolean/near_faces.hpp>
#include <libmesh/boolean/propagate_inside.hpp>
#include <libmesh/boolean/sound_pair.hpp>
#include <libmesh/boolean/sum_of_cones.hpp>
#include <libmesh/round/round_surface.hpp>
#include <libmesh/topology/is_manifold.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <utility>

namespace treeform::detail::boolean {
namespace {

using ids = std::vector<std::uint32_t>;

/// Which side of a face is in the solid, if one is.
enum class kept : std::uint8_t { no, as_it_is, turned };

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
    [[nodiscard]] kept operator()(unsigned front, unsigned behind) const {
        if (solid_[front] == solid_[behind]) return kept::no;
        return solid_[behind] ? kept::as_it_is : kept::turned;
    }
    /// Of a face that one operand covers.
    [[nodiscard]] kept of(std::size_t operand, bool in_other) const {
        const unsigned own = 1U << operand;
        const unsigned other = in_other ? 3U - own : 0U;
        return (*this)(other, other | own);
    }

  private:
    std::array<bool, 4> solid_{};
};

face turned_if(bool turn, const face& f) { return turn ? face{f[0], f[2], f[1]} : f; }

/// Faces of the arrangement that bound the solid.
struct chosen_faces {
    std::vector<face> faces;
    ids face_of;
};

kept choice_of(const near_faces& near, const mesh_arrangement& cut, std::size_t f, bool inside,
               const choice& choice) {
    const auto covers = cut.covers_of(f);
    if (covers.size() == 1) return choice.of(near.operand_of(covers[0].face), inside);
    unsigned front = 0, behind = 0;
    for (const covering_face& cover : covers)
        (cover.opposite ? front : behind) |= 1U << near.operand_of(cover.face);
    return choice(front, behind);
}

chosen_faces choose(const near_faces& near, const mesh_arrangement& cut,
                    const std::vector<std::uint8_t>& inside, const choice& choice) {
    const auto kept_of = [&](std::size_t f) {
        return choice_of(near, cut, f, inside[f] != 0, choice);
    };
    chosen_faces result;
    base::compact(
        cut.faces.size(), [&](std::size_t f) { return kept_of(f) != kept::no; },
        [&](std::size_t count) {
            result.faces.resize(count);
            result.face_of.resize(count);
        },
        [&](std::size_t f, std::size_t place) {
            result.faces[place] = turned_if(kept_of(f) == kept::turned, cut.faces[f]);
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
        const kept side = choice_of(near, cut, f, inside[f] != 0, common);
        if (side == kept::no) return base::double_double{};
        const auto [p, q, r] = turned_if(side == kept::turned, cut.faces[f]);
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

/// Puts together the faces that were looked at and those that need not be, of both operands counted
/// through.
class assembly {
  public:
    assembly(std::span<const mesh_view, 2> operands, const near_faces& near, const choice& choice)
        : operands_(operands),
          near_(near),
          keeps_{{{choice.of(0, false), choice.of(0, true)},
                  {choice.of(1, false), choice.of(1, true)}}},
          faces_{0, operands[0].faces.size(), operands[0].faces.size() + operands[1].faces.size()},
          points_{0, operands[0].points.size(),
                  operands[0].points.size() + operands[1].points.size()},
          number_(points_[2]) {}

    /// `source` are faces of operands, ascending, one for each face of `rounded`, whose points are
    /// those of `near_` and others. Returns the vertices of these in the result.
    ids write(const rounded_surface& rounded, const ids& source, boolean_result& result) {
        number_points(rounded, result);
        ids corner(rounded.point_of.size());
        const auto first_made = static_cast<std::uint32_t>(given_);
        for (std::size_t p = 0, made = 0; p < corner.size(); ++p)
            corner[p] = is_made(rounded.point_of[p])
                            ? first_made + static_cast<std::uint32_t>(made++)
                            : number_[near_.point_of[rounded.point_of[p]]];
        write_faces(rounded, corner, source, result);
        return corner;
    }

  private:
    [[nodiscard]] bool is_made(std::uint32_t local_point) const {
        return local_point >= near_.point_of.size();
    }
    [[nodiscard]] std::size_t operand_of(std::size_t face) const {
        return face < faces_[1] ? 0 : 1;
    }
    [[nodiscard]] const face& corners(std::size_t face) const {
        const std::size_t k = operand_of(face);
        return operands_[k].faces[face - faces_[k]];
    }

    /// What becomes of a face that was not looked at.
    [[nodiscard]] kept kept_of(std::size_t face) const {
        return keeps_[operand_of(face)][near_.place[face] == face_place::inside ? 1 : 0];
    }

    /// Calls `visit(face)` for the faces from `begin` to `end` that were not looked at and stay.
    template <class Visit>
    void for_far_faces(std::size_t begin, std::size_t end, const Visit& visit) const {
        for (std::size_t f = begin; f < end; ++f)
            if (near_.place[f] != face_place::near && kept_of(f) != kept::no) visit(f);
    }

    /// Numbers the points in use, those of operands first.
    void number_points(const rounded_surface& rounded, boolean_result& result) {
        const auto use = [&](std::size_t p) {
            std::atomic_ref(number_[p]).store(1, std::memory_order_relaxed);
        };
        for_chunks(points_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            std::fill(number_.data() + begin, number_.data() + end, 0U);
        });
        for_chunks(faces_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for_far_faces(begin, end, [&](std::size_t f) {
                for (const std::uint32_t p : corners(f)) use(points_[operand_of(f)] + p);
            });
        });
        std::size_t made = 0;
        for (const std::uint32_t p : rounded.point_of)
            if (is_made(p))
                ++made;
            else
                number_[near_.point_of[p]] = 1;

        std::vector<std::size_t> first(chunk_count(points_[2], light_grain) + 1, 0);
        for_chunks(points_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
            for (std::size_t p = begin; p < end; ++p) first[c + 1] += number_[p];
        });
        for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
        given_ = first.back();
        std::vector<point3>& points = result.mesh.points;
        points.resize(given_ + made);
        result.vertex_source.resize(given_ + made);
        for_chunks(points_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
            std::size_t next = first[c];
            for (std::size_t p = begin; p < end; ++p) {
                if (number_[p] == 0) continue;
                const std::size_t k = p < points_[1] ? 0 : 1;
                const auto index = static_cast<std::uint32_t>(p - points_[k]);
                number_[p] = static_cast<std::uint32_t>(next);
                points[next] = operands_[k].points[index];
                result.vertex_source[next++] = {static_cast<std::uint32_t>(k), index};
            }
        });
        std::size_t next = given_;
        for (std::size_t p = 0; p < rounded.point_of.size(); ++p)
            if (is_made(rounded.point_of[p])) points[next++] = rounded.surface.points[p];
    }

    void write_faces(const rounded_surface& rounded, const ids& corner, const ids& source,
                     boolean_result& result) const {
        const auto looked_at = [&](std::size_t face) {
            return static_cast<std::size_t>(std::lower_bound(source.begin(), source.end(), face) -
                                            source.begin());
        };
        std::vector<std::size_t> first(chunk_count(faces_[2], light_grain) + 1, 0);
        for_chunks(faces_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
            std::size_t count = looked_at(end) - looked_at(begin);
            for_far_faces(begin, end, [&](std::size_t) { ++count; });
            first[c + 1] = count;
        });
        for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
        std::vector<face>& faces = result.mesh.faces;
        faces.resize(first.back());
        result.face_source.resize(first.back());
        for_chunks(faces_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
            std::size_t next = first[c];
            const auto put = [&](std::size_t f, const face& corners) {
                const std::size_t k = operand_of(f);
                faces[next] = corners;
                result.face_source[next++] = {static_cast<std::uint32_t>(k),
                                              static_cast<std::uint32_t>(f - faces_[k])};
            };
            std::size_t piece = looked_at(begin);
            const auto put_pieces_before = [&](std::size_t f) {
                for (; piece < source.size() && source[piece] < f; ++piece) {
                    const auto& [p, q, r] = rounded.surface.faces[piece];
                    put(source[piece], {corner[p], corner[q], corner[r]});
                }
            };
            for_far_faces(begin, end, [&](std::size_t f) {
                put_pieces_before(f);
                const std::size_t k = operand_of(f);
                const std::uint32_t* const number = number_.data() + points_[k];
                const auto& [p, q, r] = corners(f);
                put(f, turned_if(kept_of(f) == kept::turned, {number[p], number[q], number[r]}));
            });
            put_pieces_before(end);
        });
    }

    std::span<const mesh_view, 2> operands_;
    const near_faces& near_;
    /// Faces that were not looked at, by operand, outside and inside the other one.
    std::array<std::array<kept, 2>, 2> keeps_;
    std::array<std::size_t, 3> faces_;   ///< where those of each operand begin
    std::array<std::size_t, 3> points_;  ///< likewise
    buffer<std::uint32_t> number_;       ///< of points of operands, in the result
    std::size_t given_ = 0;
};

bool can_be_counted_through(std::span<const mesh_view, 2> operands) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max() / 4;
    return operands[0].points.size() + operands[1].points.size() < most &&
           operands[0].faces.size() + operands[1].faces.size() < most;
}

}  // namespace

std::optional<pair_result> boolean_of_sound_pair(const prepared_pair& pair, bool once,
                                                 const boolean_expression& expression,
                                                 const boolean_options& options) {
    const std::array operands{pair[0]->view(), pair[1]->view()};
    if (options.precision == precision::float32 || !can_be_counted_through(operands))
        return std::nullopt;
    pair_result made;
    boolean_result& result = made.result;
    const auto goes_on = [&](double done) {
        if (!options.progress || options.progress(done)) return true;
        result.certificate.status = status::cancelled;
        return false;
    };
    if (!goes_on(0.1)) return made;
    near_faces near = find_near_faces(pair, once);
    if (!goes_on(0.4)) return made;
    arrange_faces_result arranged = arrange::arrange_pairs(near.local, near.pairs, {}, {});
    mesh_arrangement& cut = arranged.cut;
    auto inside = find_insides(pair, near, cut);
    if (!inside) return std::nullopt;
    if (options.volumes) result.volumes = find_volumes(pair, near, cut, *inside);
    near.local = {};  // as large as the operands, perhaps
    if (!goes_on(0.6)) return made;

    const choice choice(expression);
    chosen_faces chosen = choose(near, cut, *inside, choice);
    exact_surface exact{std::move(cut.given_points), std::move(cut.constructed),
                        std::move(chosen.faces)};
    exact.sound.resize(chosen.face_of.size());
    for_chunks(exact.sound.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t f = begin; f < end; ++f)
                       exact.sound[f] = cut.whole[chosen.face_of[f]];
               });
    for_chunks(
        chosen.face_of.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t f = begin; f < end; ++f)  // faces of operands from here on
                chosen.face_of[f] = near.face_of[cut.covers_of(chosen.face_of[f]).front().face];
        });
    cut = {};
    inside.reset();
    // What was left out meets no box of what was cut, and so no piece of it either, rounded or not:
    // rounding to nearest takes no coordinate out of a box of doubles.
    rounded_surface rounded = round_surface(std::move(exact), {.steps = 0});
    if (!rounded.certificate || rounded.vanished_components > 0) return std::nullopt;
    if (!goes_on(0.8)) return made;
    ids source(rounded.face_of.size());
    for_chunks(source.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) source[i] = chosen.face_of[rounded.face_of[i]];
    });
    const ids near_vertices = assembly(operands, near, choice).write(rounded, source, result);
    // Far faces are as they were in their operand, all of those at a vertex or none.
    made.is_manifold = topology::is_manifold_at(near_vertices, result.mesh);
    result.certificate = std::move(rounded.certificate);
    result.statistics.pairs = arranged.pairs;
    result.statistics.cut_faces = arranged.cut_faces;
    result.statistics.exact_faces =
        result.mesh.faces.size() + (chosen.face_of.size() - source.size());
    goes_on(1.0);
    return made;
}

}  // namespace treeform::detail::boolean
