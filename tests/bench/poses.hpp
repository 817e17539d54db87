#pragma once
/// \file
/// Pairs of models in random positions to each other, and what is asked of them in the paper.

#include "bench/models.hpp"
#include "bench/workload.hpp"
#include <treeform/tree/aabb.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace treeform::bench {

/// Two models, each centered and scaled to the unit sphere, and positions of the second.
struct scene {
    shared_mesh a;
    shared_mesh b;
    std::vector<transform<3>> meeting;  ///< in which their surfaces meet
    std::vector<transform<3>> apart;    ///< in which they do not
};
using shared_scene = std::shared_ptr<const scene>;

/// Which two models, and how many positions of each kind.
struct scene_name {
    model a;
    model b;
    std::size_t poses = 0;
};

/// Turns are uniform, moves uniform in the ball of radius 2, in which the spheres meet; both are
/// drawn until the models meet or do not. The same for a seed, here 1.
[[nodiscard]] shared_scene load(const setting& setting, const scene_name& name);
/// "armadillo_212k+bunny_70k"
[[nodiscard]] std::string name_of(const setting& setting, const scene_name& name);
[[nodiscard]] std::size_t triangles_of(const setting& setting, const scene_name& name);

/// What is asked of each position.
enum class pose_question {
    collide,    ///< whether they meet
    intersect,  ///< how many pairs of faces meet
    distance    ///< the least distance
};

/// [poses] 1 or 0, a number of pairs, or a distance.
using pose_answers = std::vector<double>;
using ask_pose = std::function<double(const transform<3>&)>;

/// The positions that a question is about: those apart for distances, meeting ones else.
[[nodiscard]] const std::vector<transform<3>>& poses_of(const scene& scene, pose_question question);

/// Makes what answers a question about a scene; trees are built here and not timed.
using make_asker = std::function<ask_pose(const scene&)>;

/// Asks about all positions. The error is the number of answers that are not as expected, by more
/// than 1e-9 for distances, of those that are expected.
[[nodiscard]] job pose_job(const shared_scene& scene, pose_question question,
                           const make_asker& make, const std::function<pose_answers()>& expected);
/// The answers for the first positions, up to 100, found once and only when asked for.
[[nodiscard]] std::function<pose_answers()> answered_once(
    const std::function<shared_scene()>& given, pose_question question, const make_asker& make);

/// Who answers, and how.
struct asker {
    std::string who;
    make_asker make;
};

/// The unit of a contest about positions: a time for each of them.
[[nodiscard]] unit per_pose(std::size_t poses);

}  // namespace treeform::bench
