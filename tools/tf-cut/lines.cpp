#include "tools/shell/console.hpp"
#include "tools/shell/output_file.hpp"
#include "tools/tf-cut/cutting.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace tools {
namespace {

/// The value of each vertex.
struct vertex_values {
    std::vector<double> of{};
    bool is_signed = false;  ///< of distances
};

vertex_values distances_of(job& work, const cut_settings& s, const usable_input& input) {
    json about;
    tf::mesh_file to = work.read(s.lines.to, about);
    tf::drop_unusable_faces(to.mesh);
    tf::mesh from = input.file.mesh;
    for (tf::point3& p : from.points)  // no face uses such a one
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) p = {};
    const auto timing = work.time("prepare");
    auto found = tf::deviation(
        from, to.mesh, {.bins = 0, .both_ways = false, .progress = work.progress("distances")});
    if (!found) refuse("--to " + s.lines.to + ": no face with finite coordinates");
    work.call_ended(found->status == tf::status::cancelled);
    return {std::move(found->distances), found->is_signed};
}

vertex_values values_of(job& work, const cut_settings& s, const usable_input& input) {
    const std::vector<tf::point3>& points = input.file.mesh.points;
    vertex_values values;
    if (s.lines.value == "distance") return distances_of(work, s, input);
    if (s.lines.value == "height") return {heights_of(s, input)};
    const tf::element* vertices = input.file.attributes.find("vertex");
    const tf::column* column = vertices == nullptr ? nullptr : vertices->find(s.lines.value);
    if (column == nullptr || column->role != tf::column_role::data || column->list_length ||
        column->size() != points.size()) {
        std::string names = "height, distance";
        if (vertices != nullptr)
            for (const tf::column& c : vertices->columns)
                if (c.role == tf::column_role::data && !c.list_length) names += ", " + c.name;
        refuse("--value " + s.lines.value + ": " + work.name +
               " has no such property of vertices; expected one of " + names);
    }
    for (std::size_t v = 0; v < points.size(); ++v) values.of.push_back(column->number(v));
    return values;
}

/// As given, or so many, equally far apart within the range.
std::vector<double> levels_of(const cut_settings& s, const std::array<double, 2>& range) {
    std::vector<double> levels = s.lines.levels;
    const auto parts = static_cast<double>(s.lines.count) + 1.0;
    for (std::uint64_t i = 1; i <= s.lines.count; ++i)
        levels.push_back(std::lerp(range[0], range[1], static_cast<double>(i) / parts));
    return levels;
}

/// Adds the sides of a line; `at` says where each of its points is.
template <class At>
void add_sides(drawn_lines& lines, std::size_t count, bool closed, const At& at) {
    for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i)
        lines.sides.push_back({at(i), at((i + 1) % count)});
}

drawn_lines drawn(const tf::section_result& made) {
    drawn_lines lines{"loops"};
    for (const tf::section_layer& layer : made.layers)
        for (const tf::section_loop& loop :
             std::span(made.loops).subspan(layer.first_loop, layer.loop_count))
            add_sides(lines, loop.point_count, loop.closed, [&](std::size_t i) {
                return made.in_space(layer, made.points[loop.first_point + i]);
            });
    return lines;
}

drawn_lines drawn(const tf::isolines_result& made) {
    drawn_lines lines{"isolines"};
    for (const tf::isoline& line : made.lines)
        add_sides(lines, line.point_count, line.closed,
                  [&](std::size_t i) { return made.points[line.first_point + i]; });
    return lines;
}

/// A layer by itself.
tf::section_result layer_of(const tf::section_result& all, std::size_t i) {
    tf::section_result one;
    one.axes = all.axes;
    one.layers.push_back(all.layers[i]);
    const std::uint32_t first = std::exchange(one.layers[0].first_loop, 0);
    for (std::uint32_t l = first; l < first + all.layers[i].loop_count; ++l) {
        tf::section_loop& loop = one.loops.emplace_back(all.loops[l]);
        if (loop.parent != tf::section_loop::none) loop.parent -= first;
        const auto begin =
            static_cast<std::ptrdiff_t>(std::exchange(loop.first_point, one.points.size()));
        const auto end = begin + static_cast<std::ptrdiff_t>(loop.point_count);
        one.points.insert(one.points.end(), all.points.begin() + begin, all.points.begin() + end);
    }
    return one;
}

/// Writes lines by `write(path, i, format, unit)`, where they are asked for: `count` files, where
/// the name has a place for a number.
template <class Write>
void give_lines(job& work, const cut_settings& s, std::size_t count, const Write& write) {
    if (s.output.empty() || work.options.dry_run) return;
    const auto timing = work.time("write");
    const std::string format = lines_format(s.output), unit = work.unit();
    const auto paths = numbered_paths(work, s.output, count);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        output_place place(paths[i], work.options.force);
        write(place.writable(), i, format, unit);
        place.commit();
    }
    work.entry["output"] = {{"file", s.output.string()},
                            {"format", format},
                            {"precision_out", nullptr},
                            {"max_move", nullptr}};
}

void say_isolines(job& work, const cut_settings& s, const vertex_values& values,
                  const std::array<double, 2>& range, const std::vector<double>& levels,
                  const tf::isolines_result& made) {
    json list = json::array();
    std::uint64_t open = 0;
    double length = 0.0;
    for (auto line = made.lines.begin(); const double level : levels) {
        std::uint64_t count = 0, ends = 0;
        double sum = 0.0;
        for (; line != made.lines.end() && line->level == level; ++line) {
            ++count;
            ends += line->closed ? 0 : 1;
            sum += line->length;
        }
        list.push_back({{"level", level}, {"lines", count}, {"open", ends}, {"length", sum}});
        open += ends;
        length += sum;
    }
    work.entry["isolines"] = {{"value", s.lines.value},
                              {"signed", or_null(s.lines.value == "distance", values.is_signed)},
                              {"min", range[0]},
                              {"max", range[1]},
                              {"levels", std::move(list)}};
    std::string text = counted(levels.size(), "level", "levels") + ", " +
                       counted(made.lines.size(), "line", "lines");
    if (open > 0) text += ", " + grouped(open) + " open";
    work.out.result(work.name + ": " + text + ", length " + brief(length));
    if (made.lines.empty())
        work.warn("no-lines", "no level is in the range: " + s.lines.value + " is between " +
                                  brief(range[0]) + " and " + brief(range[1]));
}

}  // namespace

std::vector<double> heights_of(const cut_settings& s, const usable_input& input) {
    const tf::point3 n = s.plane.axes()[2], at = s.plane.at;
    std::vector<double> heights;
    for (const tf::point3& p : input.file.mesh.points)
        heights.push_back(n.x * (p.x - at.x) + n.y * (p.y - at.y) + n.z * (p.z - at.z));
    return heights;
}

std::array<double, 2> range_of(const usable_input& input, const std::vector<double>& values) {
    std::array range{std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};
    for (const tf::face& f : input.file.mesh.faces)
        for (const std::uint32_t v : f)
            range = {std::min(range[0], values[v]), std::max(range[1], values[v])};
    return range;
}

std::string lines_format(const std::filesystem::path& path) {
    return path == "-" ? "json" : extension_of(path);
}

exit_status make_section(job& work, const usable_input& input, cut_settings s) {
    if (s.layers > 0.0) {
        s.heights = suitable(
            "--layers", [&] { return s.plane.layer_heights(input.file.mesh.points, s.layers); });
        work.entry["planes"]["heights"] = s.heights;
    }
    tf::section_result made;
    {
        const auto timing = work.time("cut");
        made = tf::section(input.file.mesh, s.plane, s.heights, {work.progress("section")});
    }
    work.call_ended(made.status == tf::status::cancelled);
    say_section(work, s, input, made);
    if (work.options.shows()) {
        const drawn_lines lines = drawn(made);
        write_page(work, input, "section", true, {}, &lines);
    }
    const bool apart = has_number(s.output);
    give_lines(work, s, made.layers.size(),
               [&](const auto& path, std::size_t i, const auto& format, const auto& unit) {
                   tf::write_section(path, apart ? layer_of(made, i) : made, format, unit);
               });
    return done;
}

exit_status make_isolines(job& work, const usable_input& input, const cut_settings& s) {
    const vertex_values values = values_of(work, s, input);
    const std::array range = range_of(input, values.of);
    const std::vector<double> levels = levels_of(s, range);
    tf::isolines_result made;
    {
        const auto timing = work.time("cut");
        made = suitable("--value", [&] {
            return tf::isolines(input.file.mesh, values.of, levels, {work.progress("isolines")});
        });
    }
    work.call_ended(made.status == tf::status::cancelled);
    say_isolines(work, s, values, range, levels, made);
    if (work.options.shows()) {
        const drawn_lines lines = drawn(made);
        write_page(work, input, "isolines", true, {}, &lines);
    }
    give_lines(work, s, 1,
               [&](const auto& path, std::size_t, const auto& format, const auto& unit) {
                   tf::write_isolines(path, made, s.plane, format, unit);
               });
    return done;
}

}  // namespace tools
