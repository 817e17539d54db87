#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/parallel_invoke.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/round/displacement.hpp>
#include <libmesh/round/drop_unused_points.hpp>
#include <libmesh/round/exact_parts.hpp>
#include <libmesh/round/flatten.hpp>
#include <libmesh/round/near_edges.hpp>
#include <libmesh/round/remove_slivers.hpp>
#include <libmesh/round/round_surface.hpp>
#include <libmesh/round/rounding_steps.hpp>
#include <libmesh/round/solid_faces.hpp>
#include <libmesh/round/surface_faults.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace treeform {
namespace {

constexpr std::size_t point_grain = std::size_t{1} << 7;  // the constructed ones are the last
constexpr std::size_t most_listed = 100;

// In steps of the precision at the largest coordinate: the height of slivers, and how far apart
// what is joined may be at first. Rounding moves points by half a step, so that most of what it
// breaks is thinner than one. On real results (threads, a gantry, a slicer's test object) 2, 4, 8
// and 16 take as many rounds, give or take one.
constexpr double sliver_height = 1.0;
constexpr double first_reach = 8.0;
/// More pairs of a solid than that, and one for as many faces, are not cut: the reach is too short.
constexpr std::size_t fewest_cut = 100, faces_a_cut = 64;
/// Pairs that are held against each other for that, of all rounds of an attempt, for each face and
/// beyond: real parts take 50 to 1000. Where one face meets thousands, it is better to cut.
constexpr std::uint64_t visits_a_face = 1024, fewest_visits = std::uint64_t{1} << 20;
constexpr double longest_reach = 0x1p-10;  ///< nothing longer goes: of the largest coordinate

/// The surface, exact and as rounded so far. Of the exact one, points of the surface that was
/// rounded before come first.
class rounding {
  public:
    rounding(exact_surface exact, const round_options& options)
        : options_(options), exact_(std::move(exact)), faces_given_(exact_.faces.size()) {
        point_of_ = detail::base::numbers_below(exact_.given.size() + exact_.constructed.size());
        result_.face_of = detail::base::numbers_below(exact_.faces.size());
    }

    rounded_surface run() {
        result_.certificate.status = status::out_of_range;
        if (settle()) {
            first_move_ = result_.certificate.max_displacement = moved_most_;
            const bool certified = check();
            if (vanished_ || !certified)
                exact_parts_ = {exact_, [&](std::uint32_t p) { return rounded_point(p); }};
            if (!certified && !is_cancelled()) mend();
        }
        point_of_.resize(result_.surface.points.size());  // a step may have ended half way
        if (vanished_) detail::round::drop_unused_points(result_.surface, point_of_);
        exact_parts_.count_vanished(result_, before_);
        result_.point_of = std::move(point_of_);
        if (!before_.faces.empty()) measure();
        return std::move(result_);
    }

    [[nodiscard]] exact_surface take_exact() { return std::move(exact_); }

  private:
    using state = detail::round::rounding_state;
    using rounds = detail::round::rounding_rounds;

    [[nodiscard]] bool to_float32() const { return options_.precision == precision::float32; }
    [[nodiscard]] bool is_cancelled() const {
        return result_.certificate.status == status::cancelled;
    }

    void mend() {
        double largest = 0.0;
        for (const point3& p : result_.surface.points)
            largest = std::max(largest, detail::base::largest_of(p));
        int exponent = 0;
        std::frexp(largest, &exponent);
        const double step = std::ldexp(1.0, exponent - (to_float32() ? 24 : 53));
        const double limit = std::min(options_.max_displacement, longest_reach * largest);
        rounds all{.reach = first_reach * step,
                   .limit = limit,
                   .height = sliver_height * step,
                   .visits = fewest_visits + visits_a_face * faces_given_};
        if (!(all.reach <= limit)) return;
        remember_places();
        if (options_.rest) {
            fix_rim();
            all.visits /= 8;  // else all is begun once more, with the rest
            take_out_slivers(all);
            return;
        }
        const state start = now();
        cut_rounds(all, options_.solid);
        if (options_.solid && may_retry_from(start)) flat_rounds(all);
        if (options_.solid && may_retry_from(start)) cut_rounds(all, false);
    }

    /// Whether another attempt is made; then all is as it was.
    bool may_retry_from(const state& start) {
        if (result_.certificate || is_cancelled()) return false;
        go_back(start);
        return true;
    }

    /// Slivers go, and what still meets is cut. The reach stays while fewer than half as many pairs
    /// are left, so that rounds end. `only_near`: until it would grow, and without many new faces,
    /// as cuts of nearly coplanar faces make.
    void cut_rounds(rounds all, bool only_near) {
        const std::size_t most = 3 * faces_given_ + 1000;  // far more than there was
        std::size_t before = std::numeric_limits<std::size_t>::max();
        while (all.reach <= all.limit) {
            if (take_out_slivers(all) || is_cancelled()) return;
            if (pairs_.size() > std::exchange(before, pairs_.size()) / 2) {
                if (only_near) return;
                all.reach *= 4.0;
            }
            if (result_.surface.faces.size() > most) return;
            if (pairs_.size() > most) continue;
            if (!cut_once()) return;
            if (only_near && result_.surface.faces.size() > faces_given_ + faces_given_ / 8) return;
        }
    }

    /// Flat parts come first. Where too much meets after that, nothing is cut: the round begins
    /// anew with a longer reach.
    void flat_rounds(rounds all) {
        std::size_t fewest = std::numeric_limits<std::size_t>::max();
        while (all.reach <= all.limit) {
            const state before = now();
            if (flatten_parts(all.reach) || is_cancelled()) return;
            if (pairs_.size() > faces_given_ / faces_a_cut + fewest_cut) {
                go_back(before);
                all.reach *= 4.0;
                continue;
            }
            if (take_out_slivers(all) || is_cancelled() || !cut_once()) return;
            if (pairs_.size() > std::exchange(fewest, pairs_.size()) / 2) all.reach *= 4.0;
        }
    }

    /// Whether something meets still, so that another round may help.
    bool cut_once() {
        ++result_.rounds;
        return cut_again() && settle() && !check() && !is_cancelled();
    }

    [[nodiscard]] state now() const {
        return {result_.surface,     result_.face_of, point_of_,       certified_,    pairs_,
                result_.certificate, joined_,         result_.slivers, result_.rounds};
    }
    void go_back(const state& before) {
        result_.surface = before.surface;
        result_.face_of = before.face_of;
        point_of_ = before.point_of;
        certified_ = before.certified;
        pairs_ = before.pairs;
        result_.certificate = before.certificate;
        joined_ = before.joined;
        result_.slivers = before.slivers;
        result_.rounds = before.rounds;
    }

    /// Certified faces at edges where the rest of the surface is, or where it ends, are to stay.
    void fix_rim() {
        const std::vector<std::uint32_t> all =
            detail::base::numbers_below(result_.surface.faces.size());
        fixed_.assign(all.size(), 0);
        detail::round::near_edges(result_.surface, all).for_each([&](auto uses) {
            if (uses.size() == 1 && certified_[uses[0].place] != 0)
                std::atomic_ref(fixed_[uses[0].place]).store(1, std::memory_order_relaxed);
        });
    }

    bool take_out_slivers(rounds& all) {
        std::vector<face_pair> bad = pairs_;
        for (std::uint32_t f = 0; f < result_.surface.faces.size(); ++f)
            if (certified_.empty() || certified_[f] == 0) bad.push_back({f, f});
        detail::round::slivers_removed left =
            detail::round::remove_slivers(result_.surface, bad,
                                          {.reach = all.reach,
                                           .thin = all.height,
                                           .solid = options_.solid,
                                           .fixed = fixed_,
                                           .visits = all.visits});
        all.visits -= std::min(all.visits, left.visits);
        if (left.changes == 0) return false;
        result_.slivers += left.changes;
        joined_ += left.moved;
        take_changed(left);
        return check();
    }

    /// Whether the surface is certified with flat parts that their rims alone describe; else it is
    /// as before, unless less meets.
    bool flatten_parts(double reach) {
        std::optional<detail::round::flattened> made = detail::round::flatten(
            result_.surface, pairs_, {.reach = reach / 2, .certified = certified_});
        if (!made || made->faces.empty()) return false;
        detail::round::flattened& flat = *made;
        const state before = now();
        result_.surface.points = std::move(flat.points);
        if (to_float32())
            for (point3& p : result_.surface.points) p = detail::round::to_single(p);
        point_of_.resize(result_.surface.points.size(), rounded_surface::none);
        take_changed(flat);
        const bool certified = check();
        if (!certified && !is_cancelled() && pairs_.size() >= before.pairs.size())
            go_back(before);
        else
            joined_ += reach;
        return certified;
    }

    template <class Changed>
    void take_changed(Changed& changed) {
        std::vector<std::uint8_t> certified;
        for (std::size_t f = 0; f < changed.faces.size(); ++f) {
            if (!certified_.empty())
                certified.push_back(changed.is_new[f] != 0 ? std::uint8_t{0}
                                                           : certified_[changed.face_of[f]]);
            changed.face_of[f] = result_.face_of[changed.face_of[f]];
        }
        result_.surface.faces = std::move(changed.faces);
        result_.face_of = std::move(changed.face_of);
        certified_ = std::move(certified);
        moved_ = std::numeric_limits<double>::infinity();
        vanished_ = true;
    }

    /// Where all points were, to the nearest doubles, and the faces between them.
    void remember_places() {
        const std::size_t given = exact_.given.size();
        before_.faces = exact_.faces;
        before_.points = exact_.given;
        before_.points.resize(given + exact_.constructed.size());
        for_chunks(exact_.constructed.size(), point_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t p = begin; p < end; ++p)
                           before_.points[given + p] = rounded(exact_.constructed[p]);
                   });
    }

    void measure() {
        double slack = 0.0;  // of the places of before
        for (const point3& p : result_.surface.points)
            slack = std::max(slack, detail::round::half_unit(p));
        const detail::round::surface_moves moves =
            detail::round::displacement(result_.surface, result_.point_of, before_);
        // What is gone further away than all rounds have joined has vanished.
        result_.certificate.max_displacement =
            std::max({first_move_, moves.moved + slack, std::min(moves.gone, joined_)});
        result_.vanished_distance = moves.gone;
    }

    /// Each phase has half of the work that was left; nobody knows how many there will be.
    progress_callback next_phase() {
        if (!options_.progress) return {};
        const double begin = done_;
        const double share = (1.0 - done_) / 2.0;
        done_ += share;
        return [this, begin, share](double d) { return options_.progress(begin + share * d); };
    }

    [[nodiscard]] point3 rounded_point(std::uint32_t p) const {
        const std::size_t given = exact_.given.size();
        if (p < given)
            return to_float32() ? detail::round::to_single(exact_.given[p]) : exact_.given[p];
        const implicit_point& made = exact_.constructed[p - given];
        return to_float32() ? rounded_to_float(made) : rounded(made);
    }

    /// The exact surface becomes the rounded one; false when a coordinate is too large for it.
    bool settle() {
        const std::vector<std::uint32_t> points = detail::base::used_points(
            exact_.given.size() + exact_.constructed.size(), exact_.faces);
        std::vector<point3> at;
        detail::base::resize_all(points.size(), at);
        std::vector<double> moves(chunk_count(points.size(), point_grain) + 1, 0.0);
        std::atomic<bool> finite{true};
        for_chunks(points.size(), point_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t c) {
                       for (std::size_t i = begin; i < end; ++i) {
                           at[i] = rounded_point(points[i]);
                           moves[c] = std::max(moves[c], move_of(points[i], at[i], moves[c]));
                           if (!detail::base::is_finite(at[i])) finite = false;
                       }
                   });
        const double move = *std::max_element(moves.begin(), moves.end());
        moved_most_ = move;
        if (!finite) first_move_ = result_.certificate.max_displacement = move;
        const bool joined = join_equal(points, std::move(at));
        moved_ = joined && move > 0.0 ? std::numeric_limits<double>::infinity() : move;
        return finite;
    }

    /// Bound of how far rounding has moved a point, in each coordinate; where that is no more than
    /// `known`, perhaps not the least: to see that a point has not moved takes exact arithmetic.
    [[nodiscard]] double move_of(std::uint32_t p, const point3& to, double known) const {
        const std::size_t given = exact_.given.size();
        if (p < given) return detail::round::largest_difference(exact_.given[p], to);
        const implicit_point& made = exact_.constructed[p - given];
        const double most = detail::round::largest_difference(made.center(), to) + made.radius();
        if (!(most < std::numeric_limits<double>::infinity())) return most;
        const double bound = to_float32() ? most : std::min(most, detail::round::half_unit(to));
        return bound <= known || !equal(made, to) ? bound : 0.0;
    }

    /// Equal points become one, under the number of the lowest of them; faces that repeat a corner
    /// then go: what is left of them runs back and forth. Whether there were any.
    bool join_equal(const std::vector<std::uint32_t>& points, std::vector<point3> at) {
        std::vector<std::uint32_t> new_of_old, point_of;
        detail::base::parallel_invoke(
            [&] { detail::base::resize_all(point_of_.size(), new_of_old); },
            [&] { detail::base::resize_all(points.size(), point_of); });
        const auto equal = detail::weld::few_equal_points(at);
        for_chunks(points.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t i = begin; i < end; ++i) {
                           const auto number = static_cast<std::uint32_t>(i);
                           new_of_old[points[i]] = equal ? equal->group_of_point[i] : number;
                           point_of[i] = point_of_[points[i]];
                       }
                   });
        if (equal) {
            const std::vector<std::uint32_t>& first = equal->first_of_group;
            for (std::size_t p = 0; p < first.size(); ++p) {  // in place: it is no earlier
                at[p] = at[first[p]];
                point_of[p] = point_of[first[p]];
            }
            at.resize(first.size());
            point_of.resize(first.size());
        }
        result_.surface.points = std::move(at);
        point_of_ = std::move(point_of);
        take_faces(new_of_old, equal.has_value());
        return equal.has_value();
    }

    /// The exact faces in new numbers, without those that repeat a corner, as some may where points
    /// were `joined`.
    void take_faces(const std::vector<std::uint32_t>& new_of_old, bool joined) {
        const std::vector<face>& exact = exact_.faces;
        const auto renumbered = [&](std::size_t f) {
            const auto [a, b, c] = exact[f];
            return face{new_of_old[a], new_of_old[b], new_of_old[c]};
        };
        mesh& now = result_.surface;
        std::vector<std::uint32_t> face_of;
        detail::base::compact(
            exact.size(),
            [&](std::size_t f) {
                return !joined || detail::base::has_three_corners(renumbered(f));
            },
            [&](std::size_t count) {
                detail::base::parallel_invoke(
                    [&] { detail::base::resize_all(count, now.faces, face_of); },
                    [&] {
                        detail::base::resize_all(exact_.certified.empty() ? 0 : count, certified_);
                    });
            },
            [&](std::size_t f, std::size_t place) {
                now.faces[place] = renumbered(f);
                face_of[place] = result_.face_of[f];
                if (!certified_.empty())
                    certified_[place] = stays_certified(f, now.points, now.faces[place]);
            });
        vanished_ = vanished_ || face_of.size() < exact.size();
        result_.face_of = std::move(face_of);
    }

    /// Whether what is known of an exact face holds of it as `rounded`: no corner has moved.
    [[nodiscard]] std::uint8_t stays_certified(std::size_t f, points_view points,
                                               const face& rounded) const {
        if (exact_.certified[f] == 0 || !to_float32()) return exact_.certified[f];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t p = exact_.faces[f][i];
            if (p >= exact_.given.size() || !(exact_.given[p] == points[rounded[i]])) return 0;
        }
        return 1;
    }

    /// Whether the rounded surface is as promised; else which faces are not.
    ///
    /// Faces that were found to be certified in these very coordinates are not held against each
    /// other again: nothing that is asked of two faces depends on a third. Their common corners
    /// have one number as before, as points with equal coordinates have. Joining points keeps a
    /// closed surface closed, whichever faces vanish by it; that is looked at again all the same,
    /// at the edges of all other faces.
    bool check() {
        const mesh& now = result_.surface;
        result_.certificate.meeting.clear();
        result_.certificate.meeting_count = 0;
        detail::round::surface_faults faults =
            detail::round::find_faults(now, {.certified = certified_,
                                             .solid = options_.solid,
                                             .moved = moved_,
                                             .rest = options_.rest,
                                             .progress = next_phase()});
        result_.certificate.status = status::cancelled;
        if (faults.cancelled) return false;
        pairs_ = std::move(faults.pairs);
        for (const std::uint32_t f : faults.degenerate) complain(f, f);
        for (const face_pair& pair : pairs_) complain(pair.a, pair.b);
        for (const std::uint32_t f : faults.turned) complain(f, f);
        const bool certified = result_.certificate.meeting_count == 0 && !faults.open;
        result_.certificate.status = certified ? status::ok : status::not_certified;
        return certified;
    }

    void complain(std::uint32_t f, std::uint32_t g) {
        ++result_.certificate.meeting_count;
        if (result_.certificate.meeting.size() < most_listed)
            result_.certificate.meeting.push_back({f, g});
    }

    /// The rounded surface, cut along itself, becomes the exact one; false when that fails.
    bool cut_again() {
        const mesh& now = result_.surface;
        arrange_faces_result arranged = arrange_faces(now, {.progress = next_phase()});
        if (arranged.cancelled) result_.certificate.status = status::cancelled;
        if (arranged.cancelled) return false;
        mesh_arrangement& cut = arranged.cut;
        std::vector<std::uint32_t> face_of_cut(cut.faces.size());
        if (options_.solid) {
            const std::vector<std::uint32_t> same_operand(now.faces.size(), 0);
            const arrangement_cells cells = find_cells(now, cut, same_operand, 1);
            if (!cells.open.empty()) return false;
            // Where the surface passes itself, it winds twice around what was outside between two
            // of its sheets, and -1 times around what was inside.
            std::vector<std::uint8_t> inside(cells.winding.size());
            for (std::size_t c = 0; c < inside.size(); ++c) inside[c] = cells.winding[c] > 0;
            detail::round::solid_faces kept = detail::round::faces_around(cut, cells, inside);
            exact_.faces = std::move(kept.faces);
            face_of_cut = std::move(kept.face_of);
        } else {
            std::iota(face_of_cut.begin(), face_of_cut.end(), 0U);
            exact_.faces = std::move(cut.faces);
        }
        exact_.certified.resize(face_of_cut.size());
        for (std::size_t f = 0; f < face_of_cut.size(); ++f)
            exact_.certified[f] = cut.whole[face_of_cut[f]];
        std::vector<std::uint32_t> face_of(face_of_cut.size());
        for (std::size_t f = 0; f < face_of.size(); ++f)
            face_of[f] = result_.face_of[cut.covers_of(face_of_cut[f]).front().face];
        result_.face_of = std::move(face_of);
        exact_.given = std::move(cut.given_points);
        exact_.constructed = std::move(cut.constructed);
        point_of_.resize(exact_.given.size() + exact_.constructed.size(), rounded_surface::none);
        return true;
    }

    const round_options& options_;
    exact_surface exact_;
    std::vector<std::uint32_t> point_of_;  ///< by point, of the original surface
    detail::round::exact_parts exact_parts_{};
    std::vector<std::uint8_t> certified_;  ///< by face, or empty
    std::vector<face_pair> pairs_{};       ///< of faces that meet
    std::vector<std::uint8_t> fixed_{};    ///< by face, or empty
    std::size_t faces_given_;
    mesh before_{};  ///< as `exact_` was given, in doubles, once something is mended
    double first_move_ = 0.0;
    double joined_ = 0.0;      ///< how far apart at most, of all rounds together
    double moved_most_ = 0.0;  ///< in the last rounding
    double moved_ = 0.0;       ///< the same; infinite where points were joined
    bool vanished_ = false;    ///< some faces, so that points may be left that none has
    double done_ = 0.0;
    rounded_surface result_{};  ///< `face_of` is by the faces of `exact_` in between
};

}  // namespace

rounded_surface round_surface(exact_surface exact, const round_options& options) {
    return rounding(std::move(exact), options).run();
}

rounded_surface round_once(exact_surface& exact, const round_options& options) {
    rounding all(std::move(exact), options);
    rounded_surface result = all.run();
    exact = all.take_exact();
    return result;
}

}  // namespace treeform
