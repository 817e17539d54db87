/// \file
/// `tf::deviation` against exact rational numbers: distances to 1e-12, sides by a sum over exact
/// crossings; and on real models against CloudCompare, where it is installed.

#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <gmpxx.h>
#include <support/models.hpp>
#include <support/random.hpp>
#include <support/rational_points.hpp>
#include <support/skip.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using test::rational_point;

mpq_class to_segment(const rational_point& p, const rational_point& a, const rational_point& b) {
    const rational_point e = test::minus(b, a);
    const mpq_class square = test::dot(e, e);
    mpq_class t = square == 0 ? mpq_class(0) : mpq_class(test::dot(test::minus(p, a), e) / square);
    t = std::clamp(t, mpq_class(0), mpq_class(1));
    const rational_point gap = test::minus(p, test::along(a, b, t));
    return test::dot(gap, gap);
}

mpq_class to_triangle(const rational_point& p, const std::array<rational_point, 3>& t) {
    const mpq_class best =
        std::min({to_segment(p, t[0], t[1]), to_segment(p, t[1], t[2]), to_segment(p, t[2], t[0])});
    const rational_point n = test::cross(test::minus(t[1], t[0]), test::minus(t[2], t[0]));
    const mpq_class square = test::dot(n, n);
    if (square == 0) return best;
    for (std::size_t i = 0; i < 3; ++i)
        if (test::dot(test::cross(test::minus(t[(i + 1) % 3], t[i]), test::minus(p, t[i])), n) < 0)
            return best;
    const mpq_class height = test::dot(n, test::minus(p, t[0]));
    return std::min(best, mpq_class(height * height / square));
}

/// The winding number by the crossings of a ray in a direction that meets no edge; none where it
/// does.
std::optional<int> winding_along(const rational_point& p, const rational_point& d,
                                 const std::vector<std::array<rational_point, 3>>& faces) {
    int winding = 0;
    for (const auto& [a, b, c] : faces) {
        const rational_point pa = test::minus(a, p), pb = test::minus(b, p), pc = test::minus(c, p);
        const mpq_class u = test::dot(d, test::cross(pa, pb)),
                        v = test::dot(d, test::cross(pb, pc)),
                        w = test::dot(d, test::cross(pc, pa));
        if (u == 0 || v == 0 || w == 0) {
            const int least = std::min({sgn(u), sgn(v), sgn(w)}),
                      most = std::max({sgn(u), sgn(v), sgn(w)});
            if (least < 0 && most > 0) continue;
            return std::nullopt;
        }
        if (sgn(u) != sgn(v) || sgn(v) != sgn(w)) continue;
        const mpq_class ahead = test::dot(pa, test::cross(pb, pc));
        if (sgn(ahead) == 0) return std::nullopt;
        if (sgn(ahead) == sgn(u)) winding += sgn(u) > 0 ? 1 : -1;
    }
    return winding;
}

/// `b` and points near it, in exact numbers; `found` in doubles.
void check_exactly(const tf::mesh& a, const tf::mesh& b) {
    const auto found = tf::deviation(a, b);
    REQUIRE(found.has_value());
    REQUIRE(found->is_signed);
    const double size = tf::bounding_box(b.points)->diagonal();
    std::vector<std::array<rational_point, 3>> faces;
    for (const tf::face& f : b.faces)
        faces.push_back({test::rational(b.points[f[0]]), test::rational(b.points[f[1]]),
                         test::rational(b.points[f[2]])});
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        CAPTURE(i);
        const rational_point p = test::rational(a.points[i]);
        mpq_class least = to_triangle(p, faces[0]);
        for (const auto& t : faces) least = std::min(least, to_triangle(p, t));
        REQUIRE(std::abs(std::abs(found->distances[i]) - std::sqrt(least.get_d())) <= 1e-12 * size);
        if (least == 0) {
            REQUIRE(found->distances[i] == 0.0);
            continue;
        }
        std::optional<int> winding;
        test::random source(i);
        while (!winding) {
            const auto whole = [&] {
                return mpq_class(static_cast<int>(source.below(2001)) - 1000);
            };
            winding = winding_along(p, {whole(), whole(), whole()}, faces);
        }
        REQUIRE(std::signbit(found->distances[i]) == (*winding != 0));
    }
}

tf::mesh points_near(test::random& source, const tf::mesh& b, double spread, int count) {
    tf::mesh a;
    for (int i = 0; i < count; ++i) {
        const tf::face& f = b.faces[source.below(b.faces.size())];
        const double u = source.unit(), v = source.unit() * (1.0 - u);
        tf::point3 p{};
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = b.points[f[0]][k] + u * (b.points[f[1]][k] - b.points[f[0]][k]) +
                   v * (b.points[f[2]][k] - b.points[f[0]][k]) + spread * source.in(-1, 1);
        a.points.push_back(p);
    }
    return a;
}

/// What CloudCompare says of the distances of these points from the mesh, in their order; empty
/// where it is not installed.
std::vector<double> by_cloudcompare(const tf::mesh& a, const tf::mesh& b) {
    if (std::system("command -v CloudCompare >/dev/null && command -v xvfb-run >/dev/null") != 0)
        return {};
    const auto folder = std::filesystem::temp_directory_path() /
                        ("treeform_c2m_" + std::to_string(reinterpret_cast<std::uintptr_t>(&a)));
    std::filesystem::create_directories(folder);
    tf::mesh_file cloud, surface;
    cloud.mesh = a;
    surface.mesh = b;
    tf::write(folder / "a.ply", cloud, {.precision = tf::precision::float64});
    tf::write(folder / "b.ply", surface, {.precision = tf::precision::float64});
    const std::string command =
        "cd '" + folder.string() +
        "' && timeout 120 xvfb-run -a CloudCompare -SILENT -AUTO_SAVE OFF "
        "-C_EXPORT_FMT PLY -PLY_EXPORT_FMT BINARY_LE -NO_TIMESTAMP -O a.ply -O "
        "b.ply -C2M_DIST -SAVE_CLOUDS FILE out.ply >log.txt 2>&1";
    std::vector<double> distances;
    if (std::system(command.c_str()) == 0 && std::filesystem::exists(folder / "out.ply")) {
        const tf::mesh_file out = tf::read(folder / "out.ply");
        if (const tf::element* const rows = out.attributes.find("vertex"))
            for (const tf::column& c : rows->columns)
                if (c.name.find("C2M") != std::string::npos)
                    for (std::size_t i = 0; i < out.mesh.points.size(); ++i)
                        distances.push_back(c.number(i));
    }
    std::filesystem::remove_all(folder);
    return distances;
}

}  // namespace

TEST_CASE("deviation: on small meshes distances are exact to 1e-12, and sides are right") {
    test::random source(1);
    for (int round = 0; round < 6; ++round) {
        CAPTURE(round);
        tf::mesh b = round % 3 == 0 ? test::ball(2, 1.0)
                     : round % 3 == 1
                         ? test::together(test::random_tetrahedron(source, 2.0),
                                          test::random_tetrahedron(source, 2.0))
                         : test::together(test::lattice_box(source), test::lattice_box(source));
        for (const double spread : {1e-15, 1e-9, 1e-2, 1.0})
            check_exactly(points_near(source, b, spread, 60), b);
        check_exactly({b.points, {}}, b);
    }
}

TEST_CASE(
    "deviation: on real models distances are those of CloudCompare, differing signs its error") {
    NEEDS_MODELS();
    const auto folder = test::models_folder();
    test::random source(2);
    std::size_t compared = 0, other_sign = 0;
    for (const char* const name :
         {"clean/fandisk_14k.off", "clean/fertility_9k.off", "clean/torus_5k.obj",
          "clean/spot_23k.obj", "clean/koala_100k.obj"}) {
        CAPTURE(name);
        const tf::mesh b = tf::join_equal_points(tf::read(folder / name).mesh);
        const double size = tf::bounding_box(b.points)->diagonal();
        tf::mesh a = points_near(source, b, 0.01 * size, 5000);
        // It computes in float32: give it what it can hold.
        for (tf::point3& p : a.points)
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = static_cast<double>(static_cast<float>(p[k]));
        const std::vector<double> theirs = by_cloudcompare(a, b);
        if (theirs.empty())
            SKIP_CASE("CloudCompare or xvfb-run is not installed, or did not do it");
        REQUIRE(theirs.size() == a.points.size());
        const auto found = tf::deviation(a, b);
        REQUIRE(found->is_signed);
        for (std::size_t i = 0; i < theirs.size(); ++i) {
            CAPTURE(i);
            REQUIRE(std::abs(std::abs(found->distances[i]) - std::abs(theirs[i])) <= 1e-6 * size);
            ++compared;
            if (std::abs(theirs[i]) <= 1e-6 * size ||
                std::signbit(theirs[i]) == std::signbit(found->distances[i]))
                continue;
            ++other_sign;
            const bool inside = tf::locate(b, a.points[i]).winding != 0;
            REQUIRE(std::signbit(found->distances[i]) == inside);
        }
    }
    MESSAGE(compared << " distances, " << other_sign << " with another sign than CloudCompare's");
}
