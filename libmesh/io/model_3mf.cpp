#include <libmesh/io/model_3mf.hpp>

namespace treeform::detail::io {

transform_3mf compose(const transform_3mf& inner, const transform_3mf& outer) {
    const transform_3mf identity;
    if (inner == identity) return outer;
    if (outer == identity) return inner;
    transform_3mf product;
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t col = 0; col < 3; ++col) {
            double sum = row == 3 ? outer.m[9 + col] : 0.0;
            for (std::size_t k = 0; k < 3; ++k) sum += inner.m[3 * row + k] * outer.m[3 * k + col];
            product.m[3 * row + col] = sum;
        }
    return product;
}

point3 moved(const transform_3mf& t, const point3& p) {
    if (t == transform_3mf{}) return p;
    point3 q;
    for (std::size_t axis = 0; axis < 3; ++axis)
        q[axis] = p.x * t.m[axis] + p.y * t.m[3 + axis] + p.z * t.m[6 + axis] + t.m[9 + axis];
    return q;
}

bool mirrors(const transform_3mf& t) {
    const auto& m = t.m;
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
               m[2] * (m[3] * m[7] - m[4] * m[6]) <
           0.0;
}

}  // namespace treeform::detail::io
