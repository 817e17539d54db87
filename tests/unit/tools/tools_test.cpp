#include "tools/manual/help_text.hpp"
#include "tools/picture/pack.hpp"
#include "tools/picture/page.hpp"
#include "tools/picture/scene.hpp"
#include "tools/shell/console.hpp"
#include "tools/shell/exit_status.hpp"
#include "tools/shell/guard.hpp"
#include "tools/shell/parse_value.hpp"
#include "tools/shell/sha256.hpp"
#include "tools/shell/shared_digests.hpp"
#include "tools/shell/tile_options.hpp"
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>
#include <support/thread_team.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

/// A folder with the files of a system that the test makes up.
class made_up_system {
  public:
    made_up_system() {
        std::string name = (std::filesystem::temp_directory_path() / "system-XXXXXX").string();
        if (mkdtemp(name.data()) != nullptr) folder_ = name;
        put("proc/meminfo",
            "MemTotal:  9000 kB\nMemFree:   1000 kB\nMemAvailable:   5000 kB\nSwapFree: 500 kB\n");
    }
    ~made_up_system() { std::filesystem::remove_all(folder_); }
    made_up_system(const made_up_system&) = delete;
    made_up_system& operator=(const made_up_system&) = delete;

    void put(const std::string& name, std::string_view text) const {
        const std::filesystem::path path = folder_ / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << text;
    }
    /// A control group with a bound, what is in use, and some text of memory.stat.
    void put_group(const std::string& folder, std::initializer_list<const char*> names,
                   std::initializer_list<const char*> texts) const {
        for (std::size_t i = 0; i < names.size(); ++i)
            put("sys/fs/cgroup/" + folder + "/" + names.begin()[i], texts.begin()[i]);
    }
    [[nodiscard]] std::uint64_t free() const { return tools::free_memory(folder_); }

  private:
    std::filesystem::path folder_;
};

}  // namespace

TEST_CASE("sha256: the examples of the standard") {
    const auto sum = [](std::string_view text) {
        return tools::sha256_of(std::as_bytes(std::span(text)));
    };
    CHECK(sum("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sum("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(sum(std::string(1'000'000, 'a')) ==
          "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("sha256: of files, read by any number of processes") {
    const test::own_folder folder{"tools_test"};
    std::vector<std::filesystem::path> paths;
    std::vector<std::string> expected;
    for (const std::size_t size : {0U, 1U, 63U, 700'000U, 0U, 64U, 1000U, 0U}) {
        paths.push_back(folder.path / std::to_string(paths.size()));
        std::string text(size, 'a');
        for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>(i * i / 7);
        std::ofstream(paths.back(), std::ios::binary) << text;
        expected.push_back(tools::sha256_of(std::as_bytes(std::span(text))));
        CHECK(tools::sha256_of_file(paths.back()) == expected.back());
    }
    paths.push_back(folder.path / "none");
    expected.emplace_back();
    for (const std::size_t size : {1U, 2U, 3U, 7U}) {
        CAPTURE(size);
        std::vector<std::vector<std::string>> found(size);
        CHECK(test::run_as_team(size, [&](const tf::communicator& team) {
            tools::tile_options tiles{.communicator = team};
            found[team.rank] = tools::digests_for_report(paths, tiles);
            CHECK(found[team.rank] == std::vector<std::string>(paths.size()));
            tiles.report = "report.json";
            found[team.rank] = tools::digests_for_report(paths, tiles);
        }));
        for (const auto& of_one : found) CHECK(of_one == expected);
    }
}

TEST_CASE("values: numbers are read whole and without a locale") {
    CHECK(tools::parse_number("-x", "1.5") == 1.5);
    CHECK(tools::parse_number("-x", "+2e3") == 2000.0);
    CHECK(tools::parse_numbers("-x", "-1,2,.5", 3) == std::vector<double>{-1, 2, 0.5});
    for (const char* bad : {"", "1,5", "1 ", "nan", "inf", "1e999", "0x10", "+"})
        CHECK_THROWS_AS(static_cast<void>(tools::parse_number("-x", bad)), tools::failure);
    for (const char* bad : {"", "1,2", "1,2,3,4", "1,2,3,", "1;2;3"})
        CHECK_THROWS_AS(static_cast<void>(tools::parse_numbers("-x", bad, 3)), tools::failure);
}

TEST_CASE("values: distances are lengths or shares of the diagonal") {
    CHECK(tools::parse_distance("-t", "0.25").used(8.0) == 0.25);
    CHECK(tools::parse_distance("-t", "50%").used(8.0) == 4.0);
    CHECK(tools::parse_distance("-t", "0").given == "0");
    for (const char* bad : {"-1", "%", "1%%", "1 %", "-0.1%"})
        CHECK_THROWS_AS(static_cast<void>(tools::parse_distance("-t", bad)), tools::failure);
}

TEST_CASE("values: sizes are in powers of 1024") {
    CHECK(tools::parse_size("--memory", "1000") == 1000);
    CHECK(tools::parse_size("--memory", "1000B") == 1000);
    CHECK(tools::parse_size("--memory", "512M") == std::uint64_t{512} << 20);
    CHECK(tools::parse_size("--memory", "4g") == std::uint64_t{4} << 30);
    CHECK(tools::parse_size("--memory", "1.5GiB") == std::uint64_t{3} << 29);
    CHECK(tools::parse_size("--memory", "1T") == std::uint64_t{1} << 40);
    for (const char* bad : {"", "M", "0", "-1G", "4X", "4GG", "4Gb2", "1e30", "0.1"})
        CHECK_THROWS_AS(static_cast<void>(tools::parse_size("--memory", bad)), tools::failure);
}

TEST_CASE("free memory: of the machine, with swap; 0 where it does not say") {
    const made_up_system machine;
    CHECK(machine.free() == 5500 * 1024);
    machine.put("proc/self/cgroup", "4:memory:/nowhere\nno line\n0::/\n");
    CHECK(machine.free() == 5500 * 1024);
    machine.put("proc/meminfo", "MemTotal:  9000 kB\nMemFree:   1000 kB\n");
    CHECK(machine.free() == 0);
    CHECK(tools::free_memory("/no/such/folder") == 0);
}

TEST_CASE("free memory: the tightest control group on the way counts, pages of files do not") {
    const made_up_system machine;
    const auto second = {"memory.max", "memory.current", "memory.stat"};
    machine.put("proc/self/cgroup", "0::/outer/inner\n");
    machine.put_group("outer", second, {"1000000\n", "600000\n", "anon 1\n"});
    CHECK(machine.free() == 400000);
    machine.put_group("outer/inner", second, {"max\n", "600000\n", ""});
    CHECK(machine.free() == 400000);
    machine.put_group("outer/inner", second,
                      {"700000\n", "600000\n", "active_file 20000\ninactive_file 30000\n"});
    CHECK(machine.free() == 150000);
    machine.put_group("outer/inner", second, {"700000\n", "800000\n", ""});
    CHECK(machine.free() == 0);
    machine.put_group("outer/inner", second, {"90000000\n", "0\n", ""});
    CHECK(machine.free() == 400000);
}

TEST_CASE("free memory: in version 1 of control groups, too, and in a container") {
    const made_up_system machine;
    const auto first = {"memory.limit_in_bytes", "memory.usage_in_bytes", "memory.stat"};
    machine.put("proc/self/cgroup", "9:cpu:/c\n4:pids,memory:/docker/7\n0::/\n");
    machine.put_group("memory", first, {"9223372036854771712\n", "1000\n", ""});
    CHECK(machine.free() == 5500 * 1024);
    machine.put_group("memory", first, {"3000\n", "1000\n", "total_inactive_file 500\n"});
    CHECK(machine.free() == 2500);
    machine.put_group("memory/docker/7", first, {"2000\n", "1000\n", ""});
    CHECK(machine.free() == 1000);
}

TEST_CASE("words: bytes are told in powers of 1000") {
    CHECK(tools::in_bytes(512'000'000) == "512 MB");
    CHECK(tools::in_bytes(1'000'000'000) == "1.0 GB");
    CHECK(tools::in_bytes(22'449'999'999) == "22.4 GB");
}

TEST_CASE("words: numbers are grouped, and counted in the singular") {
    CHECK(tools::grouped(0) == "0");
    CHECK(tools::grouped(999) == "999");
    CHECK(tools::grouped(1000) == "1,000");
    CHECK(tools::grouped(1234567) == "1,234,567");
    CHECK(tools::counted(1, "face", "faces") == "1 face");
    CHECK(tools::counted(0, "face", "faces") == "0 faces");
    CHECK(tools::shortest(0.1) == "0.1");
}

TEST_CASE("help: texts start in their column, defaults end in theirs") {
    const tools::option_group group{
        .title = "Group",
        .options = {{"-t, --tolerance", "DIST", "join corners", "0"},
                    {"--a-rather-long-name", "VALUES", "two\nlines", ""},
                    {"--limit", "N", std::string(50, 'x'), "10000"},
                    {.names = "--quiet-one"}}};
    CHECK(tools::lay_out(group) ==
          "Group:\n"
          "  -t, --tolerance DIST    join corners                                      [0]\n"
          "      --a-rather-long-name VALUES  two\n"
          "                          lines\n"
          "      --limit N           xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx\n"
          "                                                                        [10000]\n");
}

namespace {

/// Faces of a square grid of n x n cells, two each.
tf::mesh grid_of(std::uint32_t n) {
    tf::mesh mesh;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i)
            mesh.points.push_back({static_cast<double>(i), static_cast<double>(j), 0.0});
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i)
            mesh.faces.push_back({j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i});
    return mesh;
}

tools::scene scene_with(tools::scene_mesh mesh) {
    tools::scene shown;
    shown.classes = {{"other", "#b4bac2", {}, true}, {"found", "#e02020"}};
    shown.meshes = {std::move(mesh)};
    return shown;
}

}  // namespace

TEST_CASE("scene: thins out context and keeps what was found") {
    const tf::mesh mesh = grid_of(60);
    std::vector<std::uint8_t> kind(mesh.faces.size(), 0);
    for (std::uint32_t f = 0; f < 10; ++f) kind[7 * f] = 1;
    const tools::scene shown = scene_with({.mesh = mesh, .kind = kind});

    const auto whole = tools::pack(shown);
    CHECK(whole.header["meshes"][0]["faces"] == mesh.faces.size());
    CHECK(whole.header["left_out"].empty());
    CHECK(whole.header["steps"] == 1U << 22);

    const auto thin = tools::pack(shown, {.faces = 500});
    const std::size_t faces = thin.header["meshes"][0]["faces"];
    CHECK(faces <= 510);
    CHECK(faces > 10);
    CHECK(faces + thin.header["left_out"][0]["count"].get<std::size_t>() == mesh.faces.size());

    const auto few = tools::pack(shown, {.faces = 0});
    CHECK(few.header["meshes"][0]["faces"] == 10);
}

TEST_CASE("scene: faces with values are no context, and points are thinned out") {
    const tf::mesh mesh = grid_of(20);
    tools::scene shown =
        scene_with({.mesh = mesh, .kind = {0}, .value = std::vector(mesh.points.size(), 0.5)});
    shown.map = {.name = "height", .colors = {"#000000", "#ffffff"}};
    CHECK(tools::pack(shown, {.faces = 10}).header["meshes"][0]["faces"] == mesh.faces.size());

    std::vector<tf::point3> points(1000, tf::point3{1, 2, 3});
    points[5].x = std::numeric_limits<double>::quiet_NaN();
    shown.dots = {{.points = points, .kind = {1}}, {.points = points, .kind = {0}}};
    const auto thin = tools::pack(shown, {.faces = 10, .dots = 100}).header;
    CHECK(thin["dots"][0]["count"] == 999);
    CHECK(thin["dots"][1]["count"] == 50);
    CHECK(thin["left_out"][0]["count"] == 951);
}

TEST_CASE("scene: nothing, one point, coordinates at the ends of the range") {
    CHECK(tools::pack({}).header["steps"] == 1);
    const tf::mesh point{{{1, 2, 3}}, {{0, 0, 0}}};
    CHECK(tools::pack(scene_with({.mesh = point, .kind = {0}})).header["steps"] == 1);
    const double most = 1.7e308, nan = std::numeric_limits<double>::quiet_NaN();
    const tf::mesh large{{{-most, 0, 0}, {most, 0, 0}, {0, 1, 0}, {nan, nan, nan}}, {{0, 1, 2}}};
    CHECK(tools::pack(scene_with({.mesh = large, .kind = {0}})).header["size"][0] == 1U << 22);
}

TEST_CASE("scene: open edges are numbered by hole; points with equal coordinates are one") {
    tf::mesh two{{{0, 0, 0},
                  {1, 0, 0},
                  {0, 1, 0},
                  {5, 0, 0},
                  {6, 0, 0},
                  {5, 1, 0},
                  {1, 0, 0},
                  {0, 1, 0},
                  {1, 1, 0}},
                 {{0, 1, 2}, {3, 4, 5}, {6, 8, 7}}};
    const tools::open_edges open = tools::find_open_edges(two);
    CHECK(open.holes == 2);
    CHECK(open.ends.size() == 7);
    CHECK(std::count(open.hole.begin(), open.hole.end(), 0U) == 4);
}

TEST_CASE("pages: texts cannot break out of their place") {
    CHECK(tools::escaped("<a href=\"x\">'&'") == "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;");
    tools::scene shown;
    shown.title = "</title><script>";
    shown.classes = {{"</script><!--<script>", "#000000"}};
    const std::string text = tools::html(shown);
    CHECK(text.find("</title><script>") == std::string::npos);
    CHECK(text.find("<!--") == std::string::npos);
    CHECK(text.find("\"</script>") == std::string::npos);
}
