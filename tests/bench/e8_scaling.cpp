/// \file
/// E8: how time and memory of each operation grow with the size of its input.

#include "bench/accuracy.hpp"
#include "bench/workload.hpp"
#include <libmesh/boolean/boolean.hpp>
#include <libmesh/face_tree.hpp>
#include <libmesh/intersect/self_intersections.hpp>
#include <libmesh/io/read.hpp>
#include <libmesh/io/write.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <libmesh/nearness/mesh_distance.hpp>
#include <libmesh/place/first_contact.hpp>
#include <libmesh/repair/repair.hpp>
#include <libmesh/weld/weld_points.hpp>
#include <libtree/point_search.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>

namespace tf::bench {
namespace {

using shared_mesh = std::shared_ptr<const mesh>;

/// A closed ring with a rippled surface, of about `faces` triangles, as dense one way as the other.
mesh ring(std::size_t faces) {
    const auto around = static_cast<std::uint32_t>(
        std::max(8.0, std::round(std::sqrt(static_cast<double>(faces) * 1.25))));
    const auto across = static_cast<std::uint32_t>(
        std::max(6.0, std::round(static_cast<double>(faces) / 2 / around)));
    mesh result;
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around;
            const double v = 2 * std::numbers::pi * j / across;
            const double r = 0.4 + 0.02 * std::sin(7 * u) * std::sin(5 * v);
            result.points.push_back({(1 + r * std::cos(v)) * std::cos(u),
                                     (1 + r * std::cos(v)) * std::sin(u), r * std::sin(v)});
            const auto at = [&](std::uint32_t x, std::uint32_t y) {
                return x % around * across + y % across;
            };
            result.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            result.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return result;
}

mesh moved(mesh m, const point3& by) {
    for (point3& p : m.points) p = {p.x + by.x, p.y + by.y, p.z + by.z};
    return m;
}

mesh together(mesh a, const mesh& b) {
    const auto points = static_cast<std::uint32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const face& f : b.faces) a.faces.push_back({f[0] + points, f[1] + points, f[2] + points});
    return a;
}

shared_mesh shared(mesh m) { return std::make_shared<const mesh>(std::move(m)); }

/// An operation on about n triangles or points, and how many it is tried on at most.
struct operation {
    std::string name;
    std::size_t most = 10'000'000;
    std::function<job(std::size_t)> prepare;
};

/// `run` of a ring of n triangles.
template <class Run>
operation of_ring(std::string name, Run run, std::size_t most = 10'000'000) {
    return {std::move(name), most, [run](std::size_t n) {
                return make_job([given = shared(ring(n)), run] { return run(*given); });
            }};
}

/// `run` of two linked rings of n / 2 triangles each that pass through each other.
template <class Run>
operation of_two(std::string name, Run run, std::size_t most) {
    return {std::move(name), most, [run](std::size_t n) {
                const auto a = shared(ring(n / 2));
                const auto b = shared(moved(*a, {0.31, 0.17, 0.23}));
                return make_job([=] { return run(*a, *b); });
            }};
}

operation of_files(const setting& setting) {
    return {"write and read STL", 10'000'000, [folder = setting.cache_dir](std::size_t n) {
                auto given = std::make_shared<mesh_file>();
                given->mesh = ring(n);
                return make_job([given, path = folder + "/scaling.stl"] {
                    write_mesh(path, *given);
                    mesh_file file = read_mesh(path);
                    std::filesystem::remove(path);
                    return file;
                });
            }};
}

std::vector<operation> operations(const setting& setting) {
    constexpr std::size_t million = 1'000'000;
    return {
        of_ring("tree of faces", [](const mesh& m) { return face_tree(m); }),
        of_ring("self-intersections", [](const mesh& m) { return self_intersections(m); }),
        of_ring("weld", [](const mesh& m) { return weld_points(m.points, {.tolerance = 1e-5}); }),
        of_ring("10 nearest of each point",
                [](const mesh& m) {
                    const point_search<3> search(m.points);
                    std::vector<std::array<double, 3>> queries;
                    for (const point3& p : m.points) queries.push_back({p.x, p.y, p.z});
                    return search.k_nearest(std::span(queries), 10).neighbors.size();
                }),
        of_ring("nearest face of each point",
                [](const mesh& m) {
                    return closest_point_query(m).nearest(std::span(m.points)).size();
                }),
        of_files(setting),
        of_two(
            "union",
            [](const mesh& a, const mesh& b) {
                const std::array<mesh_view, 2> both{a, b};
                return boolean(both, boolean_expression::union_of(2));
            },
            million),
        of_two(
            "repair", [](const mesh& a, const mesh& b) { return repair(together(a, b)); }, million),
        of_two(
            "first contact",
            [](const mesh& a, const mesh& b) {
                return first_contact(moved(a, {0, 0, 3}), b, {0, 0, -1});
            },
            10 * million),
        of_two(
            "distance",
            [](const mesh& a, const mesh& b) {
                return mesh_distance(moved(a, {0, 0, 3}), b);
            },
            10 * million)};
}

/// The slope of the best line through the logarithms of the points from a size on.
std::string exponent_of(const std::vector<std::array<double, 2>>& points, double from) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const auto& [x, y] : points) {
        if (x < from || !(y > 0)) continue;
        const double lx = std::log(x), ly = std::log(y);
        n += 1, sx += lx, sy += ly, sxx += lx * lx, sxy += lx * ly;
    }
    if (n < 2) return "-";
    return fmt::format("{:.2f}", (n * sxy - sx * sy) / (n * sxx - sx * sx));
}

std::vector<curve> curves_of(const std::vector<outcome>& outcomes,
                             const std::function<double(const measured&)>& value) {
    std::vector<curve> curves;
    for (const outcome& outcome : outcomes)
        for (const measured& row : outcome.rows) {
            auto found = std::ranges::find(curves, row.who, &curve::name);
            if (found == curves.end()) {
                curves.push_back(
                    {row.who, {}, static_cast<int>(curves.size() % 8) + 1, curves.size() >= 8});
                found = std::prev(curves.end());
            }
            if (const double y = value(row); y > 0)
                found->points.push_back({static_cast<double>(outcome.size), y});
        }
    return curves;
}

}  // namespace

void scaling(const setting& setting, const contest_visitor& visit) {
    std::vector<std::size_t> sizes{1'000, 10'000, 100'000, 1'000'000, 10'000'000};
    if (setting.effort == effort::quick) sizes.resize(3);
    if (setting.effort == effort::tiny) sizes = {200, 1'000};
    for (const std::size_t size : sizes) {
        contest contest{.name = fmt::format("{}", size),
                        .size = [=] { return size; },
                        .long_runs = size < 10'000'000 ? 3 : 1};
        for (const operation& operation : operations(setting))
            if (size <= operation.most)
                contest.contestants.push_back(
                    {operation.name, 1,
                     [size, prepare = operation.prepare] { return prepare(size); }});
        visit(contest);
    }
}

section draw_scaling(const std::vector<outcome>& outcomes, const std::string& machine) {
    const auto times = curves_of(outcomes, [](const measured& row) { return 1e3 * row.median; });
    const auto peaks =
        curves_of(outcomes, [](const measured& row) { return row.peak_mb.value_or(0); });
    std::vector<std::vector<std::string>> table{{"", "time ~ n^", "memory ~ n^"}};
    for (const outcome& outcome : outcomes) table[0].push_back("ms, " + outcome.name);
    for (std::size_t i = 0; i < times.size(); ++i) {
        std::vector<std::string> cells{times[i].name, exponent_of(times[i].points, 1e4),
                                       exponent_of(peaks[i].points, 1e5)};
        for (const outcome& outcome : outcomes) {
            const auto ms = outcome.value(times[i].name);
            cells.push_back(ms ? fmt::format("{:.3g}", *ms) : "-");
        }
        table.push_back(std::move(cells));
    }
    const auto chart = [&](const char* title, const char* label, const std::vector<curve>& curves) {
        line_chart lines;
        lines.caption = {title, machine};
        lines.x = {"triangles (points: half as many)", true};
        lines.y = {label, true};
        lines.curves = curves;
        return svg(lines);
    };
    return {
        .paper = "",
        .ours = "Operations from arrays to arrays on one thread, a rippled ring or two of them.",
        .pictures = {{"e8_time.svg", chart("Time by size, one thread", "time, ms", times)},
                     {"e8_memory.svg", chart("Peak memory by size, input included", "MB", peaks)}},
        .table = std::move(table),
        .remarks = {
            "The exponents are slopes of the best line through the logarithms, of time from "
            "10^4 triangles on, of memory from 10^5: below that, what a process takes anyway "
            "outweighs the rest. 1 is in proportion to the size; n log n looks like 1.05 to 1.1 "
            "over these sizes, and what no longer fits into the caches, from some 10^5 "
            "triangles on, adds about as much once."}};
}

}  // namespace tf::bench
