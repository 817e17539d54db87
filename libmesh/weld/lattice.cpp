#include <libmesh/weld/lattice.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace treeform::detail::weld {
namespace {

struct bounds {
    static constexpr double big = std::numeric_limits<double>::infinity();
    std::array<double, 3> min{big, big, big};
    std::array<double, 3> max{-big, -big, -big};

    void add(const bounds& other) {
        for (std::size_t k = 0; k < 3; ++k) {
            min[k] = std::min(min[k], other.min[k]);
            max[k] = std::max(max[k], other.max[k]);
        }
    }
};

bounds bounds_of(points_view points) {
    constexpr std::size_t grain = std::size_t{1} << 16;
    std::vector<bounds> parts(chunk_count(points.size(), grain));
    for_chunks(points.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        bounds part;
        for (const point3& p : points.subspan(begin, end - begin))
            if (base::is_finite(p)) part.add({{p.x, p.y, p.z}, {p.x, p.y, p.z}});
        parts[c] = part;
    });
    bounds all;
    for (const bounds& part : parts) all.add(part);
    return all;
}

/// The box of most points, and as much again on each side, judged from some thousands of them.
bounds bounds_of_most(points_view points) {
    constexpr std::size_t sample = 2048;
    std::array<std::vector<double>, 3> at;
    const std::size_t stride = std::max<std::size_t>(1, points.size() / sample);
    for (std::size_t i = 0; i < points.size(); i += stride)
        if (base::is_finite(points[i]))
            for (std::size_t k = 0; k < 3; ++k) at[k].push_back(points[i][k]);
    bounds most;
    for (std::size_t k = 0; k < 3 && !at[k].empty(); ++k) {
        std::sort(at[k].begin(), at[k].end());
        const std::size_t few = at[k].size() / 32;
        const double low = at[k][few], high = at[k][at[k].size() - 1 - few];
        most.min[k] = low - (high - low);
        most.max[k] = high + (high - low);
    }
    return most;
}

double longest_side(const bounds& box) {
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
        longest = std::max(longest, box.max[k] * 0x1p-4 - box.min[k] * 0x1p-4);
    return longest;
}

/// Where a few points lie far off the others, the box of the others, that steps are fine enough.
bounds useful_part(const bounds& all, points_view points) {
    constexpr double far = 64.0;
    bounds most = bounds_of_most(points);
    if (!(longest_side(most) * far < longest_side(all)) || longest_side(most) == 0.0) return all;
    for (std::size_t k = 0; k < 3; ++k) {
        most.min[k] = std::max(most.min[k], all.min[k]);
        most.max[k] = std::min(most.max[k], all.max[k]);
    }
    return most;
}

}  // namespace

std::optional<lattice> lattice::over(points_view points, double tolerance) {
    const bounds all = bounds_of(points);
    const bounds box = useful_part(all, points);
    lattice result;
    result.cut_ = box.min != all.min || box.max != all.max;
    if (!(box.min[0] <= box.max[0])) return result;  // nothing is finite
    double largest = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
        largest = std::max({largest, std::abs(box.min[k]), std::abs(box.max[k])});
    if (largest > 0x1p1000) result.shrink_ = 0.25;  // no difference overflows then
    double extent = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        result.low_[k] = box.min[k] * result.shrink_;
        result.extent_[k] = box.max[k] * result.shrink_ - result.low_[k];
        extent = std::max(extent, result.extent_[k]);
    }
    if (extent > 0.0) {
        if (extent < 0x1p-960) return std::nullopt;
        result.scale_ = std::ldexp(1.0, steps_bits - 1 - std::ilogb(extent));
    }
    for (double& e : result.extent_) e *= result.scale_;
    result.tolerance_ = tolerance * result.shrink_ * result.scale_;
    if (!(result.tolerance_ < (1 << (steps_bits - 2)))) return std::nullopt;

    // A line to which no plane that people build is perpendicular, stretched until the box takes
    // all of 2^30 steps along it: by 0.57 to 3.8, as the largest extent is 2^29 to 2^30.
    result.direction_ = {0.537, 0.621, 0.570};
    double along = 0.0;
    double length = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        along += result.direction_[k] * result.extent_[k];
        length += result.direction_[k] * result.direction_[k];
    }
    const double stretch = along > 0.0 ? ((1 << steps_bits) - 8) / along : 1.0;
    for (double& d : result.direction_) d *= stretch;
    length = std::sqrt(length) * stretch;
    result.over_z_ = 1.0 / result.direction_[2];

    // The steps of a point are off by 2^-23, its s by less than 2^-19, and cutting down makes
    // differences of two less than 1 + 2^-18 off. So is what they say of the difference of two z,
    // times the sum of the weights it is taken from.
    constexpr double off = 1.0 + 0x1p-10;
    const double off_z = off * (1.0 + result.direction_[0] + result.direction_[1]) * result.over_z_;
    const double error = off * std::sqrt(2.0 * off * off + off_z * off_z);
    const double within = std::max(0.0, result.tolerance_ - error);
    const double beyond = result.tolerance_ + error;
    // Points outside the box count as on its rim, which brings no two further apart.
    result.surely_within_ = result.cut_ ? 0.0 : within * within * (1.0 - 0x1p-30);
    result.surely_beyond_ = beyond * beyond * (1.0 + 0x1p-30);
    result.reach_ = static_cast<std::int32_t>(result.tolerance_) + 2;
    result.reach_along_ = static_cast<std::int32_t>(result.tolerance_ * length * off) + 3;
    return result;
}

}  // namespace treeform::detail::weld
