#include <libmesh/weld/group_points.hpp>
#include <libmesh/weld/number_groups.hpp>
#include <libmesh/weld/ordered_groups.hpp>
#include <libmesh/weld/property_groups.hpp>
#include <libmesh/weld/vertex_values.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace treeform::detail::weld {
namespace {

struct keyed_point {
    std::uint64_t key;
    std::uint32_t point;

    [[nodiscard]] bool operator<(const keyed_point& other) const {
        return std::tie(key, point) < std::tie(other.key, other.point);
    }
};

/// values[order[k]] for each k.
template <class T, class Values>
[[nodiscard]] buffer<T> in_order(const Values& values, std::span<const std::uint32_t> order) {
    buffer<T> sorted(order.size());
    for_chunks(order.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t k = begin; k < end; ++k) sorted[k] = values[order[k]];
    });
    return sorted;
}

}  // namespace

std::vector<std::uint32_t> points_in_order(points_view points, const attributes& properties,
                                           const weld_options& options) {
    if (options.order_by.empty()) return {};
    if (options.keep != weld_keep::first)
        throw std::invalid_argument("treeform::weld: an order needs weld_keep::first");
    const vertex_values values(points, properties, column_to_order_by(properties, options));
    if (points.size() > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument("treeform::weld: more than 2^32 - 2 points");
    buffer<keyed_point> keyed(points.size());
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
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

}  // namespace treeform::detail::weld
