/// \file
/// Rows behind the points of a file: read from any of them on, and in parts.

#include <libmesh/io/point_rows.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using tf::detail::io::point_blocks;
using tf::detail::io::row_place;
using tf::detail::io::row_use;

/// Triangles, edges behind them, as bytes; STL has triangles only.
tf::mesh_file triangles_and_edges(std::uint32_t count) {
    tf::mesh_file file;
    for (std::uint32_t i = 0; i < count + 2; ++i)
        file.mesh.points.push_back({0.5 * i, static_cast<double>(i % 7), 1.0});
    for (std::uint32_t i = 0; i < count; ++i) file.mesh.faces.push_back({i, i + 1, i + 2});
    std::vector<std::int32_t> ends;
    for (std::uint32_t i = 0; i < count / 2; ++i) ends.push_back(static_cast<std::int32_t>(i));
    tf::element& edges = file.attributes.find_or_add("edge", ends.size());
    edges.set(tf::column::of<std::int32_t>("vertex1", ends));
    return file;
}

/// All rows: the name of the element, the corners, and bytes of columns, one after the other.
std::string rows_from(point_blocks& reader, std::uint64_t count, std::size_t most) {
    std::string all;
    tf::row_block block;
    while (count > 0 && reader.read(block, std::min<std::uint64_t>(count, most))) {
        count -= block.rows.rows;
        for (std::size_t r = 0; r < block.rows.rows; ++r) {
            all += block.rows.name;
            for (std::uint64_t c = block.corners.empty() ? 0 : block.first_corner[r];
                 !block.corners.empty() && c < block.first_corner[r + 1]; ++c)
                all += ' ' + std::to_string(block.corners[c]);
            for (const tf::column& c : block.rows.columns)
                if (c.role == tf::column_role::data && !c.list_length)
                    all += ' ' + std::to_string(c.number(r));
            all += '\n';
        }
    }
    return all;
}

}  // namespace

TEST_CASE("row parts: rows behind the points are read from any place, and in alike parts") {
    const test::own_folder own{"io_row_parts"};
    const fs::path stl = own.path / "a.stl";
    const fs::path binary = own.path / "a.ply";
    const fs::path text = own.path / "text.ply";
    tf::mesh_file file = triangles_and_edges(300);
    tf::write(binary, file);
    tf::write(text, file, {.ascii = true});
    tf::write(stl, file);
    constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
    for (const fs::path& path : {stl, binary, text}) {
        CAPTURE(path);
        point_blocks front(path, {}, 0, row_use::copied);
        std::vector<row_place> places{front.next_row()};
        CHECK(places[0].row == 0);
        std::string whole;
        while (true) {
            const std::string some = rows_from(front, 7, 7);
            if (some.empty()) break;
            whole += some;
            places.push_back(front.next_row());
        }
        CHECK(places.back().row == (path == stl ? 300 : 450));
        CHECK(places.back().byte == fs::file_size(path));
        for (const row_place& place : places) {
            point_blocks reader(path, {}, 0, row_use::copied);
            reader.go_to(place);
            CHECK(whole.ends_with(rows_from(reader, all, 100)));
            const bool at_end = place.row == places.back().row;
            reader.go_to(place);
            CHECK(rows_from(reader, 1, 1).empty() == at_end);
        }
        for (const std::size_t count : {1U, 4U, 7U, 1000U}) {
            point_blocks reader(path, {}, 0, row_use::copied);
            const std::vector<row_place> parts = reader.row_parts(count);
            CHECK(parts.empty() == (path == text));
            if (parts.empty()) continue;
            REQUIRE(parts.size() == count + 1);
            CHECK(parts.front().byte == places.front().byte);
            CHECK(parts.back().byte == places.back().byte);
            std::string joined;
            for (std::size_t p = 0; p < count; ++p) {
                const std::uint64_t bytes = parts[p + 1].byte - parts[p].byte;
                CHECK(bytes * count <= parts.back().byte - parts.front().byte + 50 * count);
                reader.go_to(parts[p]);
                joined += rows_from(reader, parts[p + 1].row - parts[p].row, 100);
            }
            CHECK(joined == whole);
        }
    }
}

TEST_CASE("row parts: parts of rows that cannot be alike, or are not, are not taken for such") {
    const test::own_folder own{"io_row_parts"};
    const auto polygons = [&](const std::vector<std::uint32_t>& lengths, const std::string& more) {
        std::string bytes =
            "ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty float x\n"
            "property float y\nproperty float z\nelement face " +
            std::to_string(lengths.size()) +
            "\nproperty list uchar uchar vertex_indices\nend_header\n" + std::string(108, '\0');
        for (const std::uint32_t n : lengths) {
            bytes += static_cast<char>(n);
            for (std::uint32_t i = 0; i < n; ++i) bytes += static_cast<char>(i);
        }
        std::ofstream(own.path / "a.ply", std::ios::binary) << bytes << more;
        return own.path / "a.ply";
    };
    tf::row_block block;
    point_blocks alike(polygons({4, 4, 4}, ""), {}, 0, row_use::copied);
    CHECK(alike.row_parts(3).size() == 4);
    REQUIRE(alike.read(block, 9));
    CHECK(block.rows.rows == 3);
    for (const fs::path& path : {polygons({4, 3, 4}, ""), polygons({4, 4, 4}, "more")}) {
        point_blocks mixed(path, {}, 0, row_use::copied);
        CHECK(mixed.row_parts(3).empty());
        CHECK(mixed.read(block, 9));
    }
    point_blocks same_size(polygons({4, 3, 5}, ""), {}, 0, row_use::copied);
    const auto parts = same_size.row_parts(3);
    REQUIRE(parts.size() == 4);
    CHECK_THROWS_AS(same_size.read(block, 9), tf::io_error);
    point_blocks front(polygons({4, 3, 5}, ""), {}, 0, row_use::copied);
    REQUIRE(front.read(block, 9));
    CHECK(block.rows.rows == 3);
}
