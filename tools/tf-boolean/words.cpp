#include "tools/shell/console.hpp"
#include "tools/tf-boolean/outputs.hpp"
#include <treeform/mesh/carry.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cmath>

namespace tools {

namespace {

/// ", 3 parts below 0.001 left out (0.00012 in all), gaps of up to 0.1 filled between 4 faces"
std::string choices_in_words(const job& work, const boolean_settings& settings,
                             const tf::boolean_statistics& did) {
    std::string text;
    if (did.small_parts > 0)
        text += ", " + counted(did.small_parts, "part", "parts") + " below " +
                brief(settings.min_volume) + " left out (" + brief(did.small_volume) + " in all)";
    if (!settings.gap) return text;
    const std::string width = brief(work.entry["gap"]["used"].get<double>());
    if (did.filled_faces == 0) return text + ", no gaps of up to " + width + " between faces";
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
        return text + " are left of the exact result's " + grouped(result.statistics.exact_faces) +
               " when rounded to " + name_of(result.certificate.precision);
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
                                    " of the exact result left out, the first at " +
                                    in_words(result.vanished_at.front()) + ": thinner than " +
                                    numbers_of(result.certificate.precision) +
                                    " numbers tell apart there");
    // Beyond what all else may have moved.
    if (result.certificate && result.vanished_reach > result.certificate.max_displacement &&
        result.vanished_reach > 64.0 * work.entry["output"]["step"].get<double>())
        work.warn("lost-parts", std::string("places thinner than ") +
                                    numbers_of(result.certificate.precision) +
                                    " numbers tell apart there are left out, up to " +
                                    brief(result.vanished_reach) + " from what is left");
    if (result.statistics.degenerate > 0)
        work.warn("degenerate", counted(result.statistics.degenerate, "face", "faces") +
                                    " without an area left out; nothing changes by that");
    const json& output = work.entry["output"];
    const auto nonmanifold = output["nonmanifold_edges"].get<std::uint64_t>();
    if (result.certificate && !output["volume"].is_null() && nonmanifold > 0)
        work.warn("nonmanifold",
                  counted(nonmanifold, "edge", "edges") +
                      " of more than two faces, where the result touches itself; " +
                      (is_stl(work.options) ? "STL has no vertex numbers: other formats keep "
                                              "apart what touches"
                                            : "its points are apart, until a reader or another "
                                              "format joins equal ones") +
                      "; tf-repair sets it apart");
    if (!settings.splits() && !output["closed"].get<bool>())
        work.warn("open", "the result is a part of an open surface, and open itself");
    if (settings.simplify && !settings.no_attributes && sources_of(solids).has_vertex_values())
        work.warn("simplified", "points that are left out take their properties with them");
    if (!settings.no_attributes && sources_of(solids).has_values_left_out())
        work.warn("attributes", "lists and properties of other elements are not carried over");
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
    if (result.statistics.slivers + rounds > 0)
        work.out.info(work.name + ": rounding made faces meet: took out " +
                      counted(result.statistics.slivers, "sliver", "slivers") + ", cut again " +
                      counted(rounds, "time", "times"));
}

}  // namespace tools
