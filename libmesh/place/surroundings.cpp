#include <libmesh/base/work_progress.hpp>
#include <libmesh/place/relation_of.hpp>
#include <libmesh/place/surroundings.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/nearness.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cmath>

namespace treeform::detail::place {
namespace {

/// Wider than all rounding, also that to float32.
double margin(const box3& a, const box3& b) {
    double largest = 0.0;
    for (const box3* box : {&a, &b})
        for (std::size_t k = 0; k < 3; ++k)
            largest = std::max({largest, std::abs(box->min[k]), std::abs(box->max[k])});
    return largest * 0x1p-20;
}

/// Whether box `a`, moved by some t in [0, latest] times `motion`, comes within `reach` of `b`: by
/// the times at which it is so along each axis.
bool meets_on_the_way(const box3& a, const box3& b, const point3& motion, double latest,
                      double reach) {
    const double wide = reach + margin(a, b);
    double first = 0.0;
    double last = latest;
    for (std::size_t k = 0; k < 3; ++k) {
        const double low = b.min[k] - a.max[k] - wide;
        const double high = b.max[k] - a.min[k] + wide;
        if (motion[k] == 0.0) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        const double one = low / motion[k], two = high / motion[k];
        first = std::max(first, std::min(one, two));
        last = std::min(last, std::max(one, two));
    }
    return first <= last * (1.0 + 0x1p-20);
}

/// The distance of two boxes, not above the exact one.
double box_distance(const box3& a, const box3& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double gap = std::max({0.0, b.min[k] - a.max[k], a.min[k] - b.max[k]});
        sum += gap * gap;
    }
    return std::sqrt(sum) * (1.0 - 0x1p-48);
}

/// The order of what matters more: penetrating, touching, then the nearer.
bool before(const measured_part& a, const measured_part& b) {
    if (a.how.relation != b.how.relation) return a.how.relation > b.how.relation;
    if (a.how.distance != b.how.distance) return a.how.distance < b.how.distance;
    return a.number < b.number;
}

aabb<double, 3> tree_box(const box3& box) {
    return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

}  // namespace

surroundings::surroundings(std::span<const prepared_mesh> all, vertex_identity vertices)
    : all_(all), vertices_(vertices) {
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        const bool counts = !all[i].indexed_view().faces.empty();
        box_of_all_.push_back(counts ? bounding_box(all[i].indexed_view().points) : std::nullopt);
        if (box_of_all_.back()) number_.push_back(i);
    }
    boxes_ = build(number_, [&](std::uint32_t i) { return tree_box(*box_of_all_[i]); });
}

chosen_parts surroundings::choose(const std::vector<std::uint32_t>& found) const {
    chosen_parts chosen;
    for (const std::uint32_t i : found) {
        chosen.number.push_back(number_[i]);
        chosen.parts.push_back(shape_of(number_[i]));
        static_cast<void>(chosen.parts.back().faces());
    }
    return chosen;
}

std::vector<std::uint32_t> surroundings::met_on_the_way(const box3& box, const point3& motion,
                                                        double latest, double reach) const {
    const auto is_met = [&](const aabb<double, 3>& other) {
        const box3 b{{other.min[0], other.min[1], other.min[2]},
                     {other.max[0], other.max[1], other.max[2]}};
        return meets_on_the_way(box, b, motion, latest, reach);
    };
    return search_all(boxes_, is_met, [&](std::uint32_t i) {
        return meets_on_the_way(box, *box_of_all_[number_[i]], motion, latest, reach);
    });
}

chosen_parts surroundings::on_the_way(const box3& box, const point3& motion, double latest,
                                      double reach) const {
    return choose(met_on_the_way(box, motion, latest, reach));
}

chosen_parts surroundings::around(const box3& box, double reach) const {
    return choose(met_on_the_way(box, {}, 0.0, reach));
}

bool surroundings::others_around(const box3& box, double reach, const chosen_parts& known) const {
    std::vector<std::size_t> found;
    for (const std::uint32_t i : met_on_the_way(box, {}, 0.0, reach)) found.push_back(number_[i]);
    return !std::includes(known.number.begin(), known.number.end(), found.begin(), found.end());
}

std::optional<measured_part> surroundings::nearest(const shape& a, const box3& box, double radius,
                                                   const progress_callback& progress) const {
    std::optional<measured_part> best;
    base::work_progress work(progress);
    std::size_t looked_at = 0;
    // The nearest come first: of many meshes few are looked at.
    const progress_callback may_continue = [&](double) {
        return work.step(0.0, 0.95, looked_at, 2.0);
    };
    const auto look = [&](std::uint32_t i) {
        const std::size_t number = number_[i];
        if (box_distance(box, *box_of_all_[number]) > radius) return radius * radius;
        if (!may_continue(0.0)) return 0.0;
        ++looked_at;
        const auto how = measure_of(a, shape_of(number), radius, may_continue);
        if (work.cancelled()) return 0.0;
        if (how) {
            const measured_part one{number, *how};
            if (!best || before(one, *best)) best = one;
            radius = best->how.distance;
        }
        return radius * radius * (1.0 + 0x1p-40) + 0x1p-1000;
    };
    visit_near(boxes_, tree_box(box), look, radius);
    work.reach(1.0);
    return best;
}

}  // namespace treeform::detail::place
