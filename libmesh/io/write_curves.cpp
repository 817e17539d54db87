#include <libmesh/io/detect.hpp>
#include <libmesh/io/sink.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace treeform {
namespace {

using detail::io::sink;

/// Points and lines between them, ready to be written.
struct drawn_curves {
    struct line {
        std::vector<std::size_t> points;
        std::vector<std::uint32_t> pairs;  ///< of each segment
    };
    std::vector<point3> points;
    std::vector<line> lines;
    std::size_t segments = 0;

    void add(line added) {
        segments += added.pairs.size();
        lines.push_back(std::move(added));
    }
};

drawn_curves draw(mesh_view mesh, std::span<const face_pair> pairs) {
    std::vector<face_pair> proper, degenerate;
    std::vector<std::uint32_t> proper_number, degenerate_number;
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
        const bool flat = pairs[i].kind == pair_kind::degenerate;
        (flat ? degenerate : proper).push_back(pairs[i]);
        (flat ? degenerate_number : proper_number).push_back(i);
    }
    drawn_curves drawn;
    const curve_network network = intersection_paths(mesh, proper);
    for (const curve_point& p : network.points) drawn.points.push_back(p.position);
    for (const curve_path& path : network.paths) {
        drawn_curves::line line{{path.points.begin(), path.points.end()}, {}};
        if (path.closed || path.points.size() == 1) line.points.push_back(path.points[0]);
        for (const std::uint32_t pair : path.pairs) line.pairs.push_back(proper_number[pair]);
        drawn.add(std::move(line));
    }
    const auto segments = intersection_curves(mesh, degenerate);
    for (std::size_t i = 0; i < segments.size(); ++i)
        for (const auto& ends : segments[i]) {
            const std::size_t first = drawn.points.size();
            drawn.points.insert(drawn.points.end(), ends.begin(), ends.end());
            drawn.add({{first, first + 1}, {degenerate_number[i]}});
        }
    return drawn;
}

void put_ply_head(sink& out, const drawn_curves& drawn, std::span<const pair_column> numbers) {
    out.put("ply\nformat ascii 1.0\nelement vertex ");
    out.number(drawn.points.size());
    out.put("\nproperty double x\nproperty double y\nproperty double z\nelement edge ");
    out.number(drawn.segments);
    out.put("\nproperty int vertex1\nproperty int vertex2\n");
    for (const pair_column& n : numbers) out.put("property int " + n.first + "\n");
    out.put("end_header\n");
}

void put_points(sink& out, const drawn_curves& drawn, const char* start) {
    for (const point3& p : drawn.points) {
        out.put(start);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (axis > 0) out.put(' ');
            out.number(p[axis]);
        }
        out.put('\n');
    }
}

void put_segments(sink& out, const drawn_curves::line& line, std::span<const pair_column> numbers) {
    for (std::size_t k = 0; k < line.pairs.size(); ++k) {
        out.number(line.points[k]);
        out.put(' ');
        out.number(line.points[k + 1]);
        for (const pair_column& n : numbers) {
            out.put(' ');
            out.number(n.second[line.pairs[k]]);
        }
        out.put('\n');
    }
}

void put_path(sink& out, const drawn_curves::line& line) {
    out.put('l');
    for (const std::size_t p : line.points) {
        out.put(' ');
        out.number(p + 1);
    }
    out.put('\n');
}

}  // namespace

void write_curves(const std::filesystem::path& path, mesh_view mesh,
                  std::span<const face_pair> pairs, std::span<const pair_column> numbers,
                  const std::string& format) {
    const std::string form = format.empty() ? detail::io::extension_of(path) : format;
    if (form != "ply" && form != "obj")
        throw io_error(path.string() + ": curves can be written as obj or ply");
    for (const pair_column& n : numbers)
        if (n.second.size() != pairs.size())
            throw std::invalid_argument("treeform::write_curves: " + n.first +
                                        " has not one number for each pair");
    const drawn_curves drawn = draw(mesh, pairs);
    detail::io::output_file file(path);
    sink out(file.descriptor(), file.name());
    if (form == "ply") put_ply_head(out, drawn, numbers);
    put_points(out, drawn, form == "ply" ? "" : "v ");
    for (const drawn_curves::line& line : drawn.lines)
        form == "ply" ? put_segments(out, line, numbers) : put_path(out, line);
    out.flush();
    file.commit();
}

}  // namespace treeform
