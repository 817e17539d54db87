#include "tools/tf-place/surroundings.hpp"

#include <libmesh/base/work_progress.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/nearness.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cmath>

namespace tools {
namespace {

/// Wider than all rounding, also that to float32.
double margin(const tf::box3& a, const tf::box3& b) {
    double largest = 0.0;
    for (const tf::box3* box : {&a, &b})
        for (std::size_t k = 0; k < 3; ++k)
            largest = std::max({largest, std::abs(box->min[k]), std::abs(box->max[k])});
    return largest * 0x1p-20;
}

/// Whether box `a`, moved by some t in [0, latest] times `motion`, comes within `reach` of `b`: by
/// the times at which it is so along each axis.
bool meets_on_the_way(const tf::box3& a, const tf::box3& b, const tf::point3& motion, double latest,
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
double box_distance(const tf::box3& a, const tf::box3& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double gap = std::max({0.0, b.min[k] - a.max[k], a.min[k] - b.max[k]});
        sum += gap * gap;
    }
    return std::sqrt(sum) * (1.0 - 0x1p-48);
}

/// The order of what matters more: penetrating, touching, then the nearer.
bool before(const nearest_part& a, const nearest_part& b) {
    if (a.how.relation.relation != b.how.relation.relation)
        return a.how.relation.relation > b.how.relation.relation;
    if (a.how.distance != b.how.distance) return a.how.distance < b.how.distance;
    return a.part < b.part;
}

tf::aabb<double, 3> tree_box(const tf::box3& box) {
    return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

}  // namespace

surroundings::surroundings(std::vector<body>& all)
    : all_(all), boxes_(tf::build(all, [](const body& part) { return tree_box(*part.box); })) {}

chosen_parts surroundings::choose(const std::vector<std::uint32_t>& numbers) const {
    chosen_parts chosen;
    chosen.number.assign(numbers.begin(), numbers.end());
    for (const std::uint32_t i : numbers) chosen.parts.push_back(all_[i].still());
    return chosen;
}

std::vector<std::uint32_t> surroundings::met_on_the_way(const tf::box3& box,
                                                        const tf::point3& motion, double latest,
                                                        double reach) const {
    const auto is_met = [&](const tf::aabb<double, 3>& other) {
        const tf::box3 b{{other.min[0], other.min[1], other.min[2]},
                         {other.max[0], other.max[1], other.max[2]}};
        return meets_on_the_way(box, b, motion, latest, reach);
    };
    return tf::search_all(boxes_, is_met, [&](std::uint32_t i) {
        return meets_on_the_way(box, *all_[i].box, motion, latest, reach);
    });
}

chosen_parts surroundings::on_the_way(const tf::box3& box, const tf::point3& motion, double latest,
                                      double reach) const {
    return choose(met_on_the_way(box, motion, latest, reach));
}

chosen_parts surroundings::around(const tf::box3& box, double reach) const {
    return choose(met_on_the_way(box, {}, 0.0, reach));
}

bool surroundings::others_around(const tf::box3& box, double reach,
                                 const chosen_parts& known) const {
    const auto found = met_on_the_way(box, {}, 0.0, reach);
    return !std::includes(known.number.begin(), known.number.end(), found.begin(), found.end());
}

std::optional<nearest_part> surroundings::nearest(tf::mesh_view mesh, const tf::tree<3>& faces,
                                                  const tf::box3& box, double radius,
                                                  const tf::progress_callback& progress) const {
    std::optional<nearest_part> best;
    tf::detail::base::work_progress work(progress);
    std::size_t looked_at = 0;
    // The nearest come first: of many parts few are looked at.
    const tf::progress_callback go_on = [&](double) {
        return work.step(0.0, 0.95, looked_at, 2.0);
    };
    const auto look = [&](std::uint32_t i) {
        if (box_distance(box, *all_[i].box) > radius) return radius * radius;
        if (!go_on(0.0)) return 0.0;
        const tf::still_part still = all_[i].still();
        ++looked_at;
        const auto how = tf::measure(mesh, faces, still.mesh, *still.faces,
                                     {.radius = radius, .progress = go_on});
        if (work.cancelled()) return 0.0;
        if (how) {
            const nearest_part one{i, *how};
            if (!best || before(one, *best)) best = one;
            radius = best->how.distance;
        }
        return radius * radius * (1.0 + 0x1p-40) + 0x1p-1000;
    };
    tf::visit_near(boxes_, tree_box(box), look, {.radius = radius});
    work.reach(1.0);
    return best;
}

std::uint64_t surroundings::indexed() const {
    return static_cast<std::uint64_t>(
        std::count_if(all_.begin(), all_.end(), [](const body& b) { return b.tree != nullptr; }));
}

}  // namespace tools
