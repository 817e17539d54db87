#include <libmesh/volume.hpp>
#include <libtree/parallel.hpp>

#include <cstddef>
#include <vector>

namespace tf {
namespace {

/// The unevaluated sum of two doubles, the second below half a unit in the last place of the first.
struct twofold {
    double high = 0.0;
    double low = 0.0;
};

/// Exact. Needs no order of the summands.
twofold sum_of(double a, double b) {
    const double sum = a + b;
    const double b_there = sum - a;
    return {sum, (a - (sum - b_there)) + (b - b_there)};
}

/// Exact, where |a| >= |b| or a == 0.
twofold sum_of_ordered(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

/// The upper 26 bits, and the rest, which has as many.
twofold halves_of(double a) {
    const double large = 134217729.0 * a;  // 2^27 + 1
    const double high = large - (large - a);
    return {high, a - high};
}

/// Exact, away from the ends of double's range.
twofold product_of(double a, double b) {
    const double product = a * b;
    const twofold x = halves_of(a), y = halves_of(b);
    const double rest =
        x.low * y.low - (((product - x.high * y.high) - x.low * y.high) - x.high * y.low);
    return {product, rest};
}

twofold operator+(const twofold& a, const twofold& b) {
    const twofold high = sum_of(a.high, b.high);
    const twofold low = sum_of(a.low, b.low);
    const twofold both = sum_of_ordered(high.high, high.low + low.high);
    return sum_of_ordered(both.high, both.low + low.low);
}

twofold operator-(const twofold& a) { return {-a.high, -a.low}; }

twofold operator*(double a, const twofold& b) {
    const twofold high = product_of(a, b.high);
    return sum_of_ordered(high.high, high.low + a * b.low);
}

/// a . (b x c): six times the volume of the tetrahedron with the origin.
twofold determinant(const point3& a, const point3& b, const point3& c) {
    const auto minor = [&](std::size_t i, std::size_t j) {
        return product_of(b[i], c[j]) + -product_of(b[j], c[i]);
    };
    return a.x * minor(1, 2) + (a.y * minor(2, 0) + a.z * minor(0, 1));
}

}  // namespace

double signed_volume(mesh_view mesh) {
    constexpr std::size_t grain = std::size_t{1} << 14;
    std::vector<twofold> parts(chunk_count(mesh.faces.size(), grain));
    for_chunks(mesh.faces.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t f = begin; f < end; ++f) {
            const auto [p, q, r] = mesh.faces[f];
            parts[c] = parts[c] + determinant(mesh.points[p], mesh.points[q], mesh.points[r]);
        }
    });
    twofold all;
    for (const twofold& part : parts) all = all + part;
    return all.high / 6.0;
}

}  // namespace tf
