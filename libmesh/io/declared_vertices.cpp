#include <libmesh/io/number.hpp>
#include <libmesh/io/ply_header.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <libmesh/io/writers.hpp>

#include <algorithm>

namespace treeform::detail::io {

namespace {

/// True when every coordinate of that axis is a value of the type.
[[nodiscard]] bool fits(std::span<const point3> points, column_role axis, scalar_type type) {
    if (type == scalar_type::float64) return true;
    return with_type(type, [&]<class T>(T) {
        return std::all_of(points.begin(), points.end(), [&](const point3& p) {
            const double x = p[axis_number(axis)];
            if constexpr (std::is_floating_point_v<T>) {
                const point3 alone{x, x, x};
                return fits_float32(std::span(&alone, 1));
            } else {
                return is_value_of<T>(x);
            }
        });
    });
}

}  // namespace

element declare_vertices(const write_job& job, bool text,
                         std::optional<std::span<const point3>> points) {
    element e{.name = "vertex"};
    if (job.vertices != nullptr)
        for (const column& c : job.vertices->columns) e.columns.push_back(declaration(c));
    const scalar_type wanted = job.single() ? scalar_type::float32 : scalar_type::float64;
    // Floats that are not to be single come from text, or have been moved.
    const bool widen = !points && !job.single() && has_single_axes(e);
    std::ptrdiff_t added = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const column_role role = role_of_axis(axis);
        const auto at = std::ranges::find(e.columns, role, &column::role);
        if (at == e.columns.end())
            e.columns.insert(e.columns.begin() + added++,
                             {.name = std::string(1, "xyz"[axis]), .type = wanted, .role = role});
        else if (job.options.precision ||
                 (!(text && keeps_digits(*at)) &&
                  ((widen && keeps_digits(*at)) || (points && !fits(*points, role, at->type)))))
            at->type = wanted;
    }
    return e;
}

std::array<bool, 3> outgrown_axes(const element& declared, std::span<const point3> points) {
    std::array<bool, 3> outgrown{};
    for (const column& c : declared.columns)
        if (is_axis(c)) outgrown[axis_number(c.role)] = !fits(points, c.role, c.type);
    return outgrown;
}

void check_axes(const write_job& job, bool text, const element& declared,
                std::span<const point3> points) {
    if (job.options.precision) return;
    unfit_point first{points.size()};
    for (const column& c : declared.columns) {
        if (c.role == column_role::data || (text && keeps_digits(c))) continue;
        if (fits(points.first(first.point), c.role, c.type)) continue;
        std::size_t i = 0;
        while (fits(points.subspan(i, 1), c.role, c.type)) ++i;
        first = {i, "a coordinate does not fit column " + c.name + " of type " +
                        std::string(name_of(c.type))};
    }
    if (first.point < points.size()) throw first;
}

}  // namespace treeform::detail::io
