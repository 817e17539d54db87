#include <libmesh/weld/conditions.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace treeform::detail::weld {
namespace {

/// Numbers that are equal where the numbers in `label` are and where the values of both columns
/// are; NaN equals NaN here, and a point that takes no part nothing. Empty arrays do not tell
/// points apart.
std::vector<std::uint32_t> refine(std::size_t count, std::span<const std::uint32_t> label,
                                  std::span<const std::uint8_t> takes_part,
                                  std::span<const double> a, std::span<const double> b) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    buffer<point3> keys(count);
    for_chunks(count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        const auto value = [](std::span<const double> values, std::size_t i) {
            return values.empty() ? 0.0 : values[i];
        };
        for (std::size_t i = begin; i < end; ++i) {
            const double u = value(a, i);
            const double v = value(b, i);
            const bool no_u = std::isnan(u);
            const bool no_v = std::isnan(v);
            const std::uint64_t number = (label.empty() ? 0 : std::uint64_t{label[i]}) * 4 +
                                         (no_u ? 2U : 0U) + (no_v ? 1U : 0U);
            const bool alone = !takes_part.empty() && takes_part[i] == 0;
            keys[i] = {alone ? nan : static_cast<double>(number), no_u ? 0.0 : u, no_v ? 0.0 : v};
        }
    });
    return find_equal_points(keys.span()).group_of_point;
}

[[noreturn]] void refuse_conditions(const std::string& why) {
    throw std::invalid_argument("treeform::weld: " + why);
}

}  // namespace

conditions::conditions(points_view points, const attributes& properties,
                       const weld_options& options, std::span<const weld_condition> asked,
                       std::span<const std::uint8_t> takes_part)
    : given_(options) {
    if (!given_.label.empty() && given_.label.size() != points.size())
        refuse_conditions(std::to_string(given_.label.size()) + " labels for " +
                          std::to_string(points.size()) + " points");
    std::vector<buffer<double>> equal;
    // Two columns a round.
    const auto refine_by_columns = [&] {
        const auto values = [&](std::size_t i) {
            return i < equal.size() ? equal[i].span() : std::span<const double>{};
        };
        label_ = refine(points.size(), label_.empty() ? given_.label : label_, takes_part,
                        values(0), values(1));
        equal.clear();
    };
    for (const weld_condition& condition : asked) {
        const double tolerance = condition.tolerance;
        if (!(tolerance >= 0.0) || !std::isfinite(tolerance))
            refuse_conditions("the tolerance of '" + condition.property +
                              "' must be finite and not negative");
        vertex_values values(points, properties, condition.property);
        if (tolerance > 0.0) {
            questions_.push_back({std::move(values), tolerance});
            continue;
        }
        for (buffer<double>& column : std::move(values).take_columns()) {
            equal.push_back(std::move(column));
            if (equal.size() == 2) refine_by_columns();
        }
    }
    if (!equal.empty() || (label_.empty() && !takes_part.empty())) refine_by_columns();
}

bool conditions::agree(std::uint32_t i, std::uint32_t j) const {
    for (const question& q : questions_)
        if (!q.values.agree(i, j, q.tolerance)) return false;
    return !given_.may_merge || given_.may_merge(i, j);
}

weld_options conditions::options() const {
    weld_options options = given_;
    if (!label_.empty()) options.label = label_;
    if (!questions_.empty())
        options.may_merge = [this](std::uint32_t i, std::uint32_t j) { return agree(i, j); };
    return options;
}

}  // namespace treeform::detail::weld
