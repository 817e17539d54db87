#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/stress_families.hpp>
#include <support/stress_files.hpp>
#include <support/stress_meshes.hpp>
#include <support/stress_placement.hpp>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace {

using tf::mesh;
using tf::point3;
using tf::triangle3;
using tf::test::stress_family;
using tf::test::stress_mesh;

/// FNV-1a of all bits.
class digest {
  public:
    void add(std::uint64_t x) {
        for (int shift = 0; shift < 64; shift += 8)
            value_ = (value_ ^ (x >> shift & 0xff)) * 0x100000001b3;
    }
    void add(const point3& p) {
        for (std::size_t axis = 0; axis < 3; ++axis) add(std::bit_cast<std::uint64_t>(p[axis]));
    }
    void add(const mesh& m) {
        for (const point3& p : m.points) add(p);
        for (const tf::face& f : m.faces)
            for (const std::uint32_t corner : f) add(corner);
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0xcbf29ce484222325;
};

template <class Visit>
void for_each_family(Visit visit) {
    for (std::size_t f = 0; f < tf::test::stress_family_count; ++f) {
        const auto family = static_cast<stress_family>(f);
        CAPTURE(name_of(family));
        visit(family);
    }
}

std::uint64_t digest_of_pairs(stress_family family, std::uint64_t seed) {
    tf::test::stress_stream stream(family, seed);
    digest sum;
    for (int i = 0; i < 200; ++i) {
        const auto pair = stream.next();
        for (const triangle3* t : {&pair.a, &pair.b})
            for (const point3& p : *t) sum.add(p);
    }
    return sum.value();
}

triangle3 corners_of(const mesh& m, std::size_t f) {
    return {m.points[m.faces[f][0]], m.points[m.faces[f][1]], m.points[m.faces[f][2]]};
}

double length(const point3& p, const point3& q) {
    return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
}

point3 normal(const triangle3& t) {
    const point3 u{t[1].x - t[0].x, t[1].y - t[0].y, t[1].z - t[0].z};
    const point3 v{t[2].x - t[0].x, t[2].y - t[0].y, t[2].z - t[0].z};
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

/// Longest side over the height above it.
double aspect(const triangle3& t) {
    const double longest = std::max({length(t[0], t[1]), length(t[1], t[2]), length(t[2], t[0])});
    return longest * longest / length(normal(t), {});
}

std::size_t count_of(const mesh& m, tf::pair_kind kind) {
    return tf::self_intersections(m).counts[static_cast<std::size_t>(kind)];
}

mesh joined(stress_family family, std::size_t faces) {
    return tf::join_equal_points(stress_mesh(family, faces, 1));
}

/// Steps from one double to the next between x and y, of one sign.
std::uint64_t ulps(double x, double y) {
    const auto a = std::bit_cast<std::uint64_t>(x);
    const auto b = std::bit_cast<std::uint64_t>(y);
    return a < b ? b - a : a - b;
}

/// A folder of its own that is gone afterwards.
class scratch_folder {
  public:
    scratch_folder()
        : path_(std::filesystem::temp_directory_path() /
                ("treeform-stress-" + std::to_string(::getpid()))) {}
    ~scratch_folder() { std::filesystem::remove_all(path_); }
    scratch_folder(const scratch_folder&) = delete;
    scratch_folder& operator=(const scratch_folder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace

TEST_CASE("families have names, and names families") {
    std::set<std::string_view> names;
    for_each_family([&](stress_family family) {
        names.insert(name_of(family));
        CHECK(tf::test::stress_family_named(name_of(family)) == family);
    });
    CHECK(names.size() == tf::test::stress_family_count);
    CHECK(!tf::test::stress_family_named("nobody"));
}

TEST_CASE("a seed makes the same pairs and the same mesh again, another seed others") {
    for_each_family([](stress_family family) {
        CHECK(digest_of_pairs(family, 1) == digest_of_pairs(family, 1));
        CHECK(digest_of_pairs(family, 1) != digest_of_pairs(family, 2));
        CHECK(stress_mesh(family, 1000, 1) == stress_mesh(family, 1000, 1));
    });
}

TEST_CASE("every compiler makes the same bytes") {
    // Recorded with g++ 12.2 and clang++ 14 alike; to change with the families.
    digest pairs;
    digest meshes;
    for_each_family([&](stress_family family) {
        pairs.add(digest_of_pairs(family, 1));
        for (const auto& [name, where] : tf::test::named_placements()) {
            auto single = where;
            single.single = true;
            meshes.add(placed(stress_mesh(family, 300, 1), where));
            meshes.add(placed(stress_mesh(family, 300, 1), single));
        }
    });
    CHECK(pairs.value() == 14338723170105459889U);
    CHECK(meshes.value() == 178943315825667342U);
}

TEST_CASE("meshes have about the number of faces asked for, and are sound") {
    for_each_family([](stress_family family) {
        for (const std::size_t faces : {100U, 1000U, 10000U, 40000U}) {
            const mesh m = stress_mesh(family, faces, 7);
            CHECK(m.faces.size() <= faces);
            CHECK(m.faces.size() >= faces / 3);
            const tf::invalid_faces defects = tf::find_invalid_faces(m);
            CHECK(defects.out_of_range_faces.empty());
            CHECK(defects.nonfinite_points.empty());
        }
        CHECK(!stress_mesh(family, 1, 1).faces.empty());
    });
}

TEST_CASE("a face meets few others, however many there are") {
    for_each_family([](stress_family family) {
        if (family == stress_family::extreme_range) return;
        const mesh m = stress_mesh(family, 4000, 1);
        const auto found = tf::self_intersections(tf::join_equal_points(m), {.limit = 0});
        std::uint64_t pairs = 0;
        for (const std::uint64_t count : found.counts) pairs += count;
        CHECK(pairs < 100 * m.faces.size());
    });
}

TEST_CASE("near coplanar sheets pass through each other at angles of 1e-1 to 1e-15") {
    const mesh m = stress_mesh(stress_family::near_coplanar, 40000, 1);
    double least = 1;
    double greatest = 0;
    for (std::size_t f = m.faces.size() / 2; f < m.faces.size(); ++f) {
        const point3 n = normal(corners_of(m, f));
        if (n.x == 0) continue;
        least = std::min(least, std::abs(n.x / n.z));
        greatest = std::max(greatest, std::abs(n.x / n.z));
    }
    CHECK(greatest > 0.05);
    CHECK(least < 1e-14);
    CHECK(count_of(m, tf::pair_kind::crossing) > 100);
}

TEST_CASE("slivers are up to 1e12 times as long as wide") {
    const mesh m = stress_mesh(stress_family::slivers, 4000, 1);
    double greatest = 0;
    for (std::size_t f = 0; f < m.faces.size(); ++f)
        greatest = std::max(greatest, aspect(corners_of(m, f)));
    CHECK(greatest > 1e12);
    CHECK(greatest < 1e14);
    CHECK(count_of(m, tf::pair_kind::crossing) > 0);
}

TEST_CASE("boxes on grids have faces in common planes") {
    CHECK(count_of(joined(stress_family::coplanar_grid, 3000), tf::pair_kind::overlap) > 100);
    CHECK(count_of(joined(stress_family::cad_grid, 3000), tf::pair_kind::overlap) > 10);
    for (const point3& p : stress_mesh(stress_family::coplanar_grid, 3000, 1).points)
        for (std::size_t axis = 0; axis < 3; ++axis) REQUIRE(p[axis] == std::round(p[axis]));
}

TEST_CASE("spheres far away have what bits are left there") {
    const mesh m = stress_mesh(stress_family::large_offsets, 4000, 1);
    double farthest = 0;
    for (const point3& p : m.points) farthest = std::max(farthest, std::abs(p.x));
    CHECK(farthest > 1e12);
    CHECK(count_of(m, tf::pair_kind::crossing) > 50);
}

TEST_CASE("spheres of 1e-6 to 1e6 touch in the origin") {
    const mesh m = stress_mesh(stress_family::mixed_scales, 4000, 1);
    const auto at_origin = std::ranges::count(m.points, point3{});
    CHECK(at_origin == 5);
    double largest = 0;
    for (const point3& p : m.points) largest = std::max(largest, std::abs(p.x));
    CHECK(largest == doctest::Approx(2e6));
    CHECK(count_of(m, tf::pair_kind::touching) > 0);
}

TEST_CASE("the ends of the range are there, and zeros of either sign") {
    std::array<bool, 4> seen{};
    for (const point3& p : stress_mesh(stress_family::extreme_range, 4000, 1).points)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = p[axis];
            seen[0] |= x == 0 && std::signbit(x);
            seen[1] |= x == 0 && !std::signbit(x);
            seen[2] |= std::abs(x) > 1e300;
            seen[3] |= x != 0 && std::abs(x) < 1e-320;
        }
    CHECK(seen == std::array{true, true, true, true});
}

TEST_CASE("all faces of fans share one of two corners") {
    const mesh m = stress_mesh(stress_family::fans, 8000, 1);
    CHECK(std::ranges::count_if(m.faces, [](const tf::face& f) { return f[0] == 0; }) == 4000);
    CHECK(std::ranges::count_if(m.faces, [](const tf::face& f) { return f[0] == 1; }) == 4000);
}

TEST_CASE("duplicates are found as such, and those that an ulp keeps apart are not") {
    const mesh m = joined(stress_family::duplicates, 4000);
    const std::size_t same = count_of(m, tf::pair_kind::duplicate);
    CHECK(same > 1000);
    CHECK(same < 2000);
}

TEST_CASE(
    "a copy turned by an ulp is the same in single points, and nowhere further than two ulps") {
    const mesh m = stress_mesh(stress_family::one_ulp, 4000, 1);
    const std::size_t half = m.points.size() / 2;
    std::size_t same = 0;
    for (std::size_t i = 0; i < half; ++i) {
        same += m.points[i] == m.points[half + i];
        REQUIRE(length(m.points[i], m.points[half + i]) < 0x1p-51);
    }
    CHECK(same > 0);
    CHECK(same < half);
    CHECK(tf::count_topology(m.points.size(), m.faces).closed_manifold);
}

TEST_CASE("shells are 1 to 10 ulps thin") {
    const mesh m = stress_mesh(stress_family::thin_shells, 4000, 1);
    const std::size_t half = m.points.size() / 2;
    for (std::size_t i = 0; i < half; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double outer = m.points[i][axis];
            const double inner = m.points[half + i][axis];
            if (outer == 0) continue;
            REQUIRE(std::abs(inner) < std::abs(outer));
            REQUIRE(ulps(outer, inner) <= 10);
        }
}

TEST_CASE("every face of a pencil holds a point of its line") {
    const mesh m = stress_mesh(stress_family::pencils, 1600, 1);
    for (std::size_t f = 0; f < m.faces.size(); ++f) {
        const triangle3 t = corners_of(m, f);
        const point3 foot{std::round(t[2].x), std::round(t[2].y), 0};
        const triangle3 line{foot, {foot.x, foot.y, 1}, foot};
        REQUIRE(tf::intersect(t, line).count != 0);
    }
}

TEST_CASE("corners on a plane except for an ulp lie below, in and above it") {
    const mesh m = stress_mesh(stress_family::on_plane_by_ulp, 4000, 1);
    std::array<std::size_t, 3> sides{};
    const std::size_t half = m.faces.size() / 2;
    for (std::size_t f = 0; f < half; ++f) {
        const triangle3 below = corners_of(m, f);
        for (const point3& p : corners_of(m, half + f))
            ++sides[static_cast<std::size_t>(1 + tf::orient3d(below[0], below[1], below[2], p))];
    }
    CHECK(sides[0] > half);
    CHECK(sides[1] > half / 100);
    CHECK(sides[2] > half);
}

TEST_CASE("broken surfaces have open edges and edges of three faces") {
    const mesh m = joined(stress_family::broken_surfaces, 4000);
    const tf::topology_counts counts = tf::count_topology(m.points.size(), m.faces);
    CHECK(counts.boundary_edges > 100);
    CHECK(counts.nonmanifold_edges > 100);
}

TEST_CASE("the families are written to files as they are, the same each time") {
    const scratch_folder scratch;
    const std::array families{stress_family::soup, stress_family::extreme_range};
    const auto write = [&](const char* name) {
        return tf::test::write_stress_files(scratch.path() / name, families, 100);
    };
    const std::size_t written = write("one");
    CHECK(written == write("two"));
    std::ifstream index(scratch.path() / "one" / "index.csv");
    std::string line;
    std::getline(index, line);
    std::size_t lines = 0;
    for (; std::getline(index, line); ++lines) {
        const std::string file = line.substr(0, line.find(','));
        const auto content = [&](const char* folder) {
            std::ifstream in(scratch.path() / folder / file, std::ios::binary);
            return std::string{std::istreambuf_iterator<char>(in), {}};
        };
        CHECK(!content("one").empty());
        CHECK(content("one") == content("two"));
    }
    CHECK(lines == written);
    const auto read = tf::read(scratch.path() / "one" / "soup-100-plain-double.ply");
    CHECK(read.mesh == stress_mesh(stress_family::soup, 100, 1));
}
