#include "tools/tf-boolean/words.hpp"

#include "tools/common/carried_properties.hpp"
#include "tools/common/console.hpp"

#include <algorithm>
#include <cmath>

namespace tools {

std::string verdict(const job& work, const boolean_settings& settings,
                    const tf::solid_result& result) {
    const json& output = work.entry["output"];
    std::string text =
        settings.name() + ": " + counted(result.surface.faces.size(), "face", "faces");
    if (result.surface.faces.empty()) return text + ", nothing is left";
    const json& volume = output["volume"];
    if (!volume.is_null() && std::isfinite(volume.get<double>()))
        text += ", volume " + shortest(volume.get<double>());
    if (!result.certified)
        return text + ", but " +
               (result.meeting_count > 0
                    ? counted(result.meeting_count, "pair", "pairs") + " of faces meet"
                    : "coordinates are too large") +
               " when rounded to " + output["precision_out"].get<std::string>();
    if (result.max_move > 0.0)
        text += ", rounding moved points by " + shortest(result.max_move) + " at most";
    return text;
}

void warn_of_surprises(job& work, const boolean_settings& settings,
                       const std::vector<solid>& solids, const tf::solid_result& result) {
    const bool given = std::any_of(solids.begin(), solids.end(),
                                   [](const solid& s) { return !s.file.mesh.faces.empty(); });
    if (result.surface.faces.empty() && given && settings.name() == "union")
        work.warn("nothing-left",
                  "the inputs bound nothing: their faces cancel each other out, or enclose less "
                  "than the precision holds");
    if (result.degenerate > 0)
        work.warn("degenerate", counted(result.degenerate, "face", "faces") +
                                    " without an area left out; nothing changes by that");
    const json& output = work.entry["output"];
    const auto nonmanifold = output["nonmanifold_edges"].get<std::uint64_t>();
    if (!output["volume"].is_null() && nonmanifold > 0)
        work.warn("nonmanifold", counted(nonmanifold, "edge", "edges") +
                                     " of more than two faces, where the result touches itself");
    if (!settings.splits() && !output["closed"].get<bool>())
        work.warn("open", "the result is a part of an open surface, and open itself");
    if (settings.simplify && !settings.no_attributes && points_have_properties(sources_of(solids)))
        work.warn("simplified", "points that are left out take their properties with them");
    if (!settings.no_attributes && leaves_out_properties(sources_of(solids)))
        work.warn("attributes", "lists and properties of other elements are not carried over");
}

void say_details(job& work, const tf::solid_result& result) {
    if (!work.out.shows(level::info)) return;
    work.out.info(work.name + ": " + counted(result.pairs, "pair", "pairs") + " of faces meet, " +
                  counted(result.cut_faces, "face", "faces") + " cut");
    if (result.rounding_steps > 0)
        work.out.info(work.name + ": rounding made faces meet; mended in " +
                      counted(static_cast<std::uint64_t>(result.rounding_steps), "step", "steps"));
}

}  // namespace tools
