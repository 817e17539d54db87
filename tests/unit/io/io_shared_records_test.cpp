/// \file
/// Texts that a team looks at: all know of them what one knows who reads them alone.

#include <libmesh/io/point_rows.hpp>
#include <libmesh/stream/rows_in_turn.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>
#include <support/random.hpp>
#include <support/thread_team.hpp>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
namespace io = tf::detail::io;
namespace stream = tf::detail::stream;

/// Points, some of whose lines have what few have: a value more or less, a word, another way to
/// write a number, be it of a coordinate.
std::string odd_lines(std::size_t count, test::random& random) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t odd = random.below(40);
        text += odd == 0 ? "0x1p1 " : odd == 1 ? "# 0x1\n1 " : "1 ";
        text += "2 3";
        if (odd != 2) text += odd < 6 ? " 0x1.8p1" : odd == 6 ? " tree" : odd == 7 ? " 4 5" : " 4";
        text += '\n';
    }
    return text;
}

std::vector<std::optional<io::record_index>> look(const std::vector<fs::path>& paths,
                                                  const tf::communicator& team) {
    const stream::communicator all(team);
    return stream::survey_records(paths, {}, all);
}

/// All that a reader gives from a point on.
std::string read_shared(const fs::path& path, std::uint64_t first, const io::record_index* known) {
    io::point_blocks reader(path, {}, first, io::row_use::none, known);
    std::string all = std::to_string(reader.count());
    tf::detail::io::point_block block;
    while (reader.read(block, 50))
        for (std::size_t i = 0; i < block.points.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) all += ' ' + std::to_string(block.points[i][k]);
            for (const tf::column& c : block.properties.columns)
                if (c.role == tf::column_role::data) all += ' ' + std::to_string(c.number(i));
        }
    for (const tf::io_warning& w : reader.header().warnings) all += w.text;
    return all;
}

}  // namespace

TEST_CASE("shared records: many know of lines what one knows") {
    const test::own_folder own{"io_shared_records"};
    test::random random(3);
    std::size_t uneven = 0;
    std::size_t hexadecimal = 0;
    std::size_t plain = 0;
    for (std::size_t round = 0; round < 60; ++round) {
        std::vector<fs::path> paths;
        for (const char* name : {"a.xyz", "b.xyz"}) {
            paths.push_back(own.path / name);
            const std::size_t count = 1 + random.below(round % 3 == 0 ? 9 : 120);
            std::ofstream(paths.back(), std::ios::binary) << odd_lines(count, random);
        }
        const auto alone = look(paths, {});
        for (std::size_t i = 0; i < paths.size(); ++i) {
            REQUIRE(alone[i].has_value());
            uneven += alone[i]->even ? 0 : 1;
            hexadecimal += alone[i]->hexadecimal ? 1 : 0;
            plain += !alone[i]->even && !alone[i]->hexadecimal ? 1 : 0;
        }
        for (const std::size_t size : {2U, 4U, 7U})
            CHECK(test::run_as_team(size, [&](const tf::communicator& team) {
                const auto shared = look(paths, team);
                for (std::size_t i = 0; i < paths.size(); ++i) {
                    REQUIRE(shared[i].has_value());
                    CHECK(shared[i]->records == alone[i]->records);
                    CHECK(shared[i]->even == alone[i]->even);
                    CHECK(shared[i]->hexadecimal == alone[i]->hexadecimal);
                    const std::uint64_t first = alone[i]->records * team.rank / size;
                    CHECK(read_shared(paths[i], first, &*shared[i]) ==
                          read_shared(paths[i], first, nullptr));
                }
            }));
    }
    CHECK(uneven > 30);
    CHECK(hexadecimal > 30);
    CHECK(plain > 5);
}

TEST_CASE(
    "shared records: behind an uneven line, what is no number is a fault of a coordinate only") {
    const test::own_folder own{"io_shared_records"};
    const fs::path path = own.path / "a.xyz";
    const auto write = [&](const std::string& last) {
        std::string text = "1 2 3 4\n1 2 3\n";
        for (std::size_t i = 0; i < 30; ++i) text += "1 2 3 4\n";
        std::ofstream(path, std::ios::binary) << text + last;
    };
    for (const std::size_t size : {1U, 2U, 4U, 7U})
        CHECK(test::run_as_team(size, [&](const tf::communicator& team) {
            if (team.rank == 0) write("1 2 3 4,5\n1 2 3 1e999999x\n");
            if (size > 1) team.exchange({});
            CHECK(look({path}, team).front().has_value());
            if (size > 1) team.exchange({});
            if (team.rank == 0) write("1 2 tree 4\n");
            if (size > 1) team.exchange({});
            CHECK_FALSE(look({path}, team).front().has_value());
        }));
}

TEST_CASE("shared records: points with lists are found by many, each at its share") {
    const test::own_folder own{"io_shared_records"};
    test::random random(8);
    for (const std::size_t count : {0U, 1U, 700U, 9000U}) {
        std::string bytes =
            "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
            "\nproperty float x\nproperty list uchar uchar views\nproperty float y\n"
            "property float z\nelement face 1\nproperty list uchar uchar vertex_indices\n"
            "end_header\n";
        const std::size_t head = bytes.size();
        std::size_t last_length = 0;
        for (std::size_t i = 0; i < count; ++i) {
            bytes += {0, 0, static_cast<char>(i % 100), 0x42};
            const std::size_t views = random.below(9);
            last_length = bytes.size();
            bytes += static_cast<char>(views);
            bytes += std::string(views + 8, '\1');
        }
        const std::size_t points_end = bytes.size();
        bytes += {3, 0, 0, 0};
        const fs::path path = own.path / "a.ply";
        std::ofstream(path, std::ios::binary) << bytes;
        CHECK_FALSE(look({path}, {}).front().has_value());
        for (const std::size_t size : {2U, 4U, 7U})
            CHECK(test::run_as_team(size, [&](const tf::communicator& team) {
                const auto known = look({path}, team).front();
                REQUIRE(known.has_value());
                CHECK(known->records == count);
                CHECK(known->marks.front().byte == head);
                CHECK(known->marks.back().record == count);
                CHECK(known->marks.back().byte == points_end);
                const std::uint64_t first = count * team.rank / size;
                CHECK(first - known->before(first).record < 20);
                const auto from = [&](const io::record_index* index) {
                    io::point_blocks reader(path, {}, first, io::row_use::copied, index);
                    std::string all;
                    tf::detail::io::point_block block;
                    while (reader.read(block, 64))
                        for (const tf::point3& p : block.points) all += std::to_string(p[0]) + ' ';
                    return all;
                };
                CHECK(from(&*known) == from(nullptr));
                io::point_blocks rows(path, {}, first, io::row_use::copied, &*known);
                CHECK(rows.next_row().byte == points_end);
            }));
        if (count < 9000) continue;
        bytes[last_length] = '\xff';  // more than there is
        std::ofstream(path, std::ios::binary) << bytes.substr(0, points_end);
        CHECK(test::run_as_team(4, [&](const tf::communicator& team) {
            CHECK_FALSE(look({path}, team).front().has_value());
        }));
    }
}
