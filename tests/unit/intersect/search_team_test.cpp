/// \file
/// Self-intersections of files searched by several, each of which reads a part: what one finds, for
/// every format, and also after one was killed.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>
#include <support/soups.hpp>
#include <support/thread_team.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// Where one is killed after so many steps, nothing.
std::optional<tf::file_search_result> search_as_team(const fs::path& path,
                                                     const tf::file_search_options& asked,
                                                     std::size_t size, std::size_t victim = 0,
                                                     int steps = 0) {
    std::optional<tf::file_search_result> first;
    const bool all_lived = test::run_as_team(size, [&](const tf::communicator& team) {
        tf::file_search_options options = asked;
        options.communicator = team;
        if (team.rank == victim && steps > 0)
            options.step_done = [left = steps]() mutable {
                if (--left == 0) throw test::killed();
            };
        auto result = tf::self_intersections_of_file(path, options);
        if (team.rank == 0) first = std::move(result);
    });
    return all_lived ? first : std::nullopt;
}

void check_same(const tf::file_search_result& a, const tf::file_search_result& b) {
    CHECK(a.found.pairs == b.found.pairs);
    CHECK(a.found.counts == b.found.counts);
    CHECK(a.part.mesh.points == b.part.mesh.points);
    CHECK(a.part.mesh.faces == b.part.mesh.faces);
    CHECK(a.part.triangle_of_face == b.part.triangle_of_face);
    CHECK(a.part.non_finite == b.part.non_finite);
    CHECK(a.part.degenerate == b.part.degenerate);
    CHECK(a.stored_faces == b.stored_faces);
    CHECK(a.triangles == b.triangles);
    CHECK(a.searched == b.searched);
    CHECK(a.points == b.points);
    CHECK(a.bounds == b.bounds);
    CHECK(a.header.format == b.header.format);
    CHECK(a.header.stored_as == b.header.stored_as);
    REQUIRE(a.header.warnings.size() == b.header.warnings.size());
    for (std::size_t i = 0; i < a.header.warnings.size(); ++i)
        CHECK(a.header.warnings[i].text == b.header.warnings[i].text);
}

template <class T>
void put(std::string& to, T value) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    to.append(bytes.data(), bytes.size());
}

/// Polygons of the lengths, one after the other, as binary PLY.
std::string polygons(const std::vector<int>& lengths, std::size_t faces,
                     const std::string& behind) {
    test::random random(5);
    constexpr int points = 300;
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex 300\n"
        "property float x\nproperty uchar red\nproperty float y\nproperty double z\n"
        "element face " +
        std::to_string(faces) +
        "\nproperty short tag\nproperty list uchar int vertex_indices\nend_header\n";
    for (int i = 0; i < points; ++i) {
        put(text, static_cast<float>(random.unit()));
        put(text, std::uint8_t{9});
        put(text, static_cast<float>(random.unit()));
        put(text, i == 0 ? 1.0 / 3.0 : double{static_cast<float>(random.unit())});
    }
    for (std::size_t i = 0; i < faces; ++i) {
        const int length = lengths[i % lengths.size()];
        put(text, std::int16_t{7});
        put(text, static_cast<std::uint8_t>(length));
        for (int k = 0; k < length; ++k) put(text, static_cast<std::int32_t>(random.below(points)));
    }
    return text + behind;
}

void write_bytes(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

tf::mesh_file hard_file() {
    test::random random(11);
    tf::mesh_file file;
    file.mesh = test::together(test::random_soup(random, 500, 0.3),
                               test::lattice_soup(random, 300, 100, 5));
    return file;
}

}  // namespace

TEST_CASE("search_team: any number of processes find in any file what one finds") {
    const test::own_folder folder("search_team");
    const tf::mesh_file file = hard_file();
    tf::write(folder.path / "single.stl", file, {.precision = tf::precision::float32});
    tf::write(folder.path / "single.ply", file, {.precision = tf::precision::float32});
    tf::write(folder.path / "double.ply", file);
    tf::write(folder.path / "text.ply", file, {.ascii = true});
    write_bytes(folder.path / "quads.ply", polygons({4}, 200, ""));
    write_bytes(folder.path / "more_behind.ply", polygons({3}, 200, "more"));
    write_bytes(folder.path / "mixed.ply", polygons({3, 4, 5, 3}, 200, ""));
    // Of a length as if all were like the first.
    write_bytes(folder.path / "mixed_alike.ply", polygons({4, 3, 5, 4}, 200, ""));
    write_bytes(folder.path / "few.ply", polygons({3}, 4, ""));
    write_bytes(folder.path / "none.ply", polygons({3}, 0, ""));
    for (const auto& entry : fs::directory_iterator(folder.path)) {
        const fs::path& path = entry.path();
        CAPTURE(path.filename().string());
        tf::file_search_options options;
        options.folder = folder.path / "work";
        options.faces_per_tile = 60;
        const auto one = tf::self_intersections_of_file(path, options);
        CHECK(one.found.pairs.empty() == (path.filename() == "none.ply"));
        for (const std::size_t size : {2U, 3U, 7U}) {
            CAPTURE(size);
            const auto several = search_as_team(path, options, size);
            REQUIRE(several);
            check_same(*several, one);
            CHECK_FALSE(fs::exists(options.folder));
        }
    }
}

TEST_CASE("search_team: each gives tiles its share of the faces") {
    const test::own_folder folder("search_team");
    const fs::path path = folder.path / "mesh.ply";
    tf::write(path, hard_file());
    tf::file_search_options options;
    options.folder = folder.path / "work";
    options.faces_per_tile = 100;
    options.step_done = [] { throw test::killed(); };  // when tiles have all faces
    CHECK_FALSE(search_as_team(path, options, 4));
    std::array<std::uintmax_t, 4> given{};
    for (const auto& entry : fs::directory_iterator(options.folder)) {
        const std::string name = entry.path().filename().string();
        const std::size_t at = name.find(".faces");
        if (at == std::string::npos) continue;
        given[at + 6 == name.size() ? 0 : static_cast<std::size_t>(name.back() - '0')] +=
            entry.file_size();
    }
    const std::uintmax_t all = given[0] + given[1] + given[2] + given[3];
    CHECK(all >= 800 * 96);
    for (const std::uintmax_t bytes : given) CHECK(8 * bytes < 3 * all);  // 1.5 times its share
    CHECK_FALSE(fs::exists(options.folder / "points.1"));
}

TEST_CASE("search_team: killed at any step, another number of processes goes on to the same") {
    const test::own_folder folder("search_team");
    const fs::path path = folder.path / "mesh.ply";
    tf::write(path, hard_file());
    tf::file_search_options options;
    options.folder = folder.path / "work";
    options.faces_per_tile = 100;
    const auto one = tf::self_intersections_of_file(path, options);
    for (std::size_t victim = 0; victim < 3; ++victim)
        for (int steps = 1; steps < 4; ++steps) {
            CAPTURE(victim);
            CAPTURE(steps);
            CHECK_FALSE(search_as_team(path, options, 3, victim, steps));
            const auto rest = search_as_team(path, options, 1 + (victim + 1) % 3);
            REQUIRE(rest);
            check_same(*rest, one);
            CHECK_FALSE(fs::exists(options.folder));
        }
}

TEST_CASE("search_team: a face that names no vertex is told of as by one") {
    const test::own_folder folder("search_team");
    const fs::path path = folder.path / "bad.ply";
    std::string bytes = polygons({3}, 300, "");
    bytes[bytes.size() - 5] = '\x7f';
    write_bytes(path, bytes);
    const auto error_of = [&](std::size_t size) -> std::string {
        try {
            tf::file_search_options options;
            options.folder = folder.path / "work";
            static_cast<void>(search_as_team(path, options, size));
        } catch (const tf::io_error& error) {
            return error.what();
        }
        return "";
    };
    const std::string expected = error_of(1);
    CHECK(expected.find("out of range") != std::string::npos);
    for (const std::size_t size : {2U, 5U}) CHECK(error_of(size) == expected);
}
