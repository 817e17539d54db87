#include <libmesh/place/align_search.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace treeform::detail::place {
namespace {

constexpr unsigned still_steps = 5;      ///< without a fall of the cost
constexpr double still_move = 1e-11;     ///< of a step that moves nothing
constexpr double least_width = 1e-10;    ///< of Welsch's function: distances are as good as 0
constexpr double least_share = 0.35;     ///< of the points to be within the width
constexpr double like_bound = 1e-9;      ///< of the scale, by its rounding
constexpr double cost_rounding = 1e-28;  ///< costs differ by their rounding

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
        return cost <= least_ * (1.0 + 1e-12) + cost_rounding;
    }
    void add(double cost) {
        still_ = cost < least_ * (1.0 - tolerance_) - cost_rounding ? 0 : still_ + 1;
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

constexpr unsigned steps_of_try = 15;
constexpr double most_of_robust = 0.6;  ///< share that has a partner, where weights find it out

/// `count` turns, spread evenly over all of them.
std::vector<Matrix3d> spread_turns(std::size_t count) {
    constexpr double phi = std::numbers::sqrt2, psi = 1.533751168755204288118041;
    std::vector<Matrix3d> turns;
    for (std::size_t i = 0; i < count; ++i) {
        const double s = static_cast<double>(i) + 0.5, t = s / static_cast<double>(count);
        const double r = std::sqrt(t), q = std::sqrt(1.0 - t);
        const double a = 2.0 * std::numbers::pi * s / phi, b = 2.0 * std::numbers::pi * s / psi;
        turns.push_back(
            rotation_of(q * std::cos(b), r * std::sin(a), r * std::cos(a), q * std::sin(b)));
    }
    std::stable_sort(turns.begin(), turns.end(),
                     [](const Matrix3d& x, const Matrix3d& y) { return x.trace() > y.trace(); });
    return turns;
}

/// The place where `center` goes to `to`, turned by `turn`.
similarity placed_turned(const Matrix3d& turn, double scale, const Vector3d& center,
                         const Vector3d& to) {
    return {scale, turn, to - scale * (turn * center)};
}

similarity about_center(const Vector3d& center, const Matrix3d& turn) {
    return {1.0, turn, center - turn * center};
}

template <class At, class Weight>
inertia inertia_by(std::size_t count, const At& at, const Weight& weight) {
    inertia of;
    double weights = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        of.center += weight(i) * at(i);
        weights += weight(i);
    }
    if (weights > 0.0) of.center /= weights;
    Matrix3d sums = Matrix3d::Zero();
    for (std::size_t i = 0; i < count; ++i) {
        const Vector3d arm = at(i) - of.center;
        sums += weight(i) * arm * arm.transpose();
    }
    of.axes = eigen_of(sums).vectors;
    if (weights > 0.0) of.radius = std::sqrt(sums.trace() / weights);
    if (is_mirrored(of.axes)) of.axes.col(0) *= -1.0;
    return of;
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
                     matching& last, function_ref<bool(unsigned)> may_continue) {
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
            if (i == task.max_iterations || !may_continue(i)) return best;
            continue;
        }
        if (i == task.max_iterations || !may_continue(i)) return best;
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

inertia inertia_of(std::span<const Vector3d> points) {
    return inertia_by(
        points.size(), [&](std::size_t i) { return points[i]; }, [](std::size_t) { return 1.0; });
}

inertia inertia_of(std::span<const Vector3d> points, std::span<const face> faces) {
    const auto corner = [&](std::size_t f, std::size_t k) { return points[faces[f][k]]; };
    return inertia_by(
        faces.size(),
        [&](std::size_t f) { return Vector3d((corner(f, 0) + corner(f, 1) + corner(f, 2)) / 3.0); },
        [&](std::size_t f) {
            return cross_product(corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0)).norm();
        });
}

std::vector<similarity> starts_of(const inertia& moving, const inertia& fixed,
                                  const similarity& present, std::size_t count) {
    std::vector<similarity> starts{present};
    const Vector3d flips[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    for (const Vector3d& flip : flips)
        starts.push_back(placed_turned(fixed.axes * flip.asDiagonal() * moving.axes.transpose(),
                                       present.scale, moving.center, fixed.center));
    const std::size_t more = count > starts.size() ? count - starts.size() : 0;
    for (const Matrix3d& turn : spread_turns(more))
        starts.push_back(
            placed_turned(turn * present.rotation, present.scale, moving.center, fixed.center));
    starts.resize(std::max<std::size_t>(std::min(count, starts.size()), 1));
    return starts;
}

std::vector<similarity> starts_near(const Vector3d& center, const similarity& present,
                                    double diagonal) {
    constexpr double angle = 0.25, way = 0.08;
    std::vector<similarity> starts{present};
    const auto add = [&](const Vector3d& turn, const Vector3d& shift) {
        similarity start = after(about_center(center, rotation_by(angle * turn)), present);
        start.shift += way * diagonal * shift;
        starts.push_back(start);
    };
    const Vector3d none = Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
        for (const double sign : {1.0, -1.0}) {
            const Vector3d along = sign * Vector3d::Unit(k);
            add(none, along);
            add(along, none);
            for (const double other : {1.0, -1.0}) {
                add(along, other * Vector3d::Unit((k + 1) % 3));
                add(along, other * Vector3d::Unit((k + 2) % 3));
            }
        }
    return starts;
}

std::vector<similarity> starts_along(std::span<const freedom> motions, double most,
                                     const similarity& at, double diagonal) {
    std::vector<similarity> starts{at};
    for (const freedom& one : motions) {
        if (one.stiffness >= most) continue;
        for (double by = 0.001; by < 0.1; by *= 2.0)
            for (const double way : {by * diagonal, -by * diagonal}) {
                similarity start = at;
                start.rotation = rotation_by(way * one.turn) * at.rotation;
                start.shift += way * one.shift;
                starts.push_back(start);
            }
    }
    return starts;
}

std::vector<tried_start> try_starts(const search_task& task, const moving_points& few,
                                    std::span<const similarity> starts,
                                    function_ref<bool(std::size_t)> may_continue) {
    search_task quick = task;
    quick.max_iterations = std::min(task.max_iterations, steps_of_try);
    quick.tolerance = std::max(task.tolerance, 1e-3);
    quick.welsch = false;
    quick.scale = false;
    if (task.welsch) quick.overlap = std::min(task.overlap, most_of_robust);
    std::vector<tried_start> tried;
    for (std::size_t i = 1; i < starts.size() && may_continue(i); ++i) {
        matching last;
        tried.push_back({i, search(quick, few, starts[i], last, [](unsigned) { return true; })});
        search_result& end = tried.back().end;
        end.at = quality_at(quick, few, end.map, endless, last);
    }
    std::stable_sort(tried.begin(), tried.end(), [](const tried_start& a, const tried_start& b) {
        return a.end.at.cost < b.end.at.cost;
    });
    return tried;
}

}  // namespace treeform::detail::place
