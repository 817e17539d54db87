#include "tools/tf-selfintersect/outputs.hpp"

#include "tools/common/console.hpp"
#include "tools/tf-selfintersect/words.hpp"
#include <libmesh/intersect/curve_paths.hpp>
#include <libmesh/intersect/curves.hpp>

#include <algorithm>
#include <initializer_list>
#include <set>

namespace tools {
namespace {

json triple(const tf::point3& p) { return {p.x, p.y, p.z}; }

json box_entry(const tf::point3& min, const tf::point3& max) {
    return {{"min", triple(min)}, {"max", triple(max)}};
}

json counts_entry(const findings& result, const search_settings& settings) {
    json counts = json::object();
    for (std::size_t k = 0; k < tf::pair_kind_count; ++k) {
        const auto kind = static_cast<tf::pair_kind>(k);
        counts[name_of(kind)] =
            settings.looks_for(kind) ? json(result.found.counts[k]) : json(nullptr);
    }
    return counts;
}

json region_entry(const findings& result, std::size_t id) {
    const tf::intersection_region& region = result.regions.regions[id];
    std::set<std::uint32_t> components;
    if (!result.component.empty())
        for (const std::uint32_t f : region.faces) components.insert(result.component[f]);
    return {{"id", id},
            {"faces", region.faces.size()},
            {"pairs", region.pairs},
            {"box", box_entry(region.min, region.max)},
            {"center", triple(center(region))},
            {"components", components}};
}

json list_entry(const findings& result, std::size_t count) {
    json list = json::array();
    for (std::size_t i = 0; i < count; ++i) {
        const tf::face_pair& pair = result.found.pairs[i];
        list.push_back({result.stored_face(pair.a), result.stored_face(pair.b), name_of(pair.kind),
                        result.regions.region_of_pair[i]});
    }
    return list;
}

void append_point(std::string& text, const tf::point3& p) {
    text += shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z);
}

void append_line(std::string& text, std::initializer_list<std::size_t> numbers) {
    for (const std::size_t number : numbers) {
        text += std::to_string(number);
        text += ' ';
    }
    text.back() = '\n';
}

/// Written in pieces, so that the text of a million lines is never in memory at once.
void write_full_pieces(output_file& file, std::string& text) {
    constexpr std::size_t piece = std::size_t{1} << 16;
    if (text.size() < piece) return;
    file.write(text);
    text.clear();
}

}  // namespace

void enter_report(job& work, const findings& result, const search_settings& settings,
                  std::uint64_t limit) {
    json& entry = work.entry;
    const std::size_t listed = std::min<std::uint64_t>(limit, result.found.pairs.size());
    entry["vertices"] = {
        {"stored", result.points_stored},
        {"distinct", result.points_distinct ? json(*result.points_distinct) : json(nullptr)}};
    entry["faces"] = result.faces_stored;
    entry["triangles"] = result.triangles;
    entry["searched"] = result.mesh.faces.size();
    entry["box"] = result.box ? box_entry(result.box->min, result.box->max) : json(nullptr);
    entry["skipped"] = {{"non_finite", result.non_finite},
                        {"degenerate", result.degenerate},
                        {"filter_calls", result.found.box_pairs},
                        {"exact_calls", result.found.exact_pairs}};
    entry["tolerance"] = {{"given", settings.tolerance.given},
                          {"used", result.tolerance_used},
                          {"joined", result.corners_joined}};
    entry["pairs"] = counts_entry(result, settings);
    entry["complete"] = !(settings.first && !result.found.pairs.empty());
    entry["faces_hit"] = result.faces_hit().size();
    entry["regions"] = json::array();
    for (std::size_t id = 0; id < result.regions.regions.size(); ++id)
        entry["regions"].push_back(region_entry(result, id));
    entry["listed"] = listed;
    entry["truncated"] = listed < result.found.pairs.size();
    entry["list"] = list_entry(result, listed);
    entry["repair"] = nullptr;
    entry["output"] = nullptr;
}

void write_pairs(output_file& file, const findings& result) {
    std::string text = "face,face,kind,region\n";
    for (std::size_t i = 0; i < result.found.pairs.size(); ++i) {
        const tf::face_pair& pair = result.found.pairs[i];
        text += std::to_string(result.stored_face(pair.a)) + "," +
                std::to_string(result.stored_face(pair.b)) + "," + name_of(pair.kind) + "," +
                std::to_string(result.regions.region_of_pair[i]) + "\n";
        write_full_pieces(file, text);
    }
    file.write(text);
}

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

/// Paths, and for faces without area, which have none, segments of their own.
drawn_curves draw(const findings& result) {
    std::vector<tf::face_pair> proper, degenerate;
    std::vector<std::uint32_t> proper_number, degenerate_number;
    for (std::uint32_t i = 0; i < result.found.pairs.size(); ++i) {
        const tf::face_pair& pair = result.found.pairs[i];
        const bool flat = pair.kind == tf::pair_kind::degenerate;
        (flat ? degenerate : proper).push_back(pair);
        (flat ? degenerate_number : proper_number).push_back(i);
    }
    drawn_curves drawn;
    const tf::curve_network network = tf::intersection_paths(result.mesh, proper);
    for (const tf::curve_point& p : network.points) drawn.points.push_back(p.position);
    for (const tf::curve_path& path : network.paths) {
        drawn_curves::line line{{path.points.begin(), path.points.end()}, {}};
        if (path.closed || path.points.size() == 1) line.points.push_back(path.points[0]);
        for (const std::uint32_t pair : path.pairs) line.pairs.push_back(proper_number[pair]);
        drawn.add(std::move(line));
    }
    for (const tf::curve_segment& s : tf::intersection_curves(result.mesh, degenerate)) {
        const std::size_t first = drawn.points.size();
        drawn.points.insert(drawn.points.end(), s.ends.begin(), s.ends.end());
        drawn.add({{first, first + 1}, {degenerate_number[s.pair]}});
    }
    return drawn;
}

}  // namespace

void write_curves(output_file& file, const findings& result, bool as_ply) {
    const drawn_curves drawn = draw(result);
    std::string text;
    if (as_ply)
        text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(drawn.points.size()) +
               "\nproperty double x\nproperty double y\nproperty double z\nelement edge " +
               std::to_string(drawn.segments) +
               "\nproperty int vertex1\nproperty int vertex2\nproperty int tf_class\n"
               "property int tf_region\nend_header\n";
    for (const tf::point3& p : drawn.points) {
        if (!as_ply) text += "v ";
        append_point(text, p);
        text += "\n";
        write_full_pieces(file, text);
    }
    for (const drawn_curves::line& line : drawn.lines) {
        if (as_ply) {
            for (std::size_t k = 0; k < line.pairs.size(); ++k) {
                const std::uint32_t pair = line.pairs[k];
                append_line(text, {line.points[k], line.points[k + 1],
                                   static_cast<std::size_t>(result.found.pairs[pair].kind) + 1,
                                   result.regions.region_of_pair[pair]});
            }
        } else {
            text += "l";
            for (const std::size_t p : line.points) text += " " + std::to_string(p + 1);
            text += "\n";
        }
        write_full_pieces(file, text);
    }
    file.write(text);
}

}  // namespace tools
