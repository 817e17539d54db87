/// \file
/// B6: set operations of two solids, from arrays to arrays.

#include "bench/models.hpp"
#include "bench/peers/cgal_corefinement.hpp"
#include "bench/peers/versions.hpp"
#include "bench/subdivide.hpp"
#include "bench/workload.hpp"
#include <libmesh/base/build_face_tree.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

namespace treeform::bench {
namespace {

struct two_solids {
    std::string name;
    std::function<shared_mesh()> a;
    std::function<shared_mesh()> b;
};

mesh moved(mesh m, double by_diagonals) {
    const box3 box = bounding_box(m.points).value();
    const double step = by_diagonals * (box.max.x - box.min.x);
    for (point3& p : m.points) p.x += step;
    return m;
}

std::vector<two_solids> pairs(const setting& setting) {
    const auto loaded = [&](const model& m) { return [=] { return load(setting, m); }; };
    const auto beside = [&](const model& m, const std::string& how,
                            const std::function<mesh(const mesh&)>& change) {
        return two_solids{name_of(setting, m) + how, [=] { return load(setting, m); },
                          [=] {
                              return cached(setting, name_of(setting, m) + how,
                                            [=] { return change(*load(setting, m)); });
                          }};
    };
    const model blade_1m{"clean/turbineblade_199k.ply", "1M", 1'000'000};
    const model armadillo{"clean/armadillo_29k.obj", "100k", 100'000};
    if (setting.effort == effort::tiny)
        return {beside({"", "2k", 2'000}, "_turned", [](const mesh& m) { return turned(m, 0.8); })};
    std::vector<two_solids> result{
        {"bunny_100k+cow_100k", loaded({"pairs/bunny25k.obj", "100k", 99'000}),
         loaded({"pairs/cow25k.obj", "100k", 99'000})},
        beside(armadillo, "_turned", [](const mesh& m) { return turned(m, 0.7853981633974483); })};
    if (setting.effort == effort::full) {
        result.push_back(beside(blade_1m, "_beside", [](const mesh& m) { return moved(m, 0.97); }));
        result.push_back(beside(blade_1m, "_turned",
                                [](const mesh& m) { return turned(m, 0.7853981633974483); }));
    }
    return result;
}

std::vector<figure> figures_of(const mesh& a, const mesh& b, const boolean_result& r) {
    const auto bytes = [](const mesh& m) {
        return static_cast<double>(m.points.size() * sizeof(point3) +
                                   m.faces.size() * sizeof(face));
    };
    return {{"faces", static_cast<double>(r.mesh.faces.size())},
            {"pairs", static_cast<double>(r.statistics.pairs)},
            {"MB in and out", (bytes(a) + bytes(b) + bytes(r.mesh)) / 1e6}};
}

contest contest_of(const two_solids& solids, const std::string& suffix,
                   const std::function<boolean_expression()>& make, corefinement operation) {
    contest contest{
        .name = solids.name + suffix,
        .size = [solids] { return solids.a()->faces.size() + solids.b()->faces.size(); },
        .long_runs = 3};
    const auto evaluate = [make](const mesh_ref& a, const mesh_ref& b) {
        return boolean({a, b}, make());
    };
    // Meshes as they come, and prepared ones that have been asked about before.
    for (const bool is_prepared : {false, true})
        for (const unsigned threads : {1U, 2U})
            contest.contestants.push_back(
                {is_prepared ? "treeform (prepared)" : "treeform", threads, [=] {
                     const shared_mesh a = solids.a(), b = solids.b();
                     const auto ready_a =
                         std::make_shared<prepared_mesh>(prepared_mesh::borrow(*a));
                     const auto ready_b =
                         std::make_shared<prepared_mesh>(prepared_mesh::borrow(*b));
                     if (is_prepared) (void)evaluate(*ready_a, *ready_b);
                     return make_job(
                         [=] {
                             return is_prepared ? evaluate(*ready_a, *ready_b) : evaluate(*a, *b);
                         },
                         [](const boolean_result& r) -> std::optional<double> {
                             return r.certificate ? 0.0 : 1.0;
                         },
                         [a, b](const boolean_result& r) { return figures_of(*a, *b, r); });
                 }});
    // What cannot be had for less: a tree of each operand, and the result written once more.
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back(
            {"trees and a copy", threads, [=] {
                 const shared_mesh a = solids.a(), b = solids.b();
                 const auto made = std::make_shared<const mesh>(evaluate(*a, *b).mesh);
                 struct answer {
                     tree<3> of_a, of_b;
                     mesh copy;
                 };
                 return make_job([=] {
                     return answer{build_face_tree(*a), build_face_tree(*b), *made};
                 });
             }});
    contest.contestants.push_back(
        {cgal_name() + " EPICK", 1,
         [=] { return cgal_corefinement(*solids.a(), *solids.b(), operation); }});
    return contest;
}

}  // namespace

void booleans(const setting& setting, const contest_visitor& visit) {
    for (const two_solids& solids : pairs(setting)) {
        visit(contest_of(
            solids, "/union", [] { return boolean_expression::union_of(2); },
            corefinement::set_union));
        visit(contest_of(
            solids, "/difference", [] { return boolean_expression::difference_of(2); },
            corefinement::set_difference));
        visit(contest_of(
            solids, "/intersection", [] { return boolean_expression::intersection_of(2); },
            corefinement::set_intersection));
    }
}

}  // namespace treeform::bench
