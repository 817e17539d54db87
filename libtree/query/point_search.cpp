#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/morton_order.hpp>
#include <treeform/tree/detail/nearest_k.hpp>
#include <treeform/tree/detail/squared_radius.hpp>
#include <treeform/tree/point_search.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libtree/query/point_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind the two, as it is compiled for each target.
#include <libtree/query/near_walk-inl.hpp>

#ifndef TREEFORM_POINT_SEARCH_ONCE
#define TREEFORM_POINT_SEARCH_ONCE
namespace treeform::detail {
namespace {

/// A query with all lengths multiplied by `unit`, a power of two that keeps their squares in the
/// range of double.
template <std::size_t D>
struct point_query {
    std::array<double, D> at;
    double unit;
};

template <std::size_t D>
struct point_blocks {
    const tree<D>* nodes;
    const double* coordinates;
};

/// All that are offered within a radius.
class all_offered {
  public:
    explicit all_offered(double squared_radius) : bound_(squared_radius) {}
    void offer(const neighbor<double>& one) { kept_.push_back(one); }
    [[nodiscard]] double bound() const { return bound_; }
    [[nodiscard]] std::vector<neighbor<double>>& sorted() {
        std::sort(
            kept_.begin(), kept_.end(),
            [](const neighbor<double>& a, const neighbor<double>& b) { return nearer(a, b); });
        return kept_;
    }
    void reset(double squared_radius) {
        kept_.clear();
        bound_ = squared_radius;
    }

  private:
    double bound_;
    std::vector<neighbor<double>> kept_;
};

using k_offered = nearest_k<neighbor<double>>;

}  // namespace
}  // namespace treeform::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

/// Which of the eight points are within `bound`, and the squared distances of all. Products and
/// sums are not fused, so that distances are the same on every processor.
template <std::size_t D>
HWY_INLINE unsigned squared_distances(const double* points, const point_query<D>& query,
                                      double bound, double* squared) {
    const hn::CappedTag<double, 8> d;
    const std::size_t lanes = hn::Lanes(d);
    const auto unit = hn::Set(d, query.unit);
    unsigned mask = 0;
    for (std::size_t i = 0; i < 8; i += lanes) {
        auto sum = hn::Zero(d);
        for (std::size_t k = 0; k < D; ++k) {
            const auto gap =
                hn::Sub(hn::Mul(hn::Load(d, points + 8 * k + i), unit), hn::Set(d, query.at[k]));
            sum = hn::Add(sum, hn::Mul(gap, gap));
        }
        hn::Store(sum, d, squared + i);
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::Le(sum, hn::Set(d, bound)), bits);
        mask |= (bits[0] & ((1U << lanes) - 1)) << i;
    }
    return mask;
}

template <std::size_t D, class Kept>
void search_points(const point_blocks<D>& points, const point_query<D>& query,
                   const near_query<D>& framed, Kept& kept) {
    strategy::depth_first::frontier<near_entry, near_depth> frontier;
    const std::uint32_t* const ids = points.nodes->ids().data();
    const auto leaf = [&](std::uint32_t block, float& bound) {
        alignas(64) double squared[8];
        unsigned mask = squared_distances(points.coordinates + std::size_t{block} * D * 8, query,
                                          kept.bound(), squared);
        if (mask == 0) return;
        for (; mask != 0; mask &= mask - 1) {
            const auto slot = static_cast<std::size_t>(std::countr_zero(mask));
            kept.offer({ids[std::size_t{block} * 8 + slot], squared[slot]});
        }
        bound = framed.bound_of(kept.bound());
    };
    walk_near(*points.nodes, framed, framed.bound_of(kept.bound()), frontier, leaf);
}

void k_of_2(const point_blocks<2>& points, const point_query<2>& query, const near_query<2>& framed,
            k_offered& kept) {
    search_points(points, query, framed, kept);
}
void k_of_3(const point_blocks<3>& points, const point_query<3>& query, const near_query<3>& framed,
            k_offered& kept) {
    search_points(points, query, framed, kept);
}
void all_of_2(const point_blocks<2>& points, const point_query<2>& query,
              const near_query<2>& framed, all_offered& kept) {
    search_points(points, query, framed, kept);
}
void all_of_3(const point_blocks<3>& points, const point_query<3>& query,
              const near_query<3>& framed, all_offered& kept) {
    search_points(points, query, framed, kept);
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform {
namespace detail {
namespace {

HWY_EXPORT(k_of_2);
HWY_EXPORT(k_of_3);
HWY_EXPORT(all_of_2);
HWY_EXPORT(all_of_3);

void dispatch(const point_blocks<2>& points, const point_query<2>& query,
              const near_query<2>& framed, k_offered& kept) {
    HWY_DYNAMIC_DISPATCH(k_of_2)(points, query, framed, kept);
}
void dispatch(const point_blocks<3>& points, const point_query<3>& query,
              const near_query<3>& framed, k_offered& kept) {
    HWY_DYNAMIC_DISPATCH(k_of_3)(points, query, framed, kept);
}
void dispatch(const point_blocks<2>& points, const point_query<2>& query,
              const near_query<2>& framed, all_offered& kept) {
    HWY_DYNAMIC_DISPATCH(all_of_2)(points, query, framed, kept);
}
void dispatch(const point_blocks<3>& points, const point_query<3>& query,
              const near_query<3>& framed, all_offered& kept) {
    HWY_DYNAMIC_DISPATCH(all_of_3)(points, query, framed, kept);
}

constexpr const char* name = "treeform::point_search";

/// The frame's scale, unless coordinates are so large or so small in it that squares might leave
/// the range of double.
double unit_for(double scale, double largest) {
    if (largest * scale > 0x1p500) return std::ldexp(1.0, 499 - std::ilogb(largest));
    if (largest * scale < 0x1p-400 && largest > 0.0)
        return std::ldexp(1.0, std::min(-std::ilogb(largest), 1000));
    return scale;
}

/// One search after the other over the same points, keeping what memory it needs.
template <std::size_t D, class Kept>
class point_searcher {
  public:
    point_searcher(const point_blocks<D>& points, double largest, double radius, Kept& kept)
        : points_(points), largest_(largest), radius_(radius), kept_(kept) {}

    /// `limit`: a distance beyond which there is nothing to be found, as the caller knows.
    void search(const std::array<double, D>& query, double limit, std::vector<near_point>& found) {
        double largest = largest_;
        for (const double x : query) largest = std::max(largest, std::abs(x));
        const double scale = points_.nodes->frame().scale;
        point_query<D> scaled{query, unit_for(scale, largest)};
        for (double& x : scaled.at) x *= scaled.unit;
        const double reach = std::min(radius_, limit) * scaled.unit;
        kept_.reset(squared_limit(reach));
        const near_query<D> framed(points_.nodes->frame(), {query, query}, scaled.unit);
        if (points_.nodes->size() != 0) dispatch(points_, scaled, framed, kept_);
        const double per_unit = 1.0 / scaled.unit;  // a power of two as well
        for (const neighbor<double>& one : kept_.sorted())
            found.push_back({one.id, std::sqrt(one.answer) * per_unit});
    }

  private:
    point_blocks<D> points_;
    double largest_;
    double radius_;
    Kept& kept_;
};

template <std::size_t D>
void check_query(const std::array<double, D>& query, const std::string& which) {
    for (const double x : query)
        if (!std::isfinite(x))
            throw std::invalid_argument(std::string(name) + ": " + which + " is not finite");
}

/// How far the kth point can be from a query when it is `furthest` from the query before: by the
/// triangle inequality, with room for every rounding.
template <std::size_t D>
double limit_after(const std::array<double, D>& before, const std::array<double, D>& query,
                   double furthest) {
    double squared = 0.0;
    for (std::size_t k = 0; k < D; ++k) squared += (query[k] - before[k]) * (query[k] - before[k]);
    // What underflow takes from a square is below 1e-307; what it overflows to bounds nothing.
    return (furthest + std::sqrt(squared)) * (1.0 + 0x1p-40) + 1e-153;
}

/// Queries that one thread answers in a row.
constexpr std::size_t queries_per_chunk = 256;

/// The answers to many queries: a chunk's searches write into one list, in their own order; then
/// the lists are taken apart into the order of the queries.
template <std::size_t D, class MakeKept>
answer_lists<near_point> lists_of(const point_blocks<D>& points, double largest,
                                  std::span<const std::array<double, D>> queries, double radius,
                                  std::size_t k, const MakeKept& make_kept) {
    check_radius(name, radius);
    for (std::size_t i = 0; i < queries.size(); ++i)
        check_query(queries[i], "query " + std::to_string(i));
    const auto order = morton_order<D>(queries.size(), [&](std::size_t i) { return queries[i]; });
    std::vector<std::vector<near_point>> found(chunk_count(order.size(), queries_per_chunk));
    std::vector<std::size_t> count(order.size());
    for_chunks(order.size(), queries_per_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   auto kept = make_kept();
                   point_searcher<D, decltype(kept)> searcher(points, largest, radius, kept);
                   std::vector<near_point>& mine = found[chunk];
                   mine.reserve(std::min<std::size_t>(k, 64) * (end - begin));
                   double limit = std::numeric_limits<double>::infinity();
                   for (std::size_t i = begin; i < end; ++i) {
                       const std::size_t before = mine.size();
                       searcher.search(queries[order[i]], limit, mine);
                       count[order[i]] = mine.size() - before;
                       if (i + 1 < end && k != 0 && count[order[i]] == k)
                           limit = limit_after(queries[order[i]], queries[order[i + 1]],
                                               mine.back().distance);
                       else
                           limit = std::numeric_limits<double>::infinity();
                   }
               });
    answer_lists<near_point> lists;
    lists.begin.resize(order.size() + 1);
    for (std::size_t i = 0; i < order.size(); ++i) lists.begin[i + 1] = lists.begin[i] + count[i];
    lists.answers.resize(lists.begin.back());
    for_chunks(order.size(), queries_per_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   auto from = found[chunk].begin();
                   for (std::size_t i = begin; i < end; ++i) {
                       const auto next = from + static_cast<std::ptrdiff_t>(count[order[i]]);
                       std::copy(from, next,
                                 lists.answers.begin() +
                                     static_cast<std::ptrdiff_t>(lists.begin[order[i]]));
                       from = next;
                   }
               });
    return lists;
}

template <std::size_t D, class Kept>
std::vector<near_point> list_of(const point_blocks<D>& points, double largest,
                                const std::array<double, D>& query, double radius, Kept kept) {
    check_radius(name, radius);
    check_query(query, "the query");
    std::vector<near_point> found;
    point_searcher<D, Kept> searcher(points, largest, radius, kept);
    searcher.search(query, std::numeric_limits<double>::infinity(), found);
    return found;
}

}  // namespace
}  // namespace detail

template <std::size_t D>
std::optional<near_point> point_search<D>::nearest(const point& query, double radius) const {
    const std::vector<near_point> found = k_nearest(query, 1, radius);
    return found.empty() ? std::optional<near_point>() : found[0];
}

template <std::size_t D>
std::vector<near_point> point_search<D>::k_nearest(const point& query, std::size_t k,
                                                   double radius) const {
    return detail::list_of<D>({&tree_, coordinates_.data()}, largest_, query, radius,
                              detail::k_offered(std::min(k, size()), 0.0));
}

template <std::size_t D>
std::vector<near_point> point_search<D>::all_within(const point& query, double radius) const {
    return detail::list_of<D>({&tree_, coordinates_.data()}, largest_, query, radius,
                              detail::all_offered(0.0));
}

template <std::size_t D>
answer_lists<near_point> point_search<D>::k_nearest(std::span<const point> queries, std::size_t k,
                                                    double radius) const {
    k = std::min(k, size());
    return detail::lists_of<D>({&tree_, coordinates_.data()}, largest_, queries, radius, k,
                               [&] { return detail::k_offered(k, 0.0); });
}

template <std::size_t D>
answer_lists<near_point> point_search<D>::all_within(std::span<const point> queries,
                                                     double radius) const {
    return detail::lists_of<D>({&tree_, coordinates_.data()}, largest_, queries, radius, 0,
                               [] { return detail::all_offered(0.0); });
}

template class point_search<2>;
template class point_search<3>;

}  // namespace treeform
#endif
