#include <treeform/tree/aabb.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace treeform {

std::array<std::array<double, 4>, 3> detail::rotation_rows(const std::array<double, 3>& about,
                                                           double degrees) {
    std::array<double, 3> axis = about;
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    if (!(length > 0.0 && std::isfinite(length) && std::isfinite(degrees)))
        throw std::invalid_argument("treeform::transform::rotation: not an axis and an angle");
    for (double& k : axis) k /= length;
    int quarters = 0;
    const double rest = std::remquo(degrees, 90.0, &quarters) * (std::numbers::pi / 180.0);
    const std::array<double, 4> turns{std::cos(rest), -std::sin(rest), -std::cos(rest),
                                      std::sin(rest)};
    const double c = turns[quarters & 3], s = turns[(quarters + 3) & 3];
    std::array<std::array<double, 4>, 3> rows{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        rows[i][i] = axis[i] * axis[i] + c * (axis[j] * axis[j] + axis[k] * axis[k]);
        rows[i][j] = (1.0 - c) * axis[i] * axis[j] - s * axis[k];
        rows[i][k] = (1.0 - c) * axis[i] * axis[k] + s * axis[j];
    }
    return rows;
}

}  // namespace treeform
