#include "tools/shell/console.hpp"
#include "tools/tf-selfintersect/outputs.hpp"
#include <treeform/tf.hpp>

namespace tools {

std::string verdict(const findings& result, const search_settings& settings) {
    const auto& counts = result.found.counts;
    const std::uint64_t pairs = result.found.pairs.size();
    if (settings.first && pairs > 0) {
        const tf::face_pair& pair = result.found.pairs.front();
        return "self-intersecting: faces " + std::to_string(result.part.face_in_file(pair.a)) +
               " and " + std::to_string(result.part.face_in_file(pair.b)) + " (" +
               tf::name_of(pair.kind) + "); stopped at the first";
    }
    std::string text = "no self-intersections in ";
    if (pairs > 0)
        text = counted(pairs, "self-intersecting pair", "self-intersecting pairs") + " of ";
    text += counted(result.faces_stored, "face", "faces");
    const char* separator = ": ";
    for (std::size_t k = 0; k < tf::pair_kind_count; ++k) {
        const auto kind = static_cast<tf::pair_kind>(k);
        if (!settings.counted().contains(kind) || counts[k] == 0) continue;
        text += separator + grouped(counts[k]) + " " + tf::name_of(kind);
        separator = ", ";
    }
    if (pairs > 0) text += ", in " + counted(result.regions.size(), "region", "regions");
    const auto apart = counts[static_cast<std::size_t>(tf::pair_kind::degenerate)];
    if (apart > 0 && !settings.counted().contains(tf::pair_kind::degenerate))
        text += "; " + counted(apart, "pair", "pairs") + " with a degenerate face not counted";
    return text;
}

void say_details(job& work, const findings& result) {
    console& out = work.out;
    if (!out.shows(level::info)) return;
    out.info(work.name + ": " + counted(result.searched, "triangle", "triangles") + " searched, " +
             grouped(result.part.degenerate) + " degenerate");
    if (result.tolerance_used > 0.0)
        out.info(work.name + ": " + counted(result.part.joined, "vertex", "vertices") +
                 " joined within " + brief(result.tolerance_used));
    for (std::size_t id = 0; id < result.regions.size(); ++id) {
        const tf::intersection_region& region = result.regions[id];
        out.info(work.name + ": region " + std::to_string(id) + ": " +
                 counted(region.pairs.size(), "pair", "pairs") + ", " +
                 counted(region.faces.size(), "face", "faces") + ", center " +
                 in_words(region.center()) + ", box " + in_words(region.min) + " to " +
                 in_words(region.max));
    }
    const tf::predicate_counters& predicates = result.found.predicates;
    out.debug(work.name + ": " + grouped(result.found.box_pairs) + " pairs of boxes, " +
              grouped(result.found.exact_pairs) + " tested by the exact stage; " +
              grouped(predicates.calls) + " predicates, " + grouped(predicates.undecided) +
              " not decided by the filter");
}

}  // namespace tools
