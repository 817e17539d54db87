/// \file
/// F2: the tree over the faces of one model at several sizes, beside CGAL and FCL.

#include "bench/face_boxes.hpp"
#include "bench/page.hpp"
#include "bench/peers/cgal_aabb_tree.hpp"
#include "bench/peers/fcl_models.hpp"
#include "bench/peers/versions.hpp"
#include "bench/sizes.hpp"
#include <libtree/paper/nary_tree.hpp>
#include <treeform/tree/build.hpp>

#include <fmt/core.h>

namespace treeform::bench {
namespace {

contest contest_of(const setting& setting, const model& model) {
    const auto given = [=] { return load(setting, model); };
    const auto ours = [=] {
        return make_job([mesh = given()] { return build(mesh->faces, face_box(*mesh)); });
    };
    const auto paper = [=] {
        return make_job([mesh = given()] {
            return build(mesh->faces, face_box(*mesh), tree_config{.inner_size = 4});
        });
    };
    contest contest{.name = name_of(setting, model),
                    .size = [=] { return given()->faces.size(); },
                    .long_runs = 3};
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back({"treeform", threads, ours});
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back({"paper", threads, paper});
    contest.contestants.push_back(
        {cgal_name() + " AABB_tree", 1, [=] { return cgal_aabb_tree(*given()); }});
    contest.contestants.push_back(
        {fcl_name() + " AABB", 1, [=] { return fcl_build(*given(), fcl_volume::aabb); }});
    contest.contestants.push_back(
        {fcl_name() + " OBBRSS", 1, [=] { return fcl_build(*given(), fcl_volume::obbrss); }});
    return contest;
}

}  // namespace

void build_by_peers(const setting& setting, const contest_visitor& visit) {
    for (const model& model : one_model_by_size(setting)) visit(contest_of(setting, model));
}

section draw_build_by_peers(const std::vector<outcome>& outcomes, const std::string& machine) {
    const outcome& largest = outcomes.back();
    const double own = largest.value("treeform").value_or(0);
    std::string ours = fmt::format("{} triangles take {:.3g} ms on one thread, {:.3g} ms on two",
                                   largest.size, own, largest.value("treeform", 2).value_or(0));
    for (const measured& row : largest.rows)
        if (row.threads == 1 && row.who != "treeform")
            ours += fmt::format("; {} {}", compared(own, *largest.value(row.who)), row.who);
    return {
        .paper = "1M triangles in 52 ms on six cores, where libigl takes 894 ms and CGAL 1.7 s.",
        .ours = ours + ".",
        .pictures = {{"f2_build.svg",
                      svg(line_chart{{"Tree over the faces of a mesh, boxes included", machine},
                                     {"triangles", true},
                                     {"build time, ms", true},
                                     curves_by_size(outcomes)})}}};
}

}  // namespace treeform::bench
