/// \file
/// Caps of cuts get texture coordinates by their planes: as far apart as their points, to scale.

#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace {

/// A box of edge 4, with two units of texture on each edge of 4.
tf::mesh_file textured_box() {
    tf::mesh_file file;
    file.mesh = test::box(4, 4, 4);
    tf::corner_values& corners = file.attributes.corners;
    corners.texture = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    corners.texture_of_corner.assign(file.mesh.faces.size(), {0, 1, 2});
    return file;
}

using triple = std::array<double, 3>;

/// Texture coordinates by point, of the faces of caps.
std::map<triple, triple> on_caps(const tf::mesh_file& file, const std::vector<std::uint32_t>& cap) {
    std::map<triple, triple> found;
    const tf::corner_values& corners = file.attributes.corners;
    for (std::size_t f = 0; f < cap.size(); ++f)
        for (std::size_t k = 0; k < 3 && cap[f] != tf::cut_piece::none; ++k) {
            const tf::point3& p = file.mesh.points[file.mesh.faces[f][k]];
            found[{p.x, p.y, p.z}] = corners.texture.at(corners.texture_of_corner.at(f)[k]);
        }
    return found;
}

tf::mesh_file textured(const tf::cut_piece& piece, const tf::mesh_file& of) {
    tf::mesh_file file;
    file.mesh = piece.mesh;
    tf::attribute_sources(tf::attribute_source{&of, {}})
        .transfer(file, piece.face_source, piece.vertex_source);
    tf::attribute_source{&of, {}}.texture_caps(file, piece.cap);
    return file;
}

}  // namespace

TEST_CASE("caps have the texture of their planes, to scale, the same on both sides") {
    const tf::mesh_file file = textured_box();
    for (const tf::point3& normal : {tf::point3{0, 0, 1}, {1, 2, 3}, {-1, 0.5, -0.25}}) {
        const tf::cut_result halves = tf::cut(file.mesh, {{2, 2, 2}, normal});
        REQUIRE(halves.certificate);
        const auto below = on_caps(textured(halves.pieces[0], file), halves.pieces[0].cap);
        const auto above = on_caps(textured(halves.pieces[1], file), halves.pieces[1].cap);
        REQUIRE(below.size() >= 4);
        CHECK(below.size() == above.size());
        for (const auto& [p, s] : below) {
            const auto other = above.find(p);
            REQUIRE(other != above.end());
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(s[k] == doctest::Approx(other->second[k]).epsilon(1e-9));
            for (const auto& [q, t] : below)
                CHECK(std::hypot(t[0] - s[0], t[1] - s[1]) ==
                      doctest::Approx(0.5 * std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2])));
        }
    }
}

TEST_CASE("both sides in one file, several planes, and no texture") {
    const tf::mesh_file file = textured_box();
    const tf::cut_result made = tf::cut(file.mesh, {}, std::array{1.0, 2.0});
    std::vector<tf::mesh> meshes;
    tf::cut_piece all;
    for (const tf::cut_piece& piece : made.pieces) {
        meshes.push_back(piece.mesh);
        all.cap.insert(all.cap.end(), piece.cap.begin(), piece.cap.end());
    }
    tf::mesh_file together;
    together.mesh = tf::concatenate(meshes);
    tf::attribute_source{&file, {}}.texture_caps(together, all.cap);
    for (const auto& [p, t] : on_caps(together, all.cap))
        CHECK(t == triple{0.5 * p[0], 0.5 * p[1], 0});
    CHECK(together.attributes.corners.fault(together.mesh.faces.size()).empty());
    tf::mesh_file plain{.mesh = file.mesh};
    CHECK(textured(made.pieces[0], plain).attributes.corners == tf::corner_values{});
}
