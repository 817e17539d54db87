#include "bench/poses.hpp"

#include "support/random.hpp"
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace treeform::bench {
namespace {

shared_mesh in_unit_sphere(const mesh& given) {
    auto result = std::make_shared<mesh>(given);
    const box3 box = bounding_box(given.points).value();
    double furthest = 0;
    for (point3& p : result->points) {
        for (std::size_t k = 0; k < 3; ++k) p[k] -= 0.5 * (box.min[k] + box.max[k]);
        furthest = std::max(furthest, p.x * p.x + p.y * p.y + p.z * p.z);
    }
    const double scale = 1 / std::sqrt(furthest);
    for (point3& p : result->points) p = {p.x * scale, p.y * scale, p.z * scale};
    return result;
}

/// Uniform in the ball, with correctly rounded operations only.
template <std::size_t N>
std::array<double, N> in_ball(test::random& random, double radius) {
    for (;;) {
        std::array<double, N> x;
        double squared = 0;
        for (double& one : x) {
            one = random.in(-1, 1);
            squared += one * one;
        }
        if (squared > 1e-6 && squared <= 1) {
            for (double& one : x) one *= radius;
            return x;
        }
    }
}

transform<3> random_pose(test::random& random) {
    auto [w, x, y, z] = in_ball<4>(random, 1);
    const double length = std::sqrt(w * w + x * x + y * y + z * z);
    w /= length, x /= length, y /= length, z /= length;
    const auto t = in_ball<3>(random, 2);
    transform<3> pose;
    pose.rows[0] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), t[0]};
    pose.rows[1] = {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), t[1]};
    pose.rows[2] = {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), t[2]};
    return pose;
}

void draw_poses(scene& scene, std::size_t count) {
    const tree<3> tree_a = build_face_tree(*scene.a), tree_b = build_face_tree(*scene.b);
    test::random random(1);
    while (scene.meeting.size() < count || scene.apart.size() < count) {
        const transform<3> pose = random_pose(random);
        const bool meet = detail::intersect::intersects(*scene.a, tree_a, *scene.b, tree_b,
                                                        {.transform_b = pose});
        std::vector<transform<3>>& list = meet ? scene.meeting : scene.apart;
        if (list.size() < count) list.push_back(pose);
    }
}

}  // namespace

shared_scene load(const setting& setting, const scene_name& name) {
    static std::map<std::string, std::weak_ptr<const scene>> in_use;
    std::weak_ptr<const scene>& known = in_use[name_of(setting, name)];
    if (const shared_scene same = known.lock(); same && same->apart.size() == name.poses)
        return same;
    const auto result = std::make_shared<scene>();
    result->a = in_unit_sphere(*load(setting, name.a));
    result->b = in_unit_sphere(*load(setting, name.b));
    draw_poses(*result, name.poses);
    known = result;
    return result;
}

std::string name_of(const setting& setting, const scene_name& name) {
    return name_of(setting, name.a) + "+" + name_of(setting, name.b);
}

std::size_t triangles_of(const setting& setting, const scene_name& name) {
    return load(setting, name.a)->faces.size() + load(setting, name.b)->faces.size();
}

const std::vector<transform<3>>& poses_of(const scene& scene, pose_question question) {
    return question == pose_question::distance ? scene.apart : scene.meeting;
}

std::function<pose_answers()> answered_once(const std::function<shared_scene()>& given,
                                            pose_question question, const make_asker& make) {
    const auto known = std::make_shared<std::optional<pose_answers>>();
    return [=] {
        if (*known) return **known;
        const shared_scene scene = given();
        const ask_pose ask = make(*scene);
        pose_answers& answers = known->emplace();
        for (const transform<3>& pose : poses_of(*scene, question)) {
            if (answers.size() == 100) break;
            answers.push_back(ask(pose));
        }
        return answers;
    };
}

job pose_job(const shared_scene& scene, pose_question question, const make_asker& make,
             const std::function<pose_answers()>& expected) {
    const auto run = [scene, question, ask = make(*scene)] {
        pose_answers answers;
        for (const transform<3>& pose : poses_of(*scene, question)) answers.push_back(ask(pose));
        return answers;
    };
    const auto error = [expected, question](const pose_answers& answers) {
        const pose_answers truth = expected();
        const double most = question == pose_question::distance ? 1e-9 : 0.0;
        double wrong = 0;
        for (std::size_t i = 0; i < truth.size(); ++i)
            wrong += std::abs(answers.at(i) - truth[i]) > most;
        return wrong;
    };
    const auto figures = [question](const pose_answers& answers) -> std::vector<figure> {
        if (question != pose_question::intersect) return {};
        const double pairs = std::accumulate(answers.begin(), answers.end(), 0.0);
        return {{"pairs/pose", pairs / static_cast<double>(answers.size())}};
    };
    return make_job(run, error, figures);
}

unit per_pose(std::size_t poses) {
    return {.name = "us/pose", .scale = 1e6 / static_cast<double>(poses)};
}

}  // namespace treeform::bench
