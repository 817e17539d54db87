#include <libmesh/io/extension.hpp>
#include <libmesh/io/sink.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/section.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace treeform {
namespace {

using detail::io::sink;

void put_numbers(sink& out, std::span<const double> values, char between) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0) out.put(between);
        out.number(values[i] + 0.0);  // no -0
    }
}

class section_writer {
  public:
    section_writer(sink& out, const section_result& section) : out_(out), section_(section) {}

    /// Paths of a layer are one, so that holes are holes; open polylines are others.
    void svg() {
        point2 low{std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()};
        point2 high{-low.x, -low.y};
        for (const point2& p : section_.points) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
        if (section_.points.empty()) low = high = {};
        const double width = high.x - low.x, height = high.y - low.y;
        out_.put("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"");
        // A stroke wider than the loops: they are whole, and a straight line has a height.
        const double stroke = std::max(width, height) / 1000;
        put_numbers(
            out_,
            std::array{low.x - stroke, -high.y - stroke, width + 2 * stroke, height + 2 * stroke},
            ' ');
        out_.put("\" stroke=\"black\" stroke-width=\"");
        out_.number(stroke);
        out_.put("\" fill-rule=\"evenodd\">\n");
        for (std::size_t i = 0; i < section_.layers.size(); ++i) {
            const section_layer& layer = section_.layers[i];
            out_.put("<g id=\"layer" + std::to_string(i) + "\" data-height=\"");
            out_.number(layer.height);
            out_.put("\">\n");
            put_paths(layer, true, "<path fill=\"silver\" d=\"");
            put_paths(layer, false, "<path fill=\"none\" d=\"");
            out_.put("</g>\n");
        }
        out_.put("</svg>\n");
    }

    void dxf() {
        out_.put("0\nSECTION\n2\nENTITIES\n");
        for (std::size_t i = 0; i < section_.layers.size(); ++i) {
            const section_layer& layer = section_.layers[i];
            const std::string name = "\n8\nLAYER" + std::to_string(i) + "\n";
            const auto put_point = [&](const point2& p) {
                const std::array<std::string_view, 3> codes{"10\n", "20\n", "30\n"};
                const std::array values{p.x, p.y, layer.height};
                for (std::size_t k = 0; k < 3; ++k) {
                    out_.put(codes[k]);
                    put_numbers(out_, std::span(values).subspan(k, 1), ' ');
                    out_.put('\n');
                }
            };
            for (const section_loop& loop : loops_of(layer)) {
                // 1: closed, 8: in space
                out_.put("0\nPOLYLINE" + name + "66\n1\n70\n" + (loop.closed ? "9\n" : "8\n"));
                put_point({});
                for (const point2& p : points_of(loop)) {
                    out_.put("0\nVERTEX" + name);
                    put_point(p);
                    out_.put("70\n32\n");
                }
                out_.put("0\nSEQEND" + name);
            }
        }
        out_.put("0\nENDSEC\n0\nEOF\n");
    }

    void obj() {
        for (const section_layer& layer : section_.layers)
            for (const section_loop& loop : loops_of(layer))
                for (const point2& p : points_of(loop)) {
                    const point3 q = section_.in_space(layer, p);
                    out_.put("v ");
                    put_numbers(out_, std::array{q.x, q.y, q.z}, ' ');
                    out_.put('\n');
                }
        for (std::size_t i = 0; i < section_.layers.size(); ++i) {
            out_.put("o layer" + std::to_string(i) + "\n");
            for (const section_loop& loop : loops_of(section_.layers[i])) {
                out_.put('l');
                for (std::size_t p = 0; p < loop.point_count + (loop.closed ? 1 : 0); ++p) {
                    out_.put(' ');
                    out_.number(loop.first_point + p % loop.point_count + 1);
                }
                out_.put('\n');
            }
        }
    }

    void json() {
        out_.put('{');
        put_axis("x", section_.frame.x);
        put_axis("y", section_.frame.y);
        put_axis("normal", section_.frame.normal);
        out_.put("\"layers\":[");
        for (std::size_t i = 0; i < section_.layers.size(); ++i) {
            const section_layer& layer = section_.layers[i];
            out_.put(i == 0 ? "\n{" : ",\n{");
            put_axis("at", layer.at);
            put_value("height", layer.height);
            put_value("area", layer.area);
            put_value("length", layer.length);
            put_value("open", layer.open_count);
            out_.put("\"loops\":[");
            for (const section_loop& loop : loops_of(layer)) {
                out_.put(&loop == loops_of(layer).data() ? "\n{" : ",\n{");
                out_.put(loop.closed ? "\"closed\":true," : "\"closed\":false,");
                out_.put(loop.oriented ? "\"oriented\":true," : "\"oriented\":false,");
                if (loop.parent == section_loop::none)
                    out_.put("\"parent\":null,");
                else
                    put_value("parent", loop.parent - layer.first_loop);
                put_value("depth", loop.depth);
                put_value("area", loop.area);
                put_value("length", loop.length);
                out_.put("\"points\":[");
                for (const point2& p : points_of(loop)) {
                    out_.put(&p == points_of(loop).data() ? "[" : ",[");
                    put_numbers(out_, std::array{p.x, p.y}, ',');
                    out_.put(']');
                }
                out_.put("]}");
            }
            out_.put("]}");
        }
        out_.put("]}\n");
    }

  private:
    [[nodiscard]] std::span<const section_loop> loops_of(const section_layer& layer) const {
        return std::span(section_.loops).subspan(layer.first_loop, layer.loop_count);
    }
    [[nodiscard]] std::span<const point2> points_of(const section_loop& loop) const {
        return std::span(section_.points).subspan(loop.first_point, loop.point_count);
    }

    void put_paths(const section_layer& layer, bool closed, std::string_view start) {
        bool any = false;
        for (const section_loop& loop : loops_of(layer)) {
            if (loop.closed != closed) continue;
            if (!std::exchange(any, true)) out_.put(start);
            char before = 'M';
            for (const point2& p : points_of(loop)) {
                out_.put(std::exchange(before, 'L'));
                put_numbers(out_, std::array{p.x, -p.y}, ' ');
            }
            if (closed) out_.put('Z');
        }
        if (any) out_.put("\"/>\n");
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
    const section_result& section_;
};

}  // namespace

void write_section(const std::filesystem::path& path, const section_result& section,
                   const std::string& format) {
    const std::string form = format.empty() ? detail::io::extension_of(path) : format;
    if (form != "svg" && form != "dxf" && form != "obj" && form != "json")
        throw io_error(path.string() + ": sections can be written as svg, dxf, obj or json");
    detail::io::output_file file(path);
    sink out(file.descriptor(), file.name());
    section_writer writer(out, section);
    if (form == "svg") writer.svg();
    if (form == "dxf") writer.dxf();
    if (form == "obj") writer.obj();
    if (form == "json") writer.json();
    out.flush();
    file.commit();
}

}  // namespace treeform
