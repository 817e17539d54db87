#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <support/machine_parts.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace test {
namespace {

constexpr double full_turn = 6.283185307179586;

/// A prism over a closed rim, its lids fans around their middles.
tf::mesh prism(const std::vector<tf::point3>& rim, double height) {
    const auto count = static_cast<std::uint32_t>(rim.size());
    tf::mesh solid;
    solid.points = {{0, 0, 0}, {0, 0, height}};
    for (const tf::point3& p : rim) {
        solid.points.push_back(p);
        solid.points.push_back({p.x, p.y, height});
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % count);
        solid.faces.insert(solid.faces.end(),
                           {{a, b, b + 1}, {a, b + 1, a + 1}, {0, b, a}, {1, a + 1, b + 1}});
    }
    return solid;
}

/// Teeth of 20 points each.
tf::mesh gear(random& source, std::size_t faces) {
    const std::size_t count = std::max<std::size_t>(faces / 4, 60);
    const double step = full_turn / static_cast<double>(count);
    std::vector<tf::point3> rim;
    for (std::size_t i = 0; i < count; ++i) {
        const bool back = source.below(8) == 0;
        const double angle = step * (static_cast<double>(i) - (back ? source.in(0.0, 2.0) : 0.0));
        const double radius = (i / 10 % 2 == 0 ? 1.0 : 0.9) + source.in(-1e-3, 1e-3);
        rim.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
    }
    return prism(rim, 0.25);
}

/// A box of squares, `n` along each axis.
tf::mesh beam(const std::array<std::uint32_t, 3>& n, const tf::point3& size) {
    tf::mesh solid;
    const auto side = [&](std::size_t axis, bool high) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        const auto first = static_cast<std::uint32_t>(solid.points.size());
        for (std::uint32_t j = 0; j <= n[v]; ++j)
            for (std::uint32_t i = 0; i <= n[u]; ++i) {
                tf::point3 p{};
                p[axis] = high ? size[axis] : 0.0;
                p[u] = size[u] * i / n[u];
                p[v] = size[v] * j / n[v];
                solid.points.push_back(p);
            }
        for (std::uint32_t j = 0; j < n[v]; ++j)
            for (std::uint32_t i = 0; i < n[u]; ++i) {
                const std::uint32_t a = first + j * (n[u] + 1) + i, b = a + 1, c = a + n[u] + 1;
                std::array<tf::face, 2> two{tf::face{a, b, c + 1}, tf::face{a, c + 1, c}};
                for (tf::face& f : two)
                    if (!high) std::swap(f[1], f[2]);
                solid.faces.insert(solid.faces.end(), two.begin(), two.end());
            }
    };
    for (const std::size_t axis : {0U, 1U, 2U})
        for (const bool high : {false, true}) side(axis, high);
    return tf::join_equal_points(solid);
}

tf::mesh pin(std::size_t faces, double radius, double height) {
    std::vector<tf::point3> rim;
    const std::size_t count = std::max<std::size_t>(faces / 4, 8);
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = full_turn * static_cast<double>(i) / static_cast<double>(count);
        rim.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
    }
    return prism(rim, height);
}

}  // namespace

std::vector<tf::mesh> gears(random& source, std::size_t faces) {
    const tf::point3 axis{0.3, -0.8, 0.5};
    const double angle = source.in(0.2, 1.2);
    std::vector<tf::mesh> two{gear(source, faces), moved(gear(source, faces), {1.85, 0.0, 0.01})};
    for (tf::mesh& wheel : two) wheel = turned(std::move(wheel), axis, angle);
    return two;
}

tf::mesh gantry(random& source, std::size_t shells, std::size_t faces) {
    const std::size_t share = faces / shells;
    // A beam of n x n x 3n squares has 28 n^2 faces.
    const auto n =
        static_cast<std::uint32_t>(std::max(1.0, std::sqrt(static_cast<double>(share) / 28.0)));
    const auto whole = [&](std::size_t below) { return static_cast<double>(source.below(below)); };
    tf::mesh all;
    for (std::size_t k = 0; k < shells; ++k) {
        std::array<std::uint32_t, 3> squares{n, n, n};
        tf::point3 size{1.0, 1.0, 1.0};
        const std::size_t along = source.below(3);
        squares[along] = 3 * n;
        size[along] = 4.0;
        tf::mesh shell = k % 4 == 3 ? pin(share, 0.5, 3.0) : beam(squares, size);
        const double tilt = std::pow(10.0, -5.0 - whole(5)) * whole(2);
        shell = turned(std::move(shell), {source.in(-1, 1), 1.0, source.in(-1, 1)}, tilt);
        all = together(std::move(all),
                       moved(std::move(shell), {whole(7) / 2, whole(7) / 2, whole(7) / 2}));
    }
    return turned(std::move(all), {0.5, 0.7, -0.4}, 0.6);
}

}  // namespace test
