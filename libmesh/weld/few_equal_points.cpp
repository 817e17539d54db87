#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/flattened.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/weld/equal_firsts.hpp>
#include <libmesh/weld/few_equal_points.hpp>
#include <libmesh/weld/number_groups.hpp>
#include <libmesh/weld/point_hash.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace treeform::detail::weld {
namespace {

/// Marks of hashes, 8 to 16 for each point that there is.
class hash_marks {
  public:
    explicit hash_marks(std::size_t points)
        : shift_(32 - std::clamp(static_cast<int>(std::bit_width(points)) + 3, 6, 32)),
          seen_(std::size_t{1} << (32 - shift_ - 6)),
          again_(seen_.size()) {}

    /// Any number of threads may do so at the same time.
    void set(std::uint32_t hash) {
        if (add(seen_, hash)) add(again_, hash);
    }
    /// Whether the mark was set more than once.
    [[nodiscard]] bool is_shared(std::uint32_t hash) const {
        return (again_[word_of(hash)] & bit_of(hash)) != 0;
    }

  private:
    using words = std::vector<std::uint64_t>;

    [[nodiscard]] std::size_t word_of(std::uint32_t hash) const { return hash >> shift_ >> 6; }
    [[nodiscard]] std::uint64_t bit_of(std::uint32_t hash) const {
        return std::uint64_t{1} << (hash >> shift_ & 63U);
    }
    /// Whether the mark was there.
    bool add(words& marks, std::uint32_t hash) const {
        const std::uint64_t bit = bit_of(hash);
        return (std::atomic_ref(marks[word_of(hash)]).fetch_or(bit, std::memory_order_relaxed) &
                bit) != 0;
    }

    int shift_;
    words seen_;
    words again_;
};

/// The points whose marks are shared, ascending: all that equal another are among them.
std::vector<std::uint32_t> points_in_doubt(points_view points) {
    hash_marks marks(points.size());
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) marks.set(hash_of(points[i]));
    });
    std::vector<std::vector<std::uint32_t>> found(chunk_count(points.size(), light_grain));
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end; ++i)
            if (marks.is_shared(hash_of(points[i])))
                found[c].push_back(static_cast<std::uint32_t>(i));
    });
    return base::flattened(std::move(found));
}

}  // namespace

std::optional<point_groups> few_equal_points(points_view points) {
    if (points.size() > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument("treeform::find_equal_points: more than 2^32 - 1 points");
    const std::vector<std::uint32_t> doubted = points_in_doubt(points);
    std::vector<point3> at(doubted.size());
    for_chunks(at.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) at[i] = points[doubted[i]];
    });
    const std::vector<std::uint32_t> first = equal_firsts(at, {});
    const auto is_equal = [&](std::size_t i) { return first[i] != i; };
    if (base::first_bad(first.size(), is_equal) == first.size()) return std::nullopt;
    point_groups result;
    result.group_of_point = base::numbers_below(points.size());
    for (std::size_t i = 0; i < first.size(); ++i)
        result.group_of_point[doubted[i]] = doubted[first[i]];
    result.first_of_group = number_groups(result.group_of_point);
    return result;
}

}  // namespace treeform::detail::weld
