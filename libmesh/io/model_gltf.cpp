#include <libmesh/base/point_math.hpp>
#include <libmesh/io/model_gltf.hpp>

#include <cmath>

namespace treeform::detail::io {

namespace {

[[nodiscard]] point3 linear_row(const transform_gltf& t, std::size_t row) {
    return {t.m[row][0], t.m[row][1], t.m[row][2]};
}

}  // namespace

transform_gltf compose(const transform_gltf& inner, const transform_gltf& outer) {
    transform_gltf product;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t col = 0; col < 4; ++col) {
            double sum = col == 3 ? outer.m[row][3] : 0.0;
            for (std::size_t k = 0; k < 3; ++k) sum += outer.m[row][k] * inner.m[k][col];
            product.m[row][col] = sum;
        }
    return product;
}

point3 moved(const transform_gltf& t, const point3& p) {
    if (t == transform_gltf{}) return p;
    point3 there;
    for (std::size_t axis = 0; axis < 3; ++axis)
        there[axis] = t.m[axis][0] * p.x + t.m[axis][1] * p.y + t.m[axis][2] * p.z + t.m[axis][3];
    return there;
}

bool mirrors(const transform_gltf& t) {
    return base::dot(linear_row(t, 0), base::cross(linear_row(t, 1), linear_row(t, 2))) < 0.0;
}

point3 turned(const transform_gltf& t, const point3& normal) {
    if (t == transform_gltf{}) return normal;
    // The cofactors are the inverse transpose times the determinant, whose sign must not count.
    point3 there;
    for (std::size_t axis = 0; axis < 3; ++axis)
        there[axis] = base::dot(
            base::cross(linear_row(t, (axis + 1) % 3), linear_row(t, (axis + 2) % 3)), normal);
    const double length = std::hypot(there.x, there.y, there.z);
    if (!(length > 0.0) || !std::isfinite(length)) return {};
    return base::scaled(there, (mirrors(t) ? -1.0 : 1.0) / length);
}

bool is_rotation(const std::array<double, 4>& quaternion) {
    const auto [x, y, z, w] = quaternion;
    const double square = x * x + y * y + z * z + w * w;
    return square > 1e-100 && square < 1e100;
}

transform_gltf transform_of(const point3& translation, const std::array<double, 4>& rotation,
                            const point3& scale) {
    const auto [x, y, z, w] = rotation;
    const double s = 2.0 / (x * x + y * y + z * z + w * w);  // of any length: rounded, it is not 1
    const std::array<std::array<double, 3>, 3> turn{
        {{1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
         {s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)},
         {s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)}}};
    transform_gltf t;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t col = 0; col < 3; ++col) t.m[row][col] = turn[row][col] * scale[col];
        t.m[row][3] = translation[row];
    }
    return t;
}

}  // namespace treeform::detail::io
