#include <libmesh/base/point_math.hpp>
#include <libmesh/io/detect.hpp>
#include <libmesh/io/sink.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/section.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace treeform {
namespace {

using detail::io::sink;

void put_numbers(sink& out, std::span<const double> values, char between) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0) out.put(between);
        out.number(values[i] + 0.0);  // no -0
    }
}

/// A unit of length, in words, as DXF numbers it, and in millimeters.
struct known_unit {
    std::string_view name;
    int dxf;
    double millimeters;
};
constexpr std::array<known_unit, 7> units{{{"", 0, 0.0},
                                           {"in", 1, 25.4},
                                           {"ft", 2, 304.8},
                                           {"mm", 4, 1.0},
                                           {"cm", 5, 10.0},
                                           {"m", 6, 1000.0},
                                           {"um", 13, 0.001}}};

const known_unit& unit_named(const std::string& name) {
    const auto at = std::ranges::find(units, name, &known_unit::name);
    if (at == units.end())
        throw std::invalid_argument("treeform: unit " + name +
                                    " is unknown; expected mm, cm, m, in, ft or um");
    return *at;
}

/// Lines in groups, of layers or levels.
struct drawing {
    struct line {
        std::size_t first, count;
        bool closed;
    };
    struct group {
        double value;  ///< its height or level
        std::vector<line> lines{};
    };

    const char* word;  ///< "layer", "level"
    const char* value_name;
    bool filled;  ///< what is in closed ones
    std::size_t point_count;
    std::vector<group> groups{};
    std::function<point2(std::size_t point)> flat{};
    std::function<point3(std::size_t group, std::size_t point)> in_space{};
    std::function<point3(std::size_t group, std::size_t point)> of_dxf{};
};

drawing drawing_of(const section_result& section) {
    drawing made{"layer", "height", true, section.points.size()};
    for (const section_layer& layer : section.layers) {
        drawing::group& one = made.groups.emplace_back(drawing::group{layer.height});
        for (const section_loop& loop :
             std::span(section.loops).subspan(layer.first_loop, layer.loop_count))
            one.lines.push_back({loop.first_point, loop.point_count, loop.closed});
    }
    made.flat = [&section](std::size_t p) { return section.points[p]; };
    made.in_space = [&section](std::size_t group, std::size_t p) {
        return section.in_space(section.layers[group], section.points[p]);
    };
    made.of_dxf = [&section](std::size_t group, std::size_t p) {
        return point3{section.points[p].x, section.points[p].y, section.layers[group].height};
    };
    return made;
}

drawing drawing_of(const isolines_result& all, const oriented_plane& seen) {
    drawing made{"level", "level", false, all.points.size()};
    for (const isoline& line : all.lines) {
        if (made.groups.empty() || made.groups.back().value != line.level)
            made.groups.push_back({line.level});
        made.groups.back().lines.push_back({line.first_point, line.point_count, line.closed});
    }
    made.flat = [&all, axes = seen.axes()](std::size_t p) {
        return point2{detail::base::dot(axes[0], all.points[p]),
                      detail::base::dot(axes[1], all.points[p])};
    };
    made.in_space = made.of_dxf = [&all](std::size_t, std::size_t p) { return all.points[p]; };
    return made;
}

class curve_writer {
  public:
    curve_writer(sink& out, const drawing& what) : out_(out), what_(what) {}

    /// Paths of a group are one, so that holes are holes; open polylines are others.
    void svg(const known_unit& unit) {
        point2 low{std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()};
        point2 high{-low.x, -low.y};
        for (std::size_t i = 0; i < what_.point_count; ++i) {
            const point2 p = what_.flat(i);
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
        if (what_.point_count == 0) low = high = {};
        const double width = high.x - low.x, height = high.y - low.y;
        out_.put("<svg xmlns=\"http://www.w3.org/2000/svg\"");
        // A stroke wider than the loops: they are whole, and a straight line has a height.
        const double stroke = std::max(width, height) / 1000;
        const std::array view{low.x - stroke, -high.y - stroke, width + 2 * stroke,
                              height + 2 * stroke};
        if (unit.dxf != 0) {
            put_length(" width=\"", view[2] * unit.millimeters);
            put_length(" height=\"", view[3] * unit.millimeters);
        }
        out_.put(" viewBox=\"");
        put_numbers(out_, view, ' ');
        out_.put("\" stroke=\"black\" stroke-width=\"");
        out_.number(stroke);
        out_.put("\" fill-rule=\"evenodd\">\n");
        for (std::size_t i = 0; i < what_.groups.size(); ++i) {
            const drawing::group& group = what_.groups[i];
            out_.put(std::string("<g id=\"") + what_.word + std::to_string(i) + "\" data-" +
                     what_.value_name + "=\"");
            out_.number(group.value);
            out_.put("\">\n");
            put_paths(group, true,
                      what_.filled ? "<path fill=\"silver\" d=\"" : "<path fill=\"none\" d=\"");
            put_paths(group, false, "<path fill=\"none\" d=\"");
            out_.put("</g>\n");
        }
        out_.put("</svg>\n");
    }

    void dxf(const known_unit& unit) {
        if (unit.dxf != 0)
            out_.put("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n" + std::to_string(unit.dxf) +
                     "\n0\nENDSEC\n");
        out_.put("0\nSECTION\n2\nENTITIES\n");
        const auto put_point = [&](const point3& p) {
            const std::array<std::string_view, 3> codes{"10\n", "20\n", "30\n"};
            for (std::size_t k = 0; k < 3; ++k) {
                out_.put(codes[k]);
                put_numbers(out_, std::array{p[k]}, ' ');
                out_.put('\n');
            }
        };
        for (std::size_t i = 0; i < what_.groups.size(); ++i) {
            const drawing::group& group = what_.groups[i];
            const std::string name =
                (what_.filled ? "\n8\nLAYER" : "\n8\nLEVEL") + std::to_string(i) + "\n";
            for (const auto& [first, count, closed] : group.lines) {
                // 1: closed, 8: in space
                out_.put("0\nPOLYLINE" + name + "66\n1\n70\n" + (closed ? "9\n" : "8\n"));
                put_point({0.0, 0.0, what_.filled ? group.value : 0.0});
                for (std::size_t p = first; p < first + count; ++p) {
                    out_.put("0\nVERTEX" + name);
                    put_point(what_.of_dxf(i, p));
                    out_.put("70\n32\n");
                }
                out_.put("0\nSEQEND" + name);
            }
        }
        out_.put("0\nENDSEC\n0\nEOF\n");
    }

    void obj() {
        for (std::size_t i = 0; i < what_.groups.size(); ++i)
            for (const drawing::line& line : what_.groups[i].lines)
                for (std::size_t p = line.first; p < line.first + line.count; ++p) {
                    const point3 q = what_.in_space(i, p);
                    out_.put("v ");
                    put_numbers(out_, std::array{q.x, q.y, q.z}, ' ');
                    out_.put('\n');
                }
        for (std::size_t i = 0; i < what_.groups.size(); ++i) {
            out_.put(std::string("o ") + what_.word + std::to_string(i) + "\n");
            for (const auto& [first, count, closed] : what_.groups[i].lines) {
                out_.put('l');
                for (std::size_t p = 0; p < count + (closed ? 1 : 0); ++p) {
                    out_.put(' ');
                    out_.number(first + p % count + 1);
                }
                out_.put('\n');
            }
        }
    }

  private:
    void put_length(std::string_view start, double millimeters) {
        out_.put(start);
        out_.number(millimeters);
        out_.put("mm\"");
    }

    void put_paths(const drawing::group& group, bool closed, std::string_view start) {
        bool any = false;
        for (const drawing::line& line : group.lines) {
            if (line.closed != closed) continue;
            if (!std::exchange(any, true)) out_.put(start);
            char before = 'M';
            for (std::size_t i = line.first; i < line.first + line.count; ++i) {
                const point2 p = what_.flat(i);
                out_.put(std::exchange(before, 'L'));
                put_numbers(out_, std::array{p.x, -p.y}, ' ');
            }
            if (closed) out_.put('Z');
        }
        if (any) out_.put("\"/>\n");
    }

    sink& out_;
    const drawing& what_;
};

/// All that is known, as JSON.
class json_writer {
  public:
    explicit json_writer(sink& out) : out_(out) {}

    void put(const section_result& section, const std::string& unit) {
        put_start(unit);
        put_axis("x", section.axes[0]);
        put_axis("y", section.axes[1]);
        put_axis("normal", section.axes[2]);
        out_.put("\"layers\":[");
        for (std::size_t i = 0; i < section.layers.size(); ++i) {
            const section_layer& layer = section.layers[i];
            out_.put(i == 0 ? "\n{" : ",\n{");
            put_axis("at", layer.at);
            put_value("height", layer.height);
            put_value("area", layer.area);
            put_value("length", layer.length);
            put_value("open", layer.open_count);
            out_.put("\"loops\":[");
            for (const section_loop& loop : loops_of(section, layer)) {
                out_.put(&loop == loops_of(section, layer).data() ? "\n{" : ",\n{");
                put_flags(loop.closed, loop.oriented);
                if (loop.parent == section_loop::none)
                    out_.put("\"parent\":null,");
                else
                    put_value("parent", loop.parent - layer.first_loop);
                put_value("depth", loop.depth);
                put_value("area", loop.area);
                put_value("length", loop.length);
                put_points(loop.first_point, loop.point_count, [&](std::size_t p) {
                    return std::array{section.points[p].x, section.points[p].y};
                });
            }
            out_.put("]}");
        }
        out_.put("]}\n");
    }

    void put(const isolines_result& all, const std::string& unit) {
        put_start(unit);
        out_.put("\"lines\":[");
        for (const isoline& line : all.lines) {
            out_.put(&line == all.lines.data() ? "\n{" : ",\n{");
            put_value("level", line.level);
            put_flags(line.closed, line.oriented);
            put_value("length", line.length);
            put_points(line.first_point, line.point_count, [&](std::size_t p) {
                return std::array{all.points[p].x, all.points[p].y, all.points[p].z};
            });
        }
        out_.put("]}\n");
    }

  private:
    [[nodiscard]] static std::span<const section_loop> loops_of(const section_result& section,
                                                                const section_layer& layer) {
        return std::span(section.loops).subspan(layer.first_loop, layer.loop_count);
    }
    /// The last member of what has them.
    template <class F>
    void put_points(std::size_t first, std::size_t count, const F& coordinates_of) {
        out_.put("\"points\":[");
        for (std::size_t p = first; p < first + count; ++p) {
            out_.put(p == first ? "[" : ",[");
            put_numbers(out_, coordinates_of(p), ',');
            out_.put(']');
        }
        out_.put("]}");
    }
    void put_start(const std::string& unit) {
        out_.put('{');
        if (!unit.empty()) out_.put("\"unit\":\"" + unit + "\",");
    }
    void put_flags(bool closed, bool oriented) {
        out_.put(closed ? "\"closed\":true," : "\"closed\":false,");
        out_.put(oriented ? "\"oriented\":true," : "\"oriented\":false,");
    }
    void put_axis(std::string_view name, const point3& axis) {
        out_.put('"');
        out_.put(name);
        out_.put("\":[");
        put_numbers(out_, std::array{axis.x, axis.y, axis.z}, ',');
        out_.put("],");
    }
    template <class T>
    void put_value(std::string_view name, T value) {
        out_.put('"');
        out_.put(name);
        out_.put("\":");
        out_.number(value);
        out_.put(',');
    }

    sink& out_;
};

template <class Curves>
void write_curves_of(const std::filesystem::path& path, const Curves& curves, const drawing& shown,
                     const std::string& format, const std::string& unit) {
    const known_unit& in = unit_named(unit);
    const std::string form = format.empty() ? detail::io::extension_of(path) : format;
    if (form != "svg" && form != "dxf" && form != "obj" && form != "json")
        throw io_error(path.string() +
                       ": sections and isolines can be written as svg, dxf, obj or json");
    detail::io::output_file file(path);
    sink out(file.descriptor(), file.name());
    curve_writer writer(out, shown);
    if (form == "svg") writer.svg(in);
    if (form == "dxf") writer.dxf(in);
    if (form == "obj") writer.obj();
    if (form == "json") json_writer(out).put(curves, unit);
    out.flush();
    file.commit();
}

}  // namespace

void write_section(const std::filesystem::path& path, const section_result& section,
                   const std::string& format, const std::string& unit) {
    write_curves_of(path, section, drawing_of(section), format, unit);
}

void write_isolines(const std::filesystem::path& path, const isolines_result& isolines,
                    const oriented_plane& seen, const std::string& format,
                    const std::string& unit) {
    write_curves_of(path, isolines, drawing_of(isolines, seen), format, unit);
}

}  // namespace treeform
