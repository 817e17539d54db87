#include <libmesh/weld/conditions.hpp>
#include <treeform/mesh/equal_points.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace treeform {
namespace detail::weld {
namespace {

constexpr std::size_t grain = std::size_t{1} << 16;

/// Numbers that are equal where the numbers in `kind` are and where the values of both columns are;
/// NaN equals NaN here, and a point that takes no part nothing. Empty arrays do not tell points
/// apart.
std::vector<std::uint32_t> refine(std::size_t count, std::span<const std::uint32_t> kind,
                                  std::span<const std::uint8_t> takes_part,
                                  std::span<const double> a, std::span<const double> b) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    buffer<point3> keys(count);
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        const auto value = [](std::span<const double> values, std::size_t i) {
            return values.empty() ? 0.0 : values[i];
        };
        for (std::size_t i = begin; i < end; ++i) {
            const double u = value(a, i);
            const double v = value(b, i);
            const bool no_u = std::isnan(u);
            const bool no_v = std::isnan(v);
            const std::uint64_t number = (kind.empty() ? 0 : std::uint64_t{kind[i]}) * 4 +
                                         (no_u ? 2U : 0U) + (no_v ? 1U : 0U);
            const bool alone = !takes_part.empty() && takes_part[i] == 0;
            keys[i] = {alone ? nan : static_cast<double>(number), no_u ? 0.0 : u, no_v ? 0.0 : v};
        }
    });
    return find_equal_points(keys.span()).new_of_old;
}

[[noreturn]] void refuse(const std::string& why) {
    throw std::invalid_argument("treeform::weld_mesh: " + why);
}

}  // namespace

conditions::conditions(points_view points, const attributes& properties,
                       const mesh_weld_options& options, std::span<const std::uint8_t> takes_part)
    : given_(options.points) {
    if (!given_.kind.empty() && given_.kind.size() != points.size())
        refuse(std::to_string(given_.kind.size()) + " kinds for " + std::to_string(points.size()) +
               " points");
    std::vector<buffer<double>> equal;
    // Two columns a round.
    const auto refine_by_columns = [&] {
        const auto values = [&](std::size_t i) {
            return i < equal.size() ? equal[i].span() : std::span<const double>{};
        };
        kind_ = refine(points.size(), kind_.empty() ? given_.kind : kind_, takes_part, values(0),
                       values(1));
        equal.clear();
    };
    for (const weld_condition& condition : options.conditions) {
        const double tolerance = condition.tolerance;
        if (!(tolerance >= 0.0) || !std::isfinite(tolerance))
            refuse("the tolerance of '" + condition.property + "' must be finite and not negative");
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
    if (!equal.empty() || (kind_.empty() && !takes_part.empty())) refine_by_columns();
}

bool conditions::agree(std::uint32_t i, std::uint32_t j) const {
    for (const question& q : questions_)
        if (!q.values.agree(i, j, q.tolerance)) return false;
    return !given_.agree || given_.agree(i, j);
}

weld_options conditions::options() const {
    weld_options options = given_;
    if (!kind_.empty()) options.kind = kind_;
    if (!questions_.empty())
        options.agree = [this](std::uint32_t i, std::uint32_t j) { return agree(i, j); };
    return options;
}

}  // namespace detail::weld

std::vector<weld_condition> seam_conditions(const attributes& properties) {
    constexpr std::array<std::string_view, 13> names{
        "nx",        "ny",        "nz",  "u",     "v",    "s",    "t",
        "texture_u", "texture_v", "red", "green", "blue", "alpha"};
    std::vector<weld_condition> found;
    const element* vertices = find_element(properties, "vertex");
    if (vertices == nullptr) return found;
    for (const column& c : vertices->columns)
        if (c.role == column_role::data && !c.list_length &&
            std::find(names.begin(), names.end(), c.name) != names.end())
            found.push_back({c.name, 0.0});
    return found;
}

}  // namespace treeform
