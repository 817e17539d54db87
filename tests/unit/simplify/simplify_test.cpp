/// \file
/// Fewer faces within a distance: solids stay solids, nothing meets, both distances hold.

#include <libmesh/geometry/closest_point.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/simplify.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solid_checks.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

/// A closed torus of n by n quads.
tf::mesh fine_torus(std::uint32_t n) {
    tf::mesh made;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const double u = 6.283185307179586 * i / n, v = 6.283185307179586 * j / n;
            const double r = 3.0 + std::cos(v);
            made.points.push_back({r * std::cos(u), r * std::sin(u), std::sin(v)});
            const std::uint32_t k = (i + 1) % n, l = (j + 1) % n;
            made.faces.push_back({i * n + j, k * n + j, k * n + l});
            made.faces.push_back({i * n + j, k * n + l, i * n + l});
        }
    return made;
}

/// The square [0, 1]^2 in n by n quads, at a height.
template <class Height>
tf::mesh fine_square(std::uint32_t n, const Height& height) {
    tf::mesh made;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j) {
            const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
            made.points.push_back({x, y, height(x, y)});
        }
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t p = i * (n + 1) + j, q = p + n + 1;
            made.faces.push_back({p, q, q + 1});
            made.faces.push_back({p, q + 1, p + 1});
        }
    return made;
}
const auto flat = [](double, double) { return 0.0; };

/// The cube [0, n]^3, each side of n by n quads.
tf::mesh fine_cube(std::uint32_t n) {
    tf::mesh made;
    for (int axis = 0; axis < 3; ++axis)
        for (const double at : {0.0, 1.0}) {
            tf::mesh side = fine_square(n, [&](double, double) { return at; });
            for (tf::point3& p : side.points)
                for (int turn = 0; turn < axis; ++turn) p = {p.z, p.x, p.y};
            for (tf::face f : side.faces) {
                if (at == 0.0) std::swap(f[0], f[1]);
                for (std::uint32_t& c : f) c += static_cast<std::uint32_t>(made.points.size());
                made.faces.push_back(f);
            }
            made.points.insert(made.points.end(), side.points.begin(), side.points.end());
        }
    return made;
}

tf::mesh scaled(tf::mesh mesh, double by) {
    for (tf::point3& p : mesh.points) p = {p.x * by, p.y * by, p.z * by};
    return mesh;
}

double squared(const tf::point3& p, const tf::point3& q) {
    return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z);
}

tf::point3 between(const tf::point3& p, const tf::point3& q, double share) {
    return {p.x + share * (q.x - p.x), p.y + share * (q.y - p.y), p.z + share * (q.z - p.z)};
}

/// From a point to the nearest of 15 of each face of a mesh, and half the way between these: no
/// less than its distance, by a way that has nothing in common with the library.
class sampled_surface {
  public:
    explicit sampled_surface(const tf::mesh& mesh) {
        for (const tf::face& f : mesh.faces)
            for (int i = 0; i <= steps; ++i)
                for (int j = 0; i + j <= steps; ++j) {
                    const tf::point3 side = between(mesh.points[f[0]], mesh.points[f[1]],
                                                    i + j > 0 ? 1.0 * j / (i + j) : 0.0);
                    samples.push_back(between(mesh.points[f[2]], side, 1.0 * (i + j) / steps));
                }
        for (const tf::face& f : mesh.faces)
            for (std::size_t i = 0; i < 3; ++i)
                spacing = std::max(
                    spacing,
                    std::sqrt(squared(mesh.points[f[i]], mesh.points[f[(i + 1) % 3]])) / steps);
    }
    /// Of all samples of the other, to a sample of this.
    [[nodiscard]] double furthest(const sampled_surface& other) const {
        double far = 0.0;
        for (const tf::point3& p : other.samples) {
            double near = std::numeric_limits<double>::infinity();
            for (const tf::point3& q : samples) near = std::min(near, squared(p, q));
            far = std::max(far, near);
        }
        return std::sqrt(far);
    }

    static constexpr int steps = 4;
    std::vector<tf::point3> samples;
    double spacing = 0.0;
};

void check_distances(const tf::mesh& given, const tf::simplify_result& made) {
    const sampled_surface before(given), after(made.mesh);
    CHECK(after.furthest(before) <= made.input_to_result_bound + after.spacing);
    CHECK(before.furthest(after) <= made.result_to_input_bound + before.spacing);
    const auto far = tf::deviation(given, made.mesh);
    REQUIRE(far);
    CHECK(far->max <= made.input_to_result_bound * (1 + 1e-12));
    CHECK(far->reverse_max.value() <= made.result_to_input_bound * (1 + 1e-12));
}

bool same(const tf::simplify_result& a, const tf::simplify_result& b) {
    return a.mesh == b.mesh && a.face_source == b.face_source &&
           a.vertex_source == b.vertex_source && a.face_of_new_vertex == b.face_of_new_vertex &&
           a.input_to_result_bound == b.input_to_result_bound &&
           a.result_to_input_bound == b.result_to_input_bound;
}

}  // namespace

TEST_CASE("A torus stays a clean solid, within the distance both ways") {
    const tf::mesh torus = fine_torus(16);
    for (const double distance : {0.0, 0.01, 0.1}) {
        const tf::simplify_result made = tf::simplify(torus, distance);
        MESSAGE(distance << ": " << made.mesh.faces.size() << " faces");
        CHECK(test::is_clean_solid(made.mesh));
        CHECK(made.input_to_result_bound <= distance);
        CHECK(made.result_to_input_bound <= distance);
        if (distance > 0.0) check_distances(torus, made);
        if (distance > 0.05) CHECK(made.mesh.faces.size() < torus.faces.size() / 2);
    }
}

TEST_CASE("A distance that is no distance is refused") {
    CHECK_THROWS_AS((void)tf::simplify(fine_torus(4), -1.0), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::simplify(fine_torus(4), std::nan("")), std::invalid_argument);
}

TEST_CASE("A flat square with fine borders becomes two faces, each corner where it was") {
    for (const double distance : {1e-9, 0.01}) {
        const tf::simplify_result made = tf::simplify(fine_square(16, flat), distance);
        CHECK(made.certificate);
        CHECK(made.mesh.faces.size() == 2);
        CHECK(made.mesh.points.size() == 4);
        CHECK(tf::surface_area(made.mesh) ==
              (distance < 0.01 ? 1.0 : doctest::Approx(1.0).epsilon(0.02)));
    }
}

TEST_CASE("A tetrahedron and a triangle stay, whatever the distance") {
    tf::mesh solid{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                   {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    for (const double distance : {1e-3, 10.0, 1e300}) {
        CHECK(tf::simplify(solid, distance).mesh == solid);
        const tf::mesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
        CHECK(tf::simplify(one, distance).mesh == one);
        CHECK(test::is_clean_solid(tf::simplify(fine_torus(8), distance).mesh));
    }
}

TEST_CASE("A fine cube becomes twelve faces, with features kept or not") {
    for (const double angle : {30.0, 180.0}) {
        const tf::simplify_result made = tf::simplify(fine_cube(8), 1e-6, {.feature_angle = angle});
        CHECK(test::is_clean_solid(made.mesh));
        CHECK(made.mesh.faces.size() == 12);
        CHECK(tf::signed_volume(made.mesh) == doctest::Approx(1.0).epsilon(1e-5));
    }
}

TEST_CASE("The border of groups stays within the distance, and goes along itself") {
    const tf::mesh square = fine_square(16, flat);
    std::vector<std::uint32_t> groups;  // left and right, not along a straight line
    for (const tf::face& f : square.faces) {
        const tf::point3 &p = square.points[f[0]], &q = square.points[f[2]];
        groups.push_back(p.x + q.x + 0.5 * (p.y + q.y) > 1.5 ? 1 : 0);
    }
    const auto area_of = [&](const tf::mesh& mesh, auto&& group_of) {
        double area = 0.0;
        for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
            if (group_of(f) == 1) area += tf::surface_area(tf::mesh{mesh.points, {mesh.faces[f]}});
        return area;
    };
    const double before = area_of(square, [&](std::uint32_t f) { return groups[f]; });
    std::size_t fewest = square.faces.size();
    for (const double distance : {1e-9, 0.06, 0.2}) {
        const tf::simplify_result made = tf::simplify(square, distance, {.face_groups = groups});
        const double after =
            area_of(made.mesh, [&](std::uint32_t f) { return groups[made.face_source[f]]; });
        CHECK(std::abs(after - before) <= 4 * distance);
        CHECK(made.mesh.faces.size() < fewest);
        fewest = made.mesh.faces.size();
    }
    CHECK(fewest < 12);
    CHECK(fewest > 2);
}

TEST_CASE("A hilly square is simplified within the distance, border and all") {
    const tf::mesh hills = fine_square(
        24, [](double x, double y) { return 0.1 * std::sin(7 * x) * std::cos(5 * y + x); });
    const tf::simplify_result made = tf::simplify(hills, 0.01);
    CHECK(made.certificate);
    CHECK(made.mesh.faces.size() < hills.faces.size() / 8);
    check_distances(hills, made);
}

TEST_CASE("In float32, all coordinates are, and bounds count what rounding did") {
    const tf::mesh torus = fine_torus(24);
    const tf::simplify_result made =
        tf::simplify(torus, 0.05, {.precision = tf::precision::float32});
    CHECK(test::is_clean_solid(made.mesh));
    CHECK(made.certificate.precision == tf::precision::float32);
    CHECK(made.mesh.faces.size() < torus.faces.size() / 2);
    for (const tf::point3& p : made.mesh.points)
        for (std::size_t axis = 0; axis < 3; ++axis)
            CHECK(static_cast<double>(static_cast<float>(p[axis])) == p[axis]);
    check_distances(torus, made);
    const tf::simplify_result rounded =
        tf::simplify(torus, 0.0, {.precision = tf::precision::float32});
    CHECK(rounded.input_to_result_bound > 0.0);
    CHECK(rounded.input_to_result_bound < 1e-6);
}

TEST_CASE("It stops at as many faces as asked for") {
    const tf::simplify_result made = tf::simplify(fine_torus(24), 1.0, {.target_faces = 500});
    CHECK(made.mesh.faces.size() <= 500);
    CHECK(made.mesh.faces.size() > 496);
}

TEST_CASE("Edges of three faces and touching cones stay") {
    tf::mesh sheets;  // three half planes from one line
    for (int turn = 0; turn < 3; ++turn) {
        tf::mesh half = fine_square(8, flat);
        const double angle = 2.0 * turn;
        for (tf::point3& p : half.points) p = {p.x * std::cos(angle), p.x * std::sin(angle), p.y};
        for (tf::face f : half.faces) {
            for (std::uint32_t& c : f) c += static_cast<std::uint32_t>(sheets.points.size());
            sheets.faces.push_back(f);
        }
        sheets.points.insert(sheets.points.end(), half.points.begin(), half.points.end());
    }
    const tf::simplify_result made = tf::simplify(sheets, 1e-9);
    CHECK(made.certificate);
    CHECK(tf::find_solid_defects(made.mesh).nonmanifold_edges == 8);
    CHECK(made.fixed_vertices == 9);
    CHECK(made.mesh.faces.size() < sheets.faces.size() / 4);
    check_distances(sheets, made);
}

TEST_CASE("Vertices that stay are told, and of new ones the nearest face") {
    const tf::mesh torus = fine_torus(24);
    const tf::simplify_result made = tf::simplify(torus, 0.05);
    REQUIRE(made.vertex_source.size() == made.mesh.points.size());
    REQUIRE(made.face_of_new_vertex.size() == made.mesh.points.size());
    std::size_t changed = 0;
    for (std::size_t v = 0; v < made.mesh.points.size(); ++v) {
        const std::uint32_t source = made.vertex_source[v], face = made.face_of_new_vertex[v];
        CHECK((source == tf::simplify_result::none) != (face == tf::simplify_result::none));
        if (source != tf::simplify_result::none) {
            CHECK(made.mesh.points[v] == torus.points[source]);
            continue;
        }
        ++changed;
        const auto distance_to = [&](const tf::face& f) {
            return tf::closest_point({torus.points[f[0]], torus.points[f[1]], torus.points[f[2]]},
                                     made.mesh.points[v])
                .squared_distance;
        };
        double least = std::numeric_limits<double>::infinity();
        for (const tf::face& f : torus.faces) least = std::min(least, distance_to(f));
        CHECK(distance_to(torus.faces[face]) <= least * (1 + 1e-9) + 1e-30);
    }
    CHECK(changed > 10);
}

TEST_CASE("The same bytes on any number of threads, and at any scale of two") {
    const tf::mesh torus = fine_torus(24);
    const tf::simplify_result once = tf::simplify(torus, 0.05);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(same(tf::simplify(torus, 0.05), once));
    }
    const double by = 0x1p40;
    const tf::simplify_result larger = tf::simplify(scaled(torus, by), 0.05 * by);
    CHECK(larger.mesh.faces.size() == once.mesh.faces.size());
}

TEST_CASE("Where squares of distances are no doubles, nothing is collapsed") {
    for (const double by : {1e-200, 1e200}) {
        const tf::mesh torus = scaled(fine_torus(12), by);
        const tf::simplify_result made = tf::simplify(torus, 0.1 * by);
        CHECK(made.collapses == 0);
        CHECK(made.mesh.faces.size() == torus.faces.size());
    }
}

TEST_CASE("Faces that meet are left to do so, and no others are made to") {
    tf::mesh both = fine_torus(20);
    const tf::mesh other = fine_torus(20);
    for (tf::face f : other.faces) {
        for (std::uint32_t& c : f) c += static_cast<std::uint32_t>(other.points.size());
        both.faces.push_back(f);
    }
    for (const tf::point3& p : other.points) both.points.push_back({p.x + 1.5, p.z, p.y});
    const std::size_t before = tf::self_intersections(both).pairs.size();
    REQUIRE(before > 0);
    const tf::simplify_result made = tf::simplify(both, 0.05);
    CHECK(made.certificate);
    CHECK(made.mesh.faces.size() < both.faces.size());
    CHECK(tf::self_intersections(made.mesh).pairs.size() <= before);
}

TEST_CASE("Nothing is made of nothing, and saying stop stops") {
    CHECK(tf::simplify(tf::mesh{}, 1.0).mesh.faces.empty());
    for (const double stop : {0.1, 0.93}) {  // edges collapsed; surfaces looked at
        const tf::simplify_result made = tf::simplify(
            fine_torus(40), 0.1, {.progress = [&](double done) { return done < stop; }});
        CHECK(made.certificate.status == tf::status::cancelled);
        CHECK(made.mesh.faces.empty());
    }
    double last = 0.0;
    (void)tf::simplify(fine_torus(40), 0.1, {.progress = [&](double done) {
                           CHECK(done >= last);
                           last = done;
                           return true;
                       }});
    CHECK(last > 0.94);
}

TEST_CASE("Coordinates far from the origin cost accuracy that bounds know of") {
    tf::mesh far = fine_torus(24);
    for (tf::point3& p : far.points) p.x += 1e9;
    const tf::simplify_result made = tf::simplify(far, 0.1);
    CHECK(test::is_clean_solid(made.mesh));
    CHECK(made.mesh.faces.size() < far.faces.size() / 2);
    CHECK(tf::simplify(far, 1e-8).collapses == 0);
}
