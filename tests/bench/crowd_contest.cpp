#include "bench/crowd_contest.hpp"

#include "bench/peers/cgal_unions.hpp"
#include "bench/peers/versions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace treeform::bench {
namespace {

constexpr const char* bound = "reading and writing once";

boolean_result evaluate(const meshes& solids, const crowd_question& question) {
    const std::vector<mesh_view> views(solids.begin(), solids.end());
    return boolean(views, question.expression(views.size()));
}

job ours(const crowd_question& question, bool in_one) {
    std::shared_ptr<const meshes> given = question.solids();
    if (in_one) given = std::make_shared<const meshes>(1, in_one_mesh(*given));
    return make_job([=] { return evaluate(*given, question); },
                    [=](const boolean_result& r) {
                        if (question.is_open)
                            return r.certificate.status == status::open_input ? 0.0 : 1.0;
                        return r.certificate ? 0.0 : 1.0;
                    },
                    [](const boolean_result& r) {
                        return std::vector<figure>{
                            {"faces", static_cast<double>(r.mesh.faces.size())},
                            {"pairs", static_cast<double>(r.statistics.pairs)},
                            {"faces skipped", static_cast<double>(r.statistics.skipped_faces)}};
                    });
}

job copying(const crowd_question& question) {
    const auto given = question.solids();
    const auto result = std::make_shared<const mesh>(evaluate(*given, question).mesh);
    return make_job([=] { return std::pair(*given, *result); });
}

std::string family_of(const outcome& outcome) {
    return outcome.name.substr(0, outcome.name.find('/'));
}

/// Without slashes and blanks, for the name of a file.
std::string as_file_name(std::string name) {
    std::ranges::replace(name, ' ', '_');
    return name;
}

/// In place of times, peaks.
std::vector<outcome> peaks_of(std::vector<outcome> outcomes) {
    for (outcome& outcome : outcomes) {
        outcome.unit = {};
        std::erase_if(outcome.rows, [](const measured& row) { return !row.peak_mb; });
        for (measured& row : outcome.rows) row.median = *row.peak_mb / outcome.unit.scale;
    }
    return outcomes;
}

}  // namespace

contest contest_of(const crowd_question& question) {
    contest contest{.name = question.name,
                    .size =
                        [question] {
                            const auto solids = question.solids();
                            std::size_t faces = 0;
                            for (const mesh& solid : *solids) faces += solid.faces.size();
                            return faces;
                        },
                    .long_runs = 3};
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back({"treeform", threads, [=] { return ours(question, false); }});
    if (question.also_in_one_mesh)
        for (const unsigned threads : {1U, 2U})
            contest.contestants.push_back(
                {"treeform (one mesh)", threads, [=] { return ours(question, true); }});
    contest.contestants.push_back({bound, 1, [=] { return copying(question); }});
    if (question.also_by_peer)
        contest.contestants.push_back(
            {cgal_name() + " EPICK in pairs", 1, [=] { return cgal_unions(*question.solids()); }});
    return contest;
}

section drawn_by_family(const std::vector<outcome>& outcomes, const std::string& workload,
                        const std::string& machine) {
    section result{.paper = "",
                   .ours =
                       "From arrays to arrays. The line that nothing can be below copies the "
                       "arrays of the input and of the result once."};
    std::vector<std::string> families;
    for (const outcome& outcome : outcomes)
        if (std::ranges::find(families, family_of(outcome)) == families.end())
            families.push_back(family_of(outcome));
    for (const std::string& family : families) {
        std::vector<outcome> own;
        std::ranges::copy_if(outcomes, std::back_inserter(own),
                             [&](const outcome& o) { return family_of(o) == family; });
        const auto draw = [&](const char* what, const char* label, const char* file,
                              const std::vector<outcome>& of) {
            line_chart lines;
            lines.caption = {fmt::format("{}: {}", family, what), machine};
            lines.x = {"faces of all operands", true};
            lines.y = {label, true};
            lines.curves = curves_by_size(of);
            result.pictures.push_back(
                {fmt::format("{}_{}_{}.svg", workload, as_file_name(family), file), svg(lines)});
        };
        draw("time by size", "time, ms", "time", own);
        draw("peak memory by size", "MB", "memory", peaks_of(own));
    }
    result.table.push_back({"", "faces", "faces of the result", "ms", "MB", "times the bound"});
    for (const outcome& outcome : outcomes) {
        const std::optional<double> time = outcome.value("treeform");
        const std::optional<double> least = outcome.value(bound);
        if (!time) continue;
        const auto row = std::ranges::find(outcome.rows, "treeform", &measured::who);
        result.table.push_back(
            {outcome.name, fmt::format("{}", outcome.size),
             fmt::format("{:.0f}", outcome.figure("treeform", "faces").value_or(0)),
             fmt::format("{:.4g}", *time),
             row->peak_mb ? fmt::format("{:.4g}", *row->peak_mb) : "-",
             least && *least > 0 ? fmt::format("{:.3g}", *time / *least) : "-"});
    }
    return result;
}

}  // namespace treeform::bench
