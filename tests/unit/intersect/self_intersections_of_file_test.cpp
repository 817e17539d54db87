/// \file
/// Self-intersections of files by tiles on the disk: what is found without tiles, also after a stop
/// at any step.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// What is told of a mesh, with the file's numbers of faces.
struct told {
    std::vector<tf::face_pair> pairs{};
    std::array<std::uint64_t, tf::pair_kind_count> counts{};
    std::vector<std::vector<std::uint32_t>> regions{};
    std::uint64_t non_finite = 0;
    std::uint64_t degenerate = 0;
    std::optional<tf::box3> bounds{};
    friend bool operator==(const told&, const told&) = default;
};

told told_of(const tf::usable_mesh& part, const tf::face_pair_result& found,
             const std::optional<tf::box3>& bounds) {
    told t{.counts = found.counts,
           .non_finite = part.non_finite,
           .degenerate = part.degenerate,
           .bounds = bounds};
    for (const tf::face_pair& p : found.pairs)
        t.pairs.push_back({part.face_in_file(p.a), part.face_in_file(p.b), p.kind});
    for (const auto& region : tf::group_pairs(part.mesh, found.pairs)) {
        t.regions.emplace_back();
        for (const std::uint32_t f : region.faces) t.regions.back().push_back(part.face_in_file(f));
    }
    return t;
}

told in_memory(const fs::path& path, const tf::file_search_options& o) {
    tf::mesh_file file = tf::read(path);
    const auto bounds = tf::bounding_box(file.mesh.points);
    const auto by_format =
        file.indexed ? tf::vertex_identity::by_index : tf::vertex_identity::by_coordinates;
    const tf::usable_mesh part =
        tf::usable_faces(file.mesh, file.face_of_triangle,
                         {.vertices = o.vertices.value_or(by_format), .box = o.box});
    const auto found = tf::self_intersections(
        part.mesh, {.vertices = tf::vertex_identity::by_index, .kinds = o.kinds});
    return told_of(part, found, bounds);
}

told in_tiles(const fs::path& path, const tf::file_search_options& o) {
    const tf::file_search_result r = tf::self_intersections_of_file(path, o);
    CHECK_FALSE(fs::exists(path.string() + ".search-tiles"));
    CHECK(r.tiles > 0);
    return told_of(r.part, r.found, r.bounds);
}

/// Crossing and touching faces, copies, and faces without area; some with equal points.
tf::mesh hard_mesh() {
    test::random source(11);
    tf::mesh mesh = test::random_soup(source, 1500, 0.3);
    mesh = test::together(mesh, test::lattice_soup(source, 600, 200, 5));
    return test::together(mesh, test::moved(test::grid(20), {-3, -3, 0.5}));
}

}  // namespace

TEST_CASE("self_intersections_of_file: the answers of the whole mesh, for every cut and format") {
    const test::own_folder folder("search_of_file");
    tf::mesh_file file;
    file.mesh = hard_mesh();
    for (const char* name : {"whole.stl", "whole.ply", "text.ply"}) {
        CAPTURE(name);
        const fs::path path = folder.path / name;
        tf::write_options how;
        how.ascii = std::string(name) == "text.ply";
        how.precision = tf::precision::float32;
        tf::write(path, file, how);
        for (const unsigned faces : {150U, 100'000U}) {
            CAPTURE(faces);
            tf::file_search_options o;
            o.faces_per_tile = faces;
            const told expected = in_memory(path, o);
            CHECK(expected.pairs.size() > 1000);
            CHECK(in_tiles(path, o) == expected);
            o.vertices = tf::vertex_identity::by_coordinates;
            CHECK(in_tiles(path, o) == in_memory(path, o));
            o.kinds = tf::pair_kinds::all - tf::pair_kind::crossing;
            o.box = tf::box3{{0.25, 0.25, 0.25}, {2.5, 1.0, 1.0}};
            CHECK(in_tiles(path, o) == in_memory(path, o));
        }
    }
}

TEST_CASE(
    "self_intersections_of_file: polygons, doubles, NaN and elements that are not asked for") {
    const test::own_folder folder("search_of_file");
    const fs::path path = folder.path / "all.ply";
    std::ofstream(path) << "ply\nformat ascii 1.0\n"
                           "element camera 1\nproperty float f\nproperty list uchar int l\n"
                           "element vertex 9\nproperty uchar red\nproperty double x\n"
                           "property double y\nproperty double z\n"
                           "element face 4\nproperty list uchar int vertex_indices\n"
                           "property list uchar float w\nend_header\n"
                           "2.5 2 1 1\n"
                           "0 0 0 0\n0 4 0 0\n0 4 4 0\n0 0 4 0\n"
                           "0 1 1 -1\n0 1 1.1 1\n0 3 3 1\n0 nan 0 0\n0 9 9 9\n"
                           "4 0 1 2 3 1 0.5\n3 4 5 6 0\n3 0 1 7 0\n3 4 5 5 2 1 1\n";
    for (const unsigned faces : {1U, 100U}) {
        tf::file_search_options o;
        o.faces_per_tile = faces;
        const told found = in_tiles(path, o);
        CHECK(found == in_memory(path, o));
        CHECK(found.non_finite == 1);
        CHECK(found.degenerate == 1);
        CHECK(found.pairs.size() == 3);
        CHECK(found.bounds == tf::box3{{0, 0, -1}, {9, 9, 9}});
    }
}

TEST_CASE("self_intersections_of_file: goes on after a stop at any step") {
    const test::own_folder folder("search_of_file");
    tf::mesh_file file;
    file.mesh = hard_mesh();
    const fs::path path = folder.path / "part.stl";
    tf::write(path, file, {.precision = tf::precision::float32});
    tf::file_search_options o;
    o.faces_per_tile = 500;
    o.folder = folder.path / "work";
    const told expected = in_memory(path, o);
    struct stop {};
    std::size_t steps = 0;
    for (int left = 1;; ++left) {
        CAPTURE(left);
        o.step_done = [&, at = left]() mutable {
            if (--at == 0) throw stop{};
        };
        try {
            const auto r = tf::self_intersections_of_file(path, o);
            CHECK(told_of(r.part, r.found, r.bounds) == expected);
            CHECK(r.tiles + 1 == steps);  // the first one gives tiles their faces
            CHECK_FALSE(r.started_anew);
        } catch (const stop&) {
            ++steps;
            o.step_done = {};
            if (left % 3 == 0) {  // a tile that is damaged is found out
                for (const auto& entry : fs::directory_iterator(o.folder))
                    if (entry.path().extension() == ".hits")
                        std::ofstream(entry.path(), std::ios::app) << "8 bytes.";
            }
            const bool damaged = left % 3 == 0;
            const auto r = tf::self_intersections_of_file(path, o);
            CHECK(told_of(r.part, r.found, r.bounds) == expected);
            CHECK(r.finished_tiles == (damaged ? 0 : static_cast<std::size_t>(left - 1)));
            CHECK(r.started_anew == damaged);
            CHECK_FALSE(fs::exists(o.folder));
            continue;
        }
        break;
    }
    CHECK(steps > 5);
}

TEST_CASE("shared_search: tiles by several workers, in any order, some of them twice") {
    const test::own_folder folder("search_of_file");
    tf::mesh_file file;
    file.mesh = hard_mesh();
    const fs::path path = folder.path / "part.ply";
    tf::write(path, file);
    tf::file_search_options o;
    o.faces_per_tile = 300;
    o.folder = folder.path / "work";
    CHECK_THROWS_WITH_AS((void)tf::shared_search(path, o).tiles(),
                         doctest::Contains("contains no tiles of this input"), tf::io_error);
    tf::shared_search first(path, o), second(path, o);
    CHECK_THROWS_WITH_AS((void)first.scatter(), doctest::Contains("is in use"), tf::io_error);
    { const tf::shared_search gone = std::move(second); }
    CHECK_THROWS_WITH_AS((void)tf::self_intersections_of_file(path, o),  // held still
                         doctest::Contains("is in use"), tf::io_error);
    CHECK_THROWS_WITH_AS((void)first.finish(), doctest::Contains("contains no tiles"),
                         tf::io_error);
    REQUIRE(first.scatter() == tf::status::ok);
    tf::shared_search other(path, o);
    REQUIRE(other.tiles() > 5);
    CHECK_THROWS_AS((void)other.search_tile(other.tiles()), std::out_of_range);
    CHECK_THROWS_WITH_AS((void)other.finish(), doctest::Contains("tiles 0, 1, 2, 3, 4, 5"),
                         tf::io_error);
    tf::for_chunks(2, 1, [&](std::size_t worker, std::size_t, std::size_t) {
        tf::shared_search mine(path, o);
        const std::size_t tiles = mine.tiles();
        for (std::size_t t = worker; t < tiles; ++t)
            if (mine.search_tile(tiles - 1 - t) != tf::status::ok)
                throw std::runtime_error("ended");
    });
    REQUIRE(first.search_tile(other.tiles() - 1) == tf::status::ok);
    const tf::file_search_result r = other.finish();
    CHECK(r.tiles == other.tiles());
    tf::file_search_options others = o;
    others.kinds = tf::pair_kind::crossing;
    { const tf::shared_search gone = std::move(first); }
    { const tf::shared_search gone = std::move(other); }
    tf::shared_search last(path, others);
    CHECK_THROWS_WITH_AS((void)last.scatter(), doctest::Contains("contains tiles of another input"),
                         tf::io_error);
    CHECK(told_of(r.part, r.found, r.bounds) == in_memory(path, o));
    last.remove_folder();
    CHECK_FALSE(fs::exists(o.folder));
}

TEST_CASE("self_intersections_of_file: stops when it is told, and says what it does not read") {
    const test::own_folder folder("search_of_file");
    tf::mesh_file file;
    file.mesh = test::grid(40);
    const fs::path path = folder.path / "grid.ply";
    tf::write(path, file);
    tf::file_search_options o;
    for (const std::string_view at : {"scatter", "pairs"}) {
        o.progress = [at](std::string_view step, double) { return step != at; };
        CHECK(tf::self_intersections_of_file(path, o).found.status == tf::status::cancelled);
    }
    CHECK(tf::self_intersections_of_file(path).found.pairs.empty());

    tf::write(folder.path / "grid.obj", file);
    CHECK_THROWS_WITH_AS((void)tf::self_intersections_of_file(folder.path / "grid.obj"),
                         doctest::Contains("only binary STL and PLY are searched in tiles"),
                         tf::io_error);
    CHECK_THROWS_AS((void)tf::self_intersections_of_file(folder.path / "no.stl"), tf::io_error);
    CHECK(tf::shared_search::accepts(path));
    CHECK_FALSE(tf::shared_search::accepts(folder.path / "grid.obj"));
    CHECK_THROWS_AS(static_cast<void>(tf::shared_search::accepts(folder.path / "no.stl")),
                    tf::io_error);
    fs::resize_file(path, fs::file_size(path) - 100);
    CHECK_THROWS_AS((void)tf::self_intersections_of_file(path), tf::io_error);
    CHECK_FALSE(fs::exists(path.string() + ".search-tiles"));

    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
        "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n0 1\n";
    std::ofstream(path) << head;
    CHECK_THROWS_AS((void)tf::self_intersections_of_file(path), tf::io_error);
    std::ofstream(path) << head << "1 2\n2 0\n";
    CHECK(tf::self_intersections_of_file(path).header.warnings.size() == 1);
    std::ofstream(path) << "ply\nformat ascii 1.0\nelement face 1\n"
                           "property list uchar int vertex_indices\nelement vertex 3\n"
                           "property float x\nproperty float y\nproperty float z\nend_header\n"
                           "3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n";
    CHECK_FALSE(tf::shared_search::accepts(path));
    CHECK_THROWS_AS((void)tf::self_intersections_of_file(path), tf::io_error);
}

TEST_CASE(
    "self_intersections_of_file: memory that no cut makes enough is said, with what would be") {
    const test::own_folder folder("search_of_file");
    tf::mesh_file fan;
    test::random source(5);
    fan.mesh = test::fan(source, 3000);
    const fs::path path = folder.path / "fan.stl";
    tf::write(path, fan, {.precision = tf::precision::float32});
    tf::file_search_options o;
    o.faces_per_tile = 100;
    CHECK(tf::self_intersections_of_file(path, o).tiles > 10);  // not by the corner all have
    o.memory = 1'000'000;
    o.faces_per_tile = 3000;
    std::uint64_t needed = 0;
    try {
        (void)tf::self_intersections_of_file(path, o);
    } catch (const tf::io_error& error) {
        CHECK(error.why() == tf::io_error::kind::memory);
        needed = error.needed();
    }
    CHECK(needed > o.memory);
    CHECK_FALSE(fs::exists(path.string() + ".search-tiles"));
    o.memory = needed;
    CHECK(in_tiles(path, o) == in_memory(path, o));
}
