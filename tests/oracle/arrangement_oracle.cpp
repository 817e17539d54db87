/// \file
/// Arrangements against their definition, in CGAL's exact numbers: two faces have in common what
/// their shared corners span and nothing else, and the pieces of a face add up to it.
///
/// TREEFORM_STRESS_COUNT sets the number of meshes of each kind (default 12).

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <doctest/doctest.h>
#include <support/settings.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace {

using exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using exact_point = exact_kernel::Point_3;

exact_point exact_place(const tf::point3& p) { return {p.x, p.y, p.z}; }

exact_kernel::Plane_3 plane(const std::array<tf::point3, 9>& d, std::size_t i) {
    return {exact_place(d[i]), exact_place(d[i + 1]), exact_place(d[i + 2])};
}

template <class Result>
exact_point the_point(const Result& result) {
    REQUIRE(result.has_value());
    const auto* p = boost::get<exact_point>(&*result);
    REQUIRE(p != nullptr);
    return *p;
}

exact_point exact_place(const tf::implicit_point& p) {
    using origin = tf::implicit_point::origin;
    const auto& d = p.definition();
    switch (p.kind()) {
        case origin::given:
            return exact_place(p.center());
        case origin::lines:
            return the_point(
                CGAL::intersection(exact_kernel::Line_3(exact_place(d[0]), exact_place(d[1])),
                                   exact_kernel::Line_3(exact_place(d[2]), exact_place(d[3]))));
        case origin::line_plane:
            return the_point(CGAL::intersection(
                exact_kernel::Line_3(exact_place(d[0]), exact_place(d[1])), plane(d, 2)));
        case origin::planes:
        case origin::line_normal:  // of no arrangement
            break;
    }
    return the_point(CGAL::intersection(plane(d, 0), plane(d, 3), plane(d, 6)));
}

std::size_t count() { return test::stress_count(12); }

/// Whether the triangles have exactly their shared corners, and what these span, in common.
bool fit(const std::vector<exact_point>& points, const tf::face& f, const tf::face& g) {
    std::vector<std::uint32_t> shared;
    for (const std::uint32_t c : f)
        if (std::ranges::count(g, c) != 0) shared.push_back(c);
    const auto triangle = [&](const tf::face& c) {
        return exact_kernel::Triangle_3(points[c[0]], points[c[1]], points[c[2]]);
    };
    const auto common = CGAL::intersection(triangle(f), triangle(g));
    if (!common) return shared.empty();
    if (const auto* p = boost::get<exact_point>(&*common))
        return shared.size() == 1 && *p == points[shared[0]];
    if (const auto* s = boost::get<exact_kernel::Segment_3>(&*common)) {
        if (shared.size() != 2) return false;
        const exact_point& u = points[shared[0]];
        const exact_point& v = points[shared[1]];
        return (s->source() == u && s->target() == v) || (s->source() == v && s->target() == u);
    }
    return false;
}

void check_arrangement(const tf::mesh& mesh) {
    const auto result = tf::arrange_faces(mesh);
    const tf::mesh_arrangement& cut = result.cut;
    std::vector<exact_point> points;
    std::vector<tf::implicit_point> all(cut.given_points.begin(), cut.given_points.end());
    all.insert(all.end(), cut.constructed.begin(), cut.constructed.end());
    for (const auto& p : all) points.push_back(exact_place(p));

    std::vector<exact_kernel::Vector_3> sums(mesh.faces.size(), exact_kernel::Vector_3(0, 0, 0));
    const auto normal = [&](const tf::face& c) {
        return CGAL::cross_product(points[c[1]] - points[c[0]], points[c[2]] - points[c[0]]);
    };
    std::size_t flat = 0;
    for (std::size_t f = 0; f < cut.faces.size(); ++f) {
        const exact_kernel::Vector_3 n = normal(cut.faces[f]);
        flat += n == exact_kernel::Vector_3(0, 0, 0);
        for (const tf::covering_face& cover : cut.covers_of(f))
            sums[cover.face] = cover.opposite ? sums[cover.face] - n : sums[cover.face] + n;
    }
    CHECK(flat == 0);
    std::size_t wrong_sums = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const bool left_out =
            std::binary_search(result.degenerate.begin(), result.degenerate.end(), f);
        wrong_sums +=
            sums[f] != (left_out ? exact_kernel::Vector_3(0, 0, 0) : normal(mesh.faces[f]));
    }
    CHECK(wrong_sums == 0);

    const auto apart = [&](const tf::face& f, const tf::face& g) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto end = [&](const tf::face& c, double sign) {
                double most = -INFINITY;
                for (const std::uint32_t v : c)
                    most = std::max(most, sign * all[v].center()[axis] + all[v].radius());
                return most;
            };
            if (end(f, 1.0) + end(g, -1.0) < 0.0 || end(g, 1.0) + end(f, -1.0) < 0.0) return true;
        }
        return false;
    };
    std::size_t misfits = 0;
    for (std::size_t i = 0; i < cut.faces.size(); ++i)
        for (std::size_t j = i + 1; j < cut.faces.size(); ++j)
            if (!apart(cut.faces[i], cut.faces[j]))
                misfits += !fit(points, cut.faces[i], cut.faces[j]);
    CHECK(misfits == 0);
}

}  // namespace

TEST_CASE("arrangements of random triangles are complexes") {
    test::random source(21);
    for (std::size_t round = 0; round < count(); ++round) {
        CAPTURE(round);
        check_arrangement(test::random_soup(source, 12 + source.below(20), 0.4));
    }
}

TEST_CASE("arrangements of lattice triangles are complexes") {
    test::random source(22);
    for (std::size_t round = 0; round < count(); ++round) {
        CAPTURE(round);
        check_arrangement(tf::join_equal_points(
            test::lattice_soup(source, 8 + source.below(12), 16, 2 + source.below(3))));
    }
}

TEST_CASE("arrangements of fans that fold over themselves are complexes") {
    test::random source(23);
    for (std::size_t round = 0; round < count(); ++round) {
        CAPTURE(round);
        check_arrangement(test::fan(source, 8 + source.below(8)));
    }
}

TEST_CASE("arrangements of many coplanar triangles are complexes") {
    test::random source(24);
    for (std::size_t round = 0; round < count(); ++round) {
        CAPTURE(round);
        tf::mesh mesh = test::lattice_soup(source, 10 + source.below(10), 14, 5);
        for (tf::point3& p : mesh.points) p = {p.x, p.y + 0.5 * p.x, 3.0 * p.x - p.y};
        check_arrangement(tf::join_equal_points(mesh));
    }
}

TEST_CASE("arrangements of pencils of planes are complexes") {
    test::random source(25);
    for (std::size_t round = 0; round < count(); ++round) {
        CAPTURE(round);
        // Triangles through the z axis, and some that cross it.
        tf::mesh mesh;
        for (std::uint32_t i = 0; i < 8; ++i) {
            const auto whole = [&] { return static_cast<double>(source.below(9)) - 4.0; };
            const double x = whole(), y = whole();
            if (i % 2 == 0)
                mesh.points.insert(mesh.points.end(), {{x, y, -2}, {-x, -y, -1}, {0, 0, 5}});
            else
                mesh.points.insert(mesh.points.end(), {{x, y, 1}, {-y, x, 0}, {-x, -y, 2}});
            mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
        check_arrangement(tf::join_equal_points(mesh));
    }
}
