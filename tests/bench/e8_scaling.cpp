/// \file
/// E8: how time and memory of each tool, and of what no tool does, grow with the size of the input.

#include "bench/accuracy.hpp"
#include "bench/scaling_inputs.hpp"
#include "bench/tool_run.hpp"
#include "bench/workload.hpp"
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/tree/point_search.hpp>

#include <fmt/core.h>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace treeform::bench {
namespace {

constexpr const char* tools_prefix = "tools/";
constexpr const char* library_prefix = "library/";

/// A tool, what it is asked, and of how many elements at most.
struct command {
    std::string name;
    std::string tool;
    std::vector<std::string> (*arguments)(const scaling_files&);
    std::size_t most = 10'000'000;
};

const std::array commands{
    command{"tf-selfintersect", "tf-selfintersect",
            [](const scaling_files& f) { return std::vector{f.both}; }},
    command{"tf-selfintersect --repair", "tf-selfintersect",
            [](const scaling_files& f) {
                return std::vector<std::string>{"--repair", f.both};
            }},
    command{"tf-repair", "tf-repair", [](const scaling_files& f) { return std::vector{f.both}; }},
    command{"tf-boolean union", "tf-boolean",
            [](const scaling_files& f) {
                return std::vector<std::string>{"union", f.first, f.second};
            }},
    command{"tf-weld mesh", "tf-weld",
            [](const scaling_files& f) {
                return std::vector<std::string>{"-t", "1e-6", f.soup};
            }},
    command{"tf-weld cloud", "tf-weld",
            [](const scaling_files& f) {
                return std::vector<std::string>{"-t", fmt::format("{}", f.reach), f.cloud};
            }},
    command{"tf-place drop", "tf-place",
            [](const scaling_files& f) {
                return std::vector<std::string>{"drop", f.both};
            }},
    command{"tf-place slide", "tf-place",
            [](const scaling_files& f) {
                return std::vector<std::string>{"slide", f.above, "--fixed", f.second};
            }},
    command{"tf-place measure", "tf-place", [](const scaling_files& f) {
                return std::vector<std::string>{"measure", f.above, "--fixed", f.second};
            }}};

contest contest_of_tools(const setting& setting, std::size_t size) {
    contest contest{.name = fmt::format("{}{}", tools_prefix, size),
                    .size = [=] { return size; },
                    .with_memory = false,
                    .long_runs = size < 1'000'000 ? 3 : 1};
    for (const command& command : commands)
        if (size <= command.most)
            contest.contestants.push_back({command.name, 1, [setting, size, command] {
                                               const auto files = files_of_size(setting, size);
                                               return tool_job(command.tool,
                                                               command.arguments(*files),
                                                               files->output(command.name), files);
                                           }});
    return contest;
}

/// The job that calls `run` with a ring of n triangles.
template <class Run>
contestant of_ring(std::string name, std::size_t n, Run run) {
    return {std::move(name), 1, [=] {
                return make_job(
                    [given = std::make_shared<const mesh>(ring(n)), run] { return run(*given); });
            }};
}

contest contest_of_library(std::size_t size) {
    return {
        .name = fmt::format("{}{}", library_prefix, size),
        .size = [=] { return size; },
        .contestants = {of_ring("tree of faces", size,
                                [](const mesh& m) { return build_face_tree(m); }),
                        of_ring("10 nearest of each point", size,
                                [](const mesh& m) {
                                    const point_search<3> search(m.points);
                                    std::vector<std::array<double, 3>> queries;
                                    for (const point3& p : m.points)
                                        queries.push_back({p.x, p.y, p.z});
                                    return search.k_nearest(std::span(queries), 10).answers.size();
                                }),
                        of_ring("nearest face of each point", size,
                                [](const mesh& m) {
                                    return detail::nearness::closest_point_query(m)
                                        .nearest(std::span(m.points))
                                        .size();
                                }),
                        of_ring("distance of two rings", size / 2,
                                [](const mesh& m) {
                                    return closest_pair(m, test::moved(m, {0, 0, 3}));
                                })},
        .long_runs = size < 1'000'000 ? 3 : 1};
}

/// The slope of the best line through the logarithms of the last three points.
std::optional<double> exponent_of(const curve& curve) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    const std::size_t count = curve.points.size();
    for (std::size_t i = count < 3 ? 0 : count - 3; i < count; ++i) {
        const double x = std::log(curve.points[i][0]), y = std::log(curve.points[i][1]);
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    if (n < 2) return {};
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// A curve for each contestant of the contests whose name begins with `prefix`.
std::vector<curve> curves_of(const std::vector<outcome>& outcomes, const std::string& prefix,
                             const std::function<double(const measured&)>& value) {
    std::vector<curve> curves;
    for (const outcome& outcome : outcomes) {
        if (!outcome.name.starts_with(prefix)) continue;
        for (const measured& row : outcome.rows) {
            auto found = std::ranges::find(curves, row.who, &curve::name);
            if (found == curves.end()) {
                curves.push_back({row.who,
                                  {},
                                  static_cast<int>(curves.size()) % 8 + 1,
                                  curves.size() >= 8});  // there are 8 colors
                found = std::prev(curves.end());
            }
            if (const double y = value(row); y > 0)
                found->points.push_back({static_cast<double>(outcome.size), y});
        }
    }
    return curves;
}

std::string exponent_text(const curve& curve) {
    const auto exponent = exponent_of(curve);
    return exponent ? fmt::format("{:.2f}", *exponent) : "-";
}

struct growth {
    std::vector<curve> times, peaks;  ///< of the same contestants
};

growth growth_of(const std::vector<outcome>& outcomes, const std::string& prefix) {
    return {
        curves_of(outcomes, prefix, [](const measured& row) { return 1e3 * row.median; }),
        curves_of(outcomes, prefix, [](const measured& row) { return row.peak_mb.value_or(0); })};
}

std::string value_at(const curve& curve, double size) {
    for (const auto& [x, y] : curve.points)
        if (x == size) return fmt::format("{:.3g}", y);
    return "-";
}

void add_rows(std::vector<std::vector<std::string>>& table, const growth& growth,
              const std::vector<double>& sizes) {
    for (std::size_t i = 0; i < growth.times.size(); ++i) {
        std::vector<std::string> cells{growth.times[i].name, exponent_text(growth.times[i]),
                                       exponent_text(growth.peaks[i])};
        for (const double size : sizes)
            cells.push_back(value_at(growth.times[i], size) + " ms, " +
                            value_at(growth.peaks[i], size) + " MB");
        table.push_back(std::move(cells));
    }
}

std::vector<picture> pictures_of(const growth& growth, const std::string& name,
                                 const std::string& title, const std::string& machine) {
    const auto chart = [&](const std::string& words, const char* label, std::vector<curve> curves) {
        for (curve& curve : curves) curve.name += ", n^" + exponent_text(curve);
        line_chart lines;
        lines.caption = {words, machine};
        lines.x = {"n, triangles or points", true};
        lines.y = {label, true};
        lines.curves = std::move(curves);
        return svg(lines);
    };
    return {
        {"e8_" + name + "_time.svg",
         chart(title + ": time by size, one thread", "time, ms", growth.times)},
        {"e8_" + name + "_memory.svg", chart(title + ": peak memory by size", "MB", growth.peaks)}};
}

}  // namespace

void scaling(const setting& setting, const contest_visitor& visit) {
    std::vector<std::size_t> sizes{1'000, 10'000, 100'000, 1'000'000, 10'000'000};
    if (setting.effort == effort::quick) sizes.resize(3);
    if (setting.effort == effort::tiny) sizes = {200, 1'000};
    for (const std::size_t size : sizes) visit(contest_of_tools(setting, size));
    for (const std::size_t size : sizes) visit(contest_of_library(size));
}

section draw_scaling(const std::vector<outcome>& outcomes, const std::string& machine) {
    std::vector<double> sizes;
    std::vector<std::vector<std::string>> table{{"", "time ~ n^", "memory ~ n^"}};
    for (const outcome& outcome : outcomes)
        if (outcome.name.starts_with(tools_prefix)) {
            sizes.push_back(static_cast<double>(outcome.size));
            table[0].push_back("n = " + outcome.name.substr(std::string(tools_prefix).size()));
        }
    const growth tools = growth_of(outcomes, tools_prefix);
    const growth library = growth_of(outcomes, library_prefix);
    add_rows(table, tools, sizes);
    add_rows(table, library, sizes);
    std::vector<picture> pictures = pictures_of(tools, "tools", "Tools", machine);
    for (picture& more : pictures_of(library, "library", "Library", machine))
        pictures.push_back(std::move(more));
    return {
        .paper = "",
        .ours =
            "Tools from files to files, each a process of its own, and what the library does "
            "and no tool, from arrays to arrays; all on one thread. Exponents are of the "
            "three largest sizes.",
        .pictures = std::move(pictures),
        .table = std::move(table),
        .remarks = {
            "tf-selfintersect reads two rippled rings that are linked and pass through each other, "
            "in one mesh of n triangles, and writes it with its faces colored; --repair and "
            "tf-repair cut them and keep the outside. tf-boolean union does the same to two "
            "meshes, tf-place slide "
            "moves one down onto the other, tf-place measure says how far they are, tf-place drop "
            "lets both down to the bed. tf-weld "
            "indexes a binary STL of n triangles and merges a cloud of n points, 30 % of them "
            "copies, at a tolerance of a quarter of what they have between them. Starting the "
            "process, reading and writing are in the figures; files lie in the page cache.",
            "The exponents are slopes of the best line through the logarithms of the last three "
            "sizes: below them, what a process takes anyway outweighs the rest. 1 is in proportion "
            "to the size; n log n looks like 1.05 to 1.1 over these sizes, and what no longer fits "
            "into the caches adds about as much once. Where the rings meet is a matter of the "
            "square root of n, so that what looks only there grows less than in proportion."}};
}

}  // namespace treeform::bench
