#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <libmesh/weld/group_points.hpp>
#include <libmesh/weld/kept_values.hpp>
#include <libmesh/weld/vertex_values.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform::detail::weld {
namespace {

struct keyed_point {
    std::uint64_t key;
    std::uint32_t point;
    auto operator<=>(const keyed_point&) const = default;
};

/// values[order[k]] for each k.
template <class T, class Values>
[[nodiscard]] buffer<T> in_order(const Values& values, std::span<const std::uint32_t> order) {
    buffer<T> sorted(order.size());
    base::for_numbers(order.size(), [&](std::size_t k) { sorted[k] = values[order[k]]; });
    return sorted;
}

template <class Value>
double mean(std::span<const std::uint32_t> members, const Value& value) {
    running_mean all;
    for (const std::uint32_t i : members) all.add(value(i));
    return all.value();
}

template <class Body>
void for_groups_of_several(const group_members& members, const Body& body) {
    base::for_numbers(members.size(), [&](std::size_t g) {
        if (members[g].size() > 1) body(g, members[g]);
    });
}

/// float or double.
template <class T>
void take_column_means(const column& from, const group_members& members, column& to) {
    const auto value = [&](std::uint32_t i) {
        T x;
        std::memcpy(&x, from.values.data() + i * sizeof x, sizeof x);
        return static_cast<double>(x);
    };
    for_groups_of_several(members, [&](std::size_t g, std::span<const std::uint32_t> group) {
        const auto x = static_cast<T>(mean(group, value));
        std::memcpy(to.values.data() + g * sizeof x, &x, sizeof x);
    });
}

}  // namespace

std::vector<std::uint32_t> points_in_order(points_view points, const attributes& properties,
                                           const weld_options& options) {
    if (options.order_by.empty()) return {};
    const vertex_values values(points, properties, column_to_order_by(properties, options));
    if (points.size() > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument("treeform::weld: more than 2^32 - 2 points");
    buffer<keyed_point> keyed(points.size());
    base::for_numbers(points.size(), [&](std::size_t i) {
        keyed[i] = {options.highest_first ? values.descending_key(i) : values.ascending_key(i),
                    static_cast<std::uint32_t>(i)};
    });
    // No two compare equal, so the order is the only one there is.
    std::sort(keyed.data(), keyed.data() + keyed.size());
    std::vector<std::uint32_t> order(points.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = keyed[k].point;
    return order;
}

void put_earliest_first(std::span<const std::uint32_t> order, point_groups& groups) {
    for (std::size_t k = order.size(); k-- > 0;)
        groups.first_of_group[groups.group_of_point[order[k]]] = order[k];
    for (std::uint32_t& group : groups.group_of_point) group = groups.first_of_group[group];
    groups.first_of_group = number_groups(groups.group_of_point);
}

point_groups find_groups_in_order(const char* called, points_view points,
                                  const weld_options& options,
                                  std::span<const std::uint32_t> order) {
    const buffer<point3> sorted = in_order<point3>(points, order);
    buffer<std::uint32_t> label;
    weld_options asked = options;
    if (!options.label.empty()) {
        label = in_order<std::uint32_t>(options.label, order);
        asked.label = label.span();
    }
    if (options.may_merge)
        asked.may_merge = [&options, order](std::uint32_t i, std::uint32_t j) {
            return options.may_merge(order[i], order[j]);
        };
    point_groups groups = find_groups(called, sorted.span(), asked);
    if (groups.status == status::cancelled) return groups;
    std::vector<std::uint32_t> group_of_point(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
        group_of_point[order[k]] = groups.group_of_point[k];
    groups.group_of_point = std::move(group_of_point);
    put_earliest_first(order, groups);
    return groups;
}

std::vector<std::uint32_t> kept_points(points_view points, const attributes& properties,
                                       const weld_options& options, const point_groups& groups) {
    std::vector<std::uint32_t> kept = groups.first_of_group;
    const std::vector<std::uint32_t>& group_of = groups.group_of_point;
    if (options.keep == weld_keep::last)
        for (std::uint32_t i = 0; i < group_of.size(); ++i) kept[group_of[i]] = i;
    if (options.keep != weld_keep::lowest && options.keep != weld_keep::highest) return kept;
    const vertex_values values(points, properties, column_to_keep_by(properties, options));
    const bool lowest = options.keep == weld_keep::lowest;
    for (std::uint32_t i = 0; i < group_of.size(); ++i) {
        std::uint32_t& best = kept[group_of[i]];
        const bool better = lowest ? values.less(i, best) : values.less(best, i);
        if (better || (values.is_nan(best) && !values.is_nan(i))) best = i;
    }
    return kept;
}

group_members::group_members(const point_groups& groups)
    : begin_(groups.first_of_group.size() + 1, 0) {
    const std::vector<std::uint32_t>& group_of = groups.group_of_point;
    for (const std::uint32_t g : group_of) ++begin_[g];
    // Ends first; filling from the last point on turns them into beginnings.
    std::uint32_t total = 0;
    for (std::uint32_t& n : begin_) n = total += n;
    members_.resize(total);
    for (std::size_t i = group_of.size(); i-- > 0;)
        members_[--begin_[group_of[i]]] = static_cast<std::uint32_t>(i);
}

void take_means(points_view points, const group_members& members, std::vector<point3>& places) {
    for_groups_of_several(members, [&](std::size_t g, std::span<const std::uint32_t> group) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            places[g][axis] = mean(group, [&](std::uint32_t i) { return points[i][axis]; });
    });
}

void take_means(const element& vertices, const group_members& members, element& rows) {
    for (std::size_t c = 0; c < rows.columns.size(); ++c) {
        const column& from = vertices.columns[c];
        if (from.role != column_role::data || from.list_length) continue;
        if (from.type == scalar_type::float32)
            take_column_means<float>(from, members, rows.columns[c]);
        if (from.type == scalar_type::float64)
            take_column_means<double>(from, members, rows.columns[c]);
    }
}

}  // namespace treeform::detail::weld
