/// \file
/// B2: collision, intersecting pairs and distance of two models in random positions, beside FCL and
/// CGAL, trees given.

#include "bench/page.hpp"
#include "bench/peers/cgal_pairs.hpp"
#include "bench/peers/fcl_models.hpp"
#include "bench/peers/versions.hpp"
#include "bench/pose_askers.hpp"
#include "bench/poses.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace treeform::bench {
namespace {

/// A scene with as many positions as its slowest contestant has time for.
struct trial {
    scene_name scene;
    std::size_t poses_of_intersect;
};

std::vector<trial> trials(const setting& setting) {
    const char* armadillo = "clean/armadillo_29k.obj";
    const char* bunny = "open/bunny_69k.obj";
    const char* blade = "clean/turbineblade_199k.ply";
    switch (setting.effort) {
        case effort::tiny:
            return {{{{"", "2k", 2'000}, {"", "3k", 3'000}, 5}, 5}};
        case effort::quick:
            return {{{{armadillo, "50k", 50'000}, {bunny, "70k", 70'000}, 100}, 20}};
        case effort::full:
            break;
    }
    return {{{{armadillo, "50k", 50'000}, {bunny, "70k", 70'000}, 1000}, 200},
            {{{blade, "200k", 199'000}, {bunny, "280k", 280'000}, 1000}, 100},
            {{{blade, "1M", 1'000'000}, {bunny, "1.09M", 1'090'000}, 1000}, 50}};
}

make_asker fcl_asker(fcl_volume volume, pose_question question) {
    return [=](const scene& scene) -> ask_pose {
        const auto models = fcl_pair_of(*scene.a, *scene.b, volume);
        return [=](const transform<3>& pose) -> double {
            switch (question) {
                case pose_question::collide:
                    return models->collide(pose) ? 1 : 0;
                case pose_question::intersect:
                    return static_cast<double>(models->intersect(pose));
                case pose_question::distance:
                    break;
            }
            return models->distance(pose);
        };
    };
}

make_asker cgal_asker(pose_question question) {
    return [=](const scene& scene) -> ask_pose {
        const auto pair = std::make_shared<const cgal_pair>(*scene.a, *scene.b);
        return [=](const transform<3>& pose) -> double {
            return question == pose_question::collide ? static_cast<double>(pair->collide(pose))
                                                      : static_cast<double>(pair->intersect(pose));
        };
    };
}

/// The first asker is ours and runs with one thread and with two.
contest contest_of(const setting& setting, const scene_name& name, const std::string& suffix,
                   pose_question question, const std::vector<asker>& askers,
                   const make_asker& judge) {
    const std::function<shared_scene()> given = [=] { return load(setting, name); };
    const auto expected = answered_once(given, question, judge);
    contest contest{.name = name_of(setting, name) + suffix,
                    .size = [=] { return triangles_of(setting, name); },
                    .unit = per_pose(name.poses),
                    .with_memory = false,
                    .long_runs = 3};
    const auto add = [&](const asker& asker, unsigned threads) {
        contest.contestants.push_back({asker.who, threads, [=] {
                                           return pose_job(given(), question, asker.make, expected);
                                       }});
    };
    add(askers.front(), 1);
    add(askers.front(), 2);
    for (std::size_t i = 1; i < askers.size(); ++i) add(askers[i], 1);
    return contest;
}

std::string sentence(const std::vector<outcome>& outcomes, const std::string& suffix,
                     const std::string& what) {
    std::string text;
    for (const outcome& outcome : outcomes) {
        if (!outcome.name.ends_with(suffix)) continue;
        text = fmt::format("{} takes {:.4g} us a position", what,
                           outcome.value("treeform").value_or(0));
        for (const measured& row : outcome.rows)
            if (row.who != "treeform")
                text += fmt::format(
                    ", {} {}",
                    compared(outcome.value("treeform").value_or(0), *outcome.value(row.who)),
                    row.who);
    }
    return text;
}

}  // namespace

void poses_by_peers(const setting& setting, const contest_visitor& visit) {
    const std::string obbrss = fcl_name() + " OBBRSS", rss = fcl_name() + " RSS";
    const std::string cgal = cgal_name() + " EPICK";
    for (const trial& trial : trials(setting)) {
        visit(contest_of(setting, trial.scene, "/collide", pose_question::collide,
                         {{"treeform", own_collide},
                          {obbrss, fcl_asker(fcl_volume::obbrss, pose_question::collide)}},
                         paper_collide));
        scene_name fewer = trial.scene;
        fewer.poses = trial.poses_of_intersect;
        visit(contest_of(setting, fewer, "/intersect", pose_question::intersect,
                         {{"treeform", own_intersect},
                          {obbrss, fcl_asker(fcl_volume::obbrss, pose_question::intersect)},
                          {cgal, cgal_asker(pose_question::intersect)}},
                         cgal_asker(pose_question::intersect)));
        visit(contest_of(setting, trial.scene, "/nearest", pose_question::distance,
                         {{"treeform", own_distance},
                          {obbrss, fcl_asker(fcl_volume::obbrss, pose_question::distance)},
                          {rss, fcl_asker(fcl_volume::rss, pose_question::distance)}},
                         [](const scene& scene) { return paper_distance(scene, open_by::top_k); }));
    }
}

section draw_poses_by_peers(const std::vector<outcome>& outcomes, const std::string& machine) {
    return {.paper = "",
            .ours = fmt::format("of the largest models, {}; {}; {}; one thread.",
                                sentence(outcomes, "/collide", "a collision"),
                                sentence(outcomes, "/intersect", "finding all intersecting pairs"),
                                sentence(outcomes, "/nearest", "the nearest points")),
            .pictures = {
                {"b2_collide.svg",
                 svg(bars_by_contest(outcomes, "/collide", {"Collision", machine}, "treeform"))},
                {"b2_intersect.svg",
                 svg(bars_by_contest(outcomes, "/intersect", {"All intersecting pairs", machine},
                                     "treeform"))},
                {"b2_nearest.svg", svg(bars_by_contest(outcomes, "/nearest",
                                                       {"Nearest points", machine}, "treeform"))}}};
}

}  // namespace treeform::bench
