/// \file
/// T1: Table I of the paper: collision, intersecting pairs and distance of models in random
/// positions, trees given.

#include "bench/page.hpp"
#include "bench/pose_askers.hpp"
#include "bench/poses.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace treeform::bench {
namespace {

std::vector<scene_name> scenes(const setting& setting) {
    if (setting.effort == effort::tiny)
        return {{.a = {"", "2k", 2'000}, .b = {"", "3k", 3'000}, .poses = 5}};
    const char* armadillo = "clean/armadillo_29k.obj";
    const char* bunny = "open/bunny_69k.obj";
    const char* koala = "clean/koala_100k.obj";
    const char* blade = "clean/turbineblade_199k.ply";
    if (setting.effort == effort::quick)
        return {{{armadillo, "50k", 50'000}, {bunny, "70k", 70'000}, 100},
                {{blade, "200k", 199'000}, {bunny, "70k", 70'000}, 100}};
    const model armadillo_212k{armadillo, "212k", 212'000}, bunny_70k{bunny, "70k", 70'000},
        koala_412k{koala, "412k", 412'000}, blade_1m{blade, "1M", 1'000'000};
    return {{armadillo_212k, bunny_70k, 1000},
            {koala_412k, bunny_70k, 1000},

            {blade_1m, bunny_70k, 1000},
            {blade_1m, koala_412k, 1000}};
}

contest contest_of(const setting& setting, const scene_name& name, const std::string& suffix,
                   pose_question question, const std::vector<asker>& askers,
                   const std::function<pose_answers()>& expected) {
    const std::function<shared_scene()> given = [=] { return load(setting, name); };
    contest contest{.name = name_of(setting, name) + suffix,
                    .size = [=] { return triangles_of(setting, name); },
                    .unit = per_pose(name.poses),
                    .with_memory = false,
                    .long_runs = 2};
    for (const asker& asker : askers)
        contest.contestants.push_back(
            {asker.who, 1, [=] { return pose_job(given(), question, asker.make, expected); }});
    return contest;
}

/// The paper's search for distances, with the boxes it inspects as a figure.
contestant counting(const setting& setting, const scene_name& name, const std::string& who,
                    open_by order, const std::function<pose_answers()>& expected) {
    return {
        who, 1, [=] {
            const auto counted = std::make_shared<box_count>();
            job job = pose_job(
                load(setting, name), pose_question::distance,
                [=](const scene& scene) { return paper_distance(scene, order, {}, counted); },
                expected);
            job.figures = [counted] {
                return std::vector<figure>{{"boxes/pose", static_cast<double>(counted->boxes) /
                                                              static_cast<double>(counted->poses)}};
            };
            return job;
        }};
}

constexpr const char* own = "treeform";
constexpr const char* top_k = "paper top_k";
constexpr const char* heap = "paper heap";

/// The rows of the paper's Table I, all times in us.
const std::vector<std::vector<std::string>>& papers_rows() {
    static const std::vector<std::vector<std::string>> rows{
        {"armadillo + bunny", "282204", "33.20", "760", "1490", "3000", "2.02", "1.26"},
        {"erato + teapot", "428202", "39.15", "2140", "2550", "6160", "2.42", "1.47"},
        {"erato + bunny", "482128", "35.42", "1420", "1400", "2600", "1.86", "1.40"},
        {"erato + armadillo", "625072", "50.99", "1460", "1360", "2350", "1.72", "1.51"},
        {"buddha + teapot", "1103178", "29.76", "3710", "5430", "16400", "3.02", "1.10"},
        {"buddha + bunny", "1157104", "38.17", "2010", "2900", "6070", "2.09", "1.47"},
        {"buddha + armadillo", "1300048", "52.51", "1990", "2790", "5210", "1.87", "1.52"},
        {"buddha + erato", "1499972", "46.50", "2410", "1470", "2500", "1.70", "1.40"},
        {"bike + teapot", "1692478", "25.89", "8650", "1400", "3460", "2.47", "1.13"},
        {"bike + bunny", "1746404", "48.86", "2930", "1210", "2370", "1.96", "1.47"},
        {"bike + armadillo", "1889348", "63.46", "3150", "1210", "2170", "1.79", "1.59"},
        {"bike + erato", "2089272", "66.89", "3340", "780", "1510", "1.92", "1.25"},
        {"bike + buddha", "2764248", "61.07", "2940", "2300", "3870", "1.68", "1.58"}};
    return rows;
}

std::string cell(const std::optional<double>& value) {
    return value ? fmt::format("{:.4g}", *value) : std::string("-");
}

std::string quotient(const std::optional<double>& a, const std::optional<double>& b) {
    return a && b ? fmt::format("{:.2f}", *a / *b) : std::string("-");
}

/// The three contests of each scene, in the order they were run.
std::vector<std::vector<std::string>> table_of(const std::vector<outcome>& outcomes) {
    std::vector<std::vector<std::string>> rows{{"us a position", "triangles", "paper: collide",
                                                "intersect", "top-k", "heap", "f_time", "f_cost",
                                                "treeform: collide", "intersect", "nearest"}};
    for (std::size_t i = 0; i + 2 < outcomes.size(); i += 3) {
        const outcome &collide = outcomes[i], &intersect = outcomes[i + 1],
                      &nearest = outcomes[i + 2];
        rows.push_back(
            {collide.name.substr(0, collide.name.find('/')), std::to_string(collide.size),
             cell(collide.value("paper")), cell(intersect.value("paper")),
             cell(nearest.value(top_k)), cell(nearest.value(heap)),
             quotient(nearest.value(heap), nearest.value(top_k)),
             quotient(nearest.figure(top_k, "boxes/pose"), nearest.figure(heap, "boxes/pose")),
             cell(collide.value(own)), cell(intersect.value(own)), cell(nearest.value(own))});
    }
    for (std::vector<std::string> row : papers_rows()) {
        row[0] = "in the paper: " + row[0];
        rows.push_back(std::move(row));
    }
    return rows;
}

/// How many times as long as ours the paper's search took, in the mean of all scenes.
double mean_ratio(const std::vector<outcome>& outcomes, const std::string& suffix,
                  const std::string& who) {
    double sum = 0, count = 0;
    for (const outcome& outcome : outcomes)
        if (outcome.name.ends_with(suffix)) {
            sum += std::log(outcome.value(who).value_or(1) / outcome.value(own).value_or(1));
            ++count;
        }
    return std::exp(sum / std::max(count, 1.0));
}

}  // namespace

void poses(const setting& setting, const contest_visitor& visit) {
    for (const scene_name& name : scenes(setting)) {
        const shared_scene kept = load(setting, name);  // for all three
        // The paper's searches and ours are strangers to each other and must agree.
        const auto by_paper = [&](pose_question question, const make_asker& make) {
            return answered_once([=] { return load(setting, name); }, question, make);
        };
        visit(contest_of(setting, name, "/collide", pose_question::collide,
                         {{own, own_collide}, {"paper", paper_collide}},
                         by_paper(pose_question::collide, paper_collide)));
        visit(contest_of(setting, name, "/intersect", pose_question::intersect,
                         {{own, own_intersect}, {"paper", paper_intersect}},
                         by_paper(pose_question::intersect, paper_intersect)));
        const auto expected = by_paper(pose_question::distance, [](const scene& scene) {
            return paper_distance(scene, open_by::top_k);
        });
        contest nearest = contest_of(setting, name, "/nearest", pose_question::distance,
                                     {{own, own_distance}}, expected);
        nearest.contestants.push_back(counting(setting, name, top_k, open_by::top_k, expected));
        nearest.contestants.push_back(counting(setting, name, heap, open_by::heap, expected));
        visit(nearest);
    }
}

section draw_poses(const std::vector<outcome>& outcomes, const std::string& machine) {
    const std::string ours = fmt::format(
        "in the mean of all pairs, the paper's search takes {:.1f} times as long as treeform to "
        "find a collision, {:.1f} times for all intersecting pairs, and for the nearest points "
        "{:.1f} times with the sorted stack and {:.1f} times with the heap; one thread.",
        mean_ratio(outcomes, "/collide", "paper"), mean_ratio(outcomes, "/intersect", "paper"),
        mean_ratio(outcomes, "/nearest", top_k), mean_ratio(outcomes, "/nearest", heap));
    return {
        .paper =
            "47 us for a collision, milliseconds for all intersecting pairs; the sorted "
            "stack finds nearest points 1.7 to 3 times as fast as the heap while it "
            "inspects 1.37 times the boxes (10,000 positions, searches on six cores).",
        .ours = ours,
        .pictures = {{"t1_collide.svg", svg(bars_by_contest(outcomes, "/collide",
                                                            {"Collision, one thread", machine}))},
                     {"t1_intersect.svg",
                      svg(bars_by_contest(outcomes, "/intersect",
                                          {"All intersecting pairs, one thread", machine}))},
                     {"t1_nearest.svg",
                      svg(bars_by_contest(outcomes, "/nearest",
                                          {"Nearest points, one thread", machine}))}},
        .table = table_of(outcomes)};
}

}  // namespace treeform::bench
