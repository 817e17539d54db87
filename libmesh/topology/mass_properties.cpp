#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/double_double.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace treeform {
namespace {

using detail::base::double_double;

/// Of tetrahedra from one point to faces: 6 times the volume, 24 times the first moments, 120 times
/// the second ones (xx, yy, zz, yz, zx, xy); 6 times the volumes without their signs.
using moment_sums = std::array<double_double, 11>;

void add_moments(const point3& a, const point3& b, const point3& c, moment_sums& sums) {
    const double_double volume = detail::base::determinant(a, b, c);
    sums[0] = sums[0] + volume;
    sums[10] = sums[10] + double_double{std::abs(volume.high), 0.0};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const double first = a[i] + b[i] + c[i];
        const double square = a[i] * a[i] + b[i] * b[i] + c[i] * c[i] + first * first;
        const double product =
            a[j] * a[k] + b[j] * b[k] + c[j] * c[k] + (a[j] + b[j] + c[j]) * (a[k] + b[k] + c[k]);
        sums[1 + i] = sums[1 + i] + first * volume;
        sums[4 + i] = sums[4 + i] + square * volume;
        sums[7 + i] = sums[7 + i] + product * volume;
    }
}

}  // namespace

std::optional<mass_properties> find_mass_properties(const mesh_ref& given) {
    const mesh_view mesh = given.view();
    detail::base::check_faces("find_mass_properties", mesh.points.size(), mesh.faces);
    const std::optional<box3> box = bounding_box(mesh.points);
    if (!box) return {};
    point3 middle;
    for (std::size_t i = 0; i < 3; ++i) middle[i] = box->min[i] / 2 + box->max[i] / 2;
    const auto from_middle = [&](std::uint32_t v) {
        const point3& p = mesh.points[v];
        return point3{p.x - middle.x, p.y - middle.y, p.z - middle.z};
    };
    std::vector<moment_sums> parts(chunk_count(mesh.faces.size(), light_grain));
    for_chunks(mesh.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   for (std::size_t f = begin; f < end; ++f) {
                       const auto [a, b, c] = mesh.faces[f];
                       add_moments(from_middle(a), from_middle(b), from_middle(c), parts[chunk]);
                   }
               });
    moment_sums all{};
    for (const moment_sums& part : parts)
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] + part[i];
    mass_properties made;
    made.volume = all[0].high / 6.0;
    // First moments are off by 2^-50 of what is summed: the center by 2^-10 of the box at most.
    constexpr double least_share = 0x1p-40;
    if (!(std::abs(all[0].high) > least_share * all[10].high) || !std::isfinite(made.volume))
        return {};
    point3 off;
    for (std::size_t i = 0; i < 3; ++i) {
        off[i] = all[1 + i].high / 24.0 / made.volume;
        made.center[i] = middle[i] + off[i];
    }
    std::array<double, 3> square;  // about the center
    for (std::size_t i = 0; i < 3; ++i)
        square[i] = all[4 + i].high / 120.0 - made.volume * off[i] * off[i];
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        made.inertia[i][i] = square[j] + square[k];
        made.inertia[j][k] = made.volume * off[j] * off[k] - all[7 + i].high / 120.0;
        made.inertia[k][j] = made.inertia[j][k];
    }
    return made;
}

}  // namespace treeform
