#include <libmesh/io/point_rows.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>

#include <doctest/doctest.h>
#include <support/las_bytes.hpp>
#include <support/own_folder.hpp>
#include <support/translated.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tf = treeform;

namespace {

using test::add_translated;
using test::is_named_in;
using test::passed_through;
using test::put_translated;
using test::read_translated;
using test::sentences;
using test::translated_column;
using test::translated_file;
using test::translated_numbers;

/// Points with all that formats have names of their own for.
tf::mesh_file colored_cloud() {
    tf::mesh_file file;
    file.mesh.points = {{0, 0, 0}, {1, 0.25, 0}, {2, 0, 4.5}};
    add_translated<std::uint8_t>(file, "red", {255, 64, 1});
    add_translated<std::uint8_t>(file, "green", {128, 0, 2});
    add_translated<std::uint8_t>(file, "blue", {0, 255, 3});
    add_translated<float>(file, "nx", {0, 0, 1});
    add_translated<float>(file, "ny", {0, 1, 0});
    add_translated<float>(file, "nz", {1, 0, 0});
    add_translated<float>(file, "curvature", {0.5, 0.25, 0.125});
    add_translated<std::uint16_t>(file, "intensity", {7, 800, 60000});
    return file;
}

const sentences all_of_cloud{"red", "green", "blue", "nx", "ny", "nz", "curvature", "intensity"};

}  // namespace

TEST_CASE(
    "translation: over all pairs of formats, properties of points stay or are named as lost") {
    const sentences formats{"ply", "pcd", "las", "laz", "csv", "obj", "off"};
    const tf::mesh_file given = colored_cloud();
    for (const std::string& first : formats) {
        for (const std::string& second : formats) {
            CAPTURE(first);
            CAPTURE(second);
            const translated_file one = put_translated(given, first);
            const translated_file two = put_translated(read_translated(one.bytes, first), second);
            const translated_file three = put_translated(read_translated(two.bytes, second), "ply");
            const tf::mesh_file end = read_translated(three.bytes, "ply");
            REQUIRE(end.mesh.points == given.mesh.points);
            for (const std::string& property : all_of_cloud) {
                CAPTURE(property);
                const std::vector<double> values = translated_numbers(end, property);
                const bool is_lost = is_named_in(one.warnings, property) ||
                                     is_named_in(two.warnings, property) ||
                                     is_named_in(three.warnings, property);
                if (!is_lost) CHECK(values == translated_numbers(given, property));
            }
            for (const char* channel : {"red", "green", "blue"}) {
                REQUIRE(translated_column(end, channel) != nullptr);
                CHECK(translated_column(end, channel)->type == tf::scalar_type::uint8);
            }
            CHECK(translated_numbers(end, "nx") == translated_numbers(given, "nx"));
        }
    }
}

TEST_CASE("translation: names and types are those that others read") {
    const std::string pcd = put_translated(colored_cloud(), "pcd", {.ascii = true}).bytes;
    CHECK(pcd.find("FIELDS x y z rgb normal_x normal_y normal_z curvature intensity\n") !=
          std::string::npos);
    CHECK(pcd.find("TYPE F F F U F F F F F\n") != std::string::npos);
    CHECK(pcd.find("\n0 0 0 16744448 0 0 1 0.5 7\n") != std::string::npos);
    tf::mesh_file clear = colored_cloud();
    add_translated<std::uint8_t>(clear, "alpha", {255, 0, 16});
    const tf::mesh_file packed = read_translated(put_translated(clear, "pcd").bytes, "pcd");
    REQUIRE(translated_column(packed, "rgba") != nullptr);
    CHECK(translated_column(packed, "rgba")->type == tf::scalar_type::uint32);
    CHECK(translated_numbers(passed_through(packed, "ply"), "alpha") ==
          std::vector<double>{255, 0, 16});
    const tf::mesh_file las = read_translated(put_translated(colored_cloud(), "las").bytes, "las");
    CHECK(translated_numbers(las, "red") == std::vector<double>{65280, 16384, 256});
    CHECK(translated_numbers(las, "NormalZ") == std::vector<double>{1, 0, 0});
    const std::string obj = put_translated(colored_cloud(), "obj").bytes;
    CHECK(obj.starts_with("v 0 0 0 1 0.5019607843137255 0\nvn 0 0 1\n"));
    tf::mesh_file remarked = colored_cloud();
    remarked.attributes.obj_info = {"made by hand", "viewpoint 1 2 3 1 0 0 0"};
    const tf::mesh_file told = passed_through(remarked, "pcd");
    CHECK(told.attributes.comments == sentences{"made by hand"});
    CHECK(told.attributes.obj_info == sentences{"viewpoint 1 2 3 1 0 0 0"});
    // A file stays as it is in its own format, and where that is asked for.
    CHECK(put_translated(packed, "pcd").bytes == put_translated(clear, "pcd").bytes);
    CHECK(translated_column(
              read_translated(put_translated(packed, "ply", {.keep_names = true}).bytes, "ply"),
              "normal_x") != nullptr);
}

TEST_CASE("translation: spellings of CloudCompare and PDAL are understood, lone letters are not") {
    tf::mesh_file file;
    file.mesh.points = {{0, 0, 0}, {1, 0, 0}};
    add_translated<float>(file, "scalar_Intensity", {3, 4});
    add_translated<float>(file, "scalar_Return_Number", {1, 2});
    add_translated<double>(file, "GpsTime", {1.5, 2.5});
    add_translated<float>(file, "t", {8, 9});
    const tf::mesh_file las = passed_through(file, "las");
    CHECK(translated_numbers(las, "intensity") == std::vector<double>{3, 4});
    CHECK(translated_numbers(las, "return_number") == std::vector<double>{1, 2});
    CHECK(translated_numbers(las, "gps_time") == std::vector<double>{1.5, 2.5});
    CHECK(translated_numbers(las, "t") == std::vector<double>{8, 9});
    CHECK(translated_numbers(passed_through(file, "pcd"), "t") == std::vector<double>{8, 9});
}

TEST_CASE("translation: colors of 16 bits, of 8 bits in 16, of floats") {
    tf::mesh_file file;
    file.mesh.points = {{0, 0, 0}, {1, 0, 0}};
    file.format = "las";
    const auto with = [&](std::vector<std::uint16_t> red) {
        tf::mesh_file colored = file;
        add_translated<std::uint16_t>(colored, "red", red);
        add_translated<std::uint16_t>(colored, "green", {0, 0});
        add_translated<std::uint16_t>(colored, "blue", {0, 0});
        return colored;
    };
    CHECK(translated_numbers(passed_through(with({65535, 32768}), "ply"), "red") ==
          std::vector<double>{255, 128});
    CHECK(translated_numbers(passed_through(with({65535, 32768}), "obj"), "red").front() == 1.0);
    CHECK(translated_numbers(passed_through(with({255, 17}), "ply"), "red") ==
          std::vector<double>{255, 17});
    tf::mesh_file of_words = with({65280, 32768});
    CHECK(translated_numbers(passed_through(of_words, "ply"), "red") ==
          std::vector<double>{255, 128});
    of_words = with({16383, 65535});
    of_words.format = "glb";
    CHECK(translated_numbers(passed_through(of_words, "ply"), "red") ==
          std::vector<double>{64, 255});
    CHECK(put_translated(of_words, "pcd")
              .warnings.at(0)
              .find("16-bit colors are written with 8 bits: round") != std::string::npos);
    of_words.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    of_words.attributes = {};
    for (const char* name : {"red", "green", "blue"})
        add_translated<std::uint16_t>(of_words, name, {16383, 0, 65535});
    const auto left_out = put_translated(of_words, "stl").warnings;
    REQUIRE(left_out.size() == 1);
    CHECK(left_out[0].find("not written to STL") != std::string::npos);
    CHECK(put_translated(with({65535, 1}), "ply").warnings.at(0).find("16-bit") !=
          std::string::npos);
    CHECK(put_translated(with({255, 17}), "ply").warnings.at(0).find("below 256") !=
          std::string::npos);
    tf::mesh_file floats = file;
    floats.format = "obj";
    for (const char* name : {"red", "green", "blue"})
        add_translated<double>(floats, name, {0.5, 1.0});
    CHECK(translated_numbers(passed_through(floats, "las"), "red") ==
          std::vector<double>{32768, 65535});
    CHECK(translated_numbers(passed_through(floats, "csv"), "blue") ==
          std::vector<double>{128, 255});
    CHECK(translated_numbers(passed_through(floats, "off"), "blue") ==
          std::vector<double>{0.5, 1.0});
}

TEST_CASE("translation: intensities that are floats are whole numbers in LAS, and that is said") {
    const auto with = [](std::vector<float> values) {
        tf::mesh_file file;
        file.format = "pcd-binary";
        file.mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
        add_translated<float>(file, "intensity", std::move(values));
        return file;
    };
    CHECK(translated_numbers(passed_through(with({37.5, 0, 70000}), "las"), "intensity") ==
          std::vector<double>{38, 0, 65535});
    CHECK(put_translated(with({37.5, 0, 7}), "las").warnings.at(0).find("rounded") !=
          std::string::npos);
    CHECK(translated_numbers(passed_through(with({0.5, 0, 1}), "las"), "intensity") ==
          std::vector<double>{32768, 0, 65535});
    CHECK(put_translated(with({0.5, 0, 1}), "las").warnings.at(0).find("65535") !=
          std::string::npos);
    CHECK(put_translated(with({5, 0, 1}), "las").warnings.empty());
}

TEST_CASE("translation: by blocks, the same bytes as whole files") {
    const test::own_folder own("io_translation_blocks");
    for (const char* from : {"ply", "pcd", "las"})
        for (const char* to : {"ply", "pcd", "csv", "xyz", "obj"}) {
            CAPTURE(from);
            CAPTURE(to);
            const auto in = own.path / (std::string("in.") + from);
            (void)tf::write(in, colored_cloud());
            tf::point_reader reader(in);
            const auto out = own.path / (std::string("out.") + to);
            tf::point_writer writer(out, reader.header(), 3);
            for (tf::detail::io::point_block block; reader.read(block.points, block.properties, 2);)
                writer.write(block.points, block.properties);
            const tf::write_result parts = writer.commit();
            tf::mesh_file whole = tf::read(in);
            const translated_file expected = put_translated(whole, to);
            CHECK(test::bytes_of(out) == expected.bytes);
            sentences said;
            for (const tf::io_warning& w : parts.warnings) said.push_back(w.code + ": " + w.text);
            CHECK(said == expected.warnings);
        }
}

TEST_CASE("translation: columns are dropped and renamed as asked") {
    const tf::mesh_file file = colored_cloud();
    const tf::mesh_file made = read_translated(
        put_translated(file, "ply",
                       {.drop = {"curvature", "nx"}, .rename = {{"height", "intensity"}}})
            .bytes,
        "ply");
    CHECK(translated_column(made, "curvature") == nullptr);
    CHECK(translated_column(made, "nx") == nullptr);
    CHECK(translated_numbers(made, "height") == std::vector<double>{7, 800, 60000});
    const tf::mesh_file bare =
        read_translated(put_translated(file, "ply", {.drop = {"normal", "color"}}).bytes, "ply");
    REQUIRE(bare.attributes.find("vertex") != nullptr);
    CHECK(bare.attributes.find("vertex")->columns_called("normal").empty());
    CHECK(bare.attributes.find("vertex")->columns_called("color").empty());
    CHECK(translated_numbers(bare, "intensity") == std::vector<double>{7, 800, 60000});
    CHECK_THROWS_AS((void)tf::write("/dev/null", file, {.format = "ply", .drop = {"uv"}}),
                    std::invalid_argument);
    tf::mesh_file cornered;
    cornered.format = "obj";
    cornered.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    cornered.attributes.corners = {.texture = {{0, 0, 0}, {1, 0, 0}},
                                   .normals = {{0, 0, 1}},
                                   .texture_of_corner = {{0, 1, 0}},
                                   .normal_of_corner = {{0, 0, 0}}};
    const auto text_without = [&](std::vector<std::string> drop) {
        return put_translated(cornered, "obj", {.drop = std::move(drop)}).bytes;
    };
    CHECK(text_without({}).find("vn ") != std::string::npos);
    CHECK(text_without({"normal"}).find("vn ") == std::string::npos);
    CHECK(text_without({"normal"}).find("vt ") != std::string::npos);
    CHECK(text_without({"normal", "uv"}).find("f 1 2 3") != std::string::npos);
    CHECK_THROWS_AS((void)tf::write("/dev/null", file, {.format = "ply", .drop = {"none"}}),
                    std::invalid_argument);
    CHECK_THROWS_AS(
        (void)tf::write("/dev/null", file, {.format = "ply", .rename = {{"red", "blue"}}}),
        std::invalid_argument);
}

TEST_CASE("translation: LAS gets the scale and the offset that are asked for") {
    const auto grid = [](const tf::write_options& how) {
        return *read_translated(put_translated(colored_cloud(), "las", how).bytes, "las").las;
    };
    using axes = std::array<double, 3>;
    CHECK(grid({.las_scale = axes{0.5, 0.25, 0.125}}).scale == axes{0.5, 0.25, 0.125});
    CHECK(grid({.las_offset = axes{10, 20, 30}}).offset == axes{10, 20, 30});
    CHECK_THROWS_AS((void)put_translated(colored_cloud(), "las", {.las_scale = axes{0, 1, 1}}),
                    std::invalid_argument);
    tf::mesh_file file = colored_cloud();
    CHECK(tf::round_to_las(file, {.las_scale = axes{1, 1, 1}}) == 0.5);
    CHECK(file.mesh.points[2].z == 4.0);
}

namespace {

/// A description of extra bytes of 16 bits.
std::string described(std::string_view name, double scale, double offset, bool no_data) {
    std::string d(192, '\0');
    d[2] = 4;  // int16
    d[3] = static_cast<char>(8 | 16 | (no_data ? 1 : 0));
    name.copy(d.data() + 4, 32);
    test::put(d, 40, std::int64_t{-9999});
    test::put(d, 112, scale);
    test::put(d, 136, offset);
    return d;
}

std::string scaled_las(const std::vector<std::int16_t>& stored, double scale, double offset,
                       bool no_data = false) {
    test::las_bytes las{.minor = 4, .format = 6, .record_size = 32, .scale = 0.01};
    las.add_record("LASF_Spec", 4, described("hag", scale, offset, no_data));
    std::string points(32 * stored.size(), '\0');
    for (std::size_t i = 0; i < stored.size(); ++i) {
        test::put(points, 32 * i, static_cast<std::int32_t>(100 * i));
        points[32 * i + 14] = 0x11;
        test::put(points, 32 * i + 30, stored[i]);
    }
    return las.file(points);
}

}  // namespace

TEST_CASE("translation: extra bytes with a scale are values, and come back as they were stored") {
    const std::string bytes = scaled_las({0, 100, -150, 7, -9999}, 0.01, 100.0, true);
    const tf::mesh_file file = read_translated(bytes, "las");
    const std::vector<double> hag = translated_numbers(file, "hag");
    REQUIRE(hag.size() == 5);
    CHECK(hag[0] == 100.0);
    CHECK(hag[1] == 101.0);
    CHECK(hag[2] == 98.5);
    CHECK(hag[3] == 0.07 + 100.0);
    CHECK(std::isnan(hag[4]));
    const std::string again = put_translated(file, "las").bytes;
    CHECK(test::points_of(again) == test::points_of(bytes));
    CHECK(read_translated(again, "las").las->records == file.las->records);
    // One that is no step is rounded, which is said.
    tf::mesh_file between = file;
    auto& vertices = between.attributes.find_or_add("vertex", 5);
    (void)vertices.set(
        tf::column::of<double>("hag", std::vector<double>{100.004, 101, 98.5, 100, 100}));
    const translated_file rounded = put_translated(between, "las");
    CHECK(translated_numbers(read_translated(rounded.bytes, "las"), "hag").front() == 100.0);
    REQUIRE(rounded.warnings.size() == 1);
    CHECK(rounded.warnings[0].find("hag are rounded") != std::string::npos);
}

TEST_CASE("translation: files of LAS are joined by value, whatever their scales") {
    const sentences two{"a", "b"};
    const tf::mesh_file a = read_translated(scaled_las({10, 20}, 0.1, 0), "las");
    const tf::mesh_file b = read_translated(scaled_las({10, 20}, 1.0, 0.5), "las");
    const tf::mesh_file all = tf::concatenate_files({a, b}, two);
    CHECK(translated_numbers(passed_through(all, "las"), "hag") ==
          std::vector<double>{1, 2, 10.5, 20.5});
    // Grids that differ become one that holds all.
    tf::mesh_file near = colored_cloud(), far = colored_cloud();
    for (tf::point3& p : far.mesh.points) p.x += 8'000'000.0;
    near.las = far.las = tf::las_header{};
    near.las->scale = far.las->scale = {0.0078125, 0.0078125, 0.0078125};
    near.las->offset = {0, 0, 0};
    far.las->offset = {8'000'000, 0, 0};
    near = passed_through(near, "las");
    far = passed_through(far, "las");
    tf::mesh_file both = tf::concatenate_files({near, far}, two);
    CHECK(tf::round_to_las(both) == 0.0);
    far.las->scale = {1e-7, 1e-7, 1e-7};
    both = tf::concatenate_files({near, far}, two);
    CHECK(tf::round_to_las(both) < 0.004);
}

TEST_CASE("translation: LAS of other reference systems or time types is joined only when asked") {
    const sentences two{"a", "b"};
    const auto with = [](std::string_view wkt, bool from_epoch) {
        test::las_bytes las{.minor = 4, .format = 6, .record_size = 30};
        if (!wkt.empty()) las.add_record("LASF_Projection", 2112, wkt);
        std::string bytes = las.file(std::string(30, '\0'));
        bytes[6] = static_cast<char>(16 | (from_epoch ? 1 : 0));
        return read_translated(bytes, "las");
    };
    const std::string zone43 = "PROJCS[\"zone 43\"]", zone44 = "PROJCS[\"zone 44\"]";
    const auto complaint = [&](const tf::mesh_file& a, const tf::mesh_file& b) -> std::string {
        try {
            (void)tf::concatenate_files({a, b}, two);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return {};
    };
    CHECK(complaint(with(zone43, true), with(zone43, true)).empty());
    CHECK(complaint(with(zone43, true), with(zone44, true)).find("zone 43, zone 44") !=
          std::string::npos);
    CHECK(complaint(with("", true), with(zone44, true)).find("none, zone 44") != std::string::npos);
    CHECK(complaint(with(zone43, true), with(zone43, false)).find("GPS time") != std::string::npos);
    CHECK(tf::concatenate_files({with(zone43, true), with(zone44, false)}, two, true)
              .mesh.points.size() == 2);
}

TEST_CASE("translation: files of several formats are joined in the sentences of the first") {
    const sentences two{"a", "b"};
    const tf::mesh_file ply = passed_through(colored_cloud(), "ply");
    const tf::mesh_file all =
        tf::concatenate_files({ply, passed_through(colored_cloud(), "pcd")}, two);
    const std::vector<double> red = translated_numbers(all, "red");
    CHECK(red == std::vector<double>{255, 64, 1, 255, 64, 1});
    CHECK(translated_column(all, "rgb") == nullptr);
    CHECK(translated_numbers(all, "nz") == std::vector<double>{1, 0, 0, 1, 0, 0});
}

TEST_CASE("translation: points of a cloud are the single returns of their pulses") {
    const tf::mesh_file las = passed_through(colored_cloud(), "las");
    CHECK(translated_numbers(las, "return_number") == std::vector<double>{1, 1, 1});
    CHECK(translated_numbers(las, "number_of_returns") == std::vector<double>{1, 1, 1});
    CHECK(test::get<std::uint32_t>(put_translated(colored_cloud(), "las").bytes, 111) ==
          3);  // first returns
}

TEST_CASE("translation: points that are no points are dropped, with their faces") {
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar label\nelement face 3\n"
        "property list uchar int vertex_indices\nproperty uchar color\nend_header\n"
        "0 0 0 1\nnan 0 0 2\n1 0 0 3\n0 1 0 4\n1 1 0 5\n3 0 1 2 6\n4 0 2 4 3 7\n3 2 4 3 8\n";
    const tf::mesh_file file = read_translated(ply, "ply", {.drop_non_finite = true});
    CHECK(file.warnings.at(0).code == "non-finite");
    CHECK(translated_numbers(file, "label") == std::vector<double>{1, 3, 4, 5});
    CHECK(file.stored_faces == 2);
    CHECK(file.mesh.faces == std::vector<tf::face>{{0, 1, 3}, {0, 3, 2}, {1, 3, 2}});
    CHECK(file.face_of_triangle == std::vector<std::uint32_t>{0, 0, 1});
    CHECK(file.attributes.find("face")->rows == 2);
}
