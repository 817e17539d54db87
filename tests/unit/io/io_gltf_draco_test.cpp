// glTF packed by draco, whose own encoder makes the files.

#include <treeform/mesh/read.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <support/gltf.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace {

std::array<float, 3> cube_corner(std::size_t index) {
    const std::size_t at = std::size_t{3} * test::cube_indices[index];
    return {test::cube_corners[at], test::cube_corners[at + 1], test::cube_corners[at + 2]};
}

/// The cube, lossless, with colors that are its corners.
std::string packed_cube(draco::MeshEncoderMethod method) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(12);
    const int position =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int color = builder.AddAttribute(draco::GeometryAttribute::COLOR, 3, draco::DT_UINT8);
    for (std::uint32_t f = 0; f < 12; ++f) {
        std::array<std::array<float, 3>, 3> points{};
        std::array<std::array<std::uint8_t, 3>, 3> colors{};
        for (std::size_t k = 0; k < 3; ++k) {
            points[k] = cube_corner(std::size_t{3} * f + k);
            for (std::size_t c = 0; c < 3; ++c)
                colors[k][c] = static_cast<std::uint8_t>(255 * points[k][c]);
        }
        const draco::FaceIndex face(f);
        builder.SetAttributeValuesForFace(position, face, &points[0], &points[1], &points[2]);
        builder.SetAttributeValuesForFace(color, face, &colors[0], &colors[1], &colors[2]);
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    draco::EncoderBuffer out;
    REQUIRE(encoder.EncodeMeshToBuffer(*mesh, &out).ok());
    return {out.data(), out.size()};
}

test::gltf_file packed_gltf(const std::string& bytes, const char* count = "8",
                            const char* ids = R"("POSITION":0,"COLOR_0":1)") {
    test::gltf_file file;
    file.add_view(bytes);
    file.accessors = {
        std::string(R"({"componentType":5126,"type":"VEC3","count":)") + count + "}",
        std::string(R"({"componentType":5121,"type":"VEC3","normalized":true,"count":)") + count +
            "}",
        R"({"componentType":5123,"type":"SCALAR","count":36})"};
    file.add_mesh(R"("POSITION":0,"COLOR_0":1)",
                  std::string(R"(,"indices":2,"extensions":{"KHR_draco_mesh_compression":)") +
                      R"({"bufferView":0,"attributes":{)" + ids + "}}}");
    file.nodes = {R"({"mesh":0})"};
    file.more = R"("extensionsRequired":["KHR_draco_mesh_compression"],)";
    return file;
}

std::string draco_refusal(const std::string& glb) {
    std::vector<std::byte> block(glb.size());
    std::memcpy(block.data(), glb.data(), glb.size());
    try {
        const tf::mesh_file file = tf::read(block, "a.glb", {});
        for (const tf::face& f : file.mesh.faces)
            for (const std::uint32_t corner : f) REQUIRE(corner < file.mesh.points.size());
        return {};
    } catch (const tf::io_error& e) {
        return e.what();
    }
}

}  // namespace

TEST_CASE("gltf, draco: a cube is read with its colors, by both methods") {
    for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const std::string glb = packed_gltf(packed_cube(method)).glb();
        const tf::mesh_file file = tf::read(std::as_bytes(std::span(glb)), "a.glb", {});
        REQUIRE(file.mesh.points.size() == 8);
        REQUIRE(file.mesh.faces.size() == 12);
        const tf::element& points = *file.attributes.find("vertex");
        const std::array<const char*, 3> names{"red", "green", "blue"};
        for (std::size_t v = 0; v < 8; ++v)
            for (std::size_t c = 0; c < 3; ++c)
                CHECK(points.find(names[c])->number(v) == 255 * file.mesh.points[v][c]);
        double six = 0.0;
        for (const auto& [a, b, c] : file.mesh.faces) {
            const auto &p = file.mesh.points[a], &q = file.mesh.points[b], &r = file.mesh.points[c];
            six += p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) +
                   p.z * (q.x * r.y - q.y * r.x);
        }
        CHECK(six == 6.0);
    }
}

TEST_CASE("gltf, draco: what does not fit the accessors is refused") {
    const std::string cube = packed_cube(draco::MESH_EDGEBREAKER_ENCODING);
    CHECK(draco_refusal(packed_gltf(cube, "9").glb()) ==
          "a.glb: meshes[0] has invalid Draco data: its size differs from that of its accessors");
    CHECK(draco_refusal(packed_gltf(cube, "8", R"("POSITION":7)").glb()) ==
          "a.glb: meshes[0] has invalid Draco data: POSITION is missing");
    CHECK(draco_refusal(packed_gltf(cube, "8", R"("POSITION":0)").glb()) ==
          "a.glb: accessors[1] has no buffer view");
    CHECK(draco_refusal(packed_gltf("DRACI" + cube.substr(5)).glb()) ==
          "a.glb: meshes[0] has invalid Draco data: not a Draco header");
}

TEST_CASE("gltf, draco: damaged bytes are read or refused, and announce no more than they hold") {
    std::mt19937 random(1);
    for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const std::string cube = packed_cube(method);
        for (std::size_t size = 0; size < cube.size(); ++size)
            (void)draco_refusal(packed_gltf(cube.substr(0, size)).glb());
        for (int round = 0; round < 3000; ++round) {
            std::string bytes = cube;
            for (std::size_t change = 0; change <= random() % 3; ++change)
                bytes[random() % bytes.size()] = static_cast<char>(random());
            (void)draco_refusal(packed_gltf(bytes).glb());
        }
        std::string many = cube;
        const std::size_t at = method == draco::MESH_EDGEBREAKER_ENCODING ? 13 : 11;
        many.replace(at, 1, "\xff\xff\xff\xff\x04");
        CHECK(draco_refusal(packed_gltf(many).glb()) ==
              "a.glb: meshes[0] has invalid Draco data: more faces than its bytes can hold");
    }
}
