/// \file
/// E4: set operations and repair: time against what is wrong with the surface that is written.

#include "bench/accuracy.hpp"
#include "bench/exact_volume.hpp"
#include "bench/guarded.hpp"
#include "bench/models.hpp"
#include "bench/peers/cgal_exact_corefinement.hpp"
#include "bench/peers/versions.hpp"
#include "bench/written_surface.hpp"
#include <libmesh/boolean/boolean.hpp>
#include <libmesh/bounding_box.hpp>
#include <libmesh/repair/repair.hpp>

#include <fmt/core.h>
#include <support/solids.hpp>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

namespace tf::bench {
namespace {

constexpr double patience = 60;  // seconds that a method may take in its first run
constexpr const char* volume_name = "volume error";
constexpr const char* failures_name = "failures";
constexpr const char* intersections_name = "self-intersections";
constexpr const char* open_name = "open edges";
constexpr const char* boolean_suffix = "/union";
constexpr const char* difference_suffix = "/difference";
constexpr const char* repair_suffix = "/repair";

/// An answer, or none where the method fails; in the coordinates that are written.
using answer = std::optional<mesh>;
using make_answer = std::function<answer()>;

/// What the exact kernel says the volume is, and of what size the operands are.
struct true_volume {
    mpq_class volume;
    mpq_class scale;
};
using maybe_volume = std::optional<true_volume>;

/// Failures count as one error each, so does every defect.
double errors_of(const answer& found) {
    if (!found) return 1;
    const surface_defects d = defects_of(*found);
    return static_cast<double>(d.intersections + d.degenerate + d.open_edges);
}

std::vector<figure> figures_of(const answer& found, const maybe_volume& truth) {
    if (!found) return {{failures_name, 1}};
    const surface_defects d = defects_of(*found);
    std::vector<figure> figures{{failures_name, 0},
                                {intersections_name, static_cast<double>(d.intersections)},
                                {open_name, static_cast<double>(d.open_edges)},
                                {"crowded edges", static_cast<double>(d.crowded_edges)},
                                {"degenerate faces", static_cast<double>(d.degenerate)},
                                {"faces", static_cast<double>(found->faces.size())}};
    if (truth) {
        const mpq_class off = abs(exact_volume(*found) - truth->volume) / truth->scale;
        figures.push_back({volume_name, off.get_d()});
    }
    return figures;
}

/// What crashes, throws or takes too long in a process of its own is a failure and not run here.
job guarded_job(const make_answer& make, const std::function<maybe_volume()>& volume, bool is_own) {
    if (!is_own) {
        const ending how = ending_of([&] { return make().has_value(); }, patience);
        if (how != ending::done)
            return {.run = [] {},
                    .error = [] { return std::optional(1.0); },
                    .figures =
                        [how] {
                            return std::vector<figure>{{failures_name, 1},
                                                       {std::string(name_of(how)), 1},
                                                       {std::string(not_run), 1}};
                        }};
    }
    return make_job(make, errors_of, [volume](const answer& found) {
        return figures_of(found, volume ? volume() : std::nullopt);
    });
}

struct two_solids {
    std::string name;
    std::function<shared_mesh()> a, b;
};

shared_mesh shared(mesh m) { return std::make_shared<const mesh>(std::move(m)); }

/// Turned about the z axis of the origin, then moved.
mesh placed(mesh m, double angle, const point3& by) {
    for (point3& p : m.points)
        p = {std::cos(angle) * p.x - std::sin(angle) * p.y + by.x,
             std::sin(angle) * p.x + std::cos(angle) * p.y + by.y, p.z + by.z};
    return m;
}

std::vector<two_solids> pairs(const setting& setting) {
    const auto made = [](const std::string& name, const mesh& a, const mesh& b) {
        return two_solids{name, [=] { return shared(a); }, [=] { return shared(b); }};
    };
    const int levels = setting.effort == effort::full ? 4 : setting.effort == effort::quick ? 3 : 1;
    const mesh ball = test::ball(levels, 1.0);
    const mesh cube = test::box(1, 1, 1);
    std::vector<two_solids> all{
        made("balls", ball, placed(ball, 0.7, {0.5, 0.25, 0.125})),
        made("ball_itself", ball, ball),
        made("ball_turned_1e-9", ball, placed(ball, 1e-9, {})),
        made("ball_turned_1e-15", ball, placed(ball, 1e-15, {})),
        made("cubes_side_by_side", cube, placed(cube, 0, {1, 0, 0})),
        made("cubes_overlapping_in_planes", cube, placed(cube, 0, {0.5, 0, 0})),
        made("cube_turned_far_away", placed(cube, 0, {1e6, 1e6, 1e6}),
             placed(cube, 0.3, {1e6, 1e6, 1e6}))};
    if (setting.effort == effort::tiny) return all;
    const auto real = [&](const std::string& name, const char* a, const char* b) {
        if (load_real(setting, a) && load_real(setting, b))
            all.push_back({name, [=] { return load_real(setting, a); },
                           [=] { return load_real(setting, b); }});
    };
    real("crossed_cylinders", "pairs/xcylinder.obj", "pairs/ycylinder.obj");
    if (setting.effort == effort::full) {
        real("quickcsg_cylinders", "pairs/quickcsg_cyl1.off", "pairs/quickcsg_cyl2.off");
        real("bunny_and_cow", "pairs/bunny25k.obj", "pairs/cow25k.obj");
    }
    return all;
}

contest boolean_contest(const two_solids& solids, corefinement operation) {
    const bool is_union = operation == corefinement::set_union;
    contest contest{.name = solids.name + (is_union ? boolean_suffix : difference_suffix),
                    .size = [=] { return solids.a()->faces.size() + solids.b()->faces.size(); },
                    .with_memory = false,
                    .long_runs = 1};
    // The exact kernel's volume, once, where that kernel gives one.
    const auto known = std::make_shared<std::optional<maybe_volume>>();
    const auto volume = [=]() -> maybe_volume {
        if (*known) return **known;
        *known = maybe_volume();
        const shared_mesh a = solids.a(), b = solids.b();
        const auto peer = cgal_solids_of(*a, *b, true);
        const auto ask = [&] { return peer->volume(operation); };
        if (ending_of([&] { return ask().has_value(); }, patience) == ending::done)
            *known = true_volume{*ask(), abs(exact_volume(*a)) + abs(exact_volume(*b))};
        return **known;
    };
    const auto add = [&](std::string who, bool is_own, const std::function<make_answer()>& make) {
        contest.contestants.push_back(
            {std::move(who), 1, [=] { return guarded_job(make(), volume, is_own); }});
    };
    for (const bool in_float : {false, true})
        add(in_float ? "treeform to float" : "treeform", true, [=]() -> make_answer {
            return [=, a = solids.a(), b = solids.b()]() -> answer {
                const std::array<mesh_view, 2> operands{*a, *b};
                solid_result r = boolean(operands,
                                         is_union ? boolean_expression::union_of(2)
                                                  : boolean_expression::difference_of(2),
                                         {.to_float = in_float});
                return r.certified ? answer(std::move(r.surface)) : std::nullopt;
            };
        });
    for (const bool exactly : {false, true})
        for (const bool in_float : {false, true})
            add(cgal_name() + (exactly ? " EPECK" : " EPICK") + (in_float ? " to float" : ""),
                false, [=]() -> make_answer {
                    return
                        [=, peer = cgal_solids_of(*solids.a(), *solids.b(), exactly)]() -> answer {
                            answer found = peer->computed(operation);
                            return found ? answer(as_written(std::move(*found), in_float))
                                         : std::nullopt;
                        };
                });
    return contest;
}

contest repair_contest(const setting& setting, const std::string& path) {
    const std::size_t slash = path.find('/');
    contest contest{.name = path.substr(slash + 1, path.find('.') - slash - 1) + repair_suffix,
                    .size = [=] { return load_real(setting, path)->faces.size(); },
                    .with_memory = false,
                    .long_runs = 1};
    const auto add = [&](std::string who, bool is_own,
                         const std::function<answer(const mesh&)>& make) {
        contest.contestants.push_back({std::move(who), 1, [=] {
                                           const shared_mesh given = load_real(setting, path);
                                           return guarded_job([=] { return make(*given); }, {},
                                                              is_own);
                                       }});
    };
    const auto own = [&](std::string who, repair_mode mode, bool in_float) {
        add(std::move(who), true, [=](const mesh& given) -> answer {
            repaired_mesh r = repair(given, {.mode = mode, .to_float = in_float});
            return r.certified ? answer(std::move(r.surface)) : std::nullopt;
        });
    };
    own("treeform outer", repair_mode::outer, false);
    own("treeform outer to float", repair_mode::outer, true);
    own("treeform remove", repair_mode::remove, false);
    add(cgal_name() + " autorefine", false,
        [](const mesh& given) { return cgal_repaired(given, cgal_repair::autorefine); });
    add(cgal_name() + " local", false,
        [](const mesh& given) { return cgal_repaired(given, cgal_repair::local); });
    return contest;
}

std::vector<outcome> all_but_repairs(const std::vector<outcome>& outcomes, bool repairs) {
    std::vector<outcome> some;
    for (const outcome& o : outcomes)
        if (o.name.ends_with(repair_suffix) == repairs) some.push_back(o);
    return some;
}

}  // namespace

void solids(const setting& setting, const contest_visitor& visit) {
    for (const two_solids& solids : pairs(setting))
        for (const auto operation : {corefinement::set_union, corefinement::set_difference})
            visit(boolean_contest(solids, operation));
    if (setting.effort == effort::tiny) return;
    for (const char* path :
         {"selfint/two_cubes_intersecting.ply", "selfint/cow_6k.obj", "selfint/rear_case_19k.stl",
          "selfint/cat_03_22k.stl", "selfint/frog_legs_18k.obj"})
        if (load_real(setting, path)) visit(repair_contest(setting, path));
}

section draw_solids(const std::vector<outcome>& outcomes, const std::string& machine) {
    const auto booleans = all_but_repairs(outcomes, false);
    const auto repairs = all_but_repairs(outcomes, true);
    const error_of defects = [](const outcome&, const measured& row) -> std::optional<double> {
        return figure_of(row, failures_name).value_or(0) > 0 ? std::nullopt : row.error;
    };
    const auto chart = [&](const std::string& title, const std::string& label,
                           const std::vector<outcome>& some, const error_of& error) {
        return svg(error_chart{{title, machine}, "time, ms", label, dots_by_contest(some, error)});
    };
    const error_of failures = figure_named(failures_name);
    auto table = summary_of(
        booleans, {{"failures", failures},
                   {"self-intersections", figure_named(intersections_name)},
                   {"open edges", figure_named(open_name)},
                   {"degenerate faces", figure_named("degenerate faces")},
                   {"largest volume error", figure_named(volume_name), joined_by::largest, false}});
    for (auto& row : summary_of(repairs, {{"failures", failures},
                                          {"self-intersections", figure_named(intersections_name)},
                                          {"open edges", figure_named(open_name)},
                                          {"degenerate faces", figure_named("degenerate faces")},
                                          {"", figure_named("none")}})) {
        if (row[0].empty()) row[0] = "repair";
        table.push_back(std::move(row));
    }
    return {
        .paper = "",
        .ours = fmt::format(
            "{} set operations and {} repairs, each surface judged as it is written, corners "
            "rounded to double or float. What treeform writes has no self-intersection and no open "
            "edge.",
            booleans.size(), repairs.size()),
        .pictures = {{"e4_volume.svg",
                      chart("Set operations: volume", "volume error, in volumes of the operands",
                            booleans, figure_named(volume_name))},
                     {"e4_defects.svg",
                      chart("Set operations: what is wrong with the file",
                            "self-intersections, open edges, degenerate faces", booleans, defects)},
                     {"e4_repair.svg",
                      chart("Repair: what is wrong with the file",
                            "self-intersections, open edges, degenerate faces", repairs, defects)}},
        .table = std::move(table),
        .remarks = {
            "An answer is judged as a reader of the file sees it: corners rounded to double, or to "
            "float as a binary STL holds them, equal ones joined. CGAL decides what is inside as "
            "exactly, with either kernel; what rounds its corners afterwards does not look again, "
            "and faces that were nearly parallel pass through each other. treeform looks, mends, "
            "and refuses what it cannot certify; a refusal is a failure here, and so is an "
            "exception, a crash, or a first run of more than a minute.",
            "The volume error is against the volume of CGAL's exact result, in rational numbers, "
            "over "
            "the volume of the operands; where that kernel gives none there is no such error. "
            "Rounding moves a corner by up to half a unit in the last place of its coordinates: "
            "1e-16 of them in double, 3e-8 in float, and for the unit cubes 1e6 away from the "
            "origin that is 0.03 of an edge in float. That error is everybody's, treeform's too; "
            "mending may move a corner by a few units more.",
            "Repair: \"outer\" keeps what bounds the solid, so it refuses meshes that bound none; "
            "\"remove\" deletes what meets and fills the holes, and refuses where that comes to no "
            "end. An open edge that CGAL leaves counts here, one that was open before counts, too, "
            "for every method."}};
}

}  // namespace tf::bench
