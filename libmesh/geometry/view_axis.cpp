#include <libmesh/geometry/view_axis.hpp>
#include <treeform/mesh/predicates.hpp>

#include <cmath>
#include <utility>

namespace treeform::detail::geometry {
namespace {

/// Axes by falling size of the rounded normal; overflow and NaN only cost the good order.
std::array<int, 3> likely_axes(const triangle3& t) {
    std::array<double, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        size[axis] = std::abs((t[1][u] - t[0][u]) * (t[2][v] - t[0][v]) -
                              (t[1][v] - t[0][v]) * (t[2][u] - t[0][u]));
    }
    std::array<int, 3> axes{0, 1, 2};
    const auto sort_two = [&](std::size_t i, std::size_t j) {
        if (size[j] > size[i]) {
            std::swap(size[i], size[j]);
            std::swap(axes[i], axes[j]);
        }
    };
    sort_two(0, 1);
    sort_two(1, 2);
    sort_two(0, 1);
    return axes;
}

}  // namespace

std::optional<view_axis> find_view_axis(const triangle3& t, predicate_counters* counters) {
    for (const int axis : likely_axes(t))
        if (const int turn = orient2d(axis, t[0], t[1], t[2], counters); turn != 0)
            return view_axis{axis, turn};
    return std::nullopt;
}

}  // namespace treeform::detail::geometry
