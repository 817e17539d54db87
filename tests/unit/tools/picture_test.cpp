#include "tools/picture/font.hpp"
#include "tools/picture/scene.hpp"
#include "tools/picture/sheet.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace {

using tools::rgb;
using tools::view;

/// A scene with a mesh for each color; all are context unless they are `found`.
struct made_scene {
    std::vector<tf::mesh> meshes{};  // first, as the scene looks at them
    tools::scene shown{};

    void add(tf::mesh mesh, const char* color, bool found = false, bool ghost = false) {
        shown.classes.push_back({"class", color, "", !found});
        kinds.push_back({static_cast<std::uint8_t>(meshes.size())});
        ghosts.push_back(ghost);
        meshes.push_back(std::move(mesh));
        shown.meshes.clear();
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            tools::scene_mesh m{.mesh = meshes[i], .kind = kinds[i]};
            m.ghost = ghosts[i];
            shown.meshes.push_back(std::move(m));
        }
    }
    std::vector<std::vector<std::uint8_t>> kinds{};
    std::vector<bool> ghosts{};
};

/// A square around (0, 0) that faces up, at a height.
tf::mesh square(double half, double z) {
    return {{{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}},
            {{0, 1, 2}, {0, 2, 3}}};
}

tools::picture drawn(const tools::scene& shown, view from = view::top, std::size_t width = 160,
                     std::size_t height = 120) {
    return tools::draw(shown, {.width = width, .height = height, .views = {from}});
}

/// Off the middle, which is on an edge.
rgb at_middle(const tools::picture& p) { return p.at(p.width / 2 + 3, p.height / 2 + 9); }

bool is_red(const rgb& c) { return c[0] > 150 && c[1] < 60 && c[2] < 60; }
bool is_green(const rgb& c) { return c[1] > 150 && c[0] < 60 && c[2] < 60; }
bool is_blue(const rgb& c) { return c[2] > 150 && c[0] < 60 && c[1] < 60; }

std::size_t count(const tools::picture& p, bool (*fits)(const rgb&)) {
    return static_cast<std::size_t>(std::count_if(p.pixels.begin(), p.pixels.end(), fits));
}

}  // namespace

TEST_CASE("picture: what is nearer hides what is behind it, in whatever order they come") {
    for (const bool red_first : {true, false}) {
        CAPTURE(red_first);
        made_scene s;
        if (red_first) s.add(square(1, 1), "#ff0000");
        s.add(square(1, 0), "#0000ff");
        if (!red_first) s.add(square(1, 1), "#ff0000");
        CHECK(is_red(at_middle(drawn(s.shown, view::top))));
        CHECK(count(drawn(s.shown, view::top), is_blue) == 0);
        // From below one sees the backs, darker.
        const rgb below = at_middle(drawn(s.shown, view::bottom));
        CHECK(below[0] < 10);
        CHECK(below[2] > 100);
    }
}

TEST_CASE("picture: faces that cross are each in front where they are") {
    made_scene s;
    s.add({{{-1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, -1}}, {{0, 1, 2}, {0, 2, 3}}}, "#ff0000");
    s.add({{{-1, -1, 1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, 1}}, {{0, 1, 2}, {0, 2, 3}}}, "#0000ff");
    const tools::picture p = drawn(s.shown);
    const auto redder = [&](std::size_t x) { return p.at(x, 70)[0] > p.at(x, 70)[2]; };
    for (std::size_t x = 32; x < 128; ++x)
        if (x < 78 || x > 81) CHECK_MESSAGE(redder(x) == (x > 80), x);
}

TEST_CASE("picture: each view sees the side of its name") {
    const std::array<std::pair<view, tf::point3>, 6> sides{{{view::front, {0, -1, 0}},
                                                            {view::back, {0, 1, 0}},
                                                            {view::left, {-1, 0, 0}},
                                                            {view::right, {1, 0, 0}},
                                                            {view::top, {0, 0, 1}},
                                                            {view::bottom, {0, 0, -1}}}};
    for (const auto& [name, side] : sides) {
        const view from = name;
        CAPTURE(static_cast<int>(from));
        made_scene s;
        for (const auto& [other, out] : sides) {  // the corners of an octahedron, cut off
            const tf::point3 u{out.y, out.z, out.x}, v{out.z, out.x, out.y};
            tf::mesh mesh;
            for (const auto& [a, b] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
                mesh.points.push_back({out.x + 0.5 * (a * u.x + b * v.x),
                                       out.y + 0.5 * (a * u.y + b * v.y),
                                       out.z + 0.5 * (a * u.z + b * v.z)});
            mesh.faces = {{0, 1, 2}, {0, 2, 3}};
            s.add(mesh, other == from ? "#ff0000" : "#0000ff");
        }
        const rgb c = at_middle(drawn(s.shown, from));
        CHECK(c[0] > 120);
        CHECK(c[2] < 10);
    }
}

TEST_CASE("picture: y is up where the scene says so") {
    made_scene s;
    s.add({{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}}, {{0, 2, 1}, {0, 3, 2}}}, "#ff0000");
    s.add({{{-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 2, 3}}},
          "#0000ff");
    s.shown.y_is_up = true;
    CHECK(is_red(at_middle(drawn(s.shown, view::top))));
}

TEST_CASE("picture: there is no gap between faces that share an edge") {
    made_scene s;
    tf::mesh fan;
    fan.points.push_back({0.1, 0.07, 0});
    constexpr std::uint32_t corners = 97;
    for (std::uint32_t i = 0; i < corners; ++i)  // a square's rim, unevenly
        fan.points.push_back(i < 24   ? tf::point3{-1 + i / 12.0, -1, 0}
                             : i < 48 ? tf::point3{1, -1 + (i - 24) / 12.0, 0}
                             : i < 72 ? tf::point3{1 - (i - 48) / 12.0, 1, 0}
                                      : tf::point3{-1, 1 - (i - 72) / 12.5, 0});
    for (std::uint32_t i = 0; i < corners; ++i)
        fan.faces.push_back({0, 1 + i, 1 + (i + 1) % corners});
    s.add(std::move(fan), "#ff0000");
    const tools::picture p = drawn(s.shown);
    for (std::size_t y = 20; y < 100; ++y)
        for (std::size_t x = 40; x < 120; ++x) {
            REQUIRE(p.at(x, y)[0] > 120);
            REQUIRE(p.at(x, y)[1] < 10);
        }
}

TEST_CASE("picture: what was found shines faintly through what hides it") {
    made_scene s;
    s.add(square(1, 1), "#b4bac2");
    const rgb without = at_middle(drawn(s.shown));
    s.add(square(0.5, 0), "#ff0000", true);
    const rgb with = at_middle(drawn(s.shown));
    CHECK(with[1] < without[1]);
    CHECK(with[1] > without[1] / 2);
    CHECK(with[0] > without[0]);
    s.shown.classes[1].context = true;
    CHECK(at_middle(drawn(s.shown)) == without);
    s.shown.classes[1] = {"hidden", "#ff0000", "", false, false};
    CHECK(at_middle(drawn(s.shown)) == without);
}

TEST_CASE("picture: what was found is seen however small it is") {
    for (const double size : {1e-3, 1e-6, 0.0}) {
        CAPTURE(size);
        made_scene s;
        s.add(square(1, 0), "#b4bac2");
        s.add(
            {{{0.31, 0.32, 0.1}, {0.31 + size, 0.32, 0.1}, {0.31, 0.32 + size, 0.1}}, {{0, 1, 2}}},
            "#ff0000", true);
        const tools::picture p = drawn(s.shown, view::top, 640, 480);
        const auto reddish = [](const rgb& c) { return c[0] > c[1] + 50; };
        CHECK(count(p, reddish) >= 9);
        CHECK(count(p, reddish) < 100);
    }
}

TEST_CASE("picture: a line in a face is seen, one behind it faintly, dots alike") {
    made_scene s;
    s.add(square(1, 0), "#ffffff");
    s.shown.classes.push_back({"lines", "#00ff00"});
    for (const double z : {0.0, -1.0}) {
        CAPTURE(z);
        tools::scene_lines line{.kind = 1, .ends = {{{{-0.5, -0.3, z}, {0.5, -0.3, z}}}}};
        line.width = 6.0;
        tools::scene with = s.shown;
        with.lines.push_back(line);
        const tools::picture p = drawn(with);
        CHECK((count(p, is_green) > 50) == (z == 0.0));
        const auto greenish = [](const rgb& c) { return c[1] > c[0] + 40; };
        CHECK(count(p, greenish) > 50);
        with = s.shown;
        with.dots.push_back({.points = {{0.3, 0.3, z}}, .kind = {1}});
        CHECK((count(drawn(with), is_green) > 5) == (z == 0.0));
        CHECK(count(drawn(with), greenish) > 5);
    }
}

TEST_CASE("picture: one sees through ghosts, in front of things only") {
    made_scene s;
    s.add(square(1, 0), "#ff0000");
    const rgb plain = at_middle(drawn(s.shown));
    s.add(square(0.5, 1), "#0000ff", false, true);
    const rgb above = at_middle(drawn(s.shown));
    CHECK(above[0] > 120);
    CHECK(above[2] > plain[2] + 30);
    made_scene t;
    t.add(square(1, 0), "#ff0000");
    t.add(square(0.5, -1), "#0000ff", false, true);
    CHECK(at_middle(drawn(t.shown)) == plain);
}

TEST_CASE("picture: values have the colors of the map, those within the band are green") {
    made_scene s;
    s.add(square(1, 0), "#808080");
    s.shown.map = {.name = "distance", .low = 0, .high = 1, .colors = {"#0000ff", "#ff0000"}};
    s.shown.meshes[0].value = {0, 1, 1, 0};
    const tools::picture p = drawn(s.shown);
    CHECK(is_blue(p.at(30, 60)));
    CHECK(is_red(p.at(130, 61)));
    s.shown.map->band = {{0.0, 0.3}};
    const rgb within = drawn(s.shown).at(30, 60);
    CHECK(within[1] > within[0]);
    CHECK(within[1] > within[2]);
    s.shown.meshes[0].value[0] = std::numeric_limits<double>::quiet_NaN();
    const rgb none = drawn(s.shown).at(30, 90);
    CHECK(none[0] == none[2]);
}

TEST_CASE("picture: the same bytes for any number of threads") {
    made_scene s;
    for (int i = 0; i < 40; ++i)
        s.add(square(1.0 - 0.02 * i, 0.05 * i), i % 2 ? "#ff0000" : "#00ff00");
    std::vector<std::string> files;
    for (const unsigned threads : {1U, 2U, 3U}) {
        const tf::thread_scope scope(threads);
        files.push_back(tools::png(
            tools::draw(s.shown, {.width = 500, .height = 400, .views = {view::iso, view::top}})));
    }
    CHECK(files[0] == files[1]);
    CHECK(files[0] == files[2]);
    CHECK(files[0].starts_with("\x89PNG\r\n\x1a\n"));
}

TEST_CASE("picture: a scene of nothing, of a point, of huge and of tiny numbers") {
    CHECK(drawn({}).pixels.size() == 160 * 120);
    made_scene s;
    s.add({{{5, 5, 5}}, {{0, 0, 0}}}, "#ff0000");
    CHECK(drawn(s.shown).pixels.size() == 160 * 120);
    for (const double size : {1e308, 1e-308, 1e-320}) {
        CAPTURE(size);
        made_scene t;
        t.add(square(size, 0), "#ff0000");
        t.meshes[0].points.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
        t.shown.meshes[0].mesh = t.meshes[0];
        if (size > 1e-300) CHECK(is_red(at_middle(drawn(t.shown))));
        CHECK(drawn(t.shown, view::iso, 400, 300).pixels.size() == 400 * 300);
    }
}

TEST_CASE("picture: title, verdict and legend are there, each in its color") {
    made_scene s;
    s.add(square(1, 0), "#0000ff");
    s.shown.title = "part.stl";
    s.shown.verdict = "two pairs";
    const tools::picture p = drawn(s.shown, view::top, 640, 480);
    const auto dark = [](const rgb& c) { return c[0] < 120 && c[1] < 120 && c[2] < 120; };
    const auto reds = [](const rgb& c) { return c[0] > 150 && c[1] < 90; };
    tools::picture top(640, 50);
    std::copy_n(p.pixels.begin(), top.pixels.size(), top.pixels.begin());
    CHECK(count(top, dark) > 50);
    CHECK(count(top, reds) > 50);
    tools::picture below(640, 40);
    std::copy(p.pixels.end() - 640 * 40, p.pixels.end(), below.pixels.begin());
    CHECK(std::count(below.pixels.begin(), below.pixels.end(), rgb{0, 0, 255}) >= 36);
    s.shown.good = true;
    const tools::picture good = drawn(s.shown, view::top, 640, 480);
    std::copy_n(good.pixels.begin(), top.pixels.size(), top.pixels.begin());
    CHECK(count(top, reds) == 0);
}

TEST_CASE("picture: before and after are beside each other") {
    made_scene s;
    s.add(square(1, 0), "#ff0000");
    s.add(square(1, 0), "#0000ff");
    s.shown.meshes[0].variant = "before";
    s.shown.meshes[1].variant = "after";
    const tools::picture p = drawn(s.shown, view::top, 200, 100);
    CHECK(is_red(p.at(55, 60)));
    CHECK(is_blue(p.at(155, 60)));
}

TEST_CASE("letters: every one has its own shape, and long texts are cut") {
    std::vector<std::vector<rgb>> shapes;
    for (char c = '!'; c <= '~'; ++c) {
        tools::picture p(40, 40);
        tools::draw_text(p, {8, 28}, std::string(1, c), 18, tools::ink);
        CHECK_MESSAGE(std::find(shapes.begin(), shapes.end(), p.pixels) == shapes.end(), c);
        shapes.push_back(p.pixels);
    }
    CHECK(tools::text_width("\xc3\xa9", 9) == tools::text_width("\xe2\x82\xac", 9));
    const std::string cut = tools::shortened("\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9 a long name", 9, 24);
    CHECK(cut.ends_with("..."));
    CHECK(tools::text_width(cut, 9) <= 24);
    CHECK(cut.size() % 2 == 1);  // no letter is cut in two
}
