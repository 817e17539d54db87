#include <libmesh/stream/edge_files.hpp>
#include <libmesh/stream/paged_file.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>
#include <support/random.hpp>
#include <support/thread_team.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;
namespace stream = tf::detail::stream;

std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A sheet of quads and triangles, each with corners of its own, and a color of its own per corner.
tf::mesh_file soup(std::uint32_t n) {
    test::random random(5);
    tf::mesh_file file;
    std::vector<std::uint8_t> red;
    std::vector<std::uint16_t> number;
    const auto corner = [&](std::uint32_t i, std::uint32_t j) {
        file.mesh.points.push_back({i + 0.01 * random.unit(), j + 0.01 * random.unit(), 0.0});
        red.push_back(random.unit() < 0.9 ? 5 : 6);
    };
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const auto first = static_cast<std::uint32_t>(file.mesh.points.size());
            corner(i, j);
            corner(i + 1, j);
            corner(i + 1, j + 1);
            file.mesh.faces.push_back({first, first + 1, first + 2});
            file.stored_face.push_back(static_cast<std::uint32_t>(number.size()));
            if ((i + j) % 2 == 0) {
                corner(i, j + 1);
                file.mesh.faces.push_back({first, first + 2, first + 3});
                file.stored_face.push_back(static_cast<std::uint32_t>(number.size()));
            }
            number.push_back(static_cast<std::uint16_t>(number.size()));
        }
    file.stored_faces = number.size();
    tf::element& vertices = tf::obtain_element(file.attributes, "vertex", file.mesh.points.size());
    tf::set_column(vertices, tf::make_column<std::uint8_t>("red", red));
    tf::element& faces = tf::obtain_element(file.attributes, "face", number.size());
    tf::set_column(faces, tf::make_column<std::uint16_t>("number", number));
    return file;
}

}  // namespace

TEST_CASE("mesh tiles: the file that weld of all of it would give") {
    const test::own_folder here("mesh_tiles");
    const fs::path in = here.path / "in.ply";
    tf::write(in, soup(30));
    for (const bool seams : {false, true})
        for (const double tolerance : {0.0, 0.05, 1.5})
            for (const bool keep_degenerate : {false, true}) {
                const tf::file_weld_result whole =
                    tf::weld(tf::read(in), {.tolerance = tolerance,
                                            .keep_seams = seams,
                                            .keep_degenerate = keep_degenerate});
                tf::write(here.path / "whole.ply", whole.file);
                tf::weld_stream_options options;
                options.tolerance = tolerance;
                options.keep_seams = seams;
                options.keep_degenerate = keep_degenerate;
                options.points_per_tile = 500;
                const tf::weld_stream_result made =
                    tf::weld_stream(in, here.path / "tiles.ply", options);
                CHECK(bytes_of(here.path / "tiles.ply") == bytes_of(here.path / "whole.ply"));
                CHECK(made.survey.tiles > 1);
                CHECK(made.survey.faces == 900);
                CHECK(made.survey.triangles == 1350);
                const tf::weld_stream_counts& c = made.counts;
                const tf::weld_statistics& s = whole.statistics;
                CHECK(c.kept == whole.file.mesh.points.size());
                CHECK(c.triangles == whole.file.mesh.faces.size());
                CHECK(c.faces == whole.file.stored_faces);
                CHECK(c.collapsed == s.collapsed);
                CHECK(c.degenerate == s.degenerate);
                CHECK(c.flipped == s.flipped);
                CHECK(c.nonmanifold_before == s.nonmanifold_before);
                CHECK(c.nonmanifold_after == s.nonmanifold_after);
                CHECK(fs::exists(here.path / "in.ply.tiles") == false);
            }
}

TEST_CASE("mesh tiles: what is not written in tiles, and who does not") {
    const test::own_folder here("mesh_tiles_refused");
    const fs::path in = here.path / "in.ply";
    tf::write(in, soup(5));
    const tf::cloud_outline outline = tf::outline({.paths = {in}});
    CHECK(outline.has_rows);
    CHECK(tf::find_element(outline.header.attributes, "face")->rows == 25);
    CHECK_THROWS_AS(static_cast<void>(tf::outline({.paths = {in, in}})), tf::io_error);
    CHECK_THROWS_AS(tf::weld_stream(in, here.path / "out.xyz", {}), tf::io_error);
    CHECK_FALSE(fs::exists(here.path / "out.xyz"));
}

TEST_CASE("mesh tiles: any number of processes write what one writes, and know what it knows") {
    const test::own_folder here("mesh_tiles_team");
    const fs::path in = here.path / "in.ply";
    tf::write(in, soup(20));
    for (const tf::weld_keep keep : {tf::weld_keep::first, tf::weld_keep::mean})
        for (const double tolerance : {0.0, 0.05, 1.5}) {
            tf::weld_stream_options options;
            options.tolerance = tolerance;
            options.keep = keep;
            options.points_per_tile = 200;
            const tf::weld_stream_result one = tf::weld_stream(in, here.path / "one.ply", options);
            const std::string expected = bytes_of(here.path / "one.ply");
            for (const std::size_t size : {2U, 4U, 7U}) {
                std::vector<tf::weld_stream_result> made(size);
                CHECK(test::run_as_team(size, [&](const tf::process_team& team) {
                    tf::weld_stream_options mine = options;
                    mine.team = team;
                    made[team.rank] = tf::weld_stream(in, here.path / "team.ply", mine);
                }));
                CHECK(bytes_of(here.path / "team.ply") == expected);
                for (const tf::weld_stream_result& r : made) {
                    const auto known = [](const tf::weld_stream_result& of) {
                        const tf::weld_stream_counts& c = of.counts;
                        return std::vector<std::uint64_t>{of.survey.faces,
                                                          of.survey.triangles,
                                                          c.kept,
                                                          c.groups,
                                                          c.faces,
                                                          c.triangles,
                                                          c.collapsed,
                                                          c.degenerate,
                                                          c.flipped,
                                                          c.nonmanifold_before,
                                                          c.nonmanifold_after,
                                                          of.written.still_within.value()};
                    };
                    CHECK(known(r) == known(one));
                    CHECK(r.counts.max_displacement == one.counts.max_displacement);
                }
                CHECK_FALSE(fs::exists(here.path / "in.ply.tiles"));
            }
        }
}

TEST_CASE("edge files: edges of more than two faces, with little memory") {
    const test::own_folder here("edge_files");
    const stream::work_folder folder(here.path / "work", "test");
    stream::pacer pace({});
    test::random random(2);
    for (const std::uint32_t points : {3U, 40U, 2000U}) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
        constexpr std::size_t count = 60000;
        stream::edge_files<stream::numbered_edge> files(folder, "edges", count, 1);
        for (std::size_t i = 0; i < count; ++i) {
            const auto a = static_cast<std::uint32_t>(random.unit() * points);
            const auto b =
                (a + 1 + static_cast<std::uint32_t>(random.unit() * (points - 1))) % points;
            files.put(stream::edge_between(a, b));
            ++uses[std::minmax(a, b)];
        }
        std::uint64_t expected = 0;
        for (const auto& [edge, n] : uses) expected += n > 2 ? 1 : 0;
        CHECK(files.count_nonmanifold(pace) == expected);
    }
}

TEST_CASE("paged files: any record in any order, and a file that was cut") {
    const test::own_folder here("paged_files");
    const fs::path path = here.path / "numbers";
    constexpr std::uint64_t count = 100001;
    stream::record_writer<std::uint64_t> writer(path, 1000);
    for (std::uint64_t i = 0; i < count; ++i) writer.put(3 * i);
    CHECK(writer.finish_unsynced().records == count);
    test::random random(4);
    for (const std::uint64_t memory : {std::uint64_t{1}, std::uint64_t{1} << 30}) {
        stream::paged_file<std::uint64_t> file(path, count, memory);
        bool same = file.at(count - 1) == 3 * (count - 1);
        for (int i = 0; i < 20000; ++i) {
            const auto at = static_cast<std::uint64_t>(random.unit() * count);
            same = same && file.at(at) == 3 * at;
        }
        CHECK(same);
    }
    fs::resize_file(path, 8 * 50000);
    stream::paged_file<std::uint64_t> cut(path, count, 1);
    CHECK(cut.at(3) == 9);
    CHECK_THROWS_AS(static_cast<void>(cut.at(60000)), tf::stream_error);
}
