/// \file
/// Writes the small models of this folder: `generate DIRECTORY`.
///
/// Only operations that IEEE 754 rounds in one way (+ - * / sqrt) make coordinates, so that the
/// files are the same bytes on every machine. What is wrong with each model stands in expected.csv.

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using point = std::array<double, 3>;
using face = std::array<std::uint32_t, 3>;

struct model {
    std::vector<point> points;
    std::vector<face> faces;
};

// ---- shapes ----

model box(const point& low, const point& high) {
    model made;
    for (unsigned corner = 0; corner < 8; ++corner) {
        made.points.push_back({(corner & 1U) != 0 ? high[0] : low[0],
                               (corner & 2U) != 0 ? high[1] : low[1],
                               (corner & 4U) != 0 ? high[2] : low[2]});
    }
    made.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return made;
}

point on_unit_sphere(const point& p) {
    const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return {p[0] / length, p[1] / length, p[2] / length};
}

model icosahedron() {
    const double g = (1.0 + std::sqrt(5.0)) / 2.0;
    model made;
    for (const point& p : {point{-1, g, 0},
                           {1, g, 0},
                           {-1, -g, 0},
                           {1, -g, 0},
                           {0, -1, g},
                           {0, 1, g},
                           {0, -1, -g},
                           {0, 1, -g},
                           {g, 0, -1},
                           {g, 0, 1},
                           {-g, 0, -1},
                           {-g, 0, 1}}) {
        made.points.push_back(on_unit_sphere(p));
    }
    made.faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                  {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                  {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                  {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    return made;
}

/// Each triangle cut into four at the midpoints of its edges, which are moved onto the sphere.
model refined_on_sphere(const model& coarse) {
    model fine{coarse.points, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of_edge;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [entry, is_new] = middle_of_edge.try_emplace(
            std::minmax(a, b), static_cast<std::uint32_t>(fine.points.size()));
        if (is_new) {
            const point& p = coarse.points[a];
            const point& q = coarse.points[b];
            fine.points.push_back(on_unit_sphere({p[0] + q[0], p[1] + q[1], p[2] + q[2]}));
        }
        return entry->second;
    };
    for (const auto& [a, b, c] : coarse.faces) {
        const std::uint32_t ab = middle(a, b);
        const std::uint32_t bc = middle(b, c);
        const std::uint32_t ca = middle(c, a);
        for (const face& part : {face{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
            fine.faces.push_back(part);
        }
    }
    return fine;
}

model sphere(int refinements) {
    model made = icosahedron();
    for (int i = 0; i < refinements; ++i) made = refined_on_sphere(made);
    return made;
}

model moved(model shape, const point& by) {
    for (point& p : shape.points) p = {p[0] + by[0], p[1] + by[1], p[2] + by[2]};
    return shape;
}

/// Both, with nothing joined.
model together(model first, const model& second) {
    const auto offset = static_cast<std::uint32_t>(first.points.size());
    first.points.insert(first.points.end(), second.points.begin(), second.points.end());
    for (const auto& [a, b, c] : second.faces) {
        first.faces.push_back({a + offset, b + offset, c + offset});
    }
    return first;
}

/// A large horizontal triangle a million units from the origin, and one that stands on its tip
/// `steps` least steps of a double above that plane (below it when negative).
model tip_near_plane(int steps) {
    const double plane = 1048576.0;
    double tip = plane;
    for (int i = 0; i < std::abs(steps); ++i) {
        tip = std::nextafter(tip, steps > 0 ? 2.0 * plane : 0.0);
    }
    return {{{0, 0, plane},
             {8, 0, plane},
             {0, 8, plane},
             {2, 2, tip},
             {3, 2, plane + 4.0},
             {2, 3, plane + 4.0}},
            {{0, 1, 2}, {3, 4, 5}}};
}

// ---- files ----

template <class Number>
std::string text_of(Number value) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return {buffer.data(), end};
}

template <class Number>
std::string text_of(const point& p) {
    std::string text = text_of(static_cast<Number>(p[0]));
    text += ' ' + text_of(static_cast<Number>(p[1]));
    return text + ' ' + text_of(static_cast<Number>(p[2]));
}

template <class Number>
void append_little_endian(std::string& bytes, Number value) {
    std::array<std::uint8_t, sizeof(Number)> raw{};
    std::memcpy(raw.data(), &value, sizeof value);
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(raw);
    for (const std::uint8_t byte : raw) bytes += static_cast<char>(byte);
}

std::string stl_ascii(const model& shape) {
    std::string text = "solid model\n";
    for (const face& corners : shape.faces) {
        text += "facet normal 0 0 0\n outer loop\n";
        for (const auto v : corners) text += "  vertex " + text_of<float>(shape.points[v]) + '\n';
        text += " endloop\nendfacet\n";
    }
    return text + "endsolid model\n";
}

std::string stl_binary(const model& shape) {
    std::string bytes(80, '\0');
    append_little_endian(bytes, static_cast<std::uint32_t>(shape.faces.size()));
    for (const face& corners : shape.faces) {
        for (int i = 0; i < 3; ++i) append_little_endian(bytes, 0.0F);
        for (const auto v : corners) {
            for (const double x : shape.points[v]) {
                append_little_endian(bytes, static_cast<float>(x));
            }
        }
        append_little_endian(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::string obj(const model& shape) {
    std::string text;
    for (const point& p : shape.points) text += "v " + text_of<double>(p) + '\n';
    for (const auto& [a, b, c] : shape.faces) {
        text += "f " + text_of(a + 1) + ' ' + text_of(b + 1) + ' ' + text_of(c + 1) + '\n';
    }
    return text;
}

std::string off(const model& shape) {
    std::string text =
        "OFF\n" + text_of(shape.points.size()) + ' ' + text_of(shape.faces.size()) + " 0\n";
    for (const point& p : shape.points) text += text_of<double>(p) + '\n';
    for (const auto& [a, b, c] : shape.faces) {
        text += "3 " + text_of(a) + ' ' + text_of(b) + ' ' + text_of(c) + '\n';
    }
    return text;
}

template <class Number>
std::string ply(const model& shape) {
    const std::string number = std::is_same_v<Number, float> ? "float" : "double";
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex ";
    bytes += text_of(shape.points.size()) + '\n';
    for (const char axis : {'x', 'y', 'z'}) bytes += "property " + number + ' ' + axis + '\n';
    bytes += "element face " + text_of(shape.faces.size());
    bytes += "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const point& p : shape.points) {
        for (const double x : p) append_little_endian(bytes, static_cast<Number>(x));
    }
    for (const face& corners : shape.faces) {
        append_little_endian(bytes, std::uint8_t{3});
        for (const auto v : corners) append_little_endian(bytes, v);
    }
    return bytes;
}

void write_file(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) throw std::runtime_error("cannot write " + path.string());
}

// ---- the models ----

void write_clean(const std::filesystem::path& folder) {
    const model cube = box({0, 0, 0}, {1, 1, 1});
    write_file(folder / "cube.stl", stl_ascii(cube));
    write_file(folder / "sphere.ply", ply<float>(sphere(3)));
    write_file(folder / "nested_cubes.obj",
               obj(together(cube, box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}))));
    write_file(folder / "above_by_one_ulp.ply", ply<double>(tip_near_plane(1)));
}

void write_intersecting(const std::filesystem::path& folder) {
    const model ball = sphere(2);
    write_file(folder / "two_spheres.stl", stl_binary(together(ball, moved(ball, {1, 0.25, 0}))));
    write_file(folder / "through_by_one_ulp.ply", ply<double>(tip_near_plane(-1)));
    write_file(folder / "pierce.obj", obj({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -2}, {1, 1, 2}},
                                           {{0, 1, 2}, {0, 3, 4}}}));
}

void write_coplanar(const std::filesystem::path& folder) {
    const model cube = box({0, 0, 0}, {1, 1, 1});
    write_file(folder / "fold.obj",
               obj({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.5, 0}}, {{0, 1, 2}, {1, 0, 3}}}));
    write_file(folder / "stacked_cubes.off",
               off(together(cube, box({0.25, 0.25, 1}, {0.5, 0.5, 2}))));
    model doubled = cube;
    doubled.faces.push_back({0, 1, 2});  // the first face, seen from the other side
    write_file(folder / "duplicate_face.obj", obj(doubled));
}

void write_touching(const std::filesystem::path& folder) {
    const model cube = box({0, 0, 0}, {1, 1, 1});
    write_file(folder / "cubes_on_an_edge.stl",
               stl_ascii(together(cube, box({1, 1, 0.25}, {2, 2, 0.75}))));
    write_file(folder / "on_the_plane.ply", ply<double>(tip_near_plane(0)));
    model sliver = cube;  // one edge of the cube is a triangle without area as well
    sliver.points.push_back({0.5, 0, 0});
    sliver.faces.push_back({0, 8, 1});
    write_file(folder / "no_area.stl", stl_ascii(sliver));
}

/// Holes, faces that are turned, and a triangle that belongs to nothing.
void write_dirty(const std::filesystem::path& folder) {
    model ball = sphere(3);
    for (std::size_t f = 200; f < 240; ++f) std::swap(ball.faces[f][1], ball.faces[f][2]);
    ball.faces.erase(ball.faces.begin() + 700, ball.faces.begin() + 704);
    ball.faces.erase(ball.faces.begin() + 100);
    write_file(
        folder / "dirty.stl",
        stl_binary(together(ball, {{{3, 0, 0}, {3.125, 0, 0}, {3, 0.125, 0}}, {{0, 1, 2}}})));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "Usage: generate DIRECTORY\n";
        return 2;
    }
    try {
        const std::filesystem::path folder = argv[1];
        std::filesystem::create_directories(folder);
        write_clean(folder);
        write_intersecting(folder);
        write_coplanar(folder);
        write_touching(folder);
        write_dirty(folder);
    } catch (const std::exception& error) {
        std::cerr << "generate: " << error.what() << '\n';
        return 4;
    }
    return 0;
}
