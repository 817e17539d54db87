// 3MF: what is read of packages that others write, and that what we write reads back.

#include <libmesh/attributes/scene_parts.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/columns.hpp>
#include <support/packages.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

tf::mesh_file read_3mf(const std::string& bytes) {
    return tf::read(std::as_bytes(std::span(bytes)), "a.3mf", {});
}

std::string written_3mf(const tf::mesh_file& file, std::optional<tf::precision> precision = {}) {
    return tf::write_to_memory(file, {.format = "3mf", .precision = precision});
}

/// Resources, then a build of these items.
std::string model(const std::string& resources, const std::string& items,
                  const std::string& attributes = {}) {
    return test::model_text("<resources>" + resources + "</resources><build>" + items + "</build>",
                            attributes);
}

std::string object(int id, const std::string& attributes, const std::string& content) {
    return "<object id=\"" + std::to_string(id) + "\" " + attributes + ">" + content + "</object>";
}

/// Three tetrahedra with no point in common, of random coordinates.
tf::mesh_file scene(unsigned seed) {
    std::mt19937_64 random(seed);
    tf::mesh_file file;
    for (std::uint32_t body = 0; body < 3; ++body) {
        for (int v = 0; v < 4; ++v) {
            const auto next = [&] { return static_cast<double>(random()) * 0x1p-61 - 4.0; };
            const double x = next();
            const double y = next();
            file.mesh.points.push_back({x, y, next()});
        }
        const std::uint32_t b = 4 * body;
        for (const tf::face& f : {tf::face{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
            file.mesh.faces.push_back({b + f[0], b + f[1], b + f[2]});
        file.attributes.parts.push_back(
            {.object = "body <" + std::to_string(body) + "> & \"more\"", .first_face = b});
    }
    file.stored_faces = 12;
    return file;
}

bool same_points(const std::vector<tf::point3>& a, const std::vector<tf::point3>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t v = 0; v < a.size(); ++v)
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (std::bit_cast<std::uint64_t>(a[v][axis]) !=
                std::bit_cast<std::uint64_t>(b[v][axis]))
                return false;
    return true;
}

std::string codes(const tf::mesh_file& file) {
    std::string all;
    for (const tf::io_warning& w : file.warnings) all += w.code + ' ';
    return all;
}

}  // namespace

TEST_CASE("3mf: an object in the build is read, one outside is not") {
    const tf::mesh_file file = read_3mf(test::package_3mf(
        model(object(1, "", test::tetrahedron_3mf) + object(2, "", test::tetrahedron_3mf),
              "<item objectid=\"1\"/>")));
    CHECK(file.format == "3mf");
    CHECK(file.mesh.points.size() == 4);
    CHECK(file.mesh.faces == std::vector<tf::face>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    CHECK(file.stored_faces == 4);
    CHECK(file.stored_as == tf::precision::float32);
    CHECK(file.attributes.parts.empty());
    CHECK(file.attributes.obj_info == std::vector<std::string>{"unit millimeter"});
    CHECK(codes(file) == "not-built ");
}

TEST_CASE("3mf: nested components are placed by their transforms, inner ones first") {
    const std::string turn_z = "0 1 0 -1 0 0 0 0 1 10 0 0";  // a quarter turn, then 10 along x
    const tf::mesh_file file = read_3mf(test::package_3mf(model(
        object(1, "name=\"leaf\"", test::tetrahedron_3mf) +
            object(2, "",
                   "<components><component objectid=\"1\" transform=\"" + turn_z +
                       "\"/><component objectid=\"1\"/></components>") +
            object(3, "name=\"all\"", "<components><component objectid=\"2\"/></components>"),
        "<item objectid=\"3\" transform=\"2 0 0 0 2 0 0 0 2 0 0 1\"/><item objectid=\"1\"/>")));
    REQUIRE(file.mesh.points.size() == 12);
    CHECK(file.mesh.points[0] == tf::point3{20, 0, 1});
    CHECK(file.mesh.points[1] == tf::point3{20, 2, 1});
    CHECK(file.mesh.points[2] == tf::point3{18, 0, 1});
    CHECK(file.mesh.points[3] == tf::point3{20, 0, 3});
    CHECK(file.mesh.points[5] == tf::point3{2, 0, 1});
    CHECK(file.mesh.points[9] == tf::point3{1, 0, 0});
    CHECK(file.stored_as == tf::precision::float32);
    const auto& parts = file.attributes.parts;
    REQUIRE(parts.size() == 3);
    CHECK(parts[0].object == "leaf");
    CHECK(parts[1].object == "leaf (2)");
    CHECK(parts[2].object == "leaf (3)");
    CHECK(parts[2].first_face == 8);
    CHECK(tf::scene_parts(file.mesh, parts).size() == 3);
}

TEST_CASE("3mf: a mirrored object is still not inside out") {
    const tf::mesh_file file = read_3mf(
        test::package_3mf(model(object(1, "", test::tetrahedron_3mf),
                                "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>")));
    CHECK(tf::signed_volume(file.mesh) == doctest::Approx(1.0 / 6.0));
}

TEST_CASE("3mf: parts have the name of the object, or around it, or a number") {
    const auto name_of = [](const std::string& attributes, const std::string& item) {
        const tf::mesh_file file = read_3mf(
            test::package_3mf(model(object(7, attributes, test::tetrahedron_3mf) +
                                        object(8, "name=\"other\"", test::tetrahedron_3mf),
                                    "<item objectid=\"7\" " + item + "/><item objectid=\"8\"/>")));
        return file.attributes.parts.at(0).object;
    };
    CHECK(name_of("name=\"a\" partnumber=\"b\"", "partnumber=\"c\"") == "a");
    CHECK(name_of("partnumber=\"b\"", "partnumber=\"c\"") == "b");
    CHECK(name_of("", "partnumber=\"c\"") == "c");
    CHECK(name_of("", "") == "object 7");
    CHECK(name_of("name=\"other\"", "") == "other");
}

TEST_CASE("3mf: objects of other model parts are read where the root names them") {
    const std::string root =
        model(object(2, "name=\"plate\"",
                     "<components><component p:path=\"/3D/Objects/a.model\" objectid=\"2\"/>"
                     "<component p:path=\"/3D/Objects/a.model\" objectid=\"1\"/></components>"),
              "<item objectid=\"2\"/><item p:path=\"/3D/Objects/b.model\" objectid=\"5\"/>",
              " requiredextensions=\"p\"");
    const std::string part =
        model(object(1, "", test::tetrahedron_3mf) +
                  object(2, "", "<components><component objectid=\"1\"/></components>"),
              "");
    const std::string other = model(object(5, "name=\"five\"", test::tetrahedron_3mf), "");
    const tf::mesh_file file =
        read_3mf(test::package_3mf(root, {{.name = "3D/Objects/a.model", .bytes = part},
                                          {.name = "3D/Objects/b.model", .bytes = other}}));
    const auto& parts = file.attributes.parts;
    REQUIRE(parts.size() == 3);
    CHECK(parts[0].object == "plate");
    CHECK(parts[1].object == "plate (2)");
    CHECK(parts[2].object == "five");
}

TEST_CASE("3mf: units are kept, and written again") {
    for (const std::string unit : {"micron", "millimeter", "centimeter", "inch", "foot", "meter"}) {
        const tf::mesh_file file =
            read_3mf(test::package_3mf(model(object(1, "", test::tetrahedron_3mf),
                                             "<item objectid=\"1\"/>", " unit=\"" + unit + "\"")));
        CHECK(file.attributes.obj_info == std::vector<std::string>{"unit " + unit});
        CHECK(file.mesh.points[1] == tf::point3{1, 0, 0});
        CHECK(read_3mf(written_3mf(file)).attributes.obj_info == file.attributes.obj_info);
    }
}

TEST_CASE("3mf: base materials are parts' materials and colors of faces") {
    const std::string mesh =
        "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
        "<vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles>"
        "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>"
        "<triangle v1=\"0\" v2=\"2\" v3=\"1\" p1=\"1\"/>"
        "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"6\" p1=\"0\"/></triangles></mesh>";
    const tf::mesh_file file = read_3mf(test::package_3mf(
        model("<basematerials id=\"5\"><base name=\"PLA\" displaycolor=\"#FF0000\"/>"
              "<base name=\"ABS\" displaycolor=\"#00ff0080\"/></basematerials>"
              "<m:colorgroup id=\"6\"><m:color color=\"#0000FF\"/></m:colorgroup>" +
                  object(1, "name=\"a\" pid=\"5\" pindex=\"0\"", mesh),
              "<item objectid=\"1\"/>")));
    CHECK(test::whole_values(file, "face", "red") == std::vector<int>{255, 0, 0});
    CHECK(test::whole_values(file, "face", "green") == std::vector<int>{0, 255, 0});
    CHECK(test::whole_values(file, "face", "blue") == std::vector<int>{0, 0, 255});
    CHECK(test::whole_values(file, "face", "alpha") == std::vector<int>{255, 128, 255});
    const std::vector<tf::named_faces> parts{{.object = "a", .material = "PLA", .first_face = 0},
                                             {.object = "a", .material = "ABS", .first_face = 1},
                                             {.object = "a", .first_face = 2}};
    CHECK(file.attributes.parts == parts);
    const tf::mesh_file again = read_3mf(written_3mf(file));
    CHECK(again.attributes == file.attributes);
    CHECK(again.mesh == file.mesh);
}

TEST_CASE("3mf: corners of several colors are colors of points where that is the same") {
    const std::string head =
        "<m:colorgroup id=\"6\"><m:color color=\"#000000\"/><m:color color=\"#010000\"/>"
        "<m:color color=\"#020000\"/></m:colorgroup>";
    const auto colored = [&](const std::string& second) {
        return read_3mf(test::package_3mf(
            model(head + object(1, "",
                                "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/>"
                                "<vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/>"
                                "</vertices><triangles>"
                                "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"6\" p1=\"0\" p2=\"1\" "
                                "p3=\"2\"/><triangle v1=\"2\" v2=\"1\" v3=\"0\" " +
                                    second + "/></triangles></mesh>"),
                  "<item objectid=\"1\"/>")));
    };
    const tf::mesh_file points = colored("pid=\"6\" p1=\"2\" p2=\"1\" p3=\"0\"");
    CHECK(test::whole_values(points, "vertex", "red") == std::vector<int>{0, 1, 2});
    CHECK(points.attributes.find("face") == nullptr);
    CHECK(points.warnings.empty());
    CHECK(read_3mf(written_3mf(points)).attributes == points.attributes);
    const tf::mesh_file faces = colored("pid=\"6\" p1=\"1\"");
    CHECK(test::whole_values(faces, "face", "red") == std::vector<int>{0, 1});
    CHECK(codes(faces) == "colors ");
    CHECK(test::whole_values(colored(""), "face", "red") == std::vector<int>{0, 255});
}

TEST_CASE("3mf: texture coordinates are those of corners, their images are not read") {
    const std::string mesh =
        "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
        "<vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles>"
        "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>"
        "<triangle v1=\"0\" v2=\"2\" v3=\"1\" pid=\"6\" p1=\"0\" p2=\"1\" p3=\"2\"/>"
        "</triangles></mesh>";
    const tf::mesh_file file = read_3mf(test::package_3mf(
        model("<m:texture2d id=\"5\" path=\"/3D/t.png\" contenttype=\"image/png\"/>"
              "<m:texture2dgroup id=\"6\" texid=\"5\"><m:tex2coord u=\"0\" v=\"0.5\"/>"
              "<m:tex2coord u=\"1\" v=\"0.5\"/><m:tex2coord u=\"1\" v=\"1\"/></m:texture2dgroup>" +
                  object(1, "", mesh),
              "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>",
              " requiredextensions=\"m\"")));
    constexpr std::uint32_t none = tf::corner_values::none;
    const auto& corners = file.attributes.corners;
    CHECK(corners.texture ==
          std::vector<std::array<double, 3>>{{0, 0.5, 0}, {1, 0.5, 0}, {1, 1, 0}});
    CHECK(corners.texture_of_corner == std::vector<tf::face>{{none, none, none}, {0, 2, 1}});
    CHECK(codes(file) == "materials ");
}

TEST_CASE("3mf: objects of the type 'other' are not made, supports are") {
    const std::string resources = object(1, "type=\"support\"", test::tetrahedron_3mf) +
                                  object(2, "type=\"other\"", test::tetrahedron_3mf);
    const tf::mesh_file file = read_3mf(
        test::package_3mf(model(resources, "<item objectid=\"1\"/><item objectid=\"2\"/>")));
    CHECK(file.mesh.faces.size() == 4);
    CHECK(codes(file) == "not-built support ");
}

TEST_CASE("3mf: items that are not to be printed are read, which is said") {
    const tf::mesh_file file = read_3mf(test::package_3mf(
        model(object(1, "", test::tetrahedron_3mf),
              "<item objectid=\"1\" printable=\"0\"/><item objectid=\"1\" printable=\"1\"/>")));
    CHECK(file.mesh.faces.size() == 8);
    CHECK(codes(file) == "support ");
}

TEST_CASE("3mf: a prefix of the core, spaces in numbers and UTF-16 change nothing") {
    std::string text =
        "<c:model xmlns:c=\"http://schemas.microsoft.com/3dmanufacturing/core/"
        "2015/02\"><c:resources><c:object id=\" 1 \"><c:mesh><c:vertices>"
        "<c:vertex x=\" 1e-1\" y=\"+.5 \" z=\"-0\"/></c:vertices>"
        "<c:triangles><c:triangle v1=\"0\" v2=\"0\" v3=\"0\"/></c:triangles>"
        "</c:mesh></c:object></c:resources><c:build><c:item objectid=\"1\"/>"
        "</c:build></c:model>";
    const tf::mesh_file file = read_3mf(test::package_3mf(text));
    REQUIRE(file.mesh.points.size() == 1);
    CHECK(same_points(file.mesh.points, {{0.1, 0.5, -0.0}}));
    CHECK(file.stored_as == tf::precision::float64);
    std::string wide = "\xff\xfe";
    for (const char c : text) wide += {c, '\0'};
    CHECK(read_3mf(test::package_3mf(wide)).mesh == file.mesh);
}

TEST_CASE("3mf: doubles come back bit for bit when asked for, else their floats do") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        tf::mesh_file file = scene(seed);
        file.mesh.points[0] = {-0.0, 0x1p-1074, 0x1.fffffffffffffp1023};
        file.mesh.points[1] = {0.1, 1e22, 123456789.123456789};
        const tf::mesh_file doubles = read_3mf(written_3mf(file, tf::precision::float64));
        CHECK(same_points(doubles.mesh.points, file.mesh.points));
        CHECK(doubles.mesh.faces == file.mesh.faces);
        CHECK(doubles.attributes.parts == file.attributes.parts);
        CHECK(doubles.stored_as == tf::precision::float64);

        file.mesh.points[0] = {-0.0, 0x1p-149, 0x1.fffffep127};
        tf::mesh_file floats = read_3mf(written_3mf(file));
        CHECK(
            same_points(floats.mesh.points, tf::rounded(file.mesh.points, tf::precision::float32)));
        CHECK(floats.stored_as == tf::precision::float32);
        CHECK(written_3mf(floats) == written_3mf(file));
    }
}

TEST_CASE("3mf: a scene stays a scene, and its bytes are always the same") {
    const tf::mesh_file file = scene(1);
    const std::string bytes = written_3mf(file, tf::precision::float64);
    CHECK(bytes == written_3mf(file, tf::precision::float64));
    const tf::mesh_file again = read_3mf(bytes);
    CHECK(again.mesh == file.mesh);
    CHECK(again.attributes.parts == file.attributes.parts);
    CHECK(written_3mf(again, tf::precision::float64) == bytes);
    CHECK(again.warnings.empty());
}

TEST_CASE("3mf: names that XML cannot hold are written so that it can") {
    tf::mesh_file file = scene(1);
    file.attributes.parts[0].object =
        "a\x01"
        "b\xff\xc3\xa4\xed\xa0\x80\n\t";
    const std::string name = read_3mf(written_3mf(file)).attributes.parts[0].object;
    const std::string lost = "\xef\xbf\xbd";
    CHECK(name == "a" + lost + "b" + lost + "\xc3\xa4" + lost + lost + lost + "  ");
}

TEST_CASE("3mf: points that no face uses stay") {
    tf::mesh_file file = scene(1);
    file.mesh.points.insert(file.mesh.points.begin(), {7, 7, 7});
    file.mesh.points.push_back({8, 8, 8});
    for (tf::face& f : file.mesh.faces)
        for (std::uint32_t& corner : f) ++corner;
    CHECK(read_3mf(written_3mf(file, tf::precision::float64)).mesh == file.mesh);
}

TEST_CASE("3mf: faces without a material are white among those that have one") {
    tf::mesh_file file = scene(1);
    file.attributes.parts[1].material = "PLA";
    const tf::mesh_file again = read_3mf(written_3mf(file));
    CHECK(again.attributes.parts == file.attributes.parts);
    CHECK(test::whole_values(again, "face", "green") == std::vector<int>(12, 255));
    CHECK(written_3mf(again) == written_3mf(file));
}

TEST_CASE("3mf: parts with a point in common are written as one object") {
    tf::mesh_file file = scene(1);
    file.mesh.faces[4][0] = 0;  // the second body hangs on the first
    const tf::mesh_file again = read_3mf(written_3mf(file));
    CHECK(again.attributes.parts.size() == 2);
    CHECK(again.mesh.points.size() == file.mesh.points.size());
}

TEST_CASE("3mf: what it cannot hold is refused or said") {
    tf::mesh_file file = scene(1);
    file.mesh.points[0].x = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH_AS((void)written_3mf(file),
                         doctest::Contains("point 0: 3MF can hold only finite coordinates"),
                         tf::io_error);
    CHECK_THROWS_AS((void)written_3mf({.mesh = {.points = {{0, 0, 0}}, .faces = {}}}),
                    tf::io_error);
    CHECK(read_3mf(written_3mf({})).mesh == tf::mesh{});
    tf::mesh_file far = scene(1);
    far.mesh.points[0].x = 1e300;
    CHECK_THROWS_AS((void)written_3mf(far), tf::io_error);
    CHECK_NOTHROW((void)written_3mf(far, tf::precision::float64));
}
