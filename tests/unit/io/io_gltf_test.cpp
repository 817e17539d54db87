// glTF and GLB are read as they say, every kind of the samples of their makers among them.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/gltf.hpp>
#include <support/own_folder.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

using test::gltf_cube;
using test::gltf_file;

tf::mesh_file read_glb(const std::string& bytes, std::string_view name = "a.glb") {
    return tf::read(std::as_bytes(std::span(bytes)), name, {});
}
tf::mesh_file read_glb(const gltf_file& file) { return read_glb(file.glb()); }

std::string glb_refusal(const std::string& bytes, std::string_view name = "a.glb") {
    try {
        (void)read_glb(bytes, name);
        return {};
    } catch (const tf::io_error& e) {
        return e.what();
    }
}

double volume_of(const tf::mesh_file& file) {
    double six = 0.0;
    for (const auto& [a, b, c] : file.mesh.faces) {
        const tf::point3 &p = file.mesh.points[a], &q = file.mesh.points[b],
                         &r = file.mesh.points[c];
        six += p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) +
               p.z * (q.x * r.y - q.y * r.x);
    }
    return six / 6.0;
}

std::vector<std::string> warnings_of(const tf::mesh_file& file, std::string_view code) {
    std::vector<std::string> texts;
    for (const auto& w : file.warnings)
        if (w.code == code) texts.push_back(w.text);
    return texts;
}

std::vector<double> values_of(const tf::mesh_file& file, std::string_view name) {
    std::vector<double> values;
    const tf::element* const vertices = file.attributes.find("vertex");
    const tf::column* const c = vertices == nullptr ? nullptr : vertices->find(name);
    for (std::size_t i = 0; c != nullptr && i < c->size(); ++i) values.push_back(c->number(i));
    return values;
}

std::vector<std::string> parts_in(const tf::mesh_file& file) {
    std::vector<std::string> names;
    for (const tf::named_faces& p : file.attributes.parts) names.push_back(p.object);
    return names;
}

using list = std::vector<double>;
using words = std::vector<std::string>;

/// Two triangles that are a unit square in the plane z = 0.
gltf_file flat_square(const std::string& primitive_members = {}) {
    gltf_file file;
    file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, test::gltf_float, "VEC3");
    file.add_mesh(R"("POSITION":0)", primitive_members);
    file.nodes = {R"({"mesh":0})"};
    return file;
}

}  // namespace

TEST_CASE("gltf: a cube is read from GLB, with its numbers as they are") {
    const tf::mesh_file file = read_glb(gltf_cube());
    CHECK(file.format == "glb");
    CHECK(file.mesh.points.size() == 8);
    CHECK(file.mesh.faces.size() == 12);
    CHECK(file.stored_faces == 12);
    CHECK_FALSE(file.indexed);
    CHECK(file.stored_as == tf::precision::float32);
    CHECK(volume_of(file) == 1.0);
    CHECK(file.warnings.empty());
    CHECK(parts_in(file) == words{""});
}

TEST_CASE("gltf: text with base64 and with files beside it, encoded or not") {
    const gltf_file cube = gltf_cube();
    CHECK(read_glb(cube.embedded(), "a.gltf").format == "gltf");
    CHECK(volume_of(read_glb(cube.embedded(), "a.gltf")) == 1.0);
    const test::own_folder folder("io_gltf_test");
    std::filesystem::create_directory(folder.path / "in");
    test::put(folder.path / "b c\xc3\xbc.bin", cube.binary);
    test::put(folder.path / "100%41.bin", cube.binary);
    test::put(folder.path / "in" / "c.bin", cube.binary + "more");
    for (const char* const uri : {"b%20c%C3%BC.bin", "b c\xc3\xbc.bin", "b%20c%c3%bc.bin",
                                  "100%41.bin", "100%2541.bin", "in/c.bin", "./in/../in/c.bin"}) {
        CAPTURE(uri);
        test::put(folder.path / "a.gltf", cube.json(uri));
        CHECK(volume_of(tf::read(folder.path / "a.gltf")) == 1.0);
    }
}

TEST_CASE("gltf: only files in its folder are read, and a missing one is named") {
    const gltf_file cube = gltf_cube();
    const test::own_folder folder("io_gltf_test");
    std::filesystem::create_directory(folder.path / "in");
    test::put(folder.path / "b.bin", cube.binary);
    const auto said = [&](const std::string& uri) {
        test::put(folder.path / "in" / "a.gltf", cube.json(uri));
        try {
            (void)tf::read(folder.path / "in" / "a.gltf");
            return std::string();
        } catch (const tf::io_error& e) {
            return std::string(e.what());
        }
    };
    const std::string absolute = (folder.path / "b.bin").string();
    for (const std::string& uri :
         {std::string("../b.bin"), std::string("%2e%2e/b.bin"), std::string("x/../../b.bin"),
          absolute, "file://" + absolute, std::string("http://a.b/b.bin"), std::string("C:/b.bin"),
          std::string("%2Fetc%2Fpasswd")}) {
        CAPTURE(uri);
        CHECK(said(uri).find("refers to '" + uri + "'; only files in the folder") !=
              std::string::npos);
    }
    CHECK(said("no%20file.bin").find("no file.bin', which does not exist") != std::string::npos);
    CHECK(said(".").find("does not exist") != std::string::npos);
    test::put(folder.path / "in" / "short.bin", cube.binary.substr(1));
    CHECK(said("short.bin").find("buffers[0] has 167 of 168 bytes") != std::string::npos);
    CHECK(glb_refusal(cube.json("b.bin"), "a.gltf") ==
          "a.gltf: buffers[0] is in the file 'b.bin', which cannot be found without the path of "
          "the glTF");
    CHECK(glb_refusal(cube.json("data:text/plain,abc"), "a.gltf").find("without base64") !=
          std::string::npos);
    CHECK(glb_refusal(cube.json("data:;base64,%%%"), "a.gltf").find("not valid base64") !=
          std::string::npos);
    CHECK(glb_refusal(cube.json(), "a.gltf").find("has no data") != std::string::npos);
}

TEST_CASE("gltf: indices of each type, and none") {
    for (const int type : {test::gltf_uint8, test::gltf_uint16, test::gltf_uint32}) {
        gltf_file file = gltf_cube();
        const std::vector<std::uint8_t> narrow(test::cube_indices.begin(),
                                               test::cube_indices.end());
        const std::vector<std::uint32_t> wide(test::cube_indices.begin(), test::cube_indices.end());
        if (type == test::gltf_uint8) file.add(narrow, type, "SCALAR");
        if (type == test::gltf_uint16) file.add(test::cube_indices, type, "SCALAR");
        if (type == test::gltf_uint32) file.add(wide, type, "SCALAR");
        file.meshes.clear();
        file.add_mesh(R"("POSITION":0)", R"(,"indices":2)");
        CHECK(read_glb(file).mesh == read_glb(gltf_cube()).mesh);
    }
    std::vector<float> corners;
    for (const auto i : test::cube_indices)
        corners.insert(corners.end(), test::cube_corners.begin() + 3 * i,
                       test::cube_corners.begin() + 3 * i + 3);
    gltf_file file;
    file.add(corners, test::gltf_float, "VEC3");
    file.add_mesh(R"("POSITION":0)", "");
    file.nodes = {R"({"mesh":0})"};
    CHECK(read_glb(file).mesh.points.size() == 36);
    CHECK(volume_of(read_glb(file)) == 1.0);
}

TEST_CASE("gltf: strips and fans are triangles; of points and lines there are the points") {
    using faces = std::vector<tf::face>;
    CHECK(read_glb(flat_square(R"(,"mode":5)")).mesh.faces == faces{{0, 1, 2}, {1, 3, 2}});
    CHECK(read_glb(flat_square(R"(,"mode":6)")).mesh.faces == faces{{1, 2, 0}, {2, 3, 0}});
    const tf::mesh_file whole = read_glb(flat_square());
    CHECK(whole.mesh.faces == faces{{0, 1, 2}});
    CHECK(warnings_of(whole, "skipped-elements") ==
          words{"1 corners after the last complete triangle were not read"});
    const std::array<const char*, 4> count{"0", "2", "4", "3"};
    for (int mode = 0; mode < 4; ++mode) {
        gltf_file file = flat_square(R"(,"mode":5)");
        file.add<float>({5, 0, 0, 6, 0, 0, 7, 0, 0, 8, 0, 0}, test::gltf_float, "VEC3");
        file.meshes[0].insert(
            file.meshes[0].size() - 2,
            R"(,{"attributes":{"POSITION":1},"mode":)" + std::to_string(mode) + "}");
        const tf::mesh_file read = read_glb(file);
        CHECK(read.mesh.faces.size() == 2);
        CHECK(read.mesh.points.size() == 8);
        words said{std::string(count[static_cast<std::size_t>(mode)]) +
                   " lines were not read, only their points"};
        if (mode == 0) said.clear();
        CHECK(warnings_of(read, "skipped-elements") == said);
    }
    const tf::mesh_file cloud = read_glb(flat_square(R"(,"mode":0)"));
    CHECK(cloud.mesh.points.size() == 4);
    CHECK(cloud.mesh.faces.empty());
    CHECK(parts_in(cloud).empty());
    CHECK(glb_refusal(flat_square(R"(,"mode":7)").glb()).find("primitives[0].mode is 7") !=
          std::string::npos);
}

TEST_CASE("gltf: interleaved attributes, and views that several accessors share") {
    gltf_file file;
    std::vector<float> rows;
    for (std::size_t i = 0; i < 8; ++i) {
        const auto first = test::cube_corners.begin() + 3 * static_cast<std::ptrdiff_t>(i);
        rows.insert(rows.end(), first, first + 3);
        rows.insert(rows.end(), {0, 0, 1});
    }
    const std::size_t view = file.add_view(test::bytes_of_values(rows), R"(,"byteStride":24)");
    file.add_accessor(view, test::gltf_float, 8, "VEC3");
    file.add_accessor(view, test::gltf_float, 8, "VEC3", R"(,"byteOffset":12)");
    file.add(test::cube_indices, test::gltf_uint16, "SCALAR");
    file.add_mesh(R"("POSITION":0,"NORMAL":1)", R"(,"indices":2)");
    file.nodes = {R"({"mesh":0})"};
    const tf::mesh_file read = read_glb(file);
    CHECK(read.mesh == read_glb(gltf_cube()).mesh);
    CHECK(values_of(read, "nz") == list(8, 1.0));
    CHECK(values_of(read, "nx") == list(8, 0.0));
}

TEST_CASE("gltf: a sparse accessor replaces some values of a view, or of zeros") {
    gltf_file file = gltf_cube();
    const std::size_t indices = file.add_view(test::bytes_of_values<std::uint8_t>({6, 7}));
    const std::size_t values = file.add_view(test::bytes_of_values<float>({1, 1, 3, 0, 1, 3}));
    const std::string sparse =
        R"("sparse":{"count":2,"indices":{"bufferView":)" + std::to_string(indices) +
        R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) + "}}";
    file.add_accessor(0, test::gltf_float, 8, "VEC3", "," + sparse);
    file.accessors.push_back(R"({"componentType":5126,"count":8,"type":"VEC3",)" + sparse + "}");
    file.meshes.clear();
    file.add_mesh(R"("POSITION":2)", R"(,"indices":1)");
    file.add_mesh(R"("POSITION":3)", R"(,"indices":1)");
    const auto& points = read_glb(file).mesh.points;
    CHECK(points[6] == tf::point3{1, 1, 3});
    CHECK(points[5] == tf::point3{1, 0, 1});
    file.nodes = {R"({"mesh":1})"};
    const auto& zeros = read_glb(file).mesh.points;
    CHECK(zeros[6] == tf::point3{1, 1, 3});
    CHECK(zeros[5] == tf::point3{});
}

TEST_CASE("gltf: quantized coordinates, normalized and not, are what they stand for") {
    const auto quantized = [](auto full, int type, const char* members, const char* node) {
        using number = decltype(full);
        std::vector<number> corners;
        for (std::size_t i = 0; i < 24; ++i)
            corners.push_back(test::cube_corners[i] > 0 ? full : number{0});
        gltf_file file;
        file.add(corners, type, "VEC3", members);
        file.add(test::cube_indices, test::gltf_uint16, "SCALAR");
        file.add_mesh(R"("POSITION":0)", R"(,"indices":1)");
        file.nodes = {std::string(R"({"mesh":0)") + node + "}"};
        file.more = R"("extensionsRequired":["KHR_mesh_quantization"],)";
        return read_glb(file);
    };
    const char* const yes = R"(,"normalized":true)";
    CHECK(volume_of(quantized(std::uint16_t{65535}, test::gltf_uint16, yes, "")) == 1.0);
    CHECK(volume_of(quantized(std::uint8_t{255}, test::gltf_uint8, yes, "")) == 1.0);
    CHECK(volume_of(quantized(std::int8_t{127}, test::gltf_int8, yes, "")) == 1.0);
    CHECK(volume_of(quantized(std::int16_t{32767}, test::gltf_int16, yes, "")) == 1.0);
    CHECK(volume_of(quantized(std::int16_t{2}, test::gltf_int16, "", "")) == 8.0);
    const tf::mesh_file scaled = quantized(std::uint16_t{16383}, test::gltf_uint16, "",
                                           R"(,"scale":[6.10388815e-05,6.10388815e-05,1])");
    CHECK(scaled.mesh.points[6] ==
          tf::point3{16383 * 6.10388815e-05, 16383 * 6.10388815e-05, 16383});
    // Doubles that float32 does not hold are not rounded to it.
    const tf::mesh_file third = quantized(std::uint16_t{21845}, test::gltf_uint16, yes, "");
    CHECK(third.mesh.points[6].x == 21845.0 / 65535.0);
    CHECK(third.stored_as == tf::precision::float64);
}

TEST_CASE("gltf: transforms are composed in double") {
    gltf_file file = gltf_cube();
    file.nodes = {R"({"children":[1],"translation":[0.1,0,0]})",
                  R"({"children":[2],"rotation":[0,0,0.70710677,0.70710677]})",
                  R"({"mesh":0,"scale":[0.1,2,3]})"};
    const tf::mesh_file read = read_glb(file);
    CHECK(read.mesh.points[6] == tf::point3{0.1 - 2.0, 0.1, 3.0});
    CHECK(volume_of(read) == doctest::Approx(0.6).epsilon(1e-15));
    // Column by column.
    file.nodes = {R"({"mesh":0,"matrix":[2,0,0,0, 0,3,0,0, 0,0,4,0, 0.1,0.2,0.3,1]})"};
    CHECK(read_glb(file).mesh.points[6] == tf::point3{2.1, 3.2, 4.3});
    file.nodes = {R"({"mesh":0,"matrix":[2,0,0,0, 0,3,0,0, 0,0,4,0, 1,2,3,0.5]})"};
    CHECK(read_glb(file).mesh.points[6] == tf::point3{6, 10, 14});
    file.nodes = {R"({"mesh":0,"matrix":[2,0,0,1, 0,3,0,0, 0,0,4,0, 1,2,3,1]})"};
    CHECK(glb_refusal(file.glb()).find("nodes[0].matrix is a projection") != std::string::npos);
    file.nodes = {R"({"mesh":0,"rotation":[0,0,0,0]})"};
    CHECK(glb_refusal(file.glb()).find("nodes[0].rotation is not a rotation") != std::string::npos);
    file.nodes = {R"({"mesh":0,"scale":[1e300,1,1],"translation":[0,0,0]})"};
    CHECK(read_glb(file).mesh.points[6].x == 1e300);
    file.nodes = {R"({"children":[1],"scale":[1e300,1,1]})", R"({"mesh":0,"scale":[1e300,1,1]})"};
    CHECK(
        glb_refusal(file.glb()).find("its transform moves the mesh beyond the range of doubles") !=
        std::string::npos);
    file.nodes = {R"({"mesh":0,"scale":[1e999,1,1]})"};
    CHECK(glb_refusal(file.glb()).find("too large") != std::string::npos);
}

TEST_CASE("gltf: without a transform, -0 and NaN are as they are stored") {
    gltf_file file = flat_square(R"(,"mode":5)");
    const std::vector<float> odd{-0.0F, std::numeric_limits<float>::quiet_NaN(),
                                 std::numeric_limits<float>::infinity()};
    file.binary.replace(0, 12, test::bytes_of_values(odd));
    const tf::point3 p = read_glb(file).mesh.points[0];
    CHECK(std::signbit(p.x));
    CHECK(std::isnan(p.y));
    CHECK(std::isinf(p.z));
}

TEST_CASE("gltf: a negative determinant turns faces over, two do not") {
    for (const char* const mirror : {R"(,"scale":[-1,1,1])", R"(,"scale":[-1,-1,-1])",
                                     R"(,"matrix":[0,1,0,0, 1,0,0,0, 0,0,1,0, 0,0,0,1])"}) {
        CAPTURE(mirror);
        CHECK(volume_of(read_glb(gltf_cube(mirror))) == 1.0);
        gltf_file twice = gltf_cube(mirror);
        twice.nodes.push_back(std::string(R"({"children":[0])") + mirror + "}");
        twice.scenes = R"([{"nodes":[1]}])";
        CHECK(volume_of(read_glb(twice)) == 1.0);
        CHECK(read_glb(twice).mesh.faces == read_glb(gltf_cube()).mesh.faces);
    }
    // Normals point out of the mirrored surface.
    gltf_file file = gltf_cube(R"(,"scale":[-2,1,1])");
    file.add<float>({-1, 0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0},
                    test::gltf_float, "VEC3");
    file.meshes.clear();
    file.add_mesh(R"("POSITION":0,"NORMAL":2)", R"(,"indices":1)");
    CHECK(values_of(read_glb(file), "nx") == list{1, -1, -1, 1, 1, -1, -1, 1});
}

TEST_CASE("gltf: normals go with the inverse transpose, and have length 1") {
    gltf_file file = flat_square(R"(,"mode":5)");
    const auto h = static_cast<float>(std::sqrt(0.5));
    file.add<float>({h, h, 0, h, h, 0, h, h, 0, h, h, 0}, test::gltf_float, "VEC3");
    file.meshes.clear();
    file.add_mesh(R"("POSITION":0,"NORMAL":1)", R"(,"mode":5)");
    file.nodes = {R"({"mesh":0,"scale":[3,4,1]})"};
    const tf::mesh_file read = read_glb(file);
    CHECK(values_of(read, "nx")[0] == doctest::Approx(0.8));
    CHECK(values_of(read, "ny")[0] == doctest::Approx(0.6));
    file.nodes = {R"({"mesh":0})"};
    CHECK(values_of(read_glb(file), "nx")[0] == static_cast<double>(h));
}

TEST_CASE("gltf: the default scene is read; what is elsewhere is said") {
    gltf_file file = gltf_cube();
    file.nodes = {R"({"mesh":0,"name":"a"})", R"({"mesh":0,"name":"b"})", R"({"name":"c"})"};
    file.scenes = R"([{"nodes":[0]},{"nodes":[1,2]}])";
    CHECK(parts_in(read_glb(file)) == words{"a"});
    file.more = R"("scene":1,)";
    CHECK(parts_in(read_glb(file)) == words{"b"});
    CHECK(warnings_of(read_glb(file), "not-built") ==
          words{"1 nodes with meshes are not in the default scene and were not read"});
    file.more.clear();
    file.scenes.clear();
    CHECK(parts_in(read_glb(file)) == words{"a", "b"});
    file.nodes.clear();
    CHECK(glb_refusal(file.glb()) == "a.glb: the scene shows no mesh");
}

TEST_CASE("gltf: nodes are parts, with names of their own") {
    gltf_file file = gltf_cube();
    file.add_mesh(R"("POSITION":0)", R"(,"indices":1)");
    file.meshes[1].insert(1, R"("name":"gear",)");
    file.nodes = {R"({"children":[1,2,3,4,5]})",       R"({"mesh":0,"name":"bolt"})",
                  R"({"mesh":0,"name":"bolt"})",       R"({"mesh":1})",
                  R"j({"mesh":1,"name":"bolt (2)"})j", R"({"mesh":0})"};
    const tf::mesh_file read = read_glb(file);
    CHECK(parts_in(read) == words{"bolt", "bolt (2)", "gear", "bolt (2) (2)", "nodes[5]"});
    CHECK(read.attributes.parts[2].first_face == 24);
    CHECK(read.mesh.points.size() == 40);
}

TEST_CASE("gltf: instances are parts") {
    gltf_file file = gltf_cube();
    file.add<float>({0, 0, 0, 5, 0, 0}, test::gltf_float, "VEC3");
    file.add<std::int16_t>({0, 0, 0, 32767, 0, 0, 23170, 23170}, test::gltf_int16, "VEC4",
                           R"(,"normalized":true)");
    file.add<float>({1, 1, 1, 2, 2, -2}, test::gltf_float, "VEC3");
    const auto node = [](const std::string& attributes) {
        return R"({"mesh":0,"name":"i","translation":[0,0,7],"extensions":{)"
               R"("EXT_mesh_gpu_instancing":{"attributes":{)" +
               attributes + "}}}}";
    };
    file.more = R"("extensionsRequired":["EXT_mesh_gpu_instancing"],)";
    file.nodes = {node(R"("TRANSLATION":2,"ROTATION":3,"SCALE":4)")};
    const tf::mesh_file read = read_glb(file);
    CHECK(parts_in(read) == words{"i", "i (2)"});
    CHECK(volume_of(read) == doctest::Approx(9.0));
    CHECK(read.mesh.points[6] == tf::point3{1, 1, 8});
    CHECK(read.mesh.points[14] == tf::point3{3, 2, 5});
    file.nodes = {node(R"("TRANSLATION":2)")};
    CHECK(read_glb(file).mesh.points[14] == tf::point3{6, 1, 8});
    file.nodes = {node(R"("TRANSLATION":2,"SCALE":0)")};
    CHECK(glb_refusal(file.glb()).find("instance attributes that do not match") !=
          std::string::npos);
    file.nodes = {node(R"("ROTATION":2)")};
    CHECK(glb_refusal(file.glb()).find("instance attributes that do not match") !=
          std::string::npos);
    file.nodes = {node("")};
    CHECK(glb_refusal(file.glb()).find("instances without attributes") != std::string::npos);
}

TEST_CASE("gltf: an extension that is required and not read is refused by name") {
    const auto said = [](const std::string& name) {
        gltf_file file = gltf_cube();
        file.more =
            R"("extensionsUsed":[")" + name + R"("],"extensionsRequired":[")" + name + R"("],)";
        return glb_refusal(file.glb());
    };
    CHECK(said("VENDOR_shape") ==
          "a.glb: the file requires the extension VENDOR_shape, which is not supported");
    CHECK(said("EXT_meshopt_compression") ==
          "a.glb: the file requires the extension EXT_meshopt_compression, which is not supported; "
          "gltf-transform copy IN OUT unpacks it");
    for (const char* const looks : {"KHR_materials_unlit", "KHR_texture_basisu", "EXT_texture_webp",
                                    "KHR_lights_punctual", "KHR_texture_transform"})
        CHECK(said(looks).empty());
    // What is packed without being required has other values beside it, or none.
    gltf_file file = gltf_cube();
    file.accessors[0] = R"({"componentType":5126,"count":8,"type":"VEC3"})";
    CHECK(glb_refusal(file.glb()).find("accessors[0] has no buffer view") != std::string::npos);
    file = gltf_cube();
    file.views[0].insert(1, R"("extensions":{"EXT_meshopt_compression":{}},)");
    CHECK(glb_refusal(file.glb()).find("needs the extension EXT_meshopt_compression") !=
          std::string::npos);
}

TEST_CASE("gltf: other versions are refused") {
    // The first is left to assimp, where there is one.
    const std::string first = glb_refusal(R"({"asset":{"version":"1.0"}})", "a.gltf");
    CHECK(!first.empty());
    CHECK((first.find("gltf-pipeline") == std::string::npos) == tf::reads_scenes());
    CHECK(glb_refusal(R"({"asset":{"version":"3.0"}})", "a.gltf") ==
          "a.gltf: glTF 3.0 is not supported, only 2.0");
    CHECK(glb_refusal(R"({"asset":{"version":"2.1","minVersion":"2.1"}})", "a.gltf") ==
          "a.gltf: glTF 2.1 is not supported, only 2.0");
    CHECK(glb_refusal(R"({"asset":{"version":"2.1"},"scenes":[{}]})", "a.gltf").empty());
    std::string glb = gltf_cube().glb();
    glb[4] = '\1';
    CHECK_FALSE(glb_refusal(glb).empty());
    glb[4] = '\3';
    CHECK(glb_refusal(glb) == "a.glb: GLB version 3 is not supported, only 2");
}

TEST_CASE("gltf: morph targets and skins are said to be not applied, other attributes not read") {
    gltf_file file = gltf_cube(R"(,"skin":0)");
    file.more = R"("skins":[{"joints":[0]}],)";
    file.meshes.clear();
    file.add_mesh(R"("POSITION":0,"JOINTS_0":0,"_HEAT":0)",
                  R"(,"indices":1,"targets":[{"POSITION":0}])");
    CHECK(warnings_of(read_glb(file), "not-applied") ==
          words{"morph targets and skins are not applied: meshes have their unmodified shape"});
    CHECK(warnings_of(read_glb(file), "attributes") ==
          words{"attributes of points not read: JOINTS_0, _HEAT"});
}

TEST_CASE("gltf: colors of each type, with alpha and without, are the numbers of the file") {
    const auto colored = [](auto values, int type, const char* shape) {
        gltf_file file = flat_square(R"(,"mode":5)");
        file.add(values, type, shape, type == test::gltf_float ? "" : R"(,"normalized":true)");
        file.meshes.clear();
        file.add_mesh(R"("POSITION":0,"COLOR_0":1)", R"(,"mode":5)");
        return read_glb(file);
    };
    const tf::mesh_file bytes =
        colored(std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 255},
                test::gltf_uint8, "VEC4");
    CHECK(values_of(bytes, "red") == list{1, 5, 9, 13});
    CHECK(values_of(bytes, "alpha") == list{4, 8, 12, 255});
    const tf::mesh_file shorts =
        colored(std::vector<std::uint16_t>{1, 2, 65535, 4, 5, 6, 7, 8, 9, 10, 11, 12},
                test::gltf_uint16, "VEC3");
    CHECK(values_of(shorts, "blue") == list{65535, 6, 9, 12});
    CHECK(values_of(shorts, "alpha").empty());
    const tf::mesh_file floats = colored(
        std::vector<float>{0, 0.5F, 1, 0, 0, 0, 0, 0, 0, 0.25F, 0, 0}, test::gltf_float, "VEC3");
    CHECK(values_of(floats, "green") == list{0.5, 0, 0, 0});
    const tf::element& vertices = *floats.attributes.find("vertex");
    CHECK(vertices.find("red")->type == tf::scalar_type::float32);
    CHECK_THROWS_AS((void)colored(std::vector<std::int16_t>(12, 0), test::gltf_int16, "VEC3"),
                    tf::io_error);
}

TEST_CASE("gltf: where types of colors differ they are floats, where there are none white") {
    gltf_file file = flat_square(R"(,"mode":5)");
    file.add(std::vector<std::uint8_t>(16, 51), test::gltf_uint8, "VEC4", R"(,"normalized":true)");
    file.add(std::vector<float>(12, 0.5F), test::gltf_float, "VEC3");
    file.meshes = {R"({"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1},"mode":5},)"
                   R"({"attributes":{"POSITION":0,"COLOR_0":2},"mode":5},)"
                   R"({"attributes":{"POSITION":0},"mode":5}]})"};
    const tf::mesh_file read = read_glb(file);
    const auto fifth = static_cast<double>(51.0F / 255.0F);
    CHECK(values_of(read, "red") ==
          list{fifth, fifth, fifth, fifth, 0.5, 0.5, 0.5, 0.5, 1, 1, 1, 1});
    CHECK(values_of(read, "alpha") == list{fifth, fifth, fifth, fifth, 1, 1, 1, 1, 1, 1, 1, 1});
    CHECK(warnings_of(read, "attributes") ==
          words{"only some meshes have colors; the points of the others got white"});
}

TEST_CASE("gltf: texture coordinates are those that the color of the material takes") {
    gltf_file file = flat_square(R"(,"mode":5)");
    file.add<float>({0, 0, 1, 0, 0, 1, 1, 1}, test::gltf_float, "VEC2");
    file.add<std::uint8_t>({0, 0, 255, 0, 0, 255, 255, 255}, test::gltf_uint8, "VEC2",
                           R"(,"normalized":true)");
    const auto with = [&](const std::string& attributes, const std::string& texture) {
        file.meshes.clear();
        file.add_mesh(R"("POSITION":0,)" + attributes, R"(,"mode":5,"material":0)");
        file.more = R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0)" +
                    texture + "}}}],";
        return read_glb(file);
    };
    // They count from the lower left corner, as in other formats.
    const tf::mesh_file plain = with(R"("TEXCOORD_0":1)", "");
    CHECK(values_of(plain, "s") == list{0, 1, 0, 1});
    CHECK(values_of(plain, "t") == list{1, 1, 0, 0});
    CHECK(warnings_of(plain, "materials").size() == 1);
    CHECK(values_of(with(R"("TEXCOORD_0":2)", ""), "t") == list{1, 1, 0, 0});
    CHECK(values_of(with(R"("TEXCOORD_1":1)", R"(,"texCoord":1)"), "s") == list{0, 1, 0, 1});
    CHECK(values_of(with(R"("TEXCOORD_1":1)", ""), "s").empty());
    const auto moved = [&](const std::string& transform) {
        return with(R"("TEXCOORD_0":1)",
                    R"(,"extensions":{"KHR_texture_transform":{)" + transform + "}}");
    };
    CHECK(values_of(moved(R"("offset":[0.5,0.25],"scale":[2,4])"), "s") ==
          list{0.5, 2.5, 0.5, 2.5});
    CHECK(values_of(moved(R"("offset":[0.5,0.25],"scale":[2,4])"), "t") ==
          list{0.75, 0.75, -3.25, -3.25});
    const auto s = values_of(moved(R"("rotation":1.5707963267948966)"), "s");
    CHECK(s[0] == doctest::Approx(0.0));
    CHECK(s[2] == doctest::Approx(1.0));
}

TEST_CASE("gltf: primitives with the same attributes share their points") {
    gltf_file file = gltf_cube();
    file.add(std::vector<std::uint16_t>{0, 2, 1}, test::gltf_uint16, "SCALAR");
    file.meshes = {R"({"primitives":[{"attributes":{"POSITION":0},"indices":1},)"
                   R"({"attributes":{"POSITION":0},"indices":2}]})"};
    CHECK(read_glb(file).mesh.points.size() == 8);
    CHECK(read_glb(file).mesh.faces.size() == 13);
    CHECK(parts_in(read_glb(file)).size() == 1);
}

TEST_CASE("gltf: zeros behind the JSON, other chunks, and bytes behind the end") {
    const gltf_file cube = gltf_cube();
    std::string json = cube.json();
    json.resize((json.size() + 3) / 4 * 4 + 4, '\0');
    CHECK(volume_of(read_glb(test::glb_of(json, cube.binary))) == 1.0);
    const tf::mesh_file longer = read_glb(cube.glb() + "xyz");
    CHECK(warnings_of(longer, "trailing-bytes").size() == 1);
    // Whole numbers may be written as 8.0.
    gltf_file file = gltf_cube();
    file.accessors[0] = R"({"bufferView":0.0,"componentType":5126,"count":8.0,"type":"VEC3"})";
    CHECK(volume_of(read_glb(file)) == 1.0);
}
