/// \file
/// B5: all pairs of faces that meet, from arrays to classified pairs, tree included.

#include "bench/models.hpp"
#include "bench/peers/cgal_self_intersections.hpp"
#include "bench/peers/versions.hpp"
#include "bench/workload.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>

namespace treeform::bench {
namespace {

/// How many pairs of proper faces meet; none where nobody else knows.
using truth = std::function<std::optional<double>()>;

double pairs_of_proper_faces(const face_pair_result& result) {
    std::uint64_t pairs = 0;
    for (const std::uint64_t count : result.counts) pairs += count;
    return static_cast<double>(pairs -
                               result.counts[static_cast<std::size_t>(pair_kind::degenerate)]);
}

std::optional<double> distance(double pairs, const std::optional<double>& expected) {
    return expected ? std::optional(std::abs(pairs - *expected)) : std::nullopt;
}

job find_pairs(const shared_mesh& mesh, const truth& expected) {
    using answer = face_pair_result;
    return make_job(
        [mesh] { return self_intersections(*mesh, {.vertices = vertex_identity::by_index}); },
        [expected](const answer& result) {
            return distance(pairs_of_proper_faces(result), expected());
        },
        [](const answer& result) {
            return std::vector<figure>{
                {"pairs", pairs_of_proper_faces(result)},
                {"pairs of boxes", static_cast<double>(result.box_pairs)},
                {"pairs left to exact", static_cast<double>(result.exact_pairs)}};
        });
}

contest contest_of(const std::string& name, const truth& expected,
                   const std::function<shared_mesh()>& load) {
    contest contest{.name = name, .size = [load] { return load()->faces.size(); }};
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back(
            {"treeform", threads, [=] { return find_pairs(load(), expected); }});
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back(
            {cgal_name() + (threads == 1 ? " EPICK" : " EPICK TBB"), threads,
             [=] { return cgal_self_intersections(*load(), threads, expected); }});
    return contest;
}

/// `mesh` and a copy of it, moved along `axis` so that their boxes share a tenth of its length.
mesh two_along(const mesh& one, std::size_t axis) {
    const box3 box = bounding_box(one.points).value();
    mesh both = one;
    for (point3 p : one.points) {
        p[axis] += 0.9 * (box.max[axis] - box.min[axis]);
        both.points.push_back(p);
    }
    const auto points = static_cast<std::uint32_t>(one.points.size());
    for (const face& f : one.faces)
        both.faces.push_back({f[0] + points, f[1] + points, f[2] + points});
    return both;
}

/// Two copies along the first axis at which not only their boxes meet.
mesh overlapping_copies(const mesh& one) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        mesh both = two_along(one, axis);
        if (!self_intersections(both, {.vertices = vertex_identity::by_index, .first_only = true})
                 .pairs.empty())
            return both;
    }
    throw std::runtime_error("copies that overlap by a tenth do not meet");
}

contest overlap_contest(const setting& setting) {
    const model half =
        setting.effort == effort::full    ? model{"clean/turbineblade_199k.ply", "500k", 500'000}
        : setting.effort == effort::quick ? model{"clean/armadillo_29k.obj", "100k", 100'000}
                                          : model{"", "3k", 3'000};
    const std::string name = "two_" + name_of(setting, half);
    const auto load_both = [=] {
        return cached(setting, name, [&] { return overlapping_copies(*load(setting, half)); });
    };
    // Nothing is degenerate or shared but what both definitions mean by it, so the peer's number
    // is the one to meet.
    const auto known = std::make_shared<std::optional<double>>();
    const truth by_peer = [=] {
        if (!*known) *known = cgal_pair_count(*load_both());
        return *known;
    };
    return contest_of(name + "/overlap_10%", by_peer, load_both);
}

/// Models with faults as people have them, and how many pairs of their proper faces meet.
struct real_model {
    std::string_view path;
    double pairs;
};
constexpr std::array real_models{
    real_model{"selfint/cloth_ball_92k.ply", 63602},  real_model{"selfint/scorpion_100k.obj", 15},
    real_model{"scene/kitchen.obj", 42352},           real_model{"cad/cycloidal_43k.ply", 54960},
    real_model{"selfint/mini_gantry_22k.stl", 13317}, real_model{"selfint/cat_03_22k.stl", 114},
};

}  // namespace

void self_intersections(const setting& setting, const contest_visitor& visit) {
    for (const model& model : clean_models(setting))
        visit(contest_of(
            name_of(setting, model) + "/clean", [] { return 0.0; },
            [=] { return load(setting, model); }));
    visit(overlap_contest(setting));
    if (setting.effort == effort::tiny) return;
    const std::size_t count = setting.effort == effort::quick ? 1 : real_models.size();
    for (const real_model& model : std::span(real_models).first(count)) {
        const std::string path(model.path);
        if (!load_real(setting, path)) continue;
        const std::size_t slash = path.find('/');
        visit(contest_of(
            path.substr(slash + 1, path.find('.') - slash - 1) + "/real",
            [=] { return model.pairs; }, [=] { return load_real(setting, path); }));
    }
}

}  // namespace treeform::bench
