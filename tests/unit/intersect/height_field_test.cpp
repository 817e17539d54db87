/// \file
/// Height fields: which patches are certainly free of pairs that meet, and that none is wrong.

#include <libmesh/intersect/classify_pair.hpp>
#include <libmesh/intersect/height_field.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace {

namespace detail = tf::detail::intersect;

bool is_height_field(const tf::mesh& mesh) {
    std::vector<detail::numbered_face> patch;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        patch.push_back({mesh.faces[f][0], mesh.faces[f][1], mesh.faces[f][2], f});
    const auto test = std::make_unique<detail::height_field_test>(mesh.points);
    return (*test)(patch);
}

bool has_pair_that_meets(const tf::mesh& mesh) {
    tf::predicate_counters counters;
    for (std::size_t i = 0; i < mesh.faces.size(); ++i)
        for (std::size_t j = i + 1; j < mesh.faces.size(); ++j)
            if (detail::classify_pair(mesh.points, mesh.faces[i], mesh.faces[j], counters))
                return true;
    return false;
}

tf::mesh axes_turned(tf::mesh mesh) {
    for (tf::point3& p : mesh.points) p = {p.z, p.x, p.y};
    return mesh;
}

/// A strip of quads around the z-axis, `angle` round in all, rising by `pitch` each turn.
tf::mesh ramp(double angle, double pitch, bool is_ring = false) {
    tf::mesh mesh;
    constexpr std::uint32_t steps = 40;
    for (std::uint32_t i = 0; i <= steps; ++i) {
        const double a = angle * i / steps;
        for (const double r : {1.0, 2.0})
            mesh.points.push_back(
                {r * std::cos(a), r * std::sin(a), pitch * a / (2 * std::numbers::pi)});
    }
    for (std::uint32_t i = 0; i < steps; ++i) {
        const std::uint32_t p = 2 * i, q = is_ring && i + 1 == steps ? 0 : p + 2;
        mesh.faces.push_back({p, p + 1, q});
        mesh.faces.push_back({p + 1, q + 1, q});
    }
    return mesh;
}

/// A few faces on a lattice of up to 5 x 5 x 2 points that all turn counterclockwise from above.
tf::mesh random_patch(test::random& source) {
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(source.below(n)); };
    const std::uint32_t side = 3 + below(3);
    tf::mesh mesh;
    const std::uint32_t points = 4 + below(9);
    for (std::uint32_t p = 0; p < points; ++p)
        mesh.points.push_back({double(below(side)), double(below(side)), double(below(2))});
    const std::uint32_t faces = 2 + below(6);
    for (int tries = 0; tries < 100 && mesh.faces.size() < faces; ++tries) {
        const tf::face f{below(points), below(points), below(points)};
        const tf::point3 a = mesh.points[f[0]], b = mesh.points[f[1]], c = mesh.points[f[2]];
        if ((b.x - a.x) * (c.y - a.y) > (b.y - a.y) * (c.x - a.x)) mesh.faces.push_back(f);
    }
    return mesh;
}

/// On another lattice, which keeps what meets: what was above lies along (3, 4, 5). And with a far
/// copy of a face, so that projections are rounded by more than the filter allows for.
tf::mesh leaning(tf::mesh mesh, test::random& source) {
    const auto any = [&] { return double(source.below(5)) - 2; };
    const tf::point3 up{3, 4, 5}, x{5, any(), -3 + any()}, y{any(), 5, -4 + any()};
    for (tf::point3& p : mesh.points)
        p = {p.x * x.x + p.y * y.x + p.z * up.x, p.x * x.y + p.y * y.y + p.z * up.y,
             p.x * x.z + p.y * y.z + p.z * up.z};
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const std::uint32_t corner : mesh.faces[0]) {
        const tf::point3 p = mesh.points[corner];
        mesh.points.push_back({p.x + 1'000'003, p.y + 70'001, p.z - 800'009});
    }
    mesh.faces.push_back({first, first + 1, first + 2});
    return mesh;
}

}  // namespace

TEST_CASE("height fields: a sheet is one over any coordinate plane and on either side") {
    tf::mesh sheet = test::grid(15);  // 450 faces
    REQUIRE(sheet.faces.size() <= detail::height_field_test::max_faces);
    for (tf::point3& p : sheet.points) p.z = std::sin(p.x) * std::cos(p.y);
    for (int turns = 0; turns < 3; ++turns) {
        CHECK(is_height_field(sheet));
        CHECK(is_height_field(test::inside_out(sheet)));
        sheet = axes_turned(sheet);
    }
    std::swap(sheet.faces[7][0], sheet.faces[7][1]);
    CHECK_FALSE(is_height_field(sheet));
}

TEST_CASE("height fields: a sheet is one that is so along no axis") {
    // Slopes of up to 50 degrees about the direction (1, 1, 1), which is 55 from each axis.
    const auto facing_all_axes = [](double x, double y, double z) -> tf::point3 {
        const double p = x / std::sqrt(2), q = y / std::sqrt(6), r = z / std::sqrt(3);
        return {p + q + r, -p + q + r, -2 * q + r};
    };
    tf::mesh sheet = test::grid(20);
    for (tf::point3& p : sheet.points)
        p = facing_all_axes(p.x, p.y, 1.1 * (std::sin(0.8 * p.x) + std::sin(0.8 * p.y)));
    const auto turns = [&](int axis) {
        return std::ranges::count_if(sheet.faces, [&](const tf::face& f) {
            return tf::orient2d(axis, sheet.points[f[0]], sheet.points[f[1]], sheet.points[f[2]]) >
                   0;
        });
    };
    const auto faces = static_cast<std::ptrdiff_t>(sheet.faces.size());
    for (int axis = 0; axis < 3; ++axis) {
        REQUIRE(turns(axis) > 0);
        REQUIRE(turns(axis) < faces);
    }
    CHECK(is_height_field(sheet));
    CHECK(is_height_field(test::inside_out(sheet)));
    CHECK(is_height_field(test::moved(sheet, {1e6, -1e7, 1e8})));
    CHECK(is_height_field(test::together(sheet, test::moved(sheet, {30, 0, -30}))));
    CHECK_FALSE(is_height_field(test::together(sheet, test::moved(sheet, {1, 1, 1}))));
    CHECK_FALSE(is_height_field(
        test::together(sheet, test::moved(test::scaled(sheet, 0.5), {5, 5, 5}))));  // above it
}

TEST_CASE("height fields: patches with holes, of several pieces, or joined at a corner are, too") {
    tf::mesh sheet = test::grid(9);
    sheet.faces.erase(sheet.faces.begin() + 60, sheet.faces.begin() + 62);
    sheet.faces.erase(sheet.faces.begin() + 20, sheet.faces.begin() + 22);
    CHECK(is_height_field(sheet));
    CHECK(is_height_field(test::together(sheet, test::moved(sheet, {100, 3, 5}))));
    CHECK(is_height_field(ramp(2 * std::numbers::pi, 0, true)));

    tf::mesh corner;
    corner.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
    corner.faces = {{0, 1, 2}, {0, 3, 4}};
    CHECK(is_height_field(corner));
}

TEST_CASE("height fields: what covers a point of the plane twice is none") {
    const tf::mesh sheet = test::grid(9);
    CHECK_FALSE(is_height_field(test::together(sheet, test::moved(sheet, {0, 0, 1}))));
    CHECK_FALSE(is_height_field(
        test::together(sheet, test::moved(test::scaled(sheet, 0.5), {2.1, 2.1, 1}))));  // above it
    CHECK_FALSE(is_height_field(ramp(3 * std::numbers::pi, 1)));
    CHECK(is_height_field(ramp(1.5 * std::numbers::pi, 1)));
    tf::mesh corner;  // faces on top of each other that share a corner
    corner.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 1, 1}, {3, 2, 1}};
    corner.faces = {{0, 1, 2}, {0, 3, 4}};
    CHECK_FALSE(is_height_field(corner));
    corner.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {1, 0, 0}, {1, -1, 0}};  // edges in line
    corner.faces = {{0, 1, 2}, {0, 4, 3}};
    CHECK_FALSE(is_height_field(corner));
}

TEST_CASE("height fields: of random patches on lattices, none has a pair that meets") {
    test::random source(3);
    std::size_t fields = 0, others = 0, meeting = 0;
    for (int round = 0; round < 60'000; ++round) {
        const tf::mesh mesh = random_patch(source);
        if (mesh.faces.empty()) continue;
        const bool is_field = is_height_field(mesh), meets = has_pair_that_meets(mesh);
        REQUIRE_FALSE((is_field && meets));
        REQUIRE_FALSE((meets && is_height_field(leaning(mesh, source))));
        ++(is_field ? fields : others);
        meeting += meets;
    }
    CHECK(fields > 1'000);
    CHECK(others > 1'000);
    CHECK(meeting > 1'000);
}

TEST_CASE("height fields: most random patches that lean are, and again none that meets itself") {
    test::random source(4);
    std::size_t fields = 0, both = 0;
    for (int round = 0; round < 20'000; ++round) {
        const tf::mesh mesh = random_patch(source);
        if (mesh.faces.empty() || !is_height_field(mesh)) continue;
        ++fields;
        both += is_height_field(leaning(mesh, source));
    }
    CHECK(fields > 500);
    CHECK(both > fields / 2);
}
