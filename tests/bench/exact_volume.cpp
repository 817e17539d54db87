#include "bench/exact_volume.hpp"

namespace tf::bench {
namespace {

using rational_point = std::array<mpq_class, 3>;

rational_point rational(const point3& p) {
    return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
}

}  // namespace

mpq_class six_volumes(const rational_point& a, const rational_point& b, const rational_point& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

mpq_class exact_volume(mesh_view mesh) {
    mpq_class sum = 0;
    for (const face& f : mesh.faces)
        sum += six_volumes(rational(mesh.points[f[0]]), rational(mesh.points[f[1]]),
                           rational(mesh.points[f[2]]));
    return sum / 6;
}

}  // namespace tf::bench
