/// \file
/// B1: the tree over the triangles of a mesh, from arrays, boxes included.

#include "bench/models.hpp"
#include "bench/peers/cgal_aabb_tree.hpp"
#include "bench/peers/versions.hpp"
#include "bench/workload.hpp"
#include "support/random.hpp"
#include <libtree/paper/nary_tree.hpp>
#include <libtree/paper/validate.hpp>
#include <treeform/tree/build.hpp>

#include <cmath>
#include <limits>
#include <span>

namespace treeform::bench {
namespace {

template <class T>
auto box_maker_of(const mesh& mesh) {
    return [points = points_view(mesh.points)](const face& f) {
        aabb<double, 3> box;
        for (const std::uint32_t corner : f) box.include(points[corner]);
        if constexpr (std::is_same_v<T, double>) {
            return box;
        } else {
            constexpr float infinity = std::numeric_limits<float>::infinity();
            aabb<float, 3> outer;
            for (std::size_t k = 0; k < 3; ++k) {
                outer.min[k] = std::nextafter(static_cast<float>(box.min[k]), -infinity);
                outer.max[k] = std::nextafter(static_cast<float>(box.max[k]), infinity);
            }
            return outer;
        }
    };
}

/// 0 when all invariants of the tree hold, else 1.
template <class T, class Tree>
double error_of(const Tree& tree, const mesh& mesh) {
    std::vector<aabb<T, 3>> boxes;
    for (const face& f : mesh.faces) boxes.push_back(box_maker_of<T>(mesh)(f));
    return why_malformed(tree, std::span<const aabb<T, 3>>(boxes)) ? 1.0 : 0.0;
}

job wide_tree_build(const shared_mesh& mesh) {
    return make_job([mesh] { return build(mesh->faces, box_maker_of<double>(*mesh)); },
                    [mesh](const auto& tree) { return error_of<double>(tree, *mesh); });
}

/// The paper's scheme: a permutation of ids, nth_element, four children, boxes of type T.
template <class T>
job paper_build(const shared_mesh& mesh) {
    return make_job(
        [mesh] {
            return build<strategy::nth_element>(mesh->faces, box_maker_of<T>(*mesh),
                                                tree_config{.inner_size = 4, .leaf_size = 4});
        },
        [mesh](const auto& tree) { return error_of<T>(tree, *mesh); });
}

shared_mesh load_shuffled(const setting& setting, const model& model) {
    return cached(setting, "shuffled_" + name_of(setting, model), [&] {
        mesh mesh = *load(setting, model);
        test::random random(1);
        random.shuffle(mesh.faces);
        return mesh;
    });
}

contest contest_of(const std::string& name, const std::function<shared_mesh()>& load) {
    contest contest{.name = name, .size = [load] { return load()->faces.size(); }};
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back(
            {"treeform", threads, [load] { return wide_tree_build(load()); }});
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back(
            {"paper", threads, [load] { return paper_build<double>(load()); }});
    contest.contestants.push_back(
        {"paper (float)", 1, [load] { return paper_build<float>(load()); }});
    contest.contestants.push_back(
        {cgal_name() + " AABB_tree", 1, [load] { return cgal_aabb_tree(*load()); }});
    return contest;
}

}  // namespace

void tree_build(const setting& setting, const contest_visitor& visit) {
    for (const model& model : clean_models(setting)) {
        const std::string name = name_of(setting, model);
        visit(contest_of(name + "/mesh_order", [=] { return load(setting, model); }));
        visit(contest_of(name + "/shuffled", [=] { return load_shuffled(setting, model); }));
    }
}

}  // namespace treeform::bench
