#include "tools/common/curve_file.hpp"

#include "tools/common/common_options.hpp"
#include "tools/common/console.hpp"
#include "tools/common/exit_status.hpp"
#include "tools/common/output_file.hpp"
#include <treeform/mesh/curves.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <utility>

namespace tools {
namespace {

/// Points and lines between them, ready to be written.
struct drawn_curves {
    struct line {
        std::vector<std::size_t> points;
        std::vector<std::uint32_t> pairs;  ///< of each segment
    };
    std::vector<tf::point3> points;
    std::vector<line> lines;
    std::size_t segments = 0;

    void add(line added) {
        segments += added.pairs.size();
        lines.push_back(std::move(added));
    }
};

drawn_curves draw(tf::mesh_view mesh, std::span<const tf::face_pair> pairs) {
    std::vector<tf::face_pair> proper, degenerate;
    std::vector<std::uint32_t> proper_number, degenerate_number;
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
        const bool flat = pairs[i].kind == tf::pair_kind::degenerate;
        (flat ? degenerate : proper).push_back(pairs[i]);
        (flat ? degenerate_number : proper_number).push_back(i);
    }
    drawn_curves drawn;
    const tf::curve_network network = tf::intersection_paths(mesh, proper);
    for (const tf::curve_point& p : network.points) drawn.points.push_back(p.position);
    for (const tf::curve_path& path : network.paths) {
        drawn_curves::line line{{path.points.begin(), path.points.end()}, {}};
        if (path.closed || path.points.size() == 1) line.points.push_back(path.points[0]);
        for (const std::uint32_t pair : path.pairs) line.pairs.push_back(proper_number[pair]);
        drawn.add(std::move(line));
    }
    for (const tf::curve_segment& s : tf::intersection_curves(mesh, degenerate)) {
        const std::size_t first = drawn.points.size();
        drawn.points.insert(drawn.points.end(), s.ends.begin(), s.ends.end());
        drawn.add({{first, first + 1}, {degenerate_number[s.pair]}});
    }
    return drawn;
}

std::string ply_head(const drawn_curves& drawn, const std::vector<pair_numbers>& numbers) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex " + std::to_string(drawn.points.size()) +
        "\nproperty double x\nproperty double y\nproperty double z\nelement edge " +
        std::to_string(drawn.segments) + "\nproperty int vertex1\nproperty int vertex2\n";
    for (const pair_numbers& n : numbers) text += "property int " + n.name + "\n";
    return text + "end_header\n";
}

void append_segments(std::string& text, const drawn_curves::line& line,
                     const std::vector<pair_numbers>& numbers) {
    for (std::size_t k = 0; k < line.pairs.size(); ++k) {
        text += std::to_string(line.points[k]) + " " + std::to_string(line.points[k + 1]);
        for (const pair_numbers& n : numbers)
            text += " " + std::to_string(n.of_pair[line.pairs[k]]);
        text += "\n";
    }
}

bool curves_as_ply(const std::filesystem::path& path) { return extension_of(path) == "ply"; }

void write_lines(output_file& file, const drawn_curves& drawn,
                 const std::vector<pair_numbers>& numbers, bool as_ply) {
    std::string text = as_ply ? ply_head(drawn, numbers) : std::string();
    for (const tf::point3& p : drawn.points) {
        if (!as_ply) text += "v ";
        text += shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z) + "\n";
        file.write_full_pieces(text);
    }
    for (const drawn_curves::line& line : drawn.lines) {
        if (as_ply) {
            append_segments(text, line, numbers);
        } else {
            text += "l";
            for (const std::size_t p : line.points) text += " " + std::to_string(p + 1);
            text += "\n";
        }
        file.write_full_pieces(text);
    }
    file.write(text);
}

}  // namespace

void check_curve_path(const std::filesystem::path& path) {
    if (!path.empty() && path != "-" && !curves_as_ply(path) && extension_of(path) != "obj")
        throw failure(bad_usage, "usage", path.string() + ": curves can be written as obj or ply");
}

void write_curves(const job& work, const std::filesystem::path& path, tf::mesh_view mesh,
                  std::span<const tf::face_pair> pairs, const std::vector<pair_numbers>& numbers) {
    if (work.options.dry_run) return;
    write_file(path, work.options.force, work.keeper, [&](output_file& file) {
        write_lines(file, draw(mesh, pairs), numbers, curves_as_ply(path));
    });
}

}  // namespace tools
