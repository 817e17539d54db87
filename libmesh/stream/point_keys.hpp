#pragma once
/// \file
/// The values of points that rules, conditions and choices look at, block by block; and which
/// points are kept.

#include <libmesh/weld/vertex_values.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace treeform::detail::stream {

class point_keys {
  public:
    /// \throws weld_property_error for a property that `header` does not have in a usable form,
    ///         std::invalid_argument as `weld`
    point_keys(const mesh_file& header, const weld_stream_options& options);

    /// The conditions on the values.
    [[nodiscard]] const weld::agreement& agree() const { return agree_; }
    [[nodiscard]] const std::vector<weld_condition>& conditions() const { return conditions_; }

    /// Writes the values of all points, point after point, to `to`.
    void values_of(io::point_block& block, std::vector<std::uint64_t>& to) const;
    /// Writes one key for each point: smaller for points that come earlier in the order, or are
    /// preferred; 0 without a property.
    void order_of(io::point_block& block, std::vector<std::uint64_t>& to) const;
    void choice_of(io::point_block& block, std::vector<std::uint64_t>& to) const;

  private:
    struct key_column {
        std::string property{};
        bool lowest = true;
    };
    static void take(io::point_block& block, const key_column& p, std::vector<std::uint64_t>& to);

    std::vector<weld_condition> conditions_{};
    weld::agreement agree_{};
    key_column order_{};
    key_column choice_{};
};

/// Which points of a cloud are kept, in a bit each. All are kept at first.
class kept_points {
  public:
    /// For `count` points, numbered from `first`.
    explicit kept_points(std::uint64_t count, std::uint64_t first = 0)
        : first_(first), dropped_(count / 64 + 1, 0) {}

    /// Drops a point; returns false if it was already dropped.
    bool drop(std::uint64_t point) {
        point -= first_;
        std::uint64_t& word = dropped_[point / 64];
        const std::uint64_t bit = std::uint64_t{1} << point % 64;
        const bool was_kept = (word & bit) == 0;
        word |= bit;
        return was_kept;
    }
    void keep(std::uint64_t point) {
        point -= first_;
        dropped_[point / 64] &= ~(std::uint64_t{1} << point % 64);
    }
    [[nodiscard]] bool keeps(std::uint64_t point) const {
        point -= first_;
        return (dropped_[point / 64] >> point % 64 & 1) == 0;
    }
    [[nodiscard]] std::uint64_t dropped() const {
        std::uint64_t sum = 0;
        for (const std::uint64_t word : dropped_) sum += count_ones(word);
        return sum;
    }

    /// Whether some point is dropped in both sets. \pre both have the same count
    [[nodiscard]] bool shares_a_drop(const kept_points& other) const {
        for (std::size_t w = 0; w < dropped_.size(); ++w)
            if ((dropped_[w] & other.dropped_[w]) != 0) return true;
        return false;
    }

    /// Prepares `number_of` for the present set.
    void number() {
        dropped_before_.clear();
        dropped_before_.reserve(dropped_.size() / words_a_step + 1);
        std::uint64_t sum = 0;
        for (std::size_t w = 0; w < dropped_.size(); ++w) {
            if (w % words_a_step == 0) dropped_before_.push_back(sum);
            sum += count_ones(dropped_[w]);
        }
    }
    /// The number of kept points from `first` up to `point`, exclusive.
    [[nodiscard]] std::uint64_t number_of(std::uint64_t point) const {
        point -= first_;
        const std::size_t last = point / 64;
        std::uint64_t sum = dropped_before_[last / words_a_step];
        for (std::size_t w = last / words_a_step * words_a_step; w < last; ++w)
            sum += count_ones(dropped_[w]);
        sum += count_ones(dropped_[last] & ((std::uint64_t{1} << point % 64) - 1));
        return point - sum;
    }

  private:
    static constexpr std::size_t words_a_step = 8;

    [[nodiscard]] static std::uint64_t count_ones(std::uint64_t word) {
        return static_cast<std::uint64_t>(std::popcount(word));
    }

    std::uint64_t first_;
    std::vector<std::uint64_t> dropped_;
    std::vector<std::uint64_t> dropped_before_{};
};

}  // namespace treeform::detail::stream
