#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/place/align_frame.hpp>
#include <libmesh/place/align_search.hpp>
#include <libmesh/place/align_steps.hpp>
#include <libmesh/place/align_target.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform::detail::place {
namespace {

void refuse(const std::string& what) { throw std::invalid_argument("treeform::align: " + what); }

void check(points_view moving, mesh_view fixed, const align_options& o) {
    check_finite("align", moving, "moving point");
    check_finite("align", fixed.points, "fixed point");
    base::check_faces("align", fixed.points.size(), fixed.faces);
    if (!(o.overlap > 0.0 && o.overlap <= 1.0)) refuse("the overlap is not in (0, 1]");
    if (!(o.max_distance >= 0.0)) refuse("the largest distance is negative or NaN");
    if (!(o.tolerance >= 0.0)) refuse("the tolerance is negative or NaN");
    if (o.starts == 0) refuse("the number of starts is 0");
    if (!(o.least_scale >= 0.0 && std::isfinite(o.least_scale)))
        refuse("the least scale is negative or not finite");
    if (!(o.most_scale > 0.0 && o.most_scale >= o.least_scale))
        refuse("the largest scale is not positive, or less than the least one");
    if (!o.start.finite()) refuse("an entry of the start is not finite");
}

/// What all points say of a place.
struct evidence {
    residuals left{};
    std::vector<freedom> freedoms{};
    double uncertainty = 0.0;
    double move = 0.0;  ///< by the judges alone
};

/// One alignment, in its frame.
class alignment {
  public:
    alignment(points_view moving, mesh_view fixed, const align_options& options)
        : options_(options),
          fixed_(fixed),
          frame_(moving, fixed.points, options.start),
          target_(target_in(frame_, fixed)),
          all_(in_order(frame_, moving, target_.is_cloud())),
          task_{.fixed = target_,
                .max_distance = options.max_distance * frame_.by,
                .overlap = options.overlap,
                .planes = options.method != align_method::point_to_point,
                .welsch = options.robust,
                .scale = options.scale,
                .accelerate = options.accelerate,
                .max_iterations = options.max_iterations,
                .tolerance = options.tolerance},
          work_(options.progress) {
        target_.find_planes();
        if (task_.planes && target_.is_cloud() && options.method != align_method::point_to_plane)
            find_planes(all_);
        samples_ = some_of(fitted_of(all_), options.max_samples);
        few_ = some_of(samples_, few_samples);
        if (!task_.scale) return;
        ways_.emplace(few_, frame_, fixed_);
        task_.least_scale = options.least_scale;
        task_.most_scale = options.most_scale;
    }

    [[nodiscard]] align_result found() {
        if (!work_.reach(0.1)) return {.status = status::cancelled};
        present_.shift = frame_.offset;
        before_ = quality_at(task_, all_, present_, endless, of_all_);
        if (!std::isfinite(before_.cost))
            throw std::overflow_error("treeform::align: the distances are too large to be squared");
        if (!work_.reach(0.2)) return {.status = status::cancelled};
        present_ = within_bounds(task_, present_, inertia_of(samples_.points).center);
        best_ = search_from(present_, 0.2, 0.5);
        if (task_.scale) take_if_better(as_large_as_fixed(), 0.5, 0.6);
        const auto tried = options_.starts > 1 ? others_than(few_, options_.starts, 0.6, 0.7)
                                               : std::vector<tried_start>{};
        for (std::size_t i = 0; i < std::min(tried.size(), refined) && !work_.cancelled(); ++i)
            if (take_if_better(tried[i].end.map, 0.7, 0.75))
                best_start_ = static_cast<unsigned>(tried[i].number);
        if (task_.planes && !work_.cancelled()) slide_if_better();
        if (!work_.cancelled()) look_around_in_doubt();
        if (work_.cancelled()) return {.status = status::cancelled};
        align_result result = judged();
        if (work_.cancelled() || !work_.reach(1.0)) return {.status = status::cancelled};
        return result;
    }

  private:
    static constexpr std::size_t few_samples = 1000;
    static constexpr std::size_t coarse_samples = 5000;
    static constexpr std::size_t doubt_samples = 500;
    static constexpr std::size_t refined = 3;           ///< of other starts, the best
    static constexpr std::size_t doubts = 24;           ///< starts to try in doubt
    static constexpr double weak_stiffness = 0.02;      ///< stiffness of motions that are tried out
    static constexpr double min_stiffness = 1e-4;       ///< stiffness of motions that mean nothing
    static constexpr double negligible = 1e-9;          ///< distances that are none
    static constexpr double noise_correlation = 0.15;   ///< correlation of neighbors
    static constexpr double max_thickness_error = 0.6;  ///< share of it that neighbors may be off
    static constexpr double max_region_error =
        2e-3;                               ///< share of the diagonal that regions may be off
    static constexpr double most_in = 0.7;  ///< share of the points that tells a place from another
    static constexpr double growth = 2.0;   ///< of the scale from a start, at most

    /// With a part of the samples first, if they are many: that gets near the end.
    [[nodiscard]] search_result search_from(similarity start, double from, double to) {
        const auto may_continue = [&](unsigned i) { return work_.step(from, to, i, 20.0); };
        search_task fine = task_;
        fine.least_scale = std::max(task_.least_scale, start.scale / growth);
        fine.most_scale = std::min(task_.most_scale, start.scale * growth);
        unsigned before = 0;
        if (samples_.size() >= 4 * coarse_samples) {
            search_task coarse = fine;
            coarse.tolerance = std::max(task_.tolerance, 1e-4);
            coarse.max_iterations /= 2;
            matching last;
            const search_result near =
                search(coarse, some_of(samples_, coarse_samples), start, last, may_continue);
            start = near.map;
            before = near.iterations;
            fine.max_iterations -= before;
        }
        matching of_samples;
        matching& last = samples_.size() == all_.size() ? of_all_ : of_samples;
        search_result end = search(fine, samples_, start, last,
                                   [&](unsigned i) { return may_continue(before + i); });
        end.iterations += before;
        end.at_bound = task_.scale && task_.least_scale < task_.most_scale &&
                       (end.map.scale <= fine.least_scale * (1.0 + negligible) ||
                        end.map.scale >= fine.most_scale * (1.0 - negligible));
        return end;
    }

    /// The present place, with the moving side grown to the extent of the fixed one.
    [[nodiscard]] similarity as_large_as_fixed() const {
        const auto moving = inertia_of(samples_.points);
        const auto fixed = inertia_in(frame_, fixed_);
        similarity start = present_;
        if (moving.radius > 0.0 && fixed.radius > 0.0) start.scale = fixed.radius / moving.radius;
        start.scale = std::clamp(start.scale, task_.least_scale, task_.most_scale);
        start.shift = fixed.center - start.scale * (start.rotation * moving.center);
        return start;
    }

    /// Other places than the present one, as few samples find them, the best first.
    [[nodiscard]] std::vector<tried_start> others_than(const moving_points& few, std::size_t count,
                                                       double from, double to) {
        const similarity present = task_.scale ? as_large_as_fixed() : present_;
        const auto starts =
            starts_of(inertia_of(samples_.points), inertia_in(frame_, fixed_), present, count);
        return try_starts(task_, few, starts,
                          [&](std::size_t i) { return work_.step(from, to, i, 20.0); });
    }

    bool take_if_better(const similarity& start, double from, double to) {
        search_result other = search_from(start, from, to);
        matching last;
        const double cost = quality_at(task_, samples_, other.map, best_.width, last).cost;
        if (ways_) {
            // at a bound, a place may be right by chance alone
            const double here = ways_->cost_at(task_, best_.map);
            const double most = best_.at_bound && !other.at_bound ? here * 1.1 + 1e-20
                                                                  : here * (1.0 - 1e-6) - 1e-20;
            if (!(ways_->cost_at(task_, other.map) < most)) return false;
        } else if (!(cost < best_.at.cost * (1.0 - 1e-6) - 1e-20)) {
            return false;
        }
        best_ = other;
        return true;
    }

    /// Along motions that are little held, as of a cogwheel about its axis, the next local optimum
    /// is near, and may be the right one.
    void slide_if_better() {
        matching last;
        const quality here = quality_at(task_, few_, best_.map, best_.width, last);
        if (here.rms <= negligible) return;
        const auto starts = starts_along(freedoms_of(last.partners, best_.map.shift),
                                         weak_stiffness, best_.map, frame_.diagonal);
        const search_task near = without_outliers(last.partners);
        const auto tried = try_starts(
            near, few_, starts, [&](std::size_t i) { return work_.step(0.75, 0.78, i, 10.0); });
        if (tried.empty() || work_.cancelled()) return;
        const auto cost_at = [&](const similarity& map) {
            return quality_at(near, few_, map, endless, last).cost;
        };
        const similarity& there = tried[0].end.map;
        if (cost_at(there) < better_of(few_.size()) * cost_at(best_.map))
            take_if_better(there, 0.78, 0.8);
    }

    /// What ended in doubt may have started beside the right place.
    void look_around_in_doubt() {
        if (task_.max_iterations == 0) return;
        static_cast<void>(quality_at(task_, all_, best_.map, best_.width, of_all_));
        const evidence found = evidence_here();
        if (found.freedoms.empty() || (is_determined(found) && is_noise(found.left))) return;
        const Vector3d center = inertia_of(few_.points).center;
        similarity around = present_;
        around.scale = best_.map.scale;
        around.shift += (present_.scale - around.scale) * (around.rotation * center);
        const auto starts = starts_near(around(center), around, frame_.diagonal);
        const auto tried = try_starts(
            task_, few_, starts, [&](std::size_t i) { return work_.step(0.8, 0.82, i, 20.0); });
        for (std::size_t i = 0; i < std::min(tried.size(), refined) && !work_.cancelled(); ++i)
            take_if_better(tried[i].end.map, 0.82, 0.85);
    }

    /// The task without what the last weights leave out, to compare places close by: what belongs
    /// to nothing costs more than they differ by.
    [[nodiscard]] search_task without_outliers(const std::vector<partner>& partners) const {
        search_task task = task_;
        const auto within = std::count_if(partners.begin(), partners.end(), [&](const partner& p) {
            return p.distance <= best_.width;
        });
        if (within > 0)
            task.overlap = std::min(
                task.overlap, static_cast<double>(within) / static_cast<double>(partners.size()));
        return task;
    }

    /// By what factor the cost of so many points has to be lower at another place: by more than
    /// chance.
    [[nodiscard]] static double better_of(std::size_t points) {
        return std::clamp(1.0 - 4.0 / std::sqrt(static_cast<double>(points)), 0.5, 0.9);
    }

    /// By the last partners of all points.
    [[nodiscard]] evidence evidence_here() const {
        const auto judges = judges_among(of_all_.partners);
        evidence found;
        found.left = residuals_of(judges.size() < few_samples ? of_all_.partners : judges);
        found.freedoms = freedoms_of(of_all_.partners, best_.map.shift);
        found.uncertainty =
            uncertainty_of(residuals_of(of_all_.partners), found.freedoms, min_stiffness);
        found.move = move_by(judges, task_.scale);
        return found;
    }

    /// Whether the points tell where they belong. What slides on a mesh may do so; what slides on a
    /// cloud may be held by its points alone.
    [[nodiscard]] bool is_determined(const evidence& found) const {
        if (best_.at_bound) return false;
        if (!target_.is_cloud() || found.left.rms <= negligible) return true;
        return std::max(found.uncertainty, found.move) <= max_region_error * frame_.diagonal &&
               found.freedoms.front().stiffness >= min_stiffness;
    }

    /// Whether what remains is noise, or too little for a doubt.
    [[nodiscard]] bool is_noise(const residuals& left) const {
        if (left.rms <= negligible) return true;
        if (left.common() <= max_thickness_error * left.noise) return true;
        const double by_chance = 4.0 / std::sqrt(static_cast<double>(left.pairs + 1));
        return left.pairs >= 400 && left.correlation <= std::max(noise_correlation, by_chance);
    }

    /// Whether some other start ends at a better place than the best, by the same weights.
    [[nodiscard]] bool other_is_better(std::size_t starts) {
        const moving_points few = some_of(few_, doubt_samples);
        const auto cost_at = [&](const similarity& map) {
            matching last;
            return quality_at(task_, few, map, best_.width, last).cost;
        };
        const double here = cost_at(best_.map);
        const auto tried = others_than(few, starts, 0.88, 0.98);
        for (std::size_t i = 0; i < std::min(tried.size(), refined); ++i) {
            matching last;
            const auto end = search(task_, few, tried[i].end.map, last,
                                    [&](unsigned) { return !work_.cancelled(); });
            if (cost_at(end.map) < better_of(few.size()) * here) return true;
        }
        return false;
    }

    /// Whether weights leave out more points than noise has far ones.
    [[nodiscard]] bool leaves_out_many() const {
        return task_.welsch && without_outliers(of_all_.partners).overlap < most_in * task_.overlap;
    }

    [[nodiscard]] align_outcome end_of(const evidence& found) {
        if (!best_.converged) return align_outcome::out_of_iterations;
        if (!is_determined(found)) return align_outcome::doubtful;
        // What is noise where most points lie may be a part that fits in two places.
        if (is_noise(found.left))
            return leaves_out_many() && other_is_better(doubts / 2) ? align_outcome::doubtful
                                                                    : align_outcome::converged;
        if (target_.is_cloud() || found.left.common() > max_region_error * frame_.diagonal ||
            other_is_better(doubts))
            return align_outcome::doubtful;
        return align_outcome::converged;
    }

    [[nodiscard]] align_result judged();
    /// Of all points where they were looked for last, by no weights but those of trimming.
    [[nodiscard]] quality plain_quality() const {
        auto partners = of_all_.partners;
        const std::size_t count = share_of(task_.overlap, partners.size());
        weigh(partners, count, endless);
        return quality_of(partners, count, endless, task_.max_distance);
    }
    void enter_matrix(align_result& result, const similarity& map, bool moved) const;
    [[nodiscard]] std::uint64_t inliers() const;

    const align_options& options_;
    mesh_view fixed_;
    align_frame frame_;
    align_target target_;
    moving_points all_, samples_, few_;
    search_task task_;
    std::optional<both_ways> ways_;  ///< if the scale is looked for
    base::work_progress work_;
    similarity present_;
    quality before_;  ///< there
    matching of_all_;
    search_result best_;
    unsigned best_start_ = 0;
};

std::uint64_t alignment::inliers() const {
    const double most = 4.5 * median_distance(of_all_.partners) + negligible;
    return static_cast<std::uint64_t>(
        std::count_if(of_all_.partners.begin(), of_all_.partners.end(),
                      [most](const partner& p) { return p.distance <= most; }));
}

void alignment::enter_matrix(align_result& result, const similarity& map, bool moved) const {
    result.pivot = frame_.pivot;
    for (std::size_t k = 0; k < 3; ++k)
        result.pivot_moved[k] = frame_.center[k] + map.shift(static_cast<int>(k)) / frame_.by;
    if (moved) result.matrix = matrix_of(frame_, map, result.pivot_moved);
    if (!result.matrix.finite())
        throw std::overflow_error("treeform::align: the coordinates are too large for a matrix");
    result.scale = map.scale;
}

align_result alignment::judged() {
    const auto at = [&](const similarity& map) {
        return quality_at(task_, all_, map, best_.width, of_all_);
    };
    const bool bounded = present_.scale != 1.0;
    const quality at_start = best_.width < endless || bounded ? at(present_) : before_;
    quality end = at(best_.map);
    const bool moved = end.cost < at_start.cost;
    // Of points that were not fitted, chance decides which of two good places is better.
    const double chance = samples_.size() < all_.size() ? 1e-3 : 1e-12;
    const bool as_good = end.cost <= at_start.cost * (1.0 + chance) + 1e-28;
    if (!moved) {
        best_.map = present_;
        best_start_ = 0;
        end = at(present_);
    }
    if (!work_.reach(0.88)) return {};
    align_result result{.matrix = options_.start};
    enter_matrix(result, best_.map, moved || bounded);
    result.rms = (task_.welsch ? end : plain_quality()).rms / frame_.by;
    result.rms_at_start = before_.rms / frame_.by;
    result.overlap = end.overlap;
    result.inliers = inliers();
    const evidence found = evidence_here();
    result.correlation = found.left.correlation;
    result.uncertainty = found.uncertainty / frame_.by;
    for (const freedom& one : found.freedoms)
        result.freedoms.push_back(
            {to_point(frame_.by * one.turn), to_point(one.shift), one.stiffness});
    if (!result.freedoms.empty()) {
        result.outcome = end_of(found);
        if (!as_good) result.outcome = align_outcome::out_of_iterations;
    }
    result.converged = result.outcome == align_outcome::converged;
    result.iterations = best_.iterations;
    result.best_start = best_start_;
    return result;
}

align_result aligned(points_view moving, mesh_view fixed, const align_options& options) {
    check(moving, fixed, options);
    align_result result{.matrix = options.start};
    if (!moving.empty() && !fixed.points.empty())
        result = alignment(moving, fixed, options).found();
    if (result.status == status::cancelled) return result;
    result.points.reserve(moving.size());
    for (const point3& p : moving) {
        point3& q = result.points.emplace_back(result.matrix(p));
        for (std::size_t k = 0; k < 3 && options.precision == precision::float32; ++k)
            q[k] = base::nearest_float(q[k]);
    }
    if (!base::all_finite(result.points))
        throw std::overflow_error("treeform::align: the coordinates are too large to be written");
    return result;
}

}  // namespace
}  // namespace treeform::detail::place

namespace treeform {

align_result align(const mesh_ref& moving, const mesh_ref& fixed, const align_options& options) {
    return detail::place::aligned(moving.view().points, fixed.view(), options);
}

}  // namespace treeform
