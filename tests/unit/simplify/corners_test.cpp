/// \file
/// Texture coordinates and normals of corners go through `simplify`: seams stay, values fit.

#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/simplify.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

constexpr double turn = 6.283185307179586;

tf::point3 on_torus(double u, double v) {
    const double r = 3.0 + std::cos(turn * v);
    return {r * std::cos(turn * u), r * std::sin(turn * u), std::sin(turn * v)};
}
tf::point3 normal_of_torus(double u, double v) {
    return {std::cos(turn * v) * std::cos(turn * u), std::cos(turn * v) * std::sin(turn * u),
            std::sin(turn * v)};
}

/// A torus of n by n quads, with a square as its texture, so that it has two seams, and with smooth
/// normals or one for each face.
tf::mesh_file textured_torus(std::uint32_t n, bool smooth) {
    tf::mesh_file file;
    tf::corner_values& corners = file.attributes.corners;
    const auto add = [&](const std::array<std::array<std::uint32_t, 2>, 3>& at) {
        tf::face points, texture, normals;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [i, j] = at[k];
            points[k] = (i % n) * n + j % n;
            texture[k] = i * (n + 1) + j;
            normals[k] = smooth ? points[k] : static_cast<std::uint32_t>(file.mesh.faces.size());
        }
        if (!smooth)
            corners.normals.push_back(normal_of_torus(at[0][0] * 1.0 / n, at[0][1] * 1.0 / n));
        file.mesh.faces.push_back(points);
        corners.texture_of_corner.push_back(texture);
        corners.normal_of_corner.push_back(normals);
    };
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j) {
            const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
            corners.texture.push_back({u, v, 0.0});
            if (i == n || j == n) continue;
            file.mesh.points.push_back(on_torus(u, v));
            if (smooth) corners.normals.push_back(normal_of_torus(u, v));
        }
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            add({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
            add({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
        }
    return file;
}

struct simplified_file {
    tf::mesh_file file;
    tf::simplify_result made;
};

simplified_file simplified(const tf::mesh_file& file, double distance) {
    const tf::attribute_source source{&file};
    const tf::attribute_sources carrying(source);
    const std::vector<std::uint32_t> groups = carrying.corner_groups();
    simplified_file all{{}, tf::simplify(file.mesh, distance, {.corner_groups = groups})};
    all.file.mesh = all.made.mesh;
    carrying.transfer(all.file, all.made.face_source, all.made.vertex_source,
                      all.made.face_of_new_vertex, all.made.corner_source);
    return all;
}

double apart(const tf::point3& a, const tf::point3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

}  // namespace

TEST_CASE("A torus keeps both seams of its texture, and corners what the torus has there") {
    const tf::mesh_file torus = textured_torus(32, true);
    std::size_t most = 1200;
    for (const double distance : {0.02, 0.1}) {
        CAPTURE(distance);
        const auto [file, made] = simplified(torus, distance);
        CHECK(made.certificate);
        CHECK(file.mesh.faces.size() < most);
        most = 300;
        CHECK(std::ranges::count(made.vertex_source, tf::simplify_result::none) > 20);
        const tf::corner_values& corners = file.attributes.corners;
        REQUIRE(corners.texture_of_corner.size() == file.mesh.faces.size());
        REQUIRE(corners.normal_of_corner.size() == file.mesh.faces.size());
        for (std::size_t f = 0; f < file.mesh.faces.size(); ++f) {
            CAPTURE(f);
            std::array<double, 2> least{1.0, 1.0}, greatest{};
            for (std::size_t k = 0; k < 3; ++k) {
                const auto& [u, v, w] = corners.texture.at(corners.texture_of_corner[f][k]);
                const tf::point3& p = file.mesh.points[file.mesh.faces[f][k]];
                CHECK(apart(p, on_torus(u, v)) < 2 * distance);
                CHECK(apart(corners.normals.at(corners.normal_of_corner[f][k]),
                            normal_of_torus(u, v)) < 3 * distance);
                for (const auto& [i, x] : {std::pair{0, u}, std::pair{1, v}}) {
                    least[i] = std::min(least[i], x);
                    greatest[i] = std::max(greatest[i], x);
                }
            }
            for (const int i : {0, 1}) CHECK(greatest[i] - least[i] < 0.5);  // on one side of it
        }
    }
}

TEST_CASE("Faces with a normal each keep no edges for it, and get those of their planes") {
    const auto [file, made] = simplified(textured_torus(32, false), 0.1);
    CHECK(file.mesh.faces.size() < 300);
    const tf::corner_values& corners = file.attributes.corners;
    for (std::size_t f = 0; f < file.mesh.faces.size(); ++f) {
        const tf::face& numbers = corners.normal_of_corner.at(f);
        CHECK((numbers[0] == numbers[1] && numbers[1] == numbers[2]));
        const auto& [a, b, c] = file.mesh.faces[f];
        const tf::point3 &p = file.mesh.points[a], &n = corners.normals[numbers[0]];
        for (const std::uint32_t q : {b, c}) {
            const tf::point3& at = file.mesh.points[q];
            CHECK(std::abs((at.x - p.x) * n.x + (at.y - p.y) * n.y + (at.z - p.z) * n.z) < 1e-12);
        }
    }
}

TEST_CASE("Each corner knows the corner of the input that it is, or is new") {
    const tf::mesh_file torus = textured_torus(24, true);
    const tf::simplify_result made = tf::simplify(torus.mesh, 0.05);
    REQUIRE(made.corner_source.size() == 3 * made.mesh.faces.size());
    for (std::size_t c = 0; c < made.corner_source.size(); ++c) {
        const std::uint32_t v = made.mesh.faces[c / 3][c % 3], at = made.corner_source[c];
        CHECK((at == tf::simplify_result::none) ==
              (made.vertex_source[v] == tf::simplify_result::none));
        if (at != tf::simplify_result::none)
            CHECK(torus.mesh.faces[at / 3][at % 3] == made.vertex_source[v]);
    }
}
