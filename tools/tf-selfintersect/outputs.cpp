#include "tools/tf-selfintersect/outputs.hpp"

#include "tools/common/curve_file.hpp"
#include "tools/tf-selfintersect/words.hpp"
#include <treeform/tf.hpp>

#include <algorithm>
#include <set>
#include <utility>

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

void write_curves(output_file& file, const findings& result, bool as_ply) {
    pair_numbers kinds{"tf_class", {}};
    for (const tf::face_pair& pair : result.found.pairs)
        kinds.of_pair.push_back(static_cast<std::uint32_t>(pair.kind) + 1);
    write_curves(file, result.mesh, result.found.pairs,
                 {std::move(kinds), {"tf_region", result.regions.region_of_pair}}, as_ply);
}

}  // namespace tools
