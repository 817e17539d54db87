#include <libmesh/weld/tile_weld.hpp>
#include <libmesh/weld/tolerance.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace treeform::detail::weld {
namespace {

point3 direction_for(points_view sample) {
    constexpr double big = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{big, big, big};
    std::array<double, 3> high{-big, -big, -big};
    for (const point3& p : sample)
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], 0.5 * p[k]);
            high[k] = std::max(high[k], 0.5 * p[k]);
        }
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (high[k] - low[k] > high[longest] - low[longest]) longest = k;
    // Mostly along the cloud, and perpendicular to no plane that people build. Less than a fourth
    // long, so that nothing overflows.
    point3 direction;
    direction[longest] = 0.25 * 0.90;
    direction[(longest + 1) % 3] = 0.25 * 0.34;
    direction[(longest + 2) % 3] = 0.25 * 0.27;
    return direction;
}

}  // namespace

tile_slabs::tile_slabs(points_view sample, double tolerance, std::size_t count)
    : direction_(direction_for(sample)), tolerance_(tolerance) {
    check_tolerance("tile_slabs", tolerance);
    if (count == 0) throw std::invalid_argument("treeform::tile_slabs: no slab at all");
    std::vector<double> places;
    places.reserve(sample.size());
    for (const point3& p : sample) places.push_back(along(p));
    std::sort(places.begin(), places.end());
    for (std::size_t i = 1; i < count && !places.empty(); ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count);
        const double cut =
            places[static_cast<std::size_t>(share * static_cast<double>(places.size()))];
        if (cuts_.empty() || cuts_.back() < cut) cuts_.push_back(cut);
    }
}

double tile_slabs::along(const point3& p) const {
    return direction_.x * p.x + direction_.y * p.y + direction_.z * p.z;
}

tile_slabs::place tile_slabs::find(const point3& p) const {
    // The places of two points within the tolerance differ by at most a fourth of it. Each is off
    // by at most 2^-51 of the sum of its terms' sizes (and a few denormals), and the sums of the
    // two differ by less than the tolerance.
    const double at = along(p);
    const double sizes =
        direction_.x * std::abs(p.x) + direction_.y * std::abs(p.y) + direction_.z * std::abs(p.z);
    const double margin = 0.25 * tolerance_ + 0x1p-48 * (sizes + 0.25 * tolerance_) + 0x1p-1000;
    const auto slab = [&](double s) {
        return static_cast<std::uint32_t>(std::upper_bound(cuts_.begin(), cuts_.end(), s) -
                                          cuts_.begin());
    };
    const std::uint32_t own = slab(at);
    const bool alone = (own == 0 || cuts_[own - 1] < at - margin) &&
                       (own == cuts_.size() || at + margin < cuts_[own]);
    if (alone) return {own, own, own};
    return {own, slab(at - margin), slab(at + margin)};
}

}  // namespace treeform::detail::weld
