/// \file
/// E4: set operations and repair: time against what is wrong with the surface that is written.

#include "bench/accuracy.hpp"
#include "bench/exact_solid.hpp"
#include "bench/guarded.hpp"
#include "bench/models.hpp"
#include "bench/peers/cgal_exact_corefinement.hpp"
#include "bench/peers/versions.hpp"
#include "bench/written_surface.hpp"
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/repair.hpp>

#include <fmt/core.h>
#include <support/rational_points.hpp>
#include <support/solids.hpp>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

namespace treeform::bench {
namespace {

constexpr double patience = 60;  // seconds that a method may take in its first run
constexpr const char* volume_name = "volume error";
constexpr const char* distance_name = "corner distance";
constexpr const char* failures_name = "failures";
constexpr const char* intersections_name = "self-intersections";
constexpr const char* open_name = "open edges";
constexpr const char* degenerate_name = "degenerate faces";
constexpr const char* boolean_suffix = "/union";
constexpr const char* difference_suffix = "/difference";
constexpr const char* repair_suffix = "/repair";

/// An answer, or none where the method fails; in the coordinates that are written.
using answer = std::optional<mesh>;
using make_answer = std::function<answer()>;

/// What the answer ought to be, as far as it is known.
struct true_solid {
    std::optional<mpq_class> volume{};
    mpq_class scale = 1;            ///< of the volume
    std::optional<mesh> surface{};  ///< its corners rounded to the nearest doubles
};
using ask_truth = std::function<const true_solid&()>;

/// What `find` returns, found when it is asked for first.
template <class T>
std::function<const T&()> once(const std::function<T()>& find) {
    return [find, known = std::make_shared<std::optional<T>>()]() -> const T& {
        if (!*known) *known = find();
        return **known;
    };
}

/// Failures count as one error each, so does every defect.
double errors_of(const answer& found) {
    if (!found) return 1;
    const surface_defects d = defects_of(*found);
    return static_cast<double>(d.intersections + d.degenerate + d.open_edges);
}

std::vector<figure> figures_of(const answer& found, const true_solid& truth) {
    if (!found) return {{failures_name, 1}};
    const surface_defects d = defects_of(*found);
    std::vector<figure> figures{{failures_name, 0},
                                {intersections_name, static_cast<double>(d.intersections)},
                                {open_name, static_cast<double>(d.open_edges)},
                                {"crowded edges", static_cast<double>(d.crowded_edges)},
                                {degenerate_name, static_cast<double>(d.degenerate)},
                                {"faces", static_cast<double>(found->faces.size())}};
    if (truth.volume) {
        const mpq_class off = abs(test::volume_of(*found) - *truth.volume) / truth.scale;
        figures.push_back({volume_name, off.get_d()});
    }
    if (truth.surface) figures.push_back({distance_name, corner_distance(*found, *truth.surface)});
    return figures;
}

/// What did not end well in a process of its own is a failure and not run here.
job job_of(const make_answer& make, const ask_truth& truth, ending how = ending::done) {
    if (how != ending::done)
        return {.run = [] {},
                .error = [] { return std::optional(1.0); },
                .figures =
                    [how] {
                        return std::vector<figure>{{failures_name, 1},
                                                   {std::string(name_of(how)), 1},
                                                   {std::string(not_run), 1}};
                    }};
    return make_job(make, errors_of,
                    [truth](const answer& found) { return figures_of(found, truth()); });
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

/// CGAL's corefinement with one kernel. What crashes, throws or takes too long does so in a process
/// of its own, once for all that ask.
struct kernel_solids {
    std::function<const std::shared_ptr<const cgal_solids>&()> peer;
    std::function<const ending&()> how;
};

kernel_solids kernel_solids_of(const two_solids& solids, corefinement operation, bool exactly) {
    const auto peer = once<std::shared_ptr<const cgal_solids>>(
        [=] { return cgal_solids_of(*solids.a(), *solids.b(), exactly); });
    return {peer, once<ending>([=] {
                return ending_of([&] { return peer()->computed(operation).has_value(); }, patience);
            })};
}

/// The volume is the exact kernel's, where that gives one.
true_solid truth_of(const two_solids& solids, corefinement operation,
                    const boolean_expression& expression, const kernel_solids& exact) {
    const std::array operands{*solids.a(), *solids.b()};
    true_solid known{.scale =
                         abs(test::volume_of(operands[0])) + abs(test::volume_of(operands[1]))};
    if (exact.how() == ending::done) known.volume = exact.peer()->volume(operation);
    if (auto own = exact_solid_of(operands, expression)) known.surface = std::move(own->surface);
    return known;
}

contest boolean_contest(const two_solids& solids, corefinement operation) {
    const bool is_union = operation == corefinement::set_union;
    contest contest{.name = solids.name + (is_union ? boolean_suffix : difference_suffix),
                    .size = [=] { return solids.a()->faces.size() + solids.b()->faces.size(); },
                    .with_memory = false,
                    .long_runs = 1};
    const auto expression =
        is_union ? boolean_expression::union_of(2) : boolean_expression::difference_of(2);
    const kernel_solids filtered = kernel_solids_of(solids, operation, false);
    const kernel_solids exact = kernel_solids_of(solids, operation, true);
    const auto truth =
        once<true_solid>([=] { return truth_of(solids, operation, expression, exact); });
    const auto add = [&](std::string who, const std::function<job()>& prepare) {
        contest.contestants.push_back({std::move(who), 1, prepare});
    };
    for (const bool in_float : {false, true})
        add(in_float ? "treeform to float" : "treeform", [=] {
            return job_of(
                [=, a = solids.a(), b = solids.b()]() -> answer {
                    const std::array<mesh_view, 2> operands{*a, *b};
                    boolean_result r = boolean(
                        operands, expression,
                        {.precision = in_float ? tf::precision::float32 : tf::precision::float64});
                    return r.certificate ? answer(std::move(r.mesh)) : std::nullopt;
                },
                truth);
        });
    for (const bool exactly : {false, true})
        for (const bool in_float : {false, true})
            add(cgal_name() + (exactly ? " EPECK" : " EPICK") + (in_float ? " to float" : ""),
                [=, kernel = exactly ? exact : filtered] {
                    return job_of(
                        [=, peer = kernel.peer()]() -> answer {
                            answer found = peer->computed(operation);
                            return found ? answer(as_written(std::move(*found), in_float))
                                         : std::nullopt;
                        },
                        truth, kernel.how());
                });
    return contest;
}

contest repair_contest(const setting& setting, const std::string& path) {
    const std::size_t slash = path.find('/');
    contest contest{.name = path.substr(slash + 1, path.find('.') - slash - 1) + repair_suffix,
                    .size = [=] { return load_real(setting, path)->faces.size(); },
                    .with_memory = false,
                    .long_runs = 1};
    const auto truth = once<true_solid>([=]() -> true_solid {
        const std::array operands{*load_real(setting, path)};
        auto exact = exact_solid_of(operands, boolean_expression::union_of(1));
        if (!exact) return {};
        return {.volume = exact->volume,
                .scale = abs(exact->volume),
                .surface = std::move(exact->surface)};
    });
    const auto add = [&](std::string who, bool is_own,
                         const std::function<answer(const mesh&)>& make) {
        contest.contestants.push_back(
            {std::move(who), 1, [=] {
                 const make_answer ask = [=, given = load_real(setting, path)] {
                     return make(*given);
                 };
                 const auto has_answer = [&] { return ask().has_value(); };
                 return job_of(ask, truth, is_own ? ending::done : ending_of(has_answer, patience));
             }});
    };
    const auto own = [&](std::string who, resolve_mode mode, bool in_float) {
        add(std::move(who), true, [=](const mesh& given) -> answer {
            repair_result r = resolve_self_intersections(
                given, mode, {.precision = in_float ? precision::float32 : precision::float64});
            return r.certificate ? answer(std::move(r.mesh)) : std::nullopt;
        });
    };
    own("treeform outer", resolve_mode::outer, false);
    own("treeform outer to float", resolve_mode::outer, true);
    own("treeform remove", resolve_mode::remove, false);
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
    const std::vector<summed_column> columns{
        {"failures", figure_named(failures_name)},
        {"self-intersections", figure_named(intersections_name)},
        {"open edges", figure_named(open_name)},
        {"degenerate faces", figure_named(degenerate_name)},
        {"largest volume error", figure_named(volume_name), joined_by::largest, false},
        {"largest corner distance", figure_named(distance_name), joined_by::largest, false}};
    auto table = summary_of(booleans, columns);
    for (auto& row : summary_of(repairs, columns)) {
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
                     {"e4_distance.svg", chart("Set operations: distance from the exact surface",
                                               "furthest corner, in sizes of the result", booleans,
                                               figure_named(distance_name))},
                     {"e4_defects.svg",
                      chart("Set operations: what is wrong with the file",
                            "self-intersections, open edges, degenerate faces", booleans, defects)},
                     {"e4_repair_volume.svg",
                      chart("Repair: volume", "volume error, in volumes of the solid", repairs,
                            figure_named(volume_name))},
                     {"e4_repair_distance.svg", chart("Repair: distance from the exact surface",
                                                      "furthest corner, in sizes of the result",
                                                      repairs, figure_named(distance_name))},
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
            "over the volume of the operands; where that kernel gives none there is no such error. "
            "Rounding moves a corner by up to half a unit in the last place of its coordinates: "
            "1e-16 of them in double, 3e-8 in float, and for the unit cubes 1e6 away from the "
            "origin that is 0.03 of an edge in float. That error is everybody's, treeform's too; "
            "mending may move a corner by a few units more.",
            "The distance is of the corners of what is written from the exact surface, or of the "
            "exact corners from what is written, whichever is furthest, over the diagonal of the "
            "box of the result. The exact surface is treeform's arrangement before rounding. "
            "Distances are computed in double, and what that may be off is added: what is called "
            "2e-15 may be nothing, and nobody is called exact but where the result is and ought to "
            "be empty. A ball without the same ball turned by 1e-15, or by 1e-9 and written in "
            "float, is thinner than rounding: treeform leaves out the pieces that have no inside "
            "left, and where they were may be 0.1 of the size from the rest, while their volume is "
            "the error above. CGAL writes them, as faces without area that pass through each "
            "other.",
            "Repair: \"outer\" keeps what bounds the solid, so it refuses meshes that bound none; "
            "\"remove\" deletes what meets and fills the holes, and refuses where that comes to no "
            "end. An open edge that CGAL leaves counts here, one that was open before counts, too, "
            "for every method. Volume and distance are against what \"outer\" ought to keep, the "
            "points that the mesh winds around, with its volume in rational numbers; of a mesh "
            "that bounds no solid there is neither. \"outer\" is off by the rounding of the "
            "corners it has cut. \"remove\" and CGAL's local repair close holes where parts "
            "overlapped: they are another answer by intention, and these errors say how far off. "
            "CGAL's autorefine is as near as \"outer\" where it succeeds; where its error is 1 it "
            "has kept next to nothing of the mesh, closed and without a word."}};
}

}  // namespace treeform::bench
