#include "tools/common/console.hpp"
#include "tools/common/exit_status.hpp"
#include "tools/common/help_text.hpp"
#include "tools/common/page/page.hpp"
#include "tools/common/page/scene.hpp"
#include "tools/common/parse_value.hpp"
#include "tools/common/sha256.hpp"
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

TEST_CASE("sha256: the examples of the standard") {
    const auto sum = [](std::string_view text) {
        return tools::sha256_of(std::as_bytes(std::span(text)));
    };
    CHECK(sum("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sum("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(sum(std::string(1'000'000, 'a')) ==
          "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
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

TEST_CASE("scene: thins out plain faces and keeps marked ones") {
    tf::mesh mesh;
    constexpr std::uint32_t n = 60;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i)
            mesh.points.push_back({static_cast<double>(i), static_cast<double>(j), 0.0});
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i)
            mesh.faces.push_back({j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i});
    std::vector<std::uint8_t> kind(mesh.faces.size(), 0);
    std::vector<std::int32_t> region(mesh.faces.size(), 0);
    std::vector<std::uint32_t> number(mesh.faces.size());
    for (std::uint32_t f = 0; f < 10; ++f) kind[7 * f] = 1;
    const tools::scene_input input{mesh, kind, region, number, {}};

    const auto whole = tools::pack(input);
    CHECK(whole.faces == mesh.faces.size());
    CHECK(whole.plain_left_out + whole.marked_left_out == 0);
    CHECK(whole.steps == 1U << 22);

    const auto thin = tools::pack(input, {.plain = 500, .marked = 10});
    CHECK(thin.marked_left_out == 0);
    CHECK(thin.faces <= 510);
    CHECK(thin.faces > 10);
    CHECK(thin.faces + thin.plain_left_out == mesh.faces.size());

    const auto few = tools::pack(input, {.plain = 0, .marked = 4});
    CHECK(few.faces == 4);
    CHECK(few.marked_left_out == 6);
}

TEST_CASE("scene: one point, coordinates at the ends of the range") {
    const std::vector<std::uint8_t> kind(1, 0);
    const std::vector<std::int32_t> region(1, 0);
    const std::vector<std::uint32_t> number(1, 0);
    const tf::mesh point{{{1, 2, 3}}, {{0, 0, 0}}};
    CHECK(tools::pack({point, kind, region, number, {}}).steps == 1);
    const tf::mesh large{{{-1.7e308, 0, 0}, {1.7e308, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    CHECK(tools::pack({large, kind, region, number, {}}).size[0] == 1U << 22);
}

TEST_CASE("pages: texts cannot break out of their place") {
    CHECK(tools::escaped("<a href=\"x\">'&'") == "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;");
    tools::page page;
    page.title = "</title><script>";
    page.kinds = {{"</script>", "#000000", 1}};
    const std::string text = tools::html(page);
    CHECK(text.find("</title><script>") == std::string::npos);
    CHECK(text.find("[\"</script>") == std::string::npos);
}
