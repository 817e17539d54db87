/// \file
/// Files of points of which several write a part each.

#include <libmesh/io/point_rows.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>
#include <support/point_files.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::cloud;
using test::kind;
using test::kinds;

struct parts_folder {
    const test::own_folder own{"io_point_parts"};
    const fs::path& folder = own.path;
};

}  // namespace

TEST_CASE("point parts: parts written by several, put one after the other, are the whole file") {
    const parts_folder here;
    for (const kind& k : kinds) {
        CAPTURE(k.format);
        CAPTURE(k.ascii);
        tf::mesh_file file = cloud(700, true);
        file.format = k.read_as;
        const tf::write_options options{.format = k.format, .ascii = k.ascii};
        std::string bytes;
        std::vector<std::string> heads;
        std::vector<std::uint32_t> rows;
        tf::detail::io::point_block block;
        for (std::uint32_t i = 0; i < 700; ++i) {
            rows.push_back(i);
            block.points.push_back(file.mesh.points[i]);
            if (i != 250 && i != 699) continue;
            block.properties = file.attributes.elements[0].gathered(rows);
            tf::point_writer writer(here.folder / "part", file, 700, options);
            writer.write(block.points, block.properties);
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

TEST_CASE("point parts: parts of a compressed PCD share their values, and pack a share each") {
    const parts_folder here;
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
                    tf::detail::io::point_block block;
                    std::vector<std::uint32_t> rows;
                    for (; first < end && rows.size() < 5000; ++first) {
                        rows.push_back(static_cast<std::uint32_t>(first));
                        block.points.push_back(file.mesh.points[first]);
                    }
                    block.properties = file.attributes.elements[0].gathered(rows);
                    writer.write(block.points, block.properties);
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

TEST_CASE("point parts: a shared place is refused where it is of no use, and has its own end") {
    const parts_folder here;
    tf::mesh_file file = cloud(3, false);
    const tf::detail::io::point_block all{.points = file.mesh.points,
                                          .properties = file.attributes.elements[0]};
    tf::point_writer plain(here.folder / "a.pcd", file, 3);
    CHECK_FALSE(plain.has_shared_values());
    CHECK_THROWS_AS(plain.share_values({}), std::logic_error);
    file.format = "pcd-binary-compressed";
    tf::point_writer late(here.folder / "b.pcd", file, 3);
    late.write(all.points, all.properties);
    CHECK_THROWS_AS(late.share_values({}), std::logic_error);
    tf::point_writer part(here.folder / "c.pcd", file, 3);
    part.share_values({.put = [](std::uint64_t, auto) {}, .get = [](std::uint64_t, auto) {}});
    part.write(all.points, all.properties);
    CHECK_THROWS_AS(static_cast<void>(part.commit()), std::logic_error);
    CHECK_FALSE(fs::exists(here.folder / "c.pcd"));
}

TEST_CASE("point parts: whether points are too many to be compressed, all of them say") {
    const parts_folder here;
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
            REQUIRE_FALSE(result.warnings.empty());
            CHECK(result.warnings[0].text ==
                  "too many points for compression; written uncompressed");
        }
    }
}
