/// \file
/// S1: to find that a clean scan has no self-intersections, beside the tree that it takes. The rest
/// is pairs of faces that share a corner.

#include "bench/models.hpp"
#include "bench/page.hpp"
#include "bench/peers/cgal_self_intersections.hpp"
#include "bench/peers/versions.hpp"
#include "bench/workload.hpp"
#include <libmesh/base/build_face_tree.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <fmt/core.h>

#include <cstddef>
#include <vector>

namespace treeform::bench {
namespace {

constexpr std::size_t most_of_peer = 1'100'000;  // of CGAL, ten seconds

std::vector<model> scans(effort effort) {
    if (effort == effort::tiny) return {{"", "2k", 2'000}, {"", "4k", 4'000}};
    const char* scan = "clean/armadillo_29k.obj";
    std::vector<model> all{{scan, "100k", 100'000}, {scan, "300k", 300'000}};
    if (effort == effort::full) {
        all.push_back({scan, "1M", 1'000'000});
        all.push_back({scan, "3M", 3'000'000});
        all.push_back({scan, "10M", 10'000'000});
    }
    return all;
}

contest contest_of(const setting& setting, const model& model) {
    const auto given = [=] { return load(setting, model); };
    contest contest{.name = name_of(setting, model) + "/clean",
                    .size = [=] { return given()->faces.size(); }};
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back(
            {"treeform", threads, [=] {
                 return make_job(
                     [mesh = given()] {
                         return self_intersections(*mesh, {.vertices = vertex_identity::by_index});
                     },
                     [](const face_pair_result& found) {
                         return static_cast<double>(found.pairs.size());
                     },
                     [](const face_pair_result& found) {
                         return std::vector<figure>{
                             {"pairs of boxes", static_cast<double>(found.box_pairs)}};
                     });
             }});
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back(
            {"tree alone", threads,
             [=] { return make_job([mesh = given()] { return build_face_tree(*mesh); }); }});
    if (model.triangles <= most_of_peer)
        contest.contestants.push_back(
            {cgal_name() + " EPICK", 1,
             [=] { return cgal_self_intersections(*given(), 1, [] { return 0.0; }); }});
    return contest;
}

}  // namespace

void clean_scans(const setting& setting, const contest_visitor& visit) {
    for (const model& model : scans(setting.effort)) visit(contest_of(setting, model));
}

section draw_clean_scans(const std::vector<outcome>& outcomes, const std::string& machine) {
    section result{.paper = "", .ours = "Trees are part of the times."};
    line_chart lines;
    lines.caption = {"Self-intersections of scans that have none", machine};
    lines.x = {"triangles", true};
    lines.y = {"time, ms", true};
    lines.curves = curves_by_size(outcomes);
    result.pictures.push_back({"s1_clean_scans.svg", svg(lines)});
    result.table.push_back({"", "triangles", "ms", "tree alone, ms", "times the tree"});
    for (const outcome& outcome : outcomes) {
        const auto own = outcome.value("treeform"), tree = outcome.value("tree alone");
        if (!own || !tree) continue;
        result.table.push_back({outcome.name, fmt::format("{}", outcome.size),
                                fmt::format("{:.4g}", *own), fmt::format("{:.4g}", *tree),
                                fmt::format("{:.3g}", *own / *tree)});
    }
    return result;
}

}  // namespace treeform::bench
