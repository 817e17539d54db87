#include <libmesh/stream/edge_files.hpp>
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
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;
namespace stream = tf::detail::stream;

using test::bytes_of;

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
            file.face_of_triangle.push_back(static_cast<std::uint32_t>(number.size()));
            if ((i + j) % 2 == 0) {
                corner(i, j + 1);
                file.mesh.faces.push_back({first, first + 2, first + 3});
                file.face_of_triangle.push_back(static_cast<std::uint32_t>(number.size()));
            }
            number.push_back(static_cast<std::uint16_t>(number.size()));
        }
    file.stored_faces = number.size();
    tf::element& vertices = file.attributes.find_or_add("vertex", file.mesh.points.size());
    vertices.set(tf::column::of<std::uint8_t>("red", red));
    tf::element& faces = file.attributes.find_or_add("face", number.size());
    faces.set(tf::column::of<std::uint16_t>("number", number));
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
                const tf::weld_statistics& c = made.statistics;
                const tf::weld_statistics& s = whole.statistics;
                CHECK(made.kept == whole.file.mesh.points.size());
                CHECK(made.triangles == whole.file.mesh.faces.size());
                CHECK(made.faces == whole.file.stored_faces);
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
    const tf::mesh_file header = tf::cloud_inputs{.paths = {in}}.outline();
    CHECK(header.attributes.find("vertex")->rows == soup(5).mesh.points.size());
    CHECK(header.attributes.find("face")->rows == 25);
    CHECK_THROWS_AS(static_cast<void>(tf::cloud_inputs{.paths = {in, in}}.outline()), tf::io_error);
    CHECK_THROWS_AS(tf::weld_stream(in, here.path / "out.xyz", {}), tf::io_error);
    CHECK_FALSE(fs::exists(here.path / "out.xyz"));
}

namespace {

/// What is known of a weld.
std::vector<std::uint64_t> known(const tf::weld_stream_result& of) {
    const tf::weld_statistics& c = of.statistics;
    return {of.survey.faces,     of.survey.triangles, of.kept,      c.groups,  of.faces,
            of.triangles,        c.collapsed,         c.degenerate, c.flipped, c.nonmanifold_before,
            c.nonmanifold_after, of.mergeable.value()};
}

/// Whether teams write the bytes that one writes, and know what it knows.
void check_teams(const fs::path& in, const fs::path& out, const tf::weld_stream_options& options) {
    const tf::weld_stream_result one = tf::weld_stream(in, out, options);
    const std::string expected = bytes_of(out);
    for (const std::size_t size : {2U, 4U, 7U}) {
        CAPTURE(size);
        std::vector<tf::weld_stream_result> made(size);
        CHECK(test::run_as_team(size, [&](const tf::communicator& team) {
            tf::weld_stream_options mine = options;
            mine.communicator = team;
            made[team.rank] = tf::weld_stream(in, out, mine);
        }));
        CHECK(bytes_of(out) == expected);
        for (const tf::weld_stream_result& r : made) {
            CHECK(known(r) == known(one));
            CHECK(r.statistics.max_displacement == one.statistics.max_displacement);
            CHECK(r.survey.warnings.size() == one.survey.warnings.size());
        }
        CHECK_FALSE(fs::exists(in.string() + ".tiles"));
    }
}

/// The soup in triangles, with each edge of some of them three times, one without an area, and
/// edges of the file behind them.
tf::mesh_file triangles() {
    tf::mesh_file file = soup(16);
    file.face_of_triangle.clear();
    file.attributes.elements.pop_back();
    for (std::uint32_t i = 0; i < 40; ++i) {
        file.mesh.faces.push_back(file.mesh.faces[3 * i]);
        file.mesh.faces.push_back(file.mesh.faces[3 * i]);
    }
    file.mesh.faces.push_back({5, 5, 6});
    file.stored_faces = file.mesh.faces.size();
    std::vector<std::int32_t> ends;
    for (std::int32_t i = 0; i < 300; ++i) ends.push_back(i);
    tf::element& edges = file.attributes.find_or_add("edge", ends.size());
    edges.set(tf::column::of<std::int32_t>("vertex1", ends));
    return file;
}

}  // namespace

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
            check_teams(in, here.path / "out.ply", options);
        }
}

TEST_CASE("mesh tiles: faces of one length, text, facets of STL and OBJ are shared out as well") {
    const test::own_folder here("mesh_tiles_formats");
    const tf::mesh_file file = triangles();
    tf::write(here.path / "alike.ply", file);
    tf::write(here.path / "text.ply", file, {.ascii = true});
    tf::mesh_file facets = file;
    facets.mesh.faces.erase(facets.mesh.faces.begin());
    facets.attributes = {};
    tf::write(here.path / "in.stl", facets);
    std::ofstream(here.path / "more.ply", std::ios::binary)
        << bytes_of(here.path / "alike.ply") << "more";
    for (const char* const name : {"alike.ply", "text.ply", "in.stl", "more.ply"})
        for (const char* const out : {"out.ply", "out.obj"})
            for (const double tolerance : {0.0, 0.05}) {
                CAPTURE(name);
                CAPTURE(out);
                tf::weld_stream_options options;
                options.tolerance = tolerance;
                options.chain = true;
                options.points_per_tile = 200;
                check_teams(here.path / name, here.path / out, options);
            }
}

TEST_CASE("mesh tiles: a damaged face is told of as by one, whoever reads it") {
    const test::own_folder here("mesh_tiles_damaged");
    const fs::path path = here.path / "in.ply";
    tf::mesh_file file = triangles();
    file.attributes.elements.pop_back();
    tf::write(path, file);
    const std::string whole = bytes_of(path);
    const std::size_t first = whole.size() - 13 * file.mesh.faces.size();
    const auto error_of = [&](std::size_t size) -> std::string {
        try {
            test::run_as_team(size, [&](const tf::communicator& team) {
                tf::weld_stream_options options;
                options.communicator = team;
                static_cast<void>(tf::weld_stream(path, here.path / "out.ply", options));
            });
        } catch (const tf::io_error& error) {
            return error.what();
        }
        return "";
    };
    const std::vector<std::vector<std::size_t>> places{
        {200}, {0}, {file.mesh.faces.size() - 1}, {400, 100, 201}};
    for (const std::vector<std::size_t>& rows : places)
        for (const std::size_t byte : {0U, 4U}) {  // a length, or a number of a point
            std::string damaged = whole;
            for (const std::size_t row : rows) damaged[first + 13 * row + byte] = '\x7f';
            std::ofstream(path, std::ios::binary) << damaged;
            const std::string expected = error_of(1);
            CHECK(expected.find("in.ply: byte ") != std::string::npos);
            for (const std::size_t size : {2U, 4U, 7U}) CHECK(error_of(size) == expected);
            CHECK_FALSE(fs::exists(here.path / "out.ply"));
        }
}

TEST_CASE("edge files: edges of more than two faces, with little memory") {
    const test::own_folder here("edge_files");
    const stream::work_folder folder(here.path / "work", "test");
    stream::cancellable_progress pace({});
    const stream::communicator alone{tf::communicator{}};
    test::random random(2);
    for (const std::uint32_t points : {3U, 40U, 2000U}) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
        constexpr std::size_t count = 60000;
        stream::edge_files<stream::numbered_edge> files(folder, alone, "edges", count, 1);
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

TEST_CASE("edge files: of a team, each writes its uses, and counts a share of all") {
    const test::own_folder here("edge_files_team");
    const stream::work_folder folder(here.path / "work", "test");
    constexpr std::size_t size = 4;
    constexpr std::uint32_t points = 3000;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    std::vector<std::vector<stream::numbered_edge>> edges(size);
    test::random random(6);
    for (std::size_t i = 0; i < 60000; ++i) {
        const auto a = static_cast<std::uint32_t>(random.unit() * points);
        const auto b = static_cast<std::uint32_t>((a + 1 + i % 7) % points);
        edges[i % size].push_back(stream::edge_between(a, b));
        ++uses[std::minmax(a, b)];
    }
    std::uint64_t expected = 0;
    for (const auto& [edge, n] : uses) expected += n > 2 ? 1 : 0;
    std::vector<std::uint64_t> counted(size);
    CHECK(test::run_as_team(size, [&](const tf::communicator& some) {
        const stream::communicator all(some);
        stream::cancellable_progress pace({});
        stream::edge_files<stream::numbered_edge> files(folder, all, "edges", 60000, 1 << 20);
        for (const stream::numbered_edge e : edges[all.rank()]) files.put(e);
        counted[all.rank()] = files.count_nonmanifold(pace);
    }));
    CHECK(counted == std::vector<std::uint64_t>(size, expected));
    CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);  // the lock
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
        // Many at a time, all over the file and then in order; by little memory in ascending order.
        std::vector<std::uint32_t> found;
        for (const std::uint64_t step : {1U, 7919U, 7919U, 7919U, 1U, 1U}) {
            std::vector<std::uint32_t> of(50000);
            for (std::size_t i = 0; i < of.size(); ++i)
                of[i] = static_cast<std::uint32_t>(i * step % count);
            file.look_up(of, found);
            CHECK(file.is_scattered() == (step > 1 && memory == 1));
            REQUIRE(found.size() == of.size());
            same = true;
            for (std::size_t i = 0; i < of.size(); ++i) same = same && found[i] == 3 * of[i];
            CHECK(same);
        }
    }
    fs::resize_file(path, 8 * 50000);
    stream::paged_file<std::uint64_t> cut(path, count, 1);
    CHECK(cut.at(3) == 9);
    CHECK_THROWS_AS(static_cast<void>(cut.at(60000)), tf::io_error);
}
