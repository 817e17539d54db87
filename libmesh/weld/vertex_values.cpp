#include <libmesh/base/for_numbers.hpp>
#include <libmesh/weld/vertex_values.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace treeform::detail::weld {
namespace {

template <class T, class Value>
buffer<T> filled(std::size_t count, const Value& value) {
    buffer<T> values(count);
    base::for_numbers(count, [&](std::size_t i) { values[i] = value(i); });
    return values;
}

/// Whether |a - b| <= t, for t finite and not negative. The rounded difference settles it unless it
/// equals t, since rounding is monotone; then the sign of its error does, which the four operations
/// (Dekker's fast two-sum, with the larger magnitude first) give without rounding.
bool differ_by_at_most(double a, double b, double t) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return true;
    if (a < b) std::swap(a, b);
    const double d = a - b;
    if (d != t) return d < t;
    const double large = std::abs(a) < std::abs(b) ? -b : a;
    const double small = std::abs(a) < std::abs(b) ? a : -b;
    return small - (d - large) <= 0.0;
}

bool differ_by_at_most(std::uint64_t a, std::uint64_t b, double t) {
    const std::uint64_t d = a < b ? b - a : a - b;
    return t >= 0x1p64 || d <= static_cast<std::uint64_t>(t);
}

/// The inverse of an ascending key; NaN comes back as NaN, -0 as +0.
double number_of_key(std::uint64_t key) {
    constexpr std::uint64_t sign = std::uint64_t{1} << 63;
    return std::bit_cast<double>((key & sign) != 0 ? key ^ sign : ~key);
}

}  // namespace

void refuse(const std::string& why) { throw std::invalid_argument("treeform::weld: " + why); }

bool keys_agree(bool whole, std::uint64_t a, std::uint64_t b, double tolerance) {
    return whole ? differ_by_at_most(a, b, tolerance)
                 : differ_by_at_most(number_of_key(a), number_of_key(b), tolerance);
}

vertex_values::vertex_values(points_view points, const attributes& properties,
                             const std::string& name) {
    const element* vertices = properties.find("vertex");
    const column* c = vertices == nullptr ? nullptr : vertices->find(name);
    if (c == nullptr || c->role != column_role::data) {
        const std::size_t axis = name.size() == 1 ? std::string_view("xyz").find(name) : 3;
        if (axis > 2) refuse("no vertex property '" + name + "'");
        number_ = filled<double>(points.size(), [&](std::size_t i) { return points[i][axis]; });
        return;
    }
    if (c->list_length) refuse("the vertex property '" + name + "' is a list");
    const bool is_signed = c->type == scalar_type::int64;
    if (!is_signed && c->type != scalar_type::uint64) {
        number_ = filled<double>(points.size(), [&](std::size_t i) { return c->number(i); });
        return;
    }
    whole_ = filled<std::uint64_t>(points.size(), [&](std::size_t i) {
        std::uint64_t value = 0;
        std::memcpy(&value, c->values.data() + i * sizeof value, sizeof value);
        return is_signed ? value ^ std::uint64_t{1} << 63 : value;
    });
}

std::uint64_t vertex_values::ascending_key(std::size_t i) const {
    if (whole_.size() > 0) return whole_[i];
    if (is_nan(i)) return ~std::uint64_t{0};  // above the key of infinity
    // Magnitudes of positive doubles are ordered as their bits, of negative ones the other way.
    const auto bits = std::bit_cast<std::uint64_t>(number_[i] + 0.0);  // -0 + 0 = +0
    constexpr std::uint64_t sign = std::uint64_t{1} << 63;
    return (bits & sign) != 0 ? ~bits : bits | sign;
}

bool vertex_values::agree(std::size_t i, std::size_t j, double tolerance) const {
    return whole_.size() > 0 ? differ_by_at_most(whole_[i], whole_[j], tolerance)
                             : differ_by_at_most(number_[i], number_[j], tolerance);
}

std::vector<buffer<double>> vertex_values::take_columns() && {
    std::vector<buffer<double>> columns;
    if (whole_.size() == 0) {
        columns.push_back(std::move(number_));
        return columns;
    }
    for (const unsigned shift : {0U, 32U})
        columns.push_back(filled<double>(whole_.size(), [&](std::size_t i) {
            return static_cast<double>(static_cast<std::uint32_t>(whole_[i] >> shift));
        }));
    return columns;
}

agreement::agreement(std::vector<condition> conditions) : conditions_(std::move(conditions)) {
    transitive_ = std::all_of(conditions_.begin(), conditions_.end(),
                              [](const condition& c) { return c.tolerance == 0.0; });
}

bool agreement::holds(const std::uint64_t* a, const std::uint64_t* b) const {
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
        const condition& c = conditions_[i];
        if (a[i] == b[i]) continue;
        if (c.tolerance == 0.0 || !keys_agree(c.whole, a[i], b[i], c.tolerance)) return false;
    }
    return true;
}

bool agreement::same(const std::uint64_t* a, const std::uint64_t* b) const {
    return std::equal(a, a + conditions_.size(), b);
}

std::uint64_t agreement::salt(const std::uint64_t* values) const {
    std::uint64_t h = 0;
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
        if (conditions_[i].tolerance > 0.0) continue;
        h = (h ^ values[i] ^ h >> 32) * 0x9e3779b97f4a7c15;
        h ^= h >> 29;
    }
    return h;
}

bool agreement::equal_before(const std::uint64_t* a, const std::uint64_t* b) const {
    for (std::size_t i = 0; i < conditions_.size(); ++i)
        if (conditions_[i].tolerance == 0.0 && a[i] != b[i]) return a[i] < b[i];
    return false;
}

std::vector<std::uint32_t> agreement::labels(std::span<const std::uint64_t> rows) const {
    if (size() == 0) return {};
    std::vector<std::uint32_t> order(rows.size() / size());
    std::iota(order.begin(), order.end(), 0U);
    const auto row = [&](std::uint32_t i) { return rows.data() + i * size(); };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return equal_before(row(a), row(b)); });
    std::vector<std::uint32_t> label(order.size());
    for (std::size_t k = 1; k < order.size(); ++k)
        label[order[k]] =
            label[order[k - 1]] + (equal_before(row(order[k - 1]), row(order[k])) ? 1U : 0U);
    return label;
}

}  // namespace treeform::detail::weld
