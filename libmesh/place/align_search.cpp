#include <libmesh/place/align_search.hpp>
#include <libmesh/place/align_starts.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace treeform::detail::place {
namespace {

constexpr unsigned still_steps = 5;    ///< without a fall of the cost
constexpr double still_move = 1e-11;   ///< of a step that moves nothing
constexpr double least_width = 1e-10;  ///< of Welsch's function: distances are as good as 0
constexpr double least_share = 0.35;   ///< of the points to be within the width
constexpr double like_bound = 1e-9;    ///< of the scale, by its rounding
constexpr double nothing = 1e-28;      ///< costs differ by their rounding

using row7 = vector<7>;

/// Anderson acceleration of the steps, by the 5 before. Places are a turn from the first place, a
/// shift and a growth. \source Zhang, Yao and Deng (2022), section 3.1
class acceleration {
  public:
    void forget() { places_.clear(); }

    /// Where to go on from `at`, which a plain step would take to `plain`.
    [[nodiscard]] similarity next(const similarity& at, const similarity& plain) {
        if (places_.empty()) about_ = at.rotation;
        const row7 goal = row_of(plain), residual = goal - row_of(at);
        places_.push_back({goal, residual});
        if (places_.size() > memory + 1) places_.erase(places_.begin());
        if (places_.size() < 2 || goal.head<3>().norm() > 2.0) {
            if (goal.head<3>().norm() > 2.0) forget();
            return plain;
        }
        const auto columns = static_cast<Eigen::Index>(places_.size() - 1);
        Eigen::Matrix<double, 7, Eigen::Dynamic> residuals(7, columns), goals(7, columns);
        for (Eigen::Index i = 0; i < columns; ++i) {
            const auto& before = places_[static_cast<std::size_t>(i)];
            residuals.col(i) = residual - before.residual;
            goals.col(i) = goal - before.goal;
        }
        const Eigen::VectorXd shares = least_squares(residuals, residual);
        const row7 better = goal - goals * shares;
        return better.allFinite() ? place_of(better) : plain;
    }

  private:
    static constexpr std::size_t memory = 5;
    struct iterate {
        row7 goal, residual;
    };

    [[nodiscard]] row7 row_of(const similarity& map) const {
        row7 row;
        row << turn_of(map.rotation * about_.transpose()), map.shift, std::log(map.scale);
        return row;
    }
    [[nodiscard]] similarity place_of(const row7& row) const {
        similarity map;
        map.rotation = rotation_by(row.head<3>()) * about_;
        map.shift = row.segment<3>(3);
        map.scale = std::exp(row(6));
        return map;
    }

    Matrix3d about_ = Matrix3d::Identity();
    std::vector<iterate> places_;
};

/// Whether the cost still falls.
class descent {
  public:
    explicit descent(double tolerance, unsigned steps = still_steps)
        : tolerance_(tolerance), steps_(steps) {}

    /// Close to the end costs differ by their rounding alone, and the last place is the best.
    [[nodiscard]] bool as_good_as_any(double cost) const {
        return cost <= least_ * (1.0 + 1e-12) + nothing;
    }
    void add(double cost) {
        still_ = cost < least_ * (1.0 - tolerance_) - nothing ? 0 : still_ + 1;
        least_ = std::min(least_, cost);
    }
    [[nodiscard]] bool still() const { return still_ >= steps_; }

  private:
    double tolerance_;
    unsigned steps_;
    double least_ = endless;
    unsigned still_ = 0;
};

/// On the way to the width of the end, a place that is about the best will do.
descent descent_of(const search_task& task, bool narrow) {
    if (task.welsch && !narrow) return descent(std::max(task.tolerance, 0.01), 1);
    return descent(task.tolerance);
}

/// The quality of the start, and by what width.
quality first_quality(const search_task& task, const moving_points& samples,
                      const similarity& start, double& width, matching& last) {
    const quality plain = quality_at(task, samples, start, endless, last);
    if (!task.welsch) return plain;
    width = std::max(3.0 * median_distance(last.partners), least_width);
    return quality_at(task, samples, start, width, last);
}

/// The width after `width`, where the search has come to rest; the same when there is none. Trimmed
/// sets end by weights, too, so that a share that is somewhat too large does no harm.
///
/// With weights asked for, it halves as long as much is within twice of it: what is right is then
/// most of that, however far the rest is. Then it is what those leave.
double next_width(const search_task& task, std::vector<partner> partners, bool& narrow,
                  double width) {
    const std::size_t count = share_of(task.overlap, partners.size());
    if ((!task.welsch && count == partners.size()) || width <= least_width) return width;
    weigh(partners, count, endless);
    const auto within = [&](double most) {
        for (partner& p : partners)
            if (p.distance > most) p.weight = 0.0;
        return static_cast<double>(std::count_if(partners.begin(), partners.end(),
                                                 [](const partner& p) { return p.weight > 0.0; }));
    };
    if (task.welsch && !narrow) {
        auto all = partners;
        if (within(width) >= least_share * static_cast<double>(count))
            return std::max(0.5 * width, least_width);
        partners = std::move(all);
        narrow = true;
        within(4.0 * width);
        return std::max(4.5 * median_distance(partners), least_width);
    }
    if (width < endless) within(3.0 * width);
    const double next = std::max(4.5 * median_distance(partners), least_width);
    return next < 0.9 * width ? next : width;
}

bool is_bounded(const search_task& task, double scale) {
    return scale >= task.least_scale && scale <= task.most_scale;
}

/// The step to take from `map`, none where nothing counts. At a bound of the scale, the best of
/// those that keep it.
std::optional<similarity> step_from(const search_task& task, const similarity& map,
                                    const std::vector<partner>& partners) {
    const bool any = std::any_of(partners.begin(), partners.end(),
                                 [](const partner& p) { return p.weight > 0.0; });
    if (!any) return std::nullopt;
    const auto step_by = [&](bool scale) {
        return task.planes ? plane_step(partners, scale) : point_step(partners, scale);
    };
    similarity step = step_by(task.scale);
    const bool at_bound = map.scale <= task.least_scale * (1.0 + like_bound) ||
                          map.scale >= task.most_scale * (1.0 - like_bound);
    if (task.scale && at_bound && !is_bounded(task, step.scale * map.scale)) step = step_by(false);
    return step.finite() ? std::optional(step) : std::nullopt;
}

bool same_place(const similarity& a, const similarity& b) {
    return a.rotation == b.rotation && a.shift == b.shift && a.scale == b.scale;
}

}  // namespace

similarity within_bounds(const search_task& task, similarity map, const Vector3d& center) {
    const double scale = std::clamp(map.scale, task.least_scale, task.most_scale);
    map.shift += (map.scale - scale) * (map.rotation * center);
    map.scale = scale;
    return map;
}

quality quality_at(const search_task& task, const moving_points& samples, const similarity& map,
                   double width, matching& last) {
    task.fixed.match(samples, map, task.max_distance, last);
    const std::size_t count = share_of(task.overlap, samples.size());
    weigh(last.partners, count, width);
    return quality_of(last.partners, count, width, task.max_distance);
}

search_result search(const search_task& task, const moving_points& samples, const similarity& start,
                     matching& last, function_ref<bool(unsigned)> go_on) {
    search_result best{start};
    const Vector3d center = inertia_of(samples.points).center;
    similarity map = start;
    std::optional<similarity> plain;  // where a plain step led to, if `map` is by acceleration
    bool settled = false;             // whether the step to `map` moved nothing
    bool narrow = false;              // whether weights reject what does not belong to the rest
    double cost_before = endless;
    acceleration faster;
    descent falls = descent_of(task, narrow);
    for (unsigned i = 0;; ++i) {
        const quality here = i == 0 ? first_quality(task, samples, start, best.width, last)
                                    : quality_at(task, samples, map, best.width, last);
        best.iterations = i;
        const bool reject = plain && !(here.cost <= cost_before);
        if (!reject && falls.as_good_as_any(here.cost)) {
            best.map = map;
            best.at = here;
        }
        if (!reject) falls.add(here.cost);
        if (settled || falls.still()) {
            const double width = next_width(task, last.partners, narrow, best.width);
            best.converged = width == best.width;
            if (best.converged) return best;
            best.width = width;
            falls = descent_of(task, narrow);
            faster.forget();
            plain.reset();
            settled = false;
            map = best.map;
            cost_before = endless;
            if (i == task.max_iterations || !go_on(i)) return best;
            continue;
        }
        if (i == task.max_iterations || !go_on(i)) return best;
        if (reject) {
            faster.forget();
            map = *plain;
            plain.reset();
            continue;
        }
        const std::optional<similarity> step = step_from(task, map, last.partners);
        if (!step) return best;
        settled = displacement(*step) <= still_move;
        const similarity next = within_bounds(task, after(*step, map), center);
        cost_before = here.cost;
        plain.reset();
        if (task.accelerate && !settled) {
            const similarity guess = within_bounds(task, faster.next(map, next), center);
            if (!same_place(guess, next)) plain = next;
            map = guess;
        } else {
            map = next;
        }
    }
}

}  // namespace treeform::detail::place
