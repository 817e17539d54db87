// glTF of any bytes: an io_error, never a crash, a hang or memory out of proportion.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/gltf.hpp>

#include <cstring>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

using test::gltf_file;

/// Everything that is read in one file.
gltf_file rich_gltf() {
    gltf_file file = test::gltf_cube(
        R"(,"name":"a","scale":[1,-2,3],"children":[1],"extensions":{"EXT_mesh_gpu_instancing":)"
        R"({"attributes":{"TRANSLATION":4,"ROTATION":5}}})");
    file.add(std::vector<std::uint8_t>(32, 7), test::gltf_uint8, "VEC4", R"(,"normalized":true)");
    file.add(std::vector<float>(16, 0.5F), test::gltf_float, "VEC2");
    file.add<float>({0, 0, 0, 5, 0, 0}, test::gltf_float, "VEC3");
    file.add<float>({0, 0, 0, 1, 0, 1, 0, 1}, test::gltf_float, "VEC4");
    const std::size_t indices = file.add_view(test::bytes_of_values<std::uint8_t>({6, 7}));
    const std::size_t values = file.add_view(test::bytes_of_values<float>({1, 1, 3, 0, 1, 3}));
    file.add_accessor(0, test::gltf_float, 8, "VEC3",
                      R"(,"sparse":{"count":2,"indices":{"bufferView":)" + std::to_string(indices) +
                          R"(,"componentType":5121},"values":{"bufferView":)" +
                          std::to_string(values) + "}}");
    file.meshes.clear();
    file.add_mesh(R"("POSITION":6,"COLOR_0":2,"TEXCOORD_0":3,"NORMAL":0)",
                  R"(,"indices":1,"material":0)");
    file.nodes.push_back(R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,9,9,9,1]})");
    file.more = R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,)"
                R"("extensions":{"KHR_texture_transform":{"offset":[0,1],"rotation":0.5}}}}}],)";
    return file;
}

/// Whatever is accepted can be written, except what a format has no numbers for.
void write_somewhere(const tf::mesh_file& file) {
    for (const char* const format : {"ply", "3mf", "glb", "obj"}) {
        try {
            (void)tf::write_to_memory(file, {.format = format});
        } catch (const tf::io_error&) {
            CHECK(std::string_view(format) != "ply");
        }
    }
}

/// True when the bytes are a mesh whose corners are points, false when they are refused.
bool is_gltf(const std::string& bytes, const std::string& name) {
    // In a block of their own size, so that a sanitizer sees one byte too many.
    std::vector<std::byte> block(bytes.size());
    if (!bytes.empty()) std::memcpy(block.data(), bytes.data(), bytes.size());
    try {
        const tf::mesh_file file = tf::read(block, name, {});
        for (const tf::face& f : file.mesh.faces)
            for (const std::uint32_t corner : f) REQUIRE(corner < file.mesh.points.size());
        write_somewhere(file);
        return true;
    } catch (const tf::io_error& e) {
        REQUIRE(std::string_view(e.what()).starts_with(name));
        return false;
    }
}

std::string gltf_refusal(const gltf_file& file) {
    const std::string bytes = file.glb();
    try {
        (void)tf::read(std::as_bytes(std::span(bytes)), "a.glb", {});
        return {};
    } catch (const tf::io_error& e) {
        return e.what();
    }
}

std::string with_accessor(const std::string& accessor) {
    gltf_file file = test::gltf_cube();
    file.accessors[0] = accessor;
    return gltf_refusal(file);
}

}  // namespace

TEST_CASE("gltf, hostile: a file cut after any byte is refused") {
    const gltf_file file = rich_gltf();
    const std::string glb = file.glb();
    const std::string text = file.embedded();
    REQUIRE(is_gltf(glb, "a.glb"));
    REQUIRE(is_gltf(text, "a.gltf"));
    for (std::size_t size = 1; size < glb.size(); ++size)
        CHECK_FALSE(is_gltf(glb.substr(0, size), "a.glb"));
    for (std::size_t size = 1; size < text.size(); ++size)
        CHECK_FALSE(is_gltf(text.substr(0, size), "a.gltf"));
}

TEST_CASE("gltf, hostile: changed, doubled and lost bytes are read or refused") {
    const std::string glb = rich_gltf().glb();
    std::mt19937 random(1);
    const auto pick = [&](std::size_t count) { return random() % count; };
    constexpr std::string_view likely = "0123456789-.eE,:{}[]\"abnt\xff\x80";
    std::size_t accepted = 0;
    for (int round = 0; round < 20'000; ++round) {
        std::string bytes = glb;
        for (std::size_t change = 0; change <= pick(3); ++change) {
            const std::size_t at = pick(bytes.size());
            if (pick(3) > 0)
                bytes[at] = likely[pick(likely.size())];
            else
                bytes[at] = static_cast<char>(random());
        }
        accepted += is_gltf(bytes, "a.glb") ? 1U : 0U;
    }
    CHECK(accepted > 1000);
}

TEST_CASE("gltf, hostile: counts and offsets that the bytes cannot hold are refused") {
    const auto accessor = [](const std::string& members) {
        return with_accessor(R"({"bufferView":0,"componentType":5126,"type":"VEC3",)" + members +
                             "}");
    };
    const std::string beyond = "a.glb: accessors[0] goes beyond the end of its buffer view";
    CHECK(accessor(R"("count":8)").empty());
    CHECK(accessor(R"("count":9)") == beyond);
    CHECK(accessor(R"("count":18446744073709551615)") == beyond);
    CHECK(accessor(R"("count":8,"byteOffset":1)") == beyond);
    CHECK(accessor(R"("count":8,"byteOffset":18446744073709551604)") == beyond);
    CHECK(accessor(R"("count":0)") == "a.glb: accessors[0].count is 0");
    CHECK(accessor(R"("count":-8)") == "a.glb: accessors[0].count is not a non-negative integer");
    CHECK(accessor(R"("count":8.5)") == "a.glb: accessors[0].count is not a non-negative integer");
    CHECK(accessor(R"("count":1e300)") ==
          "a.glb: accessors[0].count is not a non-negative integer");
    CHECK(accessor(R"("count":"8")") == "a.glb: accessors[0].count is not a non-negative integer");
    CHECK(accessor(R"("byteOffset":0)") == "a.glb: accessors[0] has no 'count'");
    CHECK(with_accessor(
              R"({"bufferView":4294967296,"componentType":5126,"count":8,"type":"VEC3"})") ==
          "a.glb: accessors[0].bufferView is 4294967296, but there are 2 buffer views");
    CHECK(with_accessor(R"({"bufferView":0,"componentType":5124,"count":8,"type":"VEC3"})") ==
          "a.glb: accessors[0].componentType is not a type of glTF 2.0");
    CHECK(with_accessor(R"({"bufferView":0,"componentType":5126,"count":8,"type":"VEC2"})") ==
          "a.glb: accessors[0] has a type that POSITION cannot have");
    CHECK(with_accessor(R"({"bufferView":0,"componentType":5126,"count":1,"type":"MAT4"})") ==
          "a.glb: accessors[0] has a type that POSITION cannot have");
    gltf_file file = test::gltf_cube();
    file.views[0] = R"({"buffer":0,"byteLength":96,"byteStride":4})";
    CHECK(gltf_refusal(file) == beyond);
    file.views[0] = R"({"buffer":0,"byteLength":169})";
    CHECK(gltf_refusal(file) == "a.glb: bufferViews[0] goes beyond the end of its buffer");
    file.views[0] = R"({"buffer":0,"byteLength":96,"byteOffset":18446744073709551600})";
    CHECK(gltf_refusal(file) == "a.glb: bufferViews[0] goes beyond the end of its buffer");
    file.views[0] = R"({"buffer":0,"byteLength":96,"byteStride":18446744073709551615})";
    CHECK(gltf_refusal(file) == beyond);
}

TEST_CASE("gltf, hostile: indices and sparse indices out of range are refused") {
    gltf_file file = test::gltf_cube();
    file.add<std::uint32_t>({0, 1, 8}, test::gltf_uint32, "SCALAR");
    file.meshes.clear();
    file.add_mesh(R"("POSITION":0)", R"(,"indices":2)");
    CHECK(gltf_refusal(file) == "a.glb: meshes[0] has index 8, but there are 8 points");
    file.meshes.clear();
    file.add_mesh(R"("POSITION":0)", R"(,"indices":0)");
    CHECK(gltf_refusal(file) == "a.glb: accessors[0] has a type that indices cannot have");
    const auto sparse = [](const std::string& count, int index, const std::string& of_all) {
        gltf_file made = test::gltf_cube();
        made.add_view(std::string(1, static_cast<char>(index)));
        made.add_view(std::string(12, '\0'));
        made.accessors[0] = R"({"componentType":5126,"type":"VEC3","count":)" + of_all +
                            R"(,"sparse":{"count":)" + count +
                            R"(,"indices":{"bufferView":2,"componentType":5121},"values":)"
                            R"({"bufferView":3}}})";
        return gltf_refusal(made);
    };
    CHECK(sparse("1", 7, "8").empty());
    CHECK(sparse("1", 8, "8") == "a.glb: accessors[0] has a sparse index that is out of range");
    CHECK(sparse("2", 7, "8") ==
          "a.glb: accessors[0] has a sparse part beyond the end of its buffer view");
    CHECK(sparse("9", 7, "8") == "a.glb: accessors[0] has a sparse part that does not match it");
    CHECK(sparse("1", 7, "4000000000") ==
          "a.glb: accessors[0] announces more values than the file has bytes");
}

TEST_CASE("gltf, hostile: attributes that do not fit each other are refused") {
    gltf_file file = test::gltf_cube();
    file.add(std::vector<float>(21, 0.0F), test::gltf_float, "VEC3");
    file.meshes.clear();
    file.add_mesh(R"("POSITION":0,"NORMAL":2)", R"(,"indices":1)");
    CHECK(gltf_refusal(file) == "a.glb: accessors[2] has 7 values of NORMAL for 8 points");
}

TEST_CASE("gltf, hostile: nodes that are no tree are refused") {
    gltf_file file = test::gltf_cube();
    file.nodes = {R"({"children":[1,2]})", R"({"children":[2]})", R"({"mesh":0})"};
    CHECK(gltf_refusal(file) == "a.glb: node 2 has two parents");
    file.nodes = {R"({"mesh":0,"children":[0]})"};
    CHECK(gltf_refusal(file) == "a.glb: a node is its own descendant");
    file.nodes = {R"({"mesh":0,"children":[1]})", "{}"};
    file.scenes = R"([{"nodes":[0,1]}])";
    CHECK(gltf_refusal(file) == "a.glb: node 1 is in the scene twice");
    file.scenes = R"([{"nodes":[7]}])";
    CHECK(gltf_refusal(file) == "a.glb: scenes[0].nodes[0] is 7, but there are 2 nodes");
    file.scenes = R"([{"nodes":"all"}])";
    CHECK(gltf_refusal(file) == "a.glb: scenes[0].nodes is not a JSON array");
}

TEST_CASE(
    "gltf, hostile: what few bytes place without end is counted before there is room for it") {
    gltf_file file = test::gltf_cube();
    file.add_view(std::string(3, '\0'));
    file.accessors.push_back(R"({"bufferView":2,"componentType":5121,"count":3,"type":"SCALAR"})");
    // A million points for each of five thousand nodes.
    file.add(std::vector<float>(3'000'000, 0.0F), test::gltf_float, "VEC3");
    file.meshes.clear();
    file.add_mesh(R"("POSITION":3)", R"(,"indices":2)");
    std::string roots;
    file.nodes.clear();
    for (int n = 0; n < 5000; ++n) {
        file.nodes.push_back(R"({"mesh":0})");
        roots += (n > 0 ? "," : "") + std::to_string(n);
    }
    file.scenes = R"([{"nodes":[)" + roots + "]}]";
    CHECK(gltf_refusal(file) == "a.glb: more points or faces than 32-bit numbers can name");
}
