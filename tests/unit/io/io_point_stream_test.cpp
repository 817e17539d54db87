#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>
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
struct scratch {
    [[nodiscard]] fs::path put(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return folder / name;
    }
    const test::own_folder own{"io_point_stream"};
    const fs::path& folder = own.path;
};

std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

bool same_bits(const std::vector<tf::point3>& a, const std::vector<tf::point3>& b) {
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
    const bool has_columns = tf::find_element(file.attributes, "vertex") != nullptr;
    tf::element& vertices = has_columns ? tf::obtain_element(file.attributes, "vertex", 0) : none;
    for (tf::column& c : vertices.columns)
        if (c.list_length) c.list_begin.assign(1, 0);
    tf::point_block block;
    while (reader.read(block, most)) {
        CHECK(block.points.size() <= most);
        REQUIRE(block.properties.rows == block.points.size());
        REQUIRE(block.properties.columns.size() == vertices.columns.size());
        file.mesh.points.insert(file.mesh.points.end(), block.points.begin(), block.points.end());
        for (std::size_t c = 0; c < vertices.columns.size(); ++c)
            append(vertices.columns[c], block.properties.columns[c]);
        vertices.rows += block.properties.rows;
    }
    CHECK(block.points.empty());
    CHECK_FALSE(reader.read(block, most));
    CHECK(reader.count() == file.mesh.points.size());
    file.warnings = reader.header().warnings;
    return file;
}

/// Points as a cloud has them: with properties of several types, NaN here and there.
tf::mesh_file cloud(std::size_t count, bool single) {
    std::mt19937_64 random(count);
    tf::mesh_file file;
    file.stored_as = single ? tf::precision::float32 : tf::precision::float64;
    std::vector<float> intensity;
    std::vector<std::uint8_t> red;
    std::vector<std::int32_t> id;
    for (std::size_t i = 0; i < count; ++i) {
        tf::point3 p;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = static_cast<double>(random() >> 11) * 0x1p-40 - 4000.0;
            p[axis] = single ? static_cast<double>(static_cast<float>(x)) : x;
        }
        file.mesh.points.push_back(p);
        intensity.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
        red.push_back(static_cast<std::uint8_t>(random()));
        id.push_back(static_cast<std::int32_t>(random()));
    }
    tf::element& e = tf::obtain_element(file.attributes, "vertex", count);
    e.columns.push_back(tf::make_column<float>("intensity", intensity));
    e.columns.push_back(tf::make_column<std::uint8_t>("red", red));
    e.columns.push_back(tf::make_column<std::int32_t>("id", id));
    file.attributes.comments = {"a cloud"};
    file.attributes.texture_files = {"a.png"};
    return file;
}

struct kind {
    const char* format;
    bool ascii;
    const char* read_as;  ///< for the byte order of PLY, and for compression
};

constexpr kind kinds[] = {
    {"ply", true, ""},  {"ply", false, ""}, {"ply", false, "ply-binary-be"},
    {"pcd", true, ""},  {"pcd", false, ""}, {"pcd", false, "pcd-binary-compressed"},
    {"csv", false, ""}, {"xyz", false, ""}};

}  // namespace

TEST_CASE("point streams: blocks of any size are what the whole file is") {
    const scratch here;
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
            CHECK(same_bits(whole.mesh.points, file.mesh.points));
            for (const std::size_t most : std::vector<std::size_t>{1, 7, 1000, 1 << 20}) {
                const tf::mesh_file parts = read_by(most, path);
                CHECK(same_bits(parts.mesh.points, whole.mesh.points));
                CHECK(parts.attributes == whole.attributes);
                CHECK(parts.format == whole.format);
            }
        }
}

TEST_CASE("point streams: blocks written one by one are the bytes of the whole file") {
    const scratch here;
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
                        tf::point_block block;
                        for (std::size_t i = first; i < std::min(count, first + most); ++i) {
                            rows.push_back(static_cast<std::uint32_t>(i));
                            block.points.push_back(file.mesh.points[i]);
                        }
                        block.properties = tf::gather(file.attributes.elements[0], rows);
                        writer.write(block);
                    }
                    const tf::write_result result = writer.commit();
                    CHECK(bytes_of(path) == expected);
                    CHECK(result.written_as == file.stored_as);
                }
            }
}

TEST_CASE("point streams: what follows the first points is the rest of the file") {
    const scratch here;
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
            tf::point_block block;
            for (std::size_t i = first; i < 700; i += block.points.size()) {
                REQUIRE(reader.read(block, 100));
                CHECK(same_bits(block.points, {whole.mesh.points.begin() + std::ptrdiff_t(i),
                                               whole.mesh.points.begin() +
                                                   std::ptrdiff_t(i + block.points.size())}));
            }
            CHECK_FALSE(reader.read(block, 100));
        }
    }
}

TEST_CASE("point streams: parts written by several, put one after the other, are the whole file") {
    const scratch here;
    for (const kind& k : kinds) {
        CAPTURE(k.format);
        CAPTURE(k.ascii);
        tf::mesh_file file = cloud(700, true);
        file.format = k.read_as;
        const tf::write_options options{.format = k.format, .ascii = k.ascii};
        std::string bytes;
        std::vector<std::string> heads;
        std::vector<std::uint32_t> rows;
        tf::point_block block;
        for (std::uint32_t i = 0; i < 700; ++i) {
            rows.push_back(i);
            block.points.push_back(file.mesh.points[i]);
            if (i != 250 && i != 699) continue;
            block.properties = tf::gather(file.attributes.elements[0], rows);
            tf::point_writer writer(here.folder / "part", file, 700, options);
            writer.write(block);
            tf::write_result result;
            REQUIRE(writer.has_parts());
            if (writer.has_shared_values()) {
                CHECK_THROWS_AS(writer.commit_part(result), std::logic_error);
                break;
            }
            const auto [head, points, behind] = writer.commit_part(result);
            CHECK(behind == 0);
            const std::string part = bytes_of(here.folder / "part");
            heads.push_back(part.substr(0, head));
            bytes += i == 250 ? part.substr(head, points) : part.substr(head);
            rows.clear();
            block = {};
        }
        const bool is_packed = std::string_view(k.read_as) == "pcd-binary-compressed";
        if (!is_packed) bytes = tf::point_writer::join_heads(heads) + bytes;
        CHECK(bytes == (is_packed ? "" : tf::write_to_memory(file, options)));
    }
}

TEST_CASE("point streams: parts of a compressed PCD share their values, and pack a share each") {
    const scratch here;
    // Values of 33 bytes a point: up to six blocks, which no field and no part begins with.
    for (const std::size_t count : std::vector<std::size_t>{0, 1, 5, 36'000, 180'000}) {
        CAPTURE(count);
        tf::mesh_file file = cloud(count, false);
        file.format = "pcd-binary-compressed";
        const tf::write_options options{.format = "pcd"};
        const std::string expected = tf::write_to_memory(file, options);
        for (const std::size_t parts : {1U, 3U, 8U}) {
            CAPTURE(parts);
            std::string values;
            std::vector<tf::point_writer> writers;
            std::uint64_t first = 0;
            for (std::size_t part = 0; part < parts; ++part) {
                const auto number = std::to_string(part);
                tf::point_writer& writer =
                    writers.emplace_back(here.folder / number, file, count, options);
                REQUIRE(writer.has_shared_values());
                writer.share_values(
                    {.first_point = first,
                     .part = part,
                     .parts = parts,
                     .put =
                         [&](std::uint64_t at, std::span<const std::byte> bytes) {
                             values.resize(std::max(values.size(), at + bytes.size()));
                             if (!bytes.empty())
                                 std::memcpy(values.data() + at, bytes.data(), bytes.size());
                         },
                     .get =
                         [&](std::uint64_t at, std::span<std::byte> bytes) {
                             REQUIRE(at + bytes.size() <= values.size());
                             std::memcpy(bytes.data(), values.data() + at, bytes.size());
                         }});
                const std::size_t end = part + 1 == parts ? count : count * part / (parts + 3);
                while (first < end) {  // the first one has none, the last one many
                    tf::point_block block;
                    std::vector<std::uint32_t> rows;
                    for (; first < end && rows.size() < 5000; ++first) {
                        rows.push_back(static_cast<std::uint32_t>(first));
                        block.points.push_back(file.mesh.points[first]);
                    }
                    block.properties = tf::gather(file.attributes.elements[0], rows);
                    writer.write(block);
                }
            }
            std::string bytes;
            std::vector<std::string> heads;
            std::size_t most = 0;
            for (std::size_t part = 0; part < parts; ++part) {
                tf::write_result result;
                const auto [head, points, behind] = writers[part].commit_part(result);
                CHECK(behind == 0);
                const std::string written = bytes_of(here.folder / std::to_string(part));
                REQUIRE(written.size() == head + points);
                heads.push_back(written.substr(0, head));
                bytes += written.substr(head);
                most = std::max(most, written.size());
            }
            CHECK((tf::point_writer::join_heads(heads) + bytes == expected));
            if (count == 180'000 && parts == 3) CHECK(most < expected.size() / 2);
        }
    }
}

TEST_CASE("point streams: a shared place is refused where it is of no use, and has its own end") {
    const scratch here;
    tf::mesh_file file = cloud(3, false);
    const tf::point_block all{.points = file.mesh.points,
                              .properties = file.attributes.elements[0]};
    tf::point_writer plain(here.folder / "a.pcd", file, 3);
    CHECK_FALSE(plain.has_shared_values());
    CHECK_THROWS_AS(plain.share_values({}), std::logic_error);
    file.format = "pcd-binary-compressed";
    tf::point_writer late(here.folder / "b.pcd", file, 3);
    late.write(all);
    CHECK_THROWS_AS(late.share_values({}), std::logic_error);
    tf::point_writer part(here.folder / "c.pcd", file, 3);
    part.share_values({.put = [](std::uint64_t, auto) {}, .get = [](std::uint64_t, auto) {}});
    part.write(all);
    CHECK_THROWS_AS(static_cast<void>(part.commit()), std::logic_error);
    CHECK_FALSE(fs::exists(here.folder / "c.pcd"));
}

TEST_CASE("point streams: whether points are too many to be compressed, all of them say") {
    const scratch here;
    tf::mesh_file file = cloud(1, false);
    file.format = "pcd-binary-compressed";
    // 33 bytes a point; packed, at worst a byte more for each 32, and one.
    constexpr std::uint64_t most = (std::uint64_t{1} << 32) / 33 * 32 / 33;
    for (const std::uint64_t count : {most - 10, most + 10}) {
        tf::point_writer writer(here.folder / "a.pcd", file, count, {});
        CHECK(writer.has_parts());
        CHECK(writer.has_shared_values() == (count < most));
        if (!writer.has_shared_values()) {
            tf::write_result result;
            static_cast<void>(writer.commit_part(result));
            CHECK(result.format == "pcd-binary");
            REQUIRE(result.warnings.size() == 1);
            CHECK(result.warnings[0].text == "too many points to be compressed");
        }
    }
}

TEST_CASE("point streams: lists and rows without coordinates alone pass through") {
    const scratch here;
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
        tf::point_writer writer(here.folder / "c.ply", reader.header(), *reader.count(),
                                {.ascii = ascii});
        tf::point_block block;
        while (reader.read(block, 2)) writer.write(block);
        (void)writer.commit();
        CHECK(bytes_of(here.folder / "c.ply") == bytes);
    }
}

TEST_CASE("point streams: uneven lines of text lose their further values from the first block on") {
    const scratch here;
    const fs::path path = here.put("a.xyz", "1 2 3 4\n1 2 3 4\n1 2 3\n");
    const tf::mesh_file parts = read_by(1, path);
    CHECK(parts.mesh.points.size() == 3);
    CHECK(parts.attributes == tf::read(path).attributes);
    CHECK(parts.warnings.at(0).code == "columns");
}

TEST_CASE("point streams: a pipe is read as its file is, more than once where it must be") {
    const scratch here;
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
        CHECK(same_bits(parts.mesh.points, file.mesh.points));
    }
}

TEST_CASE("point streams: what is no file of points is refused") {
    const scratch here;
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
    tf::point_block block;
    CHECK_THROWS_AS(cut.read(block, 10), tf::io_error);
    CHECK_THROWS_AS(tf::point_writer(here.folder / "a.off", {}, 0), tf::io_error);
    CHECK_THROWS_AS(tf::point_writer(here.folder / "a.stl", {}, 0), tf::io_error);
}

TEST_CASE("point streams: a writer takes what was announced, and leaves nothing without commit") {
    const scratch here;
    const tf::mesh_file file = cloud(2, true);
    tf::point_block block{.points = file.mesh.points, .properties = file.attributes.elements[0]};
    {
        tf::point_writer writer(here.folder / "a.ply", file, 3);
        writer.write(block);
        CHECK_THROWS_AS(writer.write(block), std::invalid_argument);
        CHECK_THROWS_AS(writer.commit(), tf::io_error);
    }
    {
        tf::point_writer writer(here.folder / "a.ply", file, 2);
        tf::point_block other = block;
        other.properties.columns.pop_back();
        CHECK_THROWS_AS(writer.write(other), std::invalid_argument);
        other = block;
        other.properties.rows = 1;
        CHECK_THROWS_AS(writer.write(other), std::invalid_argument);
        other = block;
        other.points[0].x = 0.1;  // no float32, as the header promises
        CHECK_THROWS_AS(writer.write(other), std::invalid_argument);
    }
    CHECK(fs::is_empty(here.folder));
    tf::point_writer rounding(here.folder / "a.ply", file, 2,
                              {.precision = tf::precision::float32});
    block.points[0].x = 0.1;
    rounding.write(block);
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
    tf::point_writer writer(to, reader.header(), *reader.count(), {.ascii = ascii}, 5);
    tf::point_block points;
    while (with_points && reader.read(points, most)) writer.write(points);
    for (tf::row_block rows; reader.read(rows, most);) writer.write(rows);
    writer.commit();
}

}  // namespace

TEST_CASE("point streams: rows behind the points are those of the file") {
    const scratch here;
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
    const scratch here;
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
            tf::point_block points;
            REQUIRE(reader.read(points, first == 0 ? 3 : 2));
            writer.write(points);
            tf::row_block rows;
            REQUIRE(reader.read(rows, 3));  // three faces for the first part
            if (first > 0) REQUIRE(reader.read(rows, 3));
            CHECK_THROWS_AS(writer.write(rows), std::invalid_argument);  // points are missing
            const std::uint64_t bytes = writer.end_part();
            CHECK_THROWS_AS(writer.write(points), std::invalid_argument);
            const std::uint64_t room = first == 0 ? 1000 : 0;
            writer.leave_room(room);
            do writer.write(rows);
            while (first > 0 && reader.read(rows, 100));
            tf::write_result result;
            const tf::point_writer::part part = writer.commit_part(result);
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
    const scratch here;
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
                                                          {"8 3 1 4 2 0", "8 2 1 4 0"},
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
