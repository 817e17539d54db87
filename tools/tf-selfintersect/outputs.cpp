#include "tools/tf-selfintersect/outputs.hpp"

#include "tools/shell/curve_file.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/shell/output_file.hpp"
#include <treeform/tf.hpp>

#include <algorithm>
#include <utility>

namespace tools {
namespace {

json counts_entry(const findings& result, const search_settings& settings) {
    json counts = json::object();
    for (std::size_t k = 0; k < tf::pair_kind_count; ++k) {
        const auto kind = static_cast<tf::pair_kind>(k);
        counts[tf::name_of(kind)] =
            or_null(settings.looked_for().contains(kind), result.found.counts[k]);
    }
    return counts;
}

json region_entry(const findings& result, std::size_t id) {
    const tf::intersection_region& region = result.regions[id];
    return {{"id", id},
            {"faces", region.faces.size()},
            {"pairs", region.pairs.size()},
            {"box", tf::box3{region.min, region.max}},
            {"center", region.center()},
            {"components", or_null(!result.part.component.empty(), result.components_of(region))}};
}

json list_entry(const findings& result, std::size_t count) {
    json list = json::array();
    for (std::size_t i = 0; i < count; ++i) {
        const tf::face_pair& pair = result.found.pairs[i];
        list.push_back({result.part.face_in_file(pair.a), result.part.face_in_file(pair.b),
                        tf::name_of(pair.kind), result.region_of(pair)});
    }
    return list;
}

}  // namespace

void enter_report(job& work, const findings& result, const search_settings& settings,
                  std::uint64_t limit) {
    json& entry = work.entry;
    const std::size_t listed = std::min<std::uint64_t>(limit, result.found.pairs.size());
    entry["vertices"] = {{"stored", result.points_stored}, {"distinct", result.part.distinct}};
    entry["faces"] = result.faces_stored;
    entry["triangles"] = result.triangles;
    entry["searched"] = result.searched;
    entry["box"] = result.box;
    entry["skipped"] = {{"non_finite", result.part.non_finite},
                        {"degenerate", result.part.degenerate}};
    entry["work"] = {{"box_pairs", result.found.box_pairs},
                     {"exact_pairs", result.found.exact_pairs}};
    entry["tolerance"] = {{"given", settings.tolerance.given},
                          {"used", result.tolerance_used},
                          {"joined", result.part.joined}};
    entry["pairs"] = counts_entry(result, settings);
    entry["complete"] = !(settings.first && !result.found.pairs.empty());
    entry["faces_hit"] = result.marks.marked();
    entry["regions"] = json::array();
    for (std::size_t id = 0; id < result.regions.size(); ++id)
        entry["regions"].push_back(region_entry(result, id));
    entry["listed"] = listed;
    entry["truncated"] = listed < result.found.pairs.size();
    entry["list"] = list_entry(result, listed);
    entry["repair"] = nullptr;
    entry["output"] = nullptr;
}

void write_pairs(const job& work, const std::filesystem::path& path, const findings& result) {
    write_file(path, work.options.force, [&](output_file& file) {
        std::string text = "face,face,kind,region\n";
        for (std::size_t i = 0; i < result.found.pairs.size(); ++i) {
            const tf::face_pair& pair = result.found.pairs[i];
            text += std::to_string(result.part.face_in_file(pair.a)) + "," +
                    std::to_string(result.part.face_in_file(pair.b)) + "," +
                    tf::name_of(pair.kind) + "," + std::to_string(result.region_of(pair)) + "\n";
            file.write_full_pieces(text);
        }
        file.write(text);
    });
}

void write_curves(const job& work, const std::filesystem::path& path, const findings& result) {
    tf::pair_column kinds{"tf_class", {}}, regions{"tf_region", {}};
    for (const tf::face_pair& pair : result.found.pairs) {
        kinds.second.push_back(static_cast<std::uint32_t>(pair.kind) + 1);
        regions.second.push_back(result.region_of(pair));
    }
    write_curves(work, path, result.part, result.found.pairs,
                 {std::move(kinds), std::move(regions)});
}

void write_marked(job& work, tf::mesh_file& file, const findings& result,
                  const std::filesystem::path& path) {
    const auto timing = work.time("write");
    result.marks.color(file, result.part);
    const auto written =
        write_mesh(work, file, write_options_for(work.options, form_of(work, file, path)), path);
    warn_of_rounding(work, written.max_displacement);
}

}  // namespace tools
