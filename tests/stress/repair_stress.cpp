/// \file
/// `repair` against truth: every kind of dirt put on clean solids, in three sizes.
///
/// TREEFORM_STRESS_TIMES sets how often each is put on each solid (default 1, at most 10),
/// TREEFORM_STRESS_SEED the seed.

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/dirt.hpp>
#include <support/models.hpp>
#include <support/rooms.hpp>
#include <support/settings.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr std::uint64_t most_times = 10;

using triangle = std::array<tf::point3, 3>;

struct clean_solid {
    std::string name;
    tf::mesh mesh;
};

/// A box whose six sides are lattices of about that many squares an edge.
tf::mesh brick(std::uint32_t cells) {
    tf::mesh soup;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool far : {false, true}) {
            tf::mesh side = test::grid(cells);
            for (tf::point3& p : side.points) {
                tf::point3 q{};
                q[axis] = far ? static_cast<double>(cells) : 0.0;
                q[(axis + 1) % 3] = p.x;
                q[(axis + 2) % 3] = p.y;
                p = {q.x * 0.3, q.y * 0.2, q.z * 0.1};
            }
            soup = test::together(std::move(soup), far ? side : test::inside_out(side));
        }
    return tf::join_equal_points(std::move(soup));
}

tf::mesh ring(std::uint32_t around, std::uint32_t across) {
    tf::mesh mesh;
    const auto angle = [](std::uint32_t i, std::uint32_t n) { return 6.283185307179586 * i / n; };
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t k = 0; k < across; ++k) {
            const double u = angle(i, around), v = angle(k, across);
            const double r = 2.0 + 0.7 * std::cos(v);
            mesh.points.push_back({r * std::cos(u), r * std::sin(u), 0.7 * std::sin(v)});
        }
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t k = 0; k < across; ++k) {
            const std::uint32_t next = (i + 1) % around * across, up = (k + 1) % across;
            mesh.faces.push_back({i * across + k, next + k, next + up});
            mesh.faces.push_back({i * across + k, next + up, i * across + up});
        }
    return mesh;
}

/// Floats, so that either precision leaves them as they are.
tf::mesh in_floats(tf::mesh mesh) {
    mesh.points = tf::rounded(mesh.points, tf::precision::float32);
    return mesh;
}

/// Eight; of those from files, as many as there are.
std::vector<clean_solid> clean_solids() {
    std::vector<clean_solid> all{
        {"ball", test::ball(4, 1.0)},
        {"brick", brick(12)},
        {"ring", ring(40, 20)},
        {"shell", test::together(test::ball(4, 1.0), test::inside_out(test::ball(3, 0.8)))}};
    if (!test::has_models())
        test::skip_part("TREEFORM_MODELS_DIR is not set");
    else
        for (const char* name :
             {"decimated_knight_1k.off", "fish_2k.obj", "fertility_9k.off", "fandisk_14k.off"})
            all.push_back(
                {name, tf::as_mesh(tf::read(test::models_folder() / "clean" / name)).mesh});
    for (clean_solid& solid : all) solid.mesh = in_floats(std::move(solid.mesh));
    return all;
}

triangle corners(const tf::mesh& mesh, const tf::face& f) {
    return {mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]};
}

/// From the lowest corner on.
triangle turned_to_lowest(triangle t) {
    const auto key = [](const tf::point3& p) { return std::array{p.x, p.y, p.z}; };
    std::rotate(t.begin(), std::ranges::min_element(t, {}, key), t.end());
    return t;
}

/// Whether at least 99 % of the triangles are faces of the mesh.
bool has_nearly_all(const tf::mesh& mesh, const std::vector<triangle>& wanted) {
    std::map<std::array<double, 9>, int> known;
    const auto key = [](const triangle& t) {
        std::array<double, 9> k{};
        for (std::size_t i = 0; i < 9; ++i) k[i] = t[i / 3][i % 3];
        return k;
    };
    for (const tf::face& f : mesh.faces) ++known[key(turned_to_lowest(corners(mesh, f)))];
    std::size_t missing = 0;
    for (const triangle& t : wanted) missing += known.contains(key(turned_to_lowest(t))) ? 0 : 1;
    return 100 * missing <= wanted.size();
}

/// As programs see it that join equal coordinates.
bool is_manifold_in_coordinates(const tf::mesh& mesh) {
    const tf::mesh joined = tf::weld(mesh).mesh;
    const auto counts = tf::count_topology(joined.points.size(), joined.faces);
    return counts.closed_manifold && counts.misoriented_edges == 0 &&
           counts.nonmanifold_points == 0;
}

/// The largest distance of corners and middles of faces of one mesh from the other.
double one_way_distance(const tf::mesh& from, const tf::mesh& to) {
    std::vector<tf::point3> points;
    for (const tf::face& f : from.faces) {
        const auto [a, b, c] = corners(from, f);
        points.insert(points.end(), {a, b, c});
        points.push_back({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3});
    }
    double largest = 0.0;
    for (const auto& found : tf::closest_point(to, points))
        largest = std::max(largest, found->distance);
    return largest;
}

/// Of the volume, of a result in coordinates of that precision: what moves by rounding.
double tolerance_of(const tf::repair_result& result, double volume) {
    const double area = result.statistics.area_before + result.statistics.area_after;
    return result.certificate.max_displacement * area + 1e-12 * volume;
}

/// What is wrong with a repair; empty when nothing is.
std::string fault_of(const tf::mesh& clean, const test::dirty_mesh& dirty,
                     const tf::repair_result& result) {
    if (!result.certificate) return "no solid: " + result.certificate.message();
    if (!is_manifold_in_coordinates(result.mesh)) return "not manifold in coordinates";
    if (!tf::self_intersections(result.mesh).pairs.empty()) return "faces meet";
    tf::mesh meant = clean;
    if (!dirty.added.faces.empty()) meant = tf::unite(clean, dirty.added).value();
    const double volume = tf::signed_volume(meant), found = tf::signed_volume(result.mesh);
    const auto off_by_volume = [&] {
        return "volume " + std::to_string(found) + " instead of " + std::to_string(volume);
    };
    if (dirty.volume_change > 0.0)
        return std::abs(found - volume) > dirty.volume_change ? off_by_volume() : "";
    const double most = 10.0 * std::max(dirty.size, result.certificate.max_displacement);
    const double away =
        std::max(one_way_distance(meant, result.mesh), one_way_distance(result.mesh, meant));
    if (away > most) return "distance " + std::to_string(away / most) + " of the largest";
    if (!dirty.added.faces.empty())
        return std::abs(found - volume) > tolerance_of(result, volume) ? off_by_volume() : "";
    return has_nearly_all(result.mesh, dirty.untouched) ? "" : "untouched faces are lost";
}

}  // namespace

TEST_CASE("every kind of dirt is repaired, and nothing else") {
    const std::vector<clean_solid> solids = clean_solids();
    const std::uint64_t times = std::min(test::setting("TREEFORM_STRESS_TIMES", 1), most_times);
    for (std::size_t k = 0; k < test::dirt_kinds; ++k) {
        const auto kind = static_cast<test::dirt_kind>(k);
        std::size_t cases = 0, failed = 0;
        for (std::size_t size = 0; size < test::dirt_sizes; ++size)
            for (std::size_t i = 0; i < solids.size(); ++i)
                for (std::uint64_t n = 0; n < times; ++n) {
                    test::random source(1'000'003 * test::stress_seed() + n);
                    const test::dirty_mesh dirty = test::soil(solids[i].mesh, kind, size, source);
                    const bool to_float = (i + n) % 2 != 0;
                    const tf::repair_result result = tf::repair(
                        dirty.mesh,
                        {.precision = to_float ? tf::precision::float32 : tf::precision::float64});
                    const std::string fault = fault_of(solids[i].mesh, dirty, result);
                    const std::string what = std::string(test::name_of(kind)) + " of size " +
                                             std::to_string(size) + " on " + solids[i].name +
                                             ", number " + std::to_string(n) +
                                             (to_float ? ", in floats" : "");
                    CAPTURE(what);
                    CHECK(fault == "");
                    ++cases;
                    failed += fault.empty() ? 0 : 1;
                }
        MESSAGE(test::name_of(kind) << ": " << cases - failed << " of " << cases << " repaired");
    }
}

TEST_CASE("rooms with one wall between two are one solid, however their walls are turned") {
    const std::uint64_t times = std::min(test::setting("TREEFORM_STRESS_TIMES", 1), most_times);
    for (std::uint64_t n = 0; n < 20 * times; ++n) {
        test::random source(1'000'003 * test::stress_seed() + n);
        const auto x = static_cast<std::uint32_t>(1 + source.below(8));
        const auto y = static_cast<std::uint32_t>(1 + source.below(8));
        tf::mesh dirty = test::rooms(x, y, 1);  // each has a floor and a roof
        for (tf::point3& p : dirty.points)
            p = {p.x + 0.1 * p.y * p.y, 0.7 * p.y, p.z * (1.0 + 0.05 * p.x)};
        tf::mesh hull{dirty.points, {}};
        for (const tf::face& f : dirty.faces)
            if (test::is_outer(f, x, y, 1)) hull.faces.push_back(f);
        const double volume = tf::signed_volume(hull);
        for (std::size_t f = 0; f < dirty.faces.size(); f += 2)
            if (source.below(3) == 0)
                for (const std::size_t k : {f, f + 1})
                    std::swap(dirty.faces[k][1], dirty.faces[k][2]);
        const tf::repair_result made = tf::repair(dirty);
        CAPTURE(n);
        REQUIRE_MESSAGE(made.certificate, made.certificate.message());
        CHECK(std::abs(tf::signed_volume(made.mesh) - volume) < 1e-3 * volume);
    }
}
