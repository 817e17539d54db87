#include <treeform/tree/detail/squared_radius.hpp>
#include <treeform/tree/point_search.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

namespace treeform {
namespace detail {
namespace {

template <std::size_t D>
using points_of = std::span<const std::array<double, D>>;

/// Asks `progress` now and then whether to go on. How far a search is, is not known.
class search_watch {
  public:
    explicit search_watch(const progress_callback& progress)
        : progress_(progress), stopped_(progress && !progress(0.0)) {}

    [[nodiscard]] bool stopped() const { return stopped_.load(std::memory_order_relaxed); }
    /// From any thread, for each pair.
    void look() {
        thread_local unsigned looks = 0;
        if (++looks % 65536 != 0 || !progress_ || stopped()) return;
        const std::unique_lock alone(mutex_, std::try_to_lock);
        if (alone && !stopped() && !progress_(0.0)) stopped_ = true;
    }

  private:
    const progress_callback& progress_;
    std::atomic<bool> stopped_;
    std::mutex mutex_;
};

/// Over boxes that overlap where two points are within `radius`, and where they are not far from
/// it.
template <std::size_t D>
tree<D> tree_around(points_of<D> points, double radius) {
    return build(points, [half = radius * 0.5 * (1 + 1e-15)](const auto& p) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        aabb<double, D> box;
        for (std::size_t k = 0; k < D; ++k) {
            box.min[k] = std::nextafter(p[k] - half, -infinity);
            box.max[k] = std::nextafter(p[k] + half, infinity);
        }
        return box;
    });
}

/// \pre squares of distances, and of the radius, are normal numbers of double
template <std::size_t D>
std::vector<id_pair> pairs_of_boxes(points_of<D> points, double radius, search_watch& watch) {
    const double limit = squared_limit(radius);
    return search_self_all(tree_around<D>(points, radius), [&](std::uint32_t a, std::uint32_t b) {
        watch.look();
        double sum = 0.0;
        for (std::size_t k = 0; k < D; ++k)
            sum += (points[a][k] - points[b][k]) * (points[a][k] - points[b][k]);
        return sum <= limit && !watch.stopped();
    });
}

/// Block by block, so that the lists of all points are never there at once.
template <std::size_t D>
std::vector<id_pair> pairs_of_lists(const point_search<D>& search, points_of<D> points,
                                    double radius, search_watch& watch) {
    constexpr std::size_t block = 4096;
    std::vector<id_pair> pairs;
    for (std::size_t begin = 0; begin < points.size() && !watch.stopped(); begin += block) {
        const std::size_t count = std::min(block, points.size() - begin);
        const auto found = search.all_within(points.subspan(begin, count), radius);
        for (std::size_t i = 0; i < count; ++i) {
            const auto a = static_cast<std::uint32_t>(begin + i);
            const std::size_t first = pairs.size();
            for (const near_point& one : found[i]) {
                watch.look();
                if (one.id > a) pairs.emplace_back(a, one.id);
            }
            std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end());
        }
    }
    return pairs;
}

}  // namespace
}  // namespace detail

template <std::size_t D>
std::vector<id_pair> point_search<D>::pairs_within(double radius,
                                                   const progress_callback& progress) const {
    detail::check_radius("treeform::point_search", radius);
    std::vector<point> points(size());
    for (std::size_t place = 0; place < size(); ++place)
        for (std::size_t k = 0; k < D; ++k)
            points[tree_.ids()[place]][k] =
                coordinates_.data()[(place / 8 * D + k) * 8 + place % 8];
    detail::search_watch watch(progress);
    if (watch.stopped()) return {};
    const bool squares = largest_ <= 1e150 && radius >= 1e-150 && radius <= 1e150;
    std::vector<id_pair> pairs = squares ? detail::pairs_of_boxes<D>(points, radius, watch)
                                         : detail::pairs_of_lists<D>(*this, points, radius, watch);
    if (watch.stopped()) pairs.clear();
    return pairs;
}

template std::vector<id_pair> point_search<2>::pairs_within(double, const progress_callback&) const;
template std::vector<id_pair> point_search<3>::pairs_within(double, const progress_callback&) const;

}  // namespace treeform
