#include "tools/shell/console.hpp"
#include "tools/tf-boolean/outputs.hpp"
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cmath>

namespace tools {

namespace {

/// ", 3 parts below 0.001 dropped (total 0.00012), gaps of up to 0.1 filled between 4 faces"
std::string choices_in_words(const job& work, const boolean_settings& settings,
                             const tf::boolean_statistics& did) {
    std::string text;
    if (did.small_parts > 0)
        text += ", " + counted(did.small_parts, "part", "parts") + " below " +
                brief(settings.min_volume) + " dropped (total " + brief(did.small_volume) + ")";
    if (!settings.gap) return text;
    const std::string width = brief(work.entry["gap"]["used"].get<double>());
    if (did.filled_faces == 0) return text + ", no gaps of up to " + width + " found";
    return text + ", gaps of up to " + width + " filled between " +
           counted(did.filled_faces, "face", "faces");
}

}  // namespace

std::string verdict(const job& work, const boolean_settings& settings,
                    const tf::boolean_result& result) {
    const json& volume = work.entry["output"]["volume"];
    const std::size_t operands = work.entry["inputs"].size();
    const bool of_objects = work.options.inputs.size() == 1 && operands > 1;
    std::string text = settings.name() +
                       (of_objects ? " of its " + grouped(operands) + " objects: " : ": ") +
                       counted(result.mesh.faces.size(), "face", "faces");
    if (result.certificate && result.mesh.faces.empty())
        return text + ", nothing is left" + choices_in_words(work, settings, result.statistics);
    if (!volume.is_null() && !result.mesh.faces.empty() && std::isfinite(volume.get<double>()))
        text += ", volume " + brief(volume.get<double>());
    if (result.certificate.status == tf::status::vanished)
        return text + " remain of the " + grouped(result.statistics.exact_faces) +
               " faces of the exact result when rounded to " +
               name_of(result.certificate.precision);
    if (!result.certificate) return text + ", but " + result.certificate.message();
    text += choices_in_words(work, settings, result.statistics);
    if (result.certificate.max_displacement > 0.0)
        text +=
            ", rounding moved points by " + brief(result.certificate.max_displacement) + " at most";
    return text;
}

void warn_of_surprises(job& work, const boolean_settings& settings,
                       const std::vector<solid>& solids, const tf::boolean_result& result) {
    const bool given = std::any_of(solids.begin(), solids.end(),
                                   [](const solid& s) { return !s.file.mesh.faces.empty(); });
    if (result.mesh.faces.empty() && result.certificate.status != tf::status::vanished && given &&
        settings.name() == "union" && result.statistics.small_parts == 0)
        work.warn("nothing-left", "the inputs bound nothing: their faces cancel each other out");
    if (result.certificate && result.vanished_components > 0)
        work.warn("lost-parts", counted(result.vanished_components, "part", "parts") +
                                    " of the exact result dropped, the first at " +
                                    in_words(result.vanished_at.front()) +
                                    ": thinner than the spacing of " +
                                    numbers_of(result.certificate.precision) + " numbers there");
    // Beyond what all else may have moved.
    if (result.certificate && result.vanished_distance > result.certificate.max_displacement &&
        result.vanished_distance > 64.0 * work.entry["output"]["step"].get<double>())
        work.warn("lost-parts", std::string("regions thinner than the spacing of ") +
                                    numbers_of(result.certificate.precision) +
                                    " numbers there were dropped; they reached up to " +
                                    brief(result.vanished_distance) + " from the rest");
    if (result.statistics.degenerate > 0)
        work.warn("degenerate", counted(result.statistics.degenerate, "face", "faces") +
                                    " without area dropped, which does not change the solids");
    const json& output = work.entry["output"];
    const auto nonmanifold = output["nonmanifold_edges"].get<std::uint64_t>();
    if (result.certificate && !output["volume"].is_null() && nonmanifold > 0)
        work.warn("nonmanifold",
                  "the result touches itself: " + counted(nonmanifold, "edge has", "edges have") +
                      " more than two faces once equal points are joined" +
                      (is_stl(work.options) ? ", as readers of STL do"
                                            : "; in the result they are separate") +
                      "; tf-repair moves the parts apart");
    if (!settings.splits() && !output["closed"].get<bool>())
        work.warn("open", "the result is open, since it is a part of an open surface");
    if (settings.simplify && !settings.no_attributes && sources_of(solids).has_vertex_values())
        work.warn("simplified", "the properties of points removed by --merge-coplanar are lost");
    if (!settings.no_attributes && sources_of(solids).has_values_left_out())
        work.warn("attributes",
                  "list properties, and properties of elements other than vertices and faces, are "
                  "not carried over");
}

void warn_of_failure(job& work, const tf::boolean_result& result, const std::string& remedy) {
    const bool vanished = result.certificate.status == tf::status::vanished;
    work.warn(vanished ? "vanished" : "not-certified",
              (vanished ? result.certificate.message() + "; " : "") + "nothing written" + remedy);
}

void say_details(job& work, const tf::boolean_result& result) {
    if (!work.out.shows(level::info)) return;
    work.out.info(work.name + ": " + counted(result.statistics.pairs, "pair", "pairs") +
                  " of faces meet, " + counted(result.statistics.cut_faces, "face", "faces") +
                  " cut");
    const auto rounds = static_cast<std::uint64_t>(result.statistics.rounding_rounds);
    if (result.statistics.rounding_repairs + rounds > 0)
        work.out.info(work.name + ": rounding made faces meet: " +
                      counted(result.statistics.rounding_repairs, "repair", "repairs") +
                      ", faces cut again " + counted(rounds, "time", "times"));
}

}  // namespace tools
