#include <libmesh/weld/reach.hpp>
#include <libmesh/weld/tile_cuts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace treeform::detail::weld {
namespace {

/// Each mostly along an axis, and perpendicular to no plane that people build. Less than a fourth
/// long, so that nothing overflows.
constexpr std::array<std::array<double, 3>, 3> directions{
    {{0.25 * 0.90, 0.25 * 0.34, 0.25 * 0.27},
     {0.25 * 0.27, 0.25 * 0.90, 0.25 * 0.34},
     {0.25 * 0.34, 0.25 * 0.27, 0.25 * 0.90}}};

double along(std::size_t direction, const point3& p) {
    const auto& d = directions[direction];
    return d[0] * p.x + d[1] * p.y + d[2] * p.z;
}

/// The places of two points within the tolerance differ by at most a fourth of it. Each is off by
/// at most 2^-51 of the sum of its terms' sizes (and a few denormals), which is less than a fourth
/// of the coordinates' sizes, and these sums of the two differ by less than the tolerance.
double margin(const point3& p, double tolerance) {
    const double sizes = 0.25 * std::abs(p.x) + 0.25 * std::abs(p.y) + 0.25 * std::abs(p.z);
    return 0.25 * tolerance + 0x1p-48 * (sizes + 0.25 * tolerance) + 0x1p-1000;
}

/// The direction in which the points reach furthest.
std::uint32_t longest_direction(std::span<const point3> points) {
    constexpr double big = std::numeric_limits<double>::infinity();
    std::uint32_t longest = 0;
    double length = -big;
    for (std::uint32_t k = 0; k < directions.size(); ++k) {
        double low = big;
        double high = -big;
        for (const point3& p : points) {
            low = std::min(low, along(k, p));
            high = std::max(high, along(k, p));
        }
        if (high - low > length) {
            length = high - low;
            longest = k;
        }
    }
    return longest;
}

}  // namespace

tile_cuts::tile_cuts(points_view sample, double tolerance, std::size_t count)
    : tolerance_(tolerance) {
    check_tolerance("tile_cuts", tolerance);
    if (count == 0) throw std::invalid_argument("treeform::tile_cuts: the number of tiles is 0");
    std::vector<point3> points(sample.begin(), sample.end());
    split(points, count);
}

tile_cuts::tile_cuts(std::vector<node> nodes, double tolerance)
    : tolerance_(tolerance), nodes_(std::move(nodes)) {
    for (const node& n : nodes_) size_ += n.direction == leaf ? 1 : 0;
}

/// Below the cut are half of the tiles, and as large a share of the points.
std::uint32_t tile_cuts::split(std::span<point3> sample, std::size_t count) {
    const auto mine = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    if (count > 1 && sample.size() > 1) {
        const std::uint32_t k = longest_direction(sample);
        const double share = static_cast<double>(count / 2) / static_cast<double>(count);
        const auto middle = static_cast<std::size_t>(share * static_cast<double>(sample.size()));
        const auto before = [k](const point3& a, const point3& b) {
            return along(k, a) < along(k, b);
        };
        const auto at = sample.begin() + static_cast<std::ptrdiff_t>(middle);
        std::nth_element(sample.begin(), at, sample.end(), before);
        double cut = along(k, *at);
        const auto is_below = [&](const point3& p) { return along(k, p) < cut; };
        auto above = std::partition(sample.begin(), sample.end(), is_below);
        if (above == sample.begin()) {  // most are at the low end: all others are above the cut
            double next = std::numeric_limits<double>::infinity();
            for (const point3& p : sample)
                if (const double x = along(k, p); x > cut) next = std::min(next, x);
            cut = next;
            above = std::partition(sample.begin(), sample.end(), is_below);
        }
        if (above != sample.end()) {
            const auto below = static_cast<std::size_t>(above - sample.begin());
            split(sample.first(below), count / 2);
            const std::uint32_t other = split(sample.subspan(below), count - count / 2);
            nodes_[mine] = {k, other, cut};
            return mine;
        }
    }
    nodes_[mine].above = size_++;
    return mine;
}

std::uint32_t tile_cuts::find(const point3& p, std::vector<std::uint32_t>& halos) const {
    halos.clear();
    const std::array<double, 3> at{along(0, p), along(1, p), along(2, p)};
    const double slack = margin(p, tolerance_);
    // What is left of the way: nodes on the far side of a cut that is near.
    std::array<std::uint32_t, 64> left;
    std::size_t waiting = 0;
    std::uint32_t own = 0;
    bool is_own = true;
    for (std::uint32_t i = 0;;) {
        const node& n = nodes_[i];
        if (n.direction == leaf) {
            if (is_own)
                own = n.above;
            else
                halos.push_back(n.above);
            if (waiting == 0) return own;
            i = left[--waiting];
            is_own = false;
            continue;
        }
        const double x = at[n.direction];
        const bool is_above = x >= n.cut;
        const bool near = is_above ? !(n.cut < x - slack) : x + slack >= n.cut;
        const std::uint32_t here = is_above ? n.above : i + 1;
        if (near) left[waiting++] = is_above ? i + 1 : n.above;
        i = here;
    }
}

}  // namespace treeform::detail::weld
