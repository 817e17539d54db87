/// \file
/// B7: two large meshes met for the first time: tree and distance, tree and collision, beside FCL;
/// collision with trees given; the first contact along a direction beside one distance, trees
/// given; and one of many parts moved.

#include "bench/peers/fcl_models.hpp"
#include "bench/peers/versions.hpp"
#include "bench/pose_askers.hpp"
#include "bench/poses.hpp"
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <libmesh/nearness/closest_pair.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search.hpp>

#include <support/solids.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

namespace treeform::bench {
namespace {

std::vector<scene_name> scenes(const setting& setting) {
    const char* armadillo = "clean/armadillo_29k.obj";
    const char* bunny = "open/bunny_69k.obj";
    const char* blade = "clean/turbineblade_199k.ply";
    switch (setting.effort) {
        case effort::tiny:
            return {{{"", "2k", 2'000}, {"", "3k", 3'000}, 2}};
        case effort::quick:
            return {{{armadillo, "50k", 50'000}, {bunny, "70k", 70'000}, 10}};
        case effort::full:
            break;
    }
    return {{{blade, "200k", 199'000}, {bunny, "280k", 280'000}, 10},
            {{blade, "1M", 1'000'000}, {bunny, "1.09M", 1'090'000}, 10}};
}

/// Trees and one answer: what a program that asks once has to wait for.
make_asker own_from_arrays(pose_question question) {
    return [=](const scene& scene) -> ask_pose {
        return [a = scene.a, b = scene.b, question](const transform<3>& pose) -> double {
            if (question == pose_question::collide)
                return intersects(*a, *b, {.transform_b = pose}) ? 1 : 0;
            return detail::nearness::closest_pair(*a, build_face_tree(*a), *b,
                                                  transformed<3>(build_face_tree(*b), pose))
                .value()
                .distance;
        };
    };
}

make_asker fcl_from_arrays(fcl_volume volume, pose_question question) {
    return [=](const scene& scene) -> ask_pose {
        return [a = scene.a, b = scene.b, volume, question](const transform<3>& pose) -> double {
            const auto models = fcl_pair_of(*a, *b, volume);
            return question == pose_question::collide ? (models->collide(pose) ? 1 : 0)
                                                      : models->distance(pose);
        };
    };
}

contest from_arrays(const setting& setting, scene_name name, const std::string& suffix,
                    pose_question question) {
    name.poses = 1;
    const std::function<shared_scene()> given = [=] { return load(setting, name); };
    const auto expected = answered_once(
        given, question, question == pose_question::collide ? own_collide : own_distance);
    contest contest{.name = name_of(setting, name) + suffix,
                    .size = [=] { return triangles_of(setting, name); },
                    .long_runs = 3};
    const auto add = [&](const std::string& who, unsigned threads, const make_asker& make) {
        contest.contestants.push_back(
            {who, threads, [=] { return pose_job(given(), question, make, expected); }});
    };
    add("treeform", 1, own_from_arrays(question));
    add("treeform", 2, own_from_arrays(question));
    add(fcl_name() + " OBBRSS", 1, fcl_from_arrays(fcl_volume::obbrss, question));
    if (question == pose_question::distance)
        add(fcl_name() + " RSS", 1, fcl_from_arrays(fcl_volume::rss, question));
    return contest;
}

/// Collision alone, trees given, as in B2: there over a thousand positions, here beside the rest.
contest collision_with_trees(const setting& setting, const scene_name& name) {
    const std::function<shared_scene()> given = [=] { return load(setting, name); };
    const auto expected = answered_once(given, pose_question::collide, own_collide);
    contest contest{.name = name_of(setting, name) + "/collide",
                    .size = [=] { return triangles_of(setting, name); },
                    .unit = per_pose(name.poses),
                    .with_memory = false,
                    .long_runs = 3};
    const auto add = [&](const std::string& who, const make_asker& make) {
        contest.contestants.push_back(
            {who, 1, [=] { return pose_job(given(), pose_question::collide, make, expected); }});
    };
    add("treeform", own_collide);
    add(fcl_name() + " OBBRSS", [](const scene& scene) -> ask_pose {
        return [models = fcl_pair_of(*scene.a, *scene.b, fcl_volume::obbrss)](
                   const transform<3>& pose) -> double { return models->collide(pose) ? 1 : 0; };
    });
    return contest;
}

struct prepared {
    shared_scene given;
    prepared_mesh a, b;
};

/// From where the second mesh is toward the center of the first.
point3 toward_first(const scene& scene, const transform<3>& pose) {
    const auto center = [](const mesh& m) {
        const box3 box = bounding_box(m.points).value();
        return point3{0.5 * (box.min.x + box.max.x), 0.5 * (box.min.y + box.max.y),
                      0.5 * (box.min.z + box.max.z)};
    };
    const point3 to = center(*scene.a);
    const point3 from = pose(center(*scene.b));
    return {to.x - from.x, to.y - from.y, to.z - from.z};
}

contest contact_beside_distance(const setting& setting, const scene_name& name) {
    const auto prepare = [=] {
        const shared_scene given = load(setting, name);
        return std::make_shared<const prepared>(
            prepared{given, prepared_mesh::borrow(*given->a), prepared_mesh::borrow(*given->b)});
    };
    contest contest{.name = name_of(setting, name) + "/first_contact",
                    .size = [=] { return triangles_of(setting, name); },
                    .unit = per_pose(name.poses),
                    .with_memory = false,
                    .long_runs = 3};
    contest.contestants.push_back({"treeform", 1, [=] {
                                       const auto p = prepare();
                                       return make_job([p] {
                                           std::size_t met = 0;
                                           for (const transform<3>& pose : p->given->apart)
                                               met += time_of_impact(p->b, p->a,
                                                                     toward_first(*p->given, pose),
                                                                     {.transform_a = pose})
                                                          .outcome == placement_outcome::contact;
                                           return met;
                                       });
                                   }});
    contest.contestants.push_back(
        {"treeform one distance", 1, [=] {
             const auto p = prepare();
             return make_job([p] {
                 double sum = 0.0;
                 for (const transform<3>& pose : p->given->apart)
                     sum += detail::nearness::closest_pair(
                                *p->given->a, build_face_tree(p->a), *p->given->b,
                                transformed<3>(build_face_tree(p->b), pose))
                                .value()
                                .distance;
                 return sum;
             });
         }});
    return contest;
}

/// A thousand balls of 2,048 triangles in a lattice, nearly touching, and where one of them is
/// moved to.
struct parts_scene {
    std::vector<mesh> parts;
    std::vector<aabb<double, 3>> boxes;
    tree<3> over_boxes;
    mesh moved;
};

std::shared_ptr<const parts_scene> make_parts(const setting& setting) {
    const std::size_t side = setting.effort == effort::tiny ? 3 : 10;
    const mesh one = test::ball(4, 1.0);
    const box3 box = bounding_box(one.points).value();
    auto scene = std::make_shared<parts_scene>();
    const auto at = [&](double x, double y, double z) {
        mesh part = one;
        for (point3& p : part.points)
            p = {p.x + x * (box.max.x - box.min.x), p.y + y * (box.max.y - box.min.y),
                 p.z + z * (box.max.z - box.min.z)};
        return part;
    };
    for (std::size_t i = 0; i < side * side * side; ++i)
        scene->parts.push_back(at(static_cast<double>(i % side),
                                  static_cast<double>(i / side % side),
                                  static_cast<double>(i / side / side)));
    for (const mesh& part : scene->parts) {
        aabb<double, 3> bounds;
        for (const point3& p : part.points) bounds.include(p);
        scene->boxes.push_back(bounds);
    }
    scene->over_boxes = build(scene->boxes, [](const aabb<double, 3>& b) { return b; });
    scene->moved = at(1.25, 1.5, 1.25);
    return scene;
}

/// How many of the parts the moved one touches or penetrates; trees of parts are made when wanted.
template <class Parts>
std::size_t met_by_moved(const parts_scene& scene, const Parts& looked_at) {
    const auto moved = prepared_mesh::borrow(scene.moved);
    std::size_t met = 0;
    for (const std::uint32_t i : looked_at)
        met += relation(moved, prepared_mesh::borrow(scene.parts[i])).relation !=
               mesh_relation::disjoint;
    return met;
}

contest scene_of_parts(const setting& setting) {
    const auto prepare = [=] { return make_parts(setting); };
    contest contest{
        .name = setting.effort == effort::tiny ? "27_parts/one_moved" : "1000_parts/one_moved",
        .size =
            [=] {
                const auto scene = prepare();
                return scene->parts.size() * scene->parts[0].faces.size();
            },
        .with_memory = false,
        .long_runs = 3};
    contest.contestants.push_back({"treeform", 1, [=] {
                                       return make_job([scene = prepare()] {
                                           aabb<double, 3> bounds;
                                           for (const point3& p : scene->moved.points)
                                               bounds.include(p);
                                           return met_by_moved(
                                               *scene, search_all(scene->over_boxes, bounds));
                                       });
                                   }});
    contest.contestants.push_back({"treeform all parts looked at", 1, [=] {
                                       return make_job([scene = prepare()] {
                                           std::vector<std::uint32_t> all(scene->parts.size());
                                           std::iota(all.begin(), all.end(), 0U);
                                           return met_by_moved(*scene, all);
                                       });
                                   }});
    return contest;
}

}  // namespace

void placement(const setting& setting, const contest_visitor& visit) {
    for (const scene_name& name : scenes(setting)) {
        visit(from_arrays(setting, name, "/build+distance", pose_question::distance));
        visit(from_arrays(setting, name, "/build+collide", pose_question::collide));
        visit(collision_with_trees(setting, name));
        visit(contact_beside_distance(setting, name));
    }
    visit(scene_of_parts(setting));
}

}  // namespace treeform::bench
