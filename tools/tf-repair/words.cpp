#include "tools/shell/console.hpp"
#include "tools/tf-repair/outputs.hpp"
#include <treeform/tf.hpp>

#include <cstdint>
#include <string>

namespace tools {
namespace {

/// The name of the part that is not as asked for, where there are several.
std::string faulty_part(const tf::repaired_file& made) {
    for (const tf::repaired_part& part : made.parts)
        if (part.certificate.status == made.certificate.status)
            return "part \"" + part.name + "\": ";
    return {};
}

/// What would lead on where the mesh is open: all but --wrap has been tried.
std::string offers(const repair_settings& settings, const tf::repaired_file& made,
                   const attempt& works) {
    std::string text;
    const auto offer = [&](const std::string& what) {
        text += (text.empty() ? " (" : ", ") + what;
    };
    repair_settings tried = settings;
    tried.steps.sheet = true;
    if (!settings.steps.sheet && works(tried)) offer("--sheet writes it");
    tried = settings;
    tried.steps.max_loss = 1.0;
    if (made.statistics.unfilled_rims > 0 && works(tried)) offer("--accept-loss makes a solid");
    offer("--wrap 2% wraps it");
    return text + ")";
}

/// What to do about too large a loss. If a single mesh was repaired and no sheet left out, only the
/// loss was refused, so --accept-loss works; else it is tried.
std::string accepted(const repair_settings& settings, const tf::repaired_file& made,
                     const attempt& works) {
    repair_settings tried = settings;
    tried.steps.max_loss = 1.0;
    const bool is_made = made.parts.empty() && made.statistics.unfilled_rims == 0;
    return is_made || works(tried) ? " (--accept-loss writes it)" : " (--wrap 2% wraps it)";
}

std::string reason(const repair_settings& settings, const tf::repaired_file& made,
                   const attempt& works) {
    const tf::certificate& known = made.certificate;
    std::string text = known.message();
    switch (known.status) {
        case tf::status::ok:
        case tf::status::sheet:
            return {};
        case tf::status::open_input:
            return "open at " + counted(known.open_count, "edge", "edges") +
                   offers(settings, made, works);
        case tf::status::excessive_loss:
            if (known.size_before == 0.0)
                return counted(made.statistics.vanished_components, "part", "parts") +
                       " would vanish" + accepted(settings, made, works);
            return text + accepted(settings, made, works);
        case tf::status::not_certified:
        case tf::status::vanished:
            return text + (known.precision == tf::precision::float32
                               ? "; --precision double, in a format that has it, may help"
                               : "");
        default:
            return text;
    }
}

}  // namespace

std::string verdict(const dirty_mesh& input, const tf::repaired_file& made) {
    const tf::repair_statistics& did = made.statistics;
    const bool is_sheet = made.certificate.status == tf::status::sheet;
    std::string text = is_sheet ? "sheet, " : "solid, ";
    if (made.parts.size() > 1) text = grouped(made.parts.size()) + " parts, each a " + text;
    text += counted(made.file.mesh.faces.size(), "face", "faces");
    if (is_sheet)
        text += ", area " + brief(did.area_after);
    else
        text += ", volume " + brief(did.volume_after) + " (was " + brief(input.volume) + ")";
    return text + ": " + repair_summary(did);
}

std::string objection(const repair_settings& settings, const tf::repaired_file& made,
                      const attempt& works) {
    const std::string why = reason(settings, made, works);
    return why.empty() ? why : faulty_part(made) + why;
}

void say_defects(job& work, const dirty_mesh& input, const tf::solid_defects& found) {
    work.entry["defects"] = {{"non_finite", input.non_finite},
                             {"non_finite_vertices", found.nonfinite_vertices},
                             {"tetrahedra", found.tetrahedra},
                             {"degenerate", found.degenerate},
                             {"repeated", found.repeated},
                             {"boundary_edges", found.boundary_edges},
                             {"nonmanifold_edges", found.nonmanifold_edges},
                             {"misoriented_edges", found.misoriented_edges},
                             {"nonmanifold_vertices", found.nonmanifold_vertices},
                             {"self_intersections", found.meeting_pairs},
                             {"inverted_parts", found.inverted},
                             {"wrongly_nested", found.wrongly_nested}};
    work.out.result(work.name + ": " +
                    (found.any()
                         ? found.message()
                         : "solid, " + counted(input.file.mesh.faces.size(), "face", "faces") +
                               ", volume " + brief(input.volume)));
}

void warn_of_surprises(job& work, const repair_settings& settings, const tf::repaired_file& made) {
    const tf::repair_statistics& did = made.statistics;
    if (did.touching > 0)
        work.warn("touching", counted(did.touching, "vertex has", "vertices have") +
                                  " the coordinates of another one: for programs that join equal "
                                  "vertices, edges have more than two faces");
    if (did.vanished_components > 0)
        work.warn("lost-parts", counted(did.vanished_components, "part has", "parts have") +
                                    " vanished, since they enclose no volume");
    if (did.dropped_shells > 0) {
        const bool is_one = did.dropped_shells == 1;
        const bool is_odd = settings.steps.fill_rule == tf::fill_rule::even_odd;
        work.warn("dropped-shells",
                  counted(did.dropped_shells, "shell", "shells") + " within another " +
                      (is_one ? "was" : "were") +
                      " dropped, since the inside of a solid is filled" +
                      (is_odd   ? ""
                       : is_one ? "; --fill-rule even-odd makes a cavity of it"
                                : "; --fill-rule even-odd makes cavities of them"));
    }
}

}  // namespace tools
