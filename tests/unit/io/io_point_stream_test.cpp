#include <libmesh/io/point_rows.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>
#include <support/point_files.hpp>
#include <sys/stat.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// A folder and the files that are put into it.
struct stream_folder {
    [[nodiscard]] fs::path put(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return folder / name;
    }
    const test::own_folder own{"io_point_stream"};
    const fs::path& folder = own.path;
};

using test::bytes_of;
using test::cloud;
using test::kind;
using test::kinds;

bool same_bytes_of(const std::vector<tf::point3>& a, const std::vector<tf::point3>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(tf::point3)) == 0);
}

void append(tf::column& to, const tf::column& from) {
    to.values.insert(to.values.end(), from.values.begin(), from.values.end());
    for (std::size_t i = 1; i < from.list_begin.size(); ++i)
        to.list_begin.push_back(to.list_begin.back() + from.list_begin[i] - from.list_begin[i - 1]);
}

/// The file put together from blocks.
tf::mesh_file read_by(std::size_t most, const fs::path& path) {
    tf::point_reader reader(path);
    tf::mesh_file file = reader.header();
    tf::element none{.name = "vertex"};
    const bool has_columns = file.attributes.find("vertex") != nullptr;
    tf::element& vertices = has_columns ? file.attributes.find_or_add("vertex", 0) : none;
    for (tf::column& c : vertices.columns)
        if (c.list_length) c.list_begin.assign(1, 0);
    tf::detail::io::point_block block;
    while (reader.read(block.points, block.properties, most)) {
        CHECK(block.points.size() <= most);
        REQUIRE(block.properties.rows == block.points.size());
        REQUIRE(block.properties.columns.size() == vertices.columns.size());
        file.mesh.points.insert(file.mesh.points.end(), block.points.begin(), block.points.end());
        for (std::size_t c = 0; c < vertices.columns.size(); ++c)
            append(vertices.columns[c], block.properties.columns[c]);
        vertices.rows += block.properties.rows;
    }
    CHECK(block.points.empty());
    CHECK_FALSE(reader.read(block.points, block.properties, most));
    CHECK(reader.count() == file.mesh.points.size());
    file.warnings = reader.header().warnings;
    return file;
}

}  // namespace

TEST_CASE("point streams: blocks of any size are what the whole file is") {
    const stream_folder here;
    for (const kind& k : kinds)
        for (const bool single : {false, true}) {
            CAPTURE(k.format);
            CAPTURE(k.ascii);
            tf::mesh_file file = cloud(2500, single);
            file.format = k.read_as;
            const fs::path path =
                here.put(std::string("a.") + k.format,
                         tf::write_to_memory(file, {.format = k.format, .ascii = k.ascii}));
            const tf::mesh_file whole = tf::read(path);
            CHECK(same_bytes_of(whole.mesh.points, file.mesh.points));
            for (const std::size_t most : std::vector<std::size_t>{1, 7, 1000, 1 << 20}) {
                const tf::mesh_file parts = read_by(most, path);
                CHECK(same_bytes_of(parts.mesh.points, whole.mesh.points));
                CHECK(parts.attributes == whole.attributes);
                CHECK(parts.format == whole.format);
            }
        }
}

TEST_CASE("point streams: blocks written one by one are the bytes of the whole file") {
    const stream_folder here;
    for (const kind& k : kinds)
        for (const bool single : {false, true})
            for (const std::size_t count : std::vector<std::size_t>{0, 1, 2500}) {
                CAPTURE(k.format);
                CAPTURE(k.ascii);
                CAPTURE(count);
                tf::mesh_file file = cloud(count, single);
                file.format = k.read_as;
                const tf::write_options options{.format = k.format, .ascii = k.ascii};
                const std::string expected = tf::write_to_memory(file, options);
                for (const std::size_t most : std::vector<std::size_t>{1, 7, 1000}) {
                    const fs::path path = here.folder / "out";
                    tf::point_writer writer(path, file, count, options);
                    for (std::size_t first = 0; first < count; first += most) {
                        std::vector<std::uint32_t> rows;
                        tf::detail::io::point_block block;
                        for (std::size_t i = first; i < std::min(count, first + most); ++i) {
                            rows.push_back(static_cast<std::uint32_t>(i));
                            block.points.push_back(file.mesh.points[i]);
                        }
                        block.properties = file.attributes.elements[0].gathered(rows);
                        writer.write(block.points, block.properties);
                    }
                    const tf::write_result result = writer.commit();
                    CHECK(bytes_of(path) == expected);
                    CHECK(result.written_as == file.stored_as);
                }
            }
}

TEST_CASE("point streams: what follows the first points is the rest of the file") {
    const stream_folder here;
    std::vector<kind> all(std::begin(kinds), std::end(kinds));
    all.push_back({"las", false, ""});
    all.push_back({"laz", false, ""});
    for (const kind& k : all) {
        CAPTURE(k.format);
        tf::mesh_file file = cloud(700, false);
        if (k.format[0] == 'l') file.attributes = {};  // LAS holds not all of these values
        file.format = k.read_as;
        const fs::path path =
            here.put(std::string("a.") + k.format,
                     tf::write_to_memory(file, {.format = k.format, .ascii = k.ascii}));
        const tf::mesh_file whole = tf::read(path);
        for (const std::size_t first : std::vector<std::size_t>{0, 1, 333, 699, 700}) {
            CAPTURE(first);
            tf::point_reader reader(path, {}, first);
            CHECK(reader.count() == 700);
            tf::detail::io::point_block block;
            for (std::size_t i = first; i < 700; i += block.points.size()) {
                REQUIRE(reader.read(block.points, block.properties, 100));
                CHECK(same_bytes_of(block.points, {whole.mesh.points.begin() + std::ptrdiff_t(i),
                                                   whole.mesh.points.begin() +
                                                       std::ptrdiff_t(i + block.points.size())}));
            }
            CHECK_FALSE(reader.read(block.points, block.properties, 100));
        }
    }
}

TEST_CASE("point streams: lists and rows without coordinates alone pass through") {
    const stream_folder here;
    const fs::path path = here.put(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty int z\nproperty list uchar short tags\n"
        "property double x\nproperty float y\nelement face 0\nproperty list uchar int "
        "vertex_indices\nend_header\n1 0 2 3\n4 2 -1 7 5 6\n7 1 9 8 9\n");
    for (const bool ascii : {true, false}) {
        const tf::mesh_file whole = tf::read(path);
        const std::string bytes = tf::write_to_memory(whole, {.format = "ply", .ascii = ascii});
        const fs::path again = here.put("b.ply", bytes);
        for (const std::size_t most : std::vector<std::size_t>{1, 2, 3})
            CHECK(read_by(most, again).attributes == whole.attributes);
        tf::point_reader reader(again);
        tf::point_writer writer(here.folder / "c.ply", reader.header(), reader.count(),
                                {.ascii = ascii});
        tf::detail::io::point_block block;
        while (reader.read(block.points, block.properties, 2))
            writer.write(block.points, block.properties);
        (void)writer.commit();
        CHECK(bytes_of(here.folder / "c.ply") == bytes);
    }
}

TEST_CASE("point streams: uneven lines of text lose their further values from the first block on") {
    const stream_folder here;
    const fs::path path = here.put("a.xyz", "1 2 3 4\n1 2 3 4\n1 2 3\n");
    const tf::mesh_file parts = read_by(1, path);
    CHECK(parts.mesh.points.size() == 3);
    CHECK(parts.attributes == tf::read(path).attributes);
    CHECK(parts.warnings.at(0).code == "columns");
}

TEST_CASE("point streams: a pipe is read as its file is, more than once where it must be") {
    const stream_folder here;
    for (const kind& k : kinds) {
        CAPTURE(k.format);
        tf::mesh_file file = cloud(3000, true);
        file.format = k.read_as;
        const std::string bytes = tf::write_to_memory(file, {.format = k.format, .ascii = k.ascii});
        const fs::path pipe = here.folder / (std::string("pipe.") + k.format);
        REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
        std::thread feeder([&] { std::ofstream(pipe, std::ios::binary) << bytes; });
        const tf::mesh_file parts = read_by(1000, pipe);
        feeder.join();
        fs::remove(pipe);
        CHECK(same_bytes_of(parts.mesh.points, file.mesh.points));
    }
}

TEST_CASE("point streams: what is no file of points is refused") {
    const stream_folder here;
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
        "property float z\n";
    CHECK_THROWS_AS(
        tf::point_reader(here.put("a.ply", head + "element face 1\nproperty list uchar int "
                                                  "vertex_indices\nend_header\n0 0 0\n3 0 0 0\n")),
        tf::io_error);
    CHECK_THROWS_AS(tf::point_reader(here.put("a.ply", head + "element edge 1\nproperty int v\n"
                                                              "end_header\n0 0 0\n0\n")),
                    tf::io_error);
    CHECK_THROWS_AS(tf::point_reader(here.put("a.obj", "v 0 0 0\n")), tf::io_error);
    CHECK_THROWS_AS(tf::point_reader(here.folder / "none.ply"), tf::io_error);
    tf::point_reader cut(here.put("b.ply", head + "end_header\n0 0 \n"));
    tf::detail::io::point_block block;
    CHECK_THROWS_AS(cut.read(block.points, block.properties, 10), tf::io_error);
    CHECK_THROWS_AS(tf::point_writer(here.folder / "a.off", {}, 0), tf::io_error);
    CHECK_THROWS_AS(tf::point_writer(here.folder / "a.stl", {}, 0), tf::io_error);
}

TEST_CASE("point streams: a writer takes what was announced, and leaves nothing without commit") {
    const stream_folder here;
    const tf::mesh_file file = cloud(2, true);
    tf::detail::io::point_block block{.points = file.mesh.points,
                                      .properties = file.attributes.elements[0]};
    {
        tf::point_writer writer(here.folder / "a.ply", file, 3);
        writer.write(block.points, block.properties);
        CHECK_THROWS_AS(writer.write(block.points, block.properties), std::invalid_argument);
        CHECK_THROWS_AS(writer.commit(), tf::io_error);
    }
    {
        tf::point_writer writer(here.folder / "a.ply", file, 2);
        tf::detail::io::point_block other = block;
        other.properties.columns.pop_back();
        CHECK_THROWS_AS(writer.write(other.points, other.properties), std::invalid_argument);
        other = block;
        other.properties.rows = 1;
        CHECK_THROWS_AS(writer.write(other.points, other.properties), std::invalid_argument);
        other = block;
        other.points[1].x = 0.1;  // no float32, as the header promises
        const std::string said =
            (here.folder / "a.ply").string() +
            ": point 1: a coordinate is not a float32 value, as the header declares; "
            "choose the option precision";
        CHECK_THROWS_WITH_AS(writer.write(other.points, other.properties), said.c_str(),
                             std::invalid_argument);
    }
    CHECK(fs::is_empty(here.folder));
    tf::point_writer rounding(here.folder / "a.ply", file, 2,
                              {.precision = tf::precision::float32});
    block.points[0].x = 0.1;
    rounding.write(block.points, block.properties);
    CHECK(rounding.commit().max_displacement > 0.0);
    CHECK(tf::read(here.folder / "a.ply").mesh.points[0].x ==
          static_cast<double>(static_cast<float>(0.1)));
}

namespace {

/// Quads and triangles, with lists and values, and edges behind them.
const char* const mesh_text =
    "ply\nformat ascii 1.0\ncomment mesh\nelement vertex 5\nproperty double x\nproperty double y\n"
    "property double z\nproperty uchar red\nelement face 4\nproperty short kind\n"
    "property list uchar int vertex_indices\nproperty list uchar float more\nelement none 0\n"
    "property int n\nelement edge 2\nproperty int vertex1\nproperty list uchar int "
    "tags\nend_header\n"
    "0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1 0.5 4\n2 0 0 5\n"
    "7 4 0 1 2 3 2 0.5 0.25\n8 3 1 4 2 0\n-1 3 0 0 1 1 4\n9 5 0 1 4 2 3 0\n4 1 6\n1 0\n";

void copy_by(std::size_t most, const fs::path& from, const fs::path& to, bool ascii,
             bool with_points = true) {
    tf::point_reader reader(from, {}, 0, true);
    tf::point_writer writer(to, reader.header(), reader.count(), {.ascii = ascii}, 5);
    tf::detail::io::point_block points;
    while (with_points && reader.read(points.points, points.properties, most))
        writer.write(points.points, points.properties);
    for (tf::row_block rows; reader.read(rows, most);) writer.write(rows);
    writer.commit();
}

}  // namespace

TEST_CASE("point streams: rows behind the points are those of the file") {
    const stream_folder here;
    const fs::path text = here.put("text.ply", mesh_text);
    tf::mesh_file big = tf::read(text);
    for (const bool ascii : {true, false}) {
        const fs::path whole = here.folder / "whole.ply";
        tf::write(whole, tf::read(text), {.ascii = ascii});
        for (const std::size_t most : {1U, 2U, 3U, 100U}) {
            for (const fs::path& from : {text, whole}) {
                copy_by(most, from, here.folder / "copy.ply", ascii);
                CHECK(bytes_of(here.folder / "copy.ply") == bytes_of(whole));
            }
        }
    }
    big.format = "ply-binary-be";
    tf::write(here.folder / "big.ply", big);
    copy_by(2, here.folder / "big.ply", here.folder / "copy.ply", false);
    CHECK(bytes_of(here.folder / "copy.ply") == bytes_of(here.folder / "big.ply"));
}

TEST_CASE("point streams: of a file in parts, each has some points, and some of the rows behind") {
    const stream_folder here;
    const fs::path text = here.put("text.ply", mesh_text);
    for (const char* const name : {"whole.ply", "whole.obj"}) {
        const fs::path to = here.folder / name;
        tf::write(to, tf::read(text));
        const std::string whole = bytes_of(to);
        std::vector<std::string> points_of;
        std::vector<std::string> rows_of;
        std::string heads;
        for (const std::uint64_t first : {0U, 3U}) {
            tf::point_reader reader(text, {}, first, true);
            const fs::path path = here.folder / (std::string("part") + to.extension().string());
            tf::point_writer writer(path, reader.header(), 5, {}, 5);
            tf::detail::io::point_block points;
            REQUIRE(reader.read(points.points, points.properties, first == 0 ? 3 : 2));
            writer.write(points.points, points.properties);
            tf::row_block rows;
            REQUIRE(reader.read(rows, 3));  // three faces for the first part
            if (first > 0) REQUIRE(reader.read(rows, 3));
            CHECK_THROWS_AS(writer.write(rows), std::invalid_argument);  // points are missing
            const std::uint64_t bytes = writer.end_part();
            CHECK_THROWS_AS(writer.write(points.points, points.properties), std::invalid_argument);
            const std::uint64_t room = first == 0 ? 1000 : 0;
            writer.skip_bytes(room);
            do writer.write(rows);
            while (first > 0 && reader.read(rows, 100));
            tf::write_result result;
            const tf::detail::io::written_part part = writer.commit_part(result);
            const std::string made = bytes_of(path);
            CHECK(part.points == bytes);
            CHECK(made.size() == part.head + part.points + room + part.rows);
            heads = made.substr(0, part.head);
            points_of.push_back(made.substr(part.head, part.points));
            rows_of.push_back(made.substr(part.head + part.points + room));
        }
        CHECK(heads + points_of[0] + points_of[1] + rows_of[0] + rows_of[1] == whole);
    }
    const tf::point_writer ply(here.folder / "b.ply", tf::point_reader(text, {}, 0, true).header(),
                               5, {}, 5);
    CHECK_FALSE(ply.has_shared_values());
    // A part may begin with rows of a later element.
    tf::point_reader reader(text, {}, 5, true);
    tf::point_writer writer(here.folder / "part.ply", reader.header(), 5, {}, 5);
    writer.end_part();
    tf::row_block rows;
    while (reader.read(rows, 100))
        if (rows.rows.name == "edge") writer.write(rows);
    rows.rows.name = "face";
    CHECK_THROWS_AS(writer.write(rows), std::invalid_argument);
}

TEST_CASE("point streams: rows behind the points can be read alone, and are checked") {
    const stream_folder here;
    const fs::path text = here.put("text.ply", mesh_text);
    tf::point_reader reader(text, {}, 5, true);
    CHECK(reader.header().attributes.elements.at(1).rows == 4);
    tf::row_block rows;
    REQUIRE(reader.read(rows, 3));
    CHECK(rows.rows.name == "face");
    CHECK(rows.corners == std::vector<std::uint32_t>{0, 1, 2, 3, 1, 4, 2, 0, 0, 1});
    CHECK(rows.first_corner == std::vector<std::uint64_t>{0, 4, 7, 10});
    REQUIRE(reader.read(rows, 3));
    CHECK(rows.rows.rows == 1);
    REQUIRE(reader.read(rows, 3));
    CHECK(rows.rows.name == "edge");
    CHECK(rows.corners.empty());
    CHECK_FALSE(reader.read(rows, 3));
    CHECK(reader.header().warnings.empty());
    tf::point_reader in_the_middle(text, {}, 2, true);
    REQUIRE(in_the_middle.read(rows, 100));
    CHECK(rows.rows.rows == 4);

    CHECK_THROWS_AS(copy_by(3, text, here.folder / "a.ply", true, false), std::invalid_argument);
    CHECK_THROWS_AS(tf::point_writer(here.folder / "a.xyz", reader.header(), 5), tf::io_error);
    tf::point_writer writer(here.folder / "a.ply", reader.header(), 0);
    rows.rows.rows = 3;
    CHECK_THROWS_AS(writer.write(rows), std::invalid_argument);  // not the corners of each
    rows.rows.name = "edge";
    CHECK_THROWS_AS(writer.write(rows), std::invalid_argument);  // faces are first
    CHECK_THROWS_AS(writer.commit(), tf::io_error);
    const auto put = [&](const std::string& from, const std::string& to) {
        std::string changed = mesh_text;
        changed.replace(changed.find(from), from.size(), to);
        return here.put("changed.ply", changed);
    };
    for (const auto& [from, to] :
         std::vector<std::pair<std::string, std::string>>{{"8 3 1 4 2 0", "8 3 1 5 2 0"},
                                                          {"8 3 1 4 2 0", "8 3 1 -1 2 0"},
                                                          {"8 3 1 4 2 0", "8 3 1 4"},
                                                          {"element edge 2", "element edge 3"},
                                                          {"float more", "float texcoord"},
                                                          {"element edge 2", "element face 2"},
                                                          {"element face 4", "element tristrips 4"},
                                                          {"vertex_indices", "others"}})
        CHECK_THROWS_AS(copy_by(2, put(from, to), here.folder / "b.ply", true), tf::io_error);
    CHECK_FALSE(fs::exists(here.folder / "b.ply"));
    tf::point_reader longer(put("4 1 6\n1 0\n", "4 1 6\n1 0\n5\n"), {}, 0, true);
    while (longer.read(rows, 9)) {
    }
    CHECK(longer.header().warnings.at(0).code == "trailing-bytes");
}
