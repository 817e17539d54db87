#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <libmesh/intersect/ray_query.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

using test::triangle_of;

/// Every face met, in order, by looking at all of them.
std::vector<std::pair<std::uint32_t, tf::ray_contact>> hits_by_brute_force(const tf::mesh& mesh,
                                                                           const tf::ray3& ray) {
    std::vector<std::pair<std::uint32_t, tf::ray_contact>> found;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        if (const auto contact = tf::intersect(ray, triangle_of(mesh, f)))
            found.emplace_back(f, *contact);
    std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
        return tf::compare(ray, a.second, b.second) < 0;
    });
    return found;
}

void check_against_brute_force(const tf::mesh& mesh, const std::vector<tf::ray3>& rays) {
    const auto tree = tf::build_face_tree(mesh);
    const tf::detail::intersect::ray_query query(mesh, tree);
    const auto first = query.first(rays);
    const auto any = query.any(rays);
    const auto all = query.all(rays);
    REQUIRE(all.begin.size() == rays.size() + 1);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto expected = hits_by_brute_force(mesh, rays[i]);
        const auto hits = query.all(rays[i]);
        REQUIRE(hits.size() == expected.size());
        REQUIRE(all.begin[i + 1] - all.begin[i] == hits.size());
        for (std::size_t j = 0; j < hits.size(); ++j) {
            CHECK(hits[j].face == expected[j].first);
            CHECK(hits[j].at == expected[j].second.at);
            CHECK(hits[j].coplanar == expected[j].second.coplanar);
            CHECK(std::abs(hits[j].t - expected[j].second.t) <=
                  0x1p-39 * std::abs(expected[j].second.t));
            CHECK(hits[j] == all.answers[all.begin[i] + j]);
            if (j > 0) CHECK(hits[j - 1].t <= hits[j].t);
        }
        REQUIRE(first[i].has_value() == !expected.empty());
        if (first[i]) CHECK(first[i]->face == expected[0].first);
        if (first[i]) CHECK(first[i]->t == expected[0].second.t);
        CHECK((any[i] != 0) == !expected.empty());
    }
}

tf::ray3 whole_ray(test::random& random, std::size_t side) {
    tf::ray3 r;
    const auto around = [&](int reach) {
        return static_cast<double>(random.below(static_cast<std::size_t>(2 * reach + 1))) - reach;
    };
    for (std::size_t k = 0; k < 3; ++k) {
        r.origin[k] = static_cast<double>(random.below(side + 2)) - 1.0;
        r.direction[k] = around(2);
    }
    if (r.direction == std::array{0.0, 0.0, 0.0}) r.direction[1] = 1;
    if (random.below(3) == 0) r.t_max = static_cast<double>(random.below(4));
    if (random.below(4) == 0) r.t_min = -std::numeric_limits<double>::infinity();
    return r;
}

TEST_CASE("rays and a mesh: hits and their order are those of a loop over all faces") {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        CAPTURE(seed);
        test::random random(seed);
        std::vector<tf::ray3> rays;
        for (int i = 0; i < 100; ++i) rays.push_back(whole_ray(random, 5));
        check_against_brute_force(test::lattice_soup(random, 80, 40, 5), rays);
        for (tf::ray3& r : rays)
            for (std::size_t k = 0; k < 3; ++k) {
                r.origin[k] = random.in(-1, 2);
                r.direction[k] = random.in(-1, 1);
            }
        check_against_brute_force(test::random_soup(random, 300, 0.2), rays);
        check_against_brute_force(test::fan(random, 40), rays);
    }
}

TEST_CASE("rays and a mesh: in a flat sheet the ray meets every face it runs along") {
    const tf::mesh sheet = test::grid(6);
    check_against_brute_force(sheet, {{{-1, 3, 0}, {1, 0, 0}},
                                      {{-1, 0.5, 0}, {1, 0, 0}},
                                      {{2.25, 2.5, 0}, {1, 1, 0}},
                                      {{-1, -1, 0}, {1, 1, 0}},
                                      {{3, 3, 1}, {0, 0, -1}},
                                      {{3.5, 3.5, 1}, {0, 0, -1}},
                                      {{3, 3, 0}, {0, 0, 1}}});
}

/// A closed surface around the origin, each ray from which leaves it once: an octahedron cut in
/// four `times` over, its corners moved out by up to a half, on a lattice of step 2^-20.
tf::mesh star_shaped(test::random& random, int times) {
    tf::mesh m;
    m.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    m.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
               {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int i = 0; i < times; ++i) {
        std::vector<tf::face> faces;
        std::vector<std::array<std::uint32_t, 3>> cuts;  // lower end, upper end, point between
        const auto between = [&](std::uint32_t a, std::uint32_t b) {
            for (const auto& c : cuts)
                if (c[0] == std::min(a, b) && c[1] == std::max(a, b)) return c[2];
            const tf::point3 p = m.points[a], q = m.points[b];
            m.points.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2});
            cuts.push_back(
                {std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(m.points.size() - 1)});
            return cuts.back()[2];
        };
        for (const auto& [a, b, c] : m.faces) {
            const std::uint32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
            faces.insert(faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        m.faces = faces;
    }
    for (tf::point3& p : m.points) {
        const double out = 1.0 + 0.5 * random.unit();
        for (std::size_t k = 0; k < 3; ++k) p[k] = std::floor(p[k] * out * 0x1p20) * 0x1p-20;
    }
    return m;
}

TEST_CASE("rays and a mesh: none slips out of a closed surface, through vertices or edges either") {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        test::random random(seed);
        const tf::mesh mesh = star_shaped(random, 3);
        const auto tree = tf::build_face_tree(mesh);
        const tf::detail::intersect::ray_query query(mesh, tree);
        std::vector<std::size_t> faces_at(mesh.points.size());
        for (const tf::face& f : mesh.faces)
            for (const std::uint32_t corner : f) ++faces_at[corner];
        const auto toward = [&](const tf::point3& p, double length) {
            return tf::ray3{{0, 0, 0}, {p.x * length, p.y * length, p.z * length}};
        };
        for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
            const auto hits = query.all(toward(mesh.points[v], 0x1p-7));
            REQUIRE(hits.size() == faces_at[v]);
            for (const tf::mesh_hit& hit : hits) {
                REQUIRE(hit.at <= tf::triangle_feature::v2);
                CHECK(mesh.faces[hit.face][static_cast<std::size_t>(hit.at)] == v);
                CHECK(hit.t == hits[0].t);
                CHECK(std::abs(hit.t - 0x1p7) < 0x1p-30);
            }
        }
        for (const tf::face& f : mesh.faces)
            for (std::size_t i = 0; i < 3; ++i) {
                const tf::point3 p = mesh.points[f[i]], q = mesh.points[f[(i + 1) % 3]];
                const auto hits = query.all(toward({p.x + q.x, p.y + q.y, p.z + q.z}, 0.5));
                REQUIRE(hits.size() == 2);
                CHECK(hits[0].at >= tf::triangle_feature::e0);
                CHECK(hits[0].at <= tf::triangle_feature::e2);
                CHECK(hits[0].t == hits[1].t);
                CHECK(query.any(toward({p.x + q.x, p.y + q.y, p.z + q.z}, 0.5)));
            }
        for (int i = 0; i < 2000; ++i) {
            // Rounded points of edges: the ray passes them to the left or to the right.
            const tf::face& f = mesh.faces[random.below(mesh.faces.size())];
            const tf::point3 p = mesh.points[f[0]], q = mesh.points[f[1]];
            const double a = random.unit();
            tf::ray3 ray =
                toward({p.x + a * (q.x - p.x), p.y + a * (q.y - p.y), p.z + a * (q.z - p.z)}, 1);
            REQUIRE(query.first(ray));
            ray.t_min = -std::numeric_limits<double>::infinity();
            CHECK(query.all(ray).size() >= 2);
        }
    }
}

TEST_CASE("rays and a mesh: scale, offset, face order and threads change nothing but the names") {
    test::random random(3);
    const tf::mesh mesh = test::lattice_soup(random, 120, 60, 6);
    std::vector<tf::ray3> rays;
    for (int i = 0; i < 600; ++i) rays.push_back(whole_ray(random, 6));
    const auto tree = tf::build_face_tree(mesh);
    const auto hits = tf::detail::intersect::ray_query(mesh, tree).all(rays);
    REQUIRE(hits.answers.size() > 300);

    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto again = tf::build_face_tree(mesh);
        CHECK(tf::detail::intersect::ray_query(mesh, again).all(rays).answers == hits.answers);
    }

    std::vector<tf::ray3> placed = rays;
    for (tf::ray3& r : placed)
        for (std::size_t k = 0; k < 3; ++k) {
            r.origin[k] = (r.origin[k] + 0x1p20) * 0x1p-300;
            r.direction[k] *= 0x1p-300;
        }
    const tf::mesh moved = test::scaled(test::moved(mesh, {0x1p20, 0x1p20, 0x1p20}), 0x1p-300);
    const auto moved_tree = tf::build_face_tree(moved);
    const auto moved_hits = tf::detail::intersect::ray_query(moved, moved_tree).all(placed);
    REQUIRE(moved_hits.begin == hits.begin);
    for (std::size_t i = 0; i < hits.answers.size(); ++i) {
        CHECK(moved_hits.answers[i].face == hits.answers[i].face);
        CHECK(moved_hits.answers[i].at == hits.answers[i].at);
    }

    const test::shuffled_mesh other = test::shuffled(random, mesh);
    const auto other_tree = tf::build_face_tree(other.mesh);
    const auto other_hits = tf::detail::intersect::ray_query(other.mesh, other_tree).all(rays);
    REQUIRE(other_hits.begin == hits.begin);
    for (std::size_t i = 0; i + 1 < hits.begin.size(); ++i) {
        std::vector<std::uint32_t> faces, others;
        for (std::size_t j = hits.begin[i]; j < hits.begin[i + 1]; ++j) {
            faces.push_back(hits.answers[j].face);
            others.push_back(other.old_of_new[other_hits.answers[j].face]);
        }
        CHECK(std::is_permutation(faces.begin(), faces.end(), others.begin()));
    }
}

TEST_CASE("rays and a mesh: an empty mesh is never met, and what cannot be meant is refused") {
    const tf::mesh none;
    const auto empty = tf::build_face_tree(none);
    const tf::detail::intersect::ray_query query(none, empty);
    const tf::ray3 x_axis{{0, 0, 0}, {1, 0, 0}};
    CHECK_FALSE(query.first(x_axis));
    CHECK_FALSE(query.any(x_axis));
    CHECK(query.all(x_axis).empty());
    CHECK(query.all(std::vector<tf::ray3>{}).begin == std::vector<std::size_t>{0});

    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(static_cast<void>(query.first(tf::ray3{{nan, 0, 0}, {1, 0, 0}})),
                    std::invalid_argument);
    CHECK_THROWS_WITH_AS(
        static_cast<void>(query.any(std::vector<tf::ray3>{x_axis, {{0, 0, 0}, {0, 0, 0}}})),
        "treeform::raycast: ray 1 has no direction", std::invalid_argument);
    const tf::mesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}}, {{0, 1, 2}}};
    CHECK_THROWS_AS(tf::detail::intersect::ray_query(one, empty), std::invalid_argument);
    CHECK_NOTHROW(static_cast<void>(tf::build_face_tree(one)));
    for (const tf::face& bad : {tf::face{0, 1, 3}, tf::face{0, 1, 4}}) {
        const tf::mesh broken{one.points, {{0, 1, 2}, bad}};
        CHECK_THROWS_AS(static_cast<void>(tf::build_face_tree(broken)), std::invalid_argument);
    }
}

}  // namespace
