#include "bench/accuracy.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace treeform::bench {
namespace {

constexpr std::string_view sweep = " eps ";

double time_of(const outcome& outcome, const measured& row) {
    return outcome.unit.is_rate ? outcome.unit.scale / row.median : outcome.unit.scale * row.median;
}

std::string name_of(const measured& row) {
    return row.threads > 1 ? fmt::format("{}, {} threads", row.who, row.threads) : row.who;
}

/// Contestants of all contests in the order in which they first appear.
std::vector<std::string> names_of(std::span<const outcome> outcomes) {
    std::vector<std::string> names;
    for (const outcome& outcome : outcomes)
        for (const measured& row : outcome.rows)
            if (std::ranges::find(names, name_of(row)) == names.end())
                names.push_back(name_of(row));
    return names;
}

const measured* row_of(const outcome& outcome, const std::string& name) {
    for (const measured& row : outcome.rows)
        if (name_of(row) == name) return &row;
    return nullptr;
}

/// Colors by name; methods of one color get different shapes.
class dresser {
  public:
    [[nodiscard]] error_series dressed(const std::string& name) {
        const int tone = tone_of(name, 7);
        return {.name = name, .tone = tone, .shape = used_[tone]++};
    }

  private:
    std::map<int, int> used_;
};

std::string number(double value) {
    return value == std::floor(value) && std::abs(value) < 1e7 ? fmt::format("{:.0f}", value)
                                                               : fmt::format("{:.3g}", value);
}

struct totals {
    double log_time = 0.0, sum = 0.0, largest = 0.0;
    int contests = 0, errors = 0;

    [[nodiscard]] double time() const { return std::exp(log_time / std::max(contests, 1)); }
    [[nodiscard]] double joined(joined_by by) const {
        return by == joined_by::largest ? largest : sum / std::max(errors, 1);
    }
};

totals totals_of(std::span<const outcome> outcomes, const std::string& name,
                 const error_of& error) {
    totals all;
    for (const outcome& outcome : outcomes) {
        const measured* const row = row_of(outcome, name);
        if (!row) continue;
        if (!figure_of(*row, not_run)) {
            all.log_time += std::log(time_of(outcome, *row));
            ++all.contests;
        }
        if (const auto e = error(outcome, *row)) {
            all.sum += *e;
            all.largest = std::max(all.largest, *e);
            ++all.errors;
        }
    }
    return all;
}

}  // namespace

std::optional<double> figure_of(const measured& row, std::string_view name) {
    for (const figure& figure : row.figures)
        if (figure.unit == name) return figure.value;
    return {};
}

error_of figure_named(std::string name, double scale) {
    return [name = std::move(name), scale](const outcome&, const measured& row) {
        std::optional<double> value = figure_of(row, name);
        if (value) *value *= scale;
        return value;
    };
}

std::vector<error_series> dots_by_contest(std::span<const outcome> outcomes,
                                          const error_of& error) {
    std::vector<error_series> all;
    dresser dresser;
    for (const std::string& name : names_of(outcomes)) {
        error_series series = dresser.dressed(name);
        for (const outcome& outcome : outcomes)
            if (const measured* const row = row_of(outcome, name))
                if (const auto e = error(outcome, *row))
                    series.points.push_back({time_of(outcome, *row), *e, outcome.name});
        if (!series.points.empty()) all.push_back(std::move(series));
    }
    return all;
}

std::vector<error_series> dots_by_method(std::span<const outcome> outcomes, const error_of& error,
                                         joined_by by) {
    std::vector<error_series> all;
    dresser dresser;
    for (const std::string& name : names_of(outcomes)) {
        const totals total = totals_of(outcomes, name, error);
        if (total.errors == 0) continue;
        const std::size_t cut = name.find(sweep);
        const bool swept = cut != std::string::npos;
        const std::string method = swept ? name.substr(0, cut) + " with eps" : name;
        auto found = std::ranges::find(all, method, &error_series::name);
        if (found == all.end()) {
            all.push_back(dresser.dressed(method));
            all.back().joined = swept;
            found = std::prev(all.end());
        }
        found->points.push_back(
            {total.time(), total.joined(by), swept ? name.substr(cut + 1) : std::string()});
    }
    return all;
}

std::vector<std::vector<std::string>> table_of(std::span<const outcome> outcomes,
                                               const error_of& error) {
    std::vector<std::vector<std::string>> table{{"", "all"}};
    for (const outcome& outcome : outcomes)
        table[0].push_back(outcome.name.substr(0, outcome.name.find('/')));
    for (const std::string& name : names_of(outcomes)) {
        const totals total = totals_of(outcomes, name, error);
        if (total.errors == 0) continue;
        std::vector<std::string> cells{name, number(total.sum)};
        for (const outcome& outcome : outcomes) {
            const measured* const row = row_of(outcome, name);
            const auto e = row ? error(outcome, *row) : std::nullopt;
            cells.push_back(e ? number(*e) : "-");
        }
        table.push_back(std::move(cells));
    }
    return table;
}

std::vector<std::vector<std::string>> summary_of(std::span<const outcome> outcomes,
                                                 const std::vector<summed_column>& columns) {
    if (outcomes.empty()) return {};
    std::vector<std::vector<std::string>> table{{"", outcomes.front().unit.name}};
    for (const summed_column& column : columns) table[0].push_back(column.head);
    for (const std::string& name : names_of(outcomes)) {
        std::vector<std::string> cells{name};
        for (const summed_column& column : columns) {
            const totals total = totals_of(outcomes, name, column.value);
            if (cells.size() == 1) cells.push_back(fmt::format("{:.3g}", total.time()));
            cells.push_back(total.errors == 0
                                ? "-"
                                : number(column.is_sum ? total.sum : total.joined(column.by)));
        }
        table.push_back(std::move(cells));
    }
    return table;
}

}  // namespace treeform::bench
