#include "tools/tf-weld/words.hpp"

#include "tools/shell/console.hpp"
#include <treeform/tf.hpp>

namespace tools {
namespace {

/// "within 0.132, 0.01% of the diagonal"
std::string reach(const welding& w, const weld_settings& settings) {
    if (!(w.tolerance > 0.0)) return "equal";
    return "within " + brief(w.tolerance) +
           (settings.tolerance.relative ? ", " + settings.tolerance.given + " of the diagonal"
                                        : "");
}

std::string faces_in_words(const welding& w, const weld_settings& settings) {
    const tf::weld_statistics& r = w.result.statistics;
    if (w.triangles == 0) return {};
    std::string text = "; " + counted(w.triangles_kept(), "triangle", "triangles") + " kept";
    if (r.collapsed > 0) text += ", " + grouped(r.collapsed) + " collapsed";
    if (r.degenerate > 0) text += ", " + grouped(r.degenerate) + " already degenerate";
    return settings.options.keep_degenerate || r.collapsed + r.degenerate == 0
               ? text
               : text + " (dropped)";
}

std::string names_of(const std::vector<tf::weld_condition>& conditions) {
    std::string text;
    for (const auto& c : conditions) text += (text.empty() ? "" : ", ") + c.property;
    return text;
}

}  // namespace

std::string verdict(const welding& w, const weld_request& request) {
    const bool mesh = w.triangles > 0;
    const std::string unit = mesh ? "vertices" : "points";
    const std::string all = counted(w.points, mesh ? "vertex" : "point", unit);
    std::string text;
    if (w.removed() == 0)
        text = "nothing to merge among " + all;
    else if (request.outputs.check)
        text = grouped(w.removed()) + " of " + all + " would be merged, " + grouped(w.distinct()) +
               " would stay";
    else if (!request.outputs.label.empty())
        text = all + " labeled, in " + counted(w.distinct(), "group", "groups");
    else if (request.outputs.withhold)
        text = grouped(w.removed()) + " of " + all + " marked as withheld, " +
               grouped(w.distinct()) + " unchanged";
    else
        text = grouped(w.removed()) + " of " + all + " merged, " + grouped(w.distinct()) + " kept";
    text += " (" + reach(w, request.settings);
    if (!w.conditions.empty()) text += ", only with equal " + names_of(w.conditions);
    return text + ")" + faces_in_words(w, request.settings);
}

void warn_of_defects(job& work, const welding& w) {
    const tf::weld_statistics& r = w.result.statistics;
    if (r.non_finite > 0)
        work.warn("non-finite", counted(r.non_finite, "point", "points") +
                                    " with a NaN or infinite coordinate kept unmerged");
    if (r.nonmanifold_after > r.nonmanifold_before)
        work.warn("nonmanifold", counted(r.nonmanifold_after, "edge has", "edges have") +
                                     " more than two faces, " + grouped(r.nonmanifold_before) +
                                     " before; --keep-manifold prevents such merges");
    if (r.flipped > 0)
        work.warn("flipped", counted(r.flipped, "face", "faces") +
                                 " flipped: the tolerance is larger than details of the mesh");
}

void say_details(job& work, const welding& w) {
    if (!work.out.shows(level::info)) return;
    const tf::weld_statistics& r = w.result.statistics;
    work.out.info(work.name + ": " + counted(r.groups, "group", "groups") +
                  " of two points or more, largest move " + brief(r.max_displacement));
    if (w.triangles == 0) return;
    work.out.info(work.name + ": " + counted(r.nonmanifold_after, "edge", "edges") +
                  " of more than two faces, " + grouped(r.nonmanifold_before) + " before; " +
                  counted(r.kept_apart, "group", "groups") +
                  " not merged completely, to stay manifold");
}

}  // namespace tools
