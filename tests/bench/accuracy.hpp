#pragma once
/// \file
/// What the accuracy experiments (E1 ...) show alike: time against error by method, and tables of
/// who is wrong how often.

#include "bench/error_chart.hpp"
#include "bench/page.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::bench {

/// A figure of what failed and was not run: it counts, its time does not.
inline constexpr std::string_view not_run = "not run";

/// An error of a contestant in a contest; none where it has none to speak of.
using error_of = std::function<std::optional<double>(const outcome&, const measured&)>;

/// The figure of that name, times `scale`; none where the row has no such figure.
[[nodiscard]] error_of figure_named(std::string name, double scale = 1.0);
[[nodiscard]] std::optional<double> figure_of(const measured& row, std::string_view name);

/// What becomes of the errors in several contests.
enum class joined_by { mean, largest };

/// A series for each contestant, a dot for each contest in it.
[[nodiscard]] std::vector<error_series> dots_by_contest(std::span<const outcome> outcomes,
                                                        const error_of& error);

/// A series for each contestant with one dot, at the geometric mean of its times and its joined
/// error; contestants whose names are the same up to " eps " are one series, joined by a line.
[[nodiscard]] std::vector<error_series> dots_by_method(std::span<const outcome> outcomes,
                                                       const error_of& error, joined_by by);

/// A row for each contestant, a column for each contest (its name up to the first slash), and one
/// of sums before them; "-" where there is no such error.
[[nodiscard]] std::vector<std::vector<std::string>> table_of(std::span<const outcome> outcomes,
                                                             const error_of& error);

/// Columns of sums over the contests behind the names of the contestants, their times first.
struct summed_column {
    std::string head;
    error_of value;
    joined_by by = joined_by::mean;
    bool is_sum = true;  ///< else joined
};
[[nodiscard]] std::vector<std::vector<std::string>> summary_of(
    std::span<const outcome> outcomes, const std::vector<summed_column>& columns);

}  // namespace treeform::bench
