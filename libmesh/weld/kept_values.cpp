#include <libmesh/base/nearest_float.hpp>
#include <libmesh/weld/kept_values.hpp>
#include <libmesh/weld/property_groups.hpp>
#include <libmesh/weld/running_mean.hpp>
#include <libmesh/weld/vertex_values.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstring>

namespace treeform::detail::weld {
namespace {

template <class Value>
double mean(std::span<const std::uint32_t> members, const Value& value) {
    running_mean all;
    for (const std::uint32_t i : members) all.add(value(i));
    return all.value();
}

template <class Body>
void for_groups_of_several(const group_members& members, const Body& body) {
    for_chunks(members.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t g = begin; g < end; ++g)
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
