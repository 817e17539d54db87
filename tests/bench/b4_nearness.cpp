/// \file
/// B4: the nearest point of a mesh, beside CGAL and the paper's search, and the k nearest points of
/// a cloud, beside nanoflann.

#include "bench/face_boxes.hpp"
#include "bench/models.hpp"
#include "bench/nary_nearness.hpp"
#include "bench/page.hpp"
#include "bench/peers/cgal_closest.hpp"
#include "bench/peers/nanoflann_points.hpp"
#include "bench/peers/versions.hpp"
#include "support/random.hpp"
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/nearness.hpp>
#include <treeform/tree/point_search.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace treeform::bench {
namespace {

using points = std::vector<point3>;
using distances = std::vector<double>;

constexpr const char* closest_name = "/closest_point";
constexpr const char* k_nearest_name = "/10_nearest";
constexpr const char* build_name = "/build";
constexpr std::size_t k = 10;

/// About normal, of mean 0 and deviation 1; with correctly rounded operations only.
double deviate(test::random& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.unit();
    return sum;
}

/// A point of a random face, moved along the normal by about 1 % of the diagonal.
point3 near_surface(const mesh& mesh, double diagonal, test::random& random) {
    for (;;) {
        const face& f = mesh.faces[random.below(mesh.faces.size())];
        const point3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
        const point3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
        const point3 n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
        const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        double s = random.unit(), t = random.unit();
        if (s + t > 1) s = 1 - s, t = 1 - t;
        const double off = 0.01 * diagonal * deviate(random) / length;
        if (length == 0) continue;
        return {a.x + s * u.x + t * v.x + off * n.x, a.y + s * u.y + t * v.y + off * n.y,
                a.z + s * u.z + t * v.z + off * n.z};
    }
}

/// Half near the surface, half uniform in a box half as large again as the model's, in no order.
points queries_about(const mesh& mesh, std::size_t count) {
    const box3 box = bounding_box(mesh.points).value();
    double squared = 0;
    for (std::size_t i = 0; i < 3; ++i)
        squared += (box.max[i] - box.min[i]) * (box.max[i] - box.min[i]);
    test::random random(1);
    points queries;
    for (std::size_t i = 0; i < count; ++i) {
        point3 p = near_surface(mesh, std::sqrt(squared), random);
        for (std::size_t j = 0; i % 2 == 1 && j < 3; ++j) {
            const double margin = 0.25 * (box.max[j] - box.min[j]);
            p[j] = random.in(box.min[j] - margin, box.max[j] + margin);
        }
        queries.push_back(p);
    }
    return queries;
}

struct closest_input {
    shared_mesh mesh;
    points queries;
};
using shared_input = std::shared_ptr<const closest_input>;

triangle3 triangle_of(const mesh& mesh, std::uint32_t f) {
    const face& corners = mesh.faces[f];
    return {mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]};
}

/// How many of some answers are off by more than rounding explains, by asking every face.
double wrong_distances(const closest_input& input, const distances& found) {
    const box3 box = bounding_box(input.mesh->points).value();
    const double size =
        std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
    const std::size_t step = std::max<std::size_t>(found.size() / 10, 1);
    double wrong = 0;
    for (std::size_t i = 0; i < found.size(); i += step) {
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t f = 0; f < input.mesh->faces.size(); ++f)
            least = std::min(
                least,
                closest_point(triangle_of(*input.mesh, f), input.queries[i]).squared_distance);
        wrong += std::abs(std::sqrt(least) - found[i]) > 1e-12 * size;
    }
    return wrong;
}

/// Times `ask`, which returns the distances of all queries.
template <class Ask>
job closest_job(const shared_input& input, const Ask& ask) {
    return make_job(ask,
                    [input](const distances& found) { return wrong_distances(*input, found); });
}

job own_batch(const shared_input& input) {
    const auto query = std::make_shared<const detail::nearness::closest_point_query>(*input->mesh);
    return closest_job(input, [input, query] {
        distances found;
        found.reserve(input->queries.size());
        for (const auto& answer : query->nearest(std::span(input->queries)))
            found.push_back(answer->distance);
        return found;
    });
}

job own_single(const shared_input& input) {
    const auto query = std::make_shared<const detail::nearness::closest_point_query>(*input->mesh);
    return closest_job(input, [input, query] {
        distances found;
        found.reserve(input->queries.size());
        for (const point3& q : input->queries) found.push_back(query->nearest(q)->distance);
        return found;
    });
}

/// The tree with a function of one's own, in the given order of opening.
job own_by_function(const shared_input& input, node_order order) {
    const auto tree =
        std::make_shared<const tf::tree<3>>(build(input->mesh->faces, face_box(*input->mesh)));
    return closest_job(input, [input, tree, order] {
        distances found;
        found.reserve(input->queries.size());
        for (const point3& q : input->queries) {
            const auto squared = [&](std::uint32_t f) {
                return closest_point(triangle_of(*input->mesh, f), q).squared_distance;
            };
            const auto best = nearest(*tree, q, squared, unlimited_radius, order);
            found.push_back(std::sqrt(best->answer));
        }
        return found;
    });
}

template <class Strategy>
job paper_single(const shared_input& input) {
    const auto tree = std::make_shared<const nary_tree<double, 3>>(
        build(input->mesh->faces, face_box(*input->mesh), tree_config{}));
    return closest_job(input, [input, tree] {
        distances found;
        found.reserve(input->queries.size());
        for (const point3& q : input->queries)
            found.push_back(std::sqrt(nary_nearest<Strategy>(
                *tree, [&](const aabb<double, 3>& box) { return squared_distance(box, q); },
                [&](std::uint32_t f) {
                    return closest_point(triangle_of(*input->mesh, f), q).squared_distance;
                })));
        return found;
    });
}

job cgal_single(const shared_input& input) {
    const auto peer = std::make_shared<const cgal_closest>(*input->mesh);
    return closest_job(input, [input, peer] { return peer->distances(input->queries); });
}

contest closest_contest(const setting& setting, const model& model, std::size_t count) {
    const auto given = [=] {
        const shared_mesh mesh = load(setting, model);
        return std::make_shared<const closest_input>(
            closest_input{mesh, queries_about(*mesh, count)});
    };
    return {.name = name_of(setting, model) + closest_name,
            .size = [=] { return load(setting, model)->faces.size(); },
            .unit = {.name = "us/query", .scale = 1e6 / static_cast<double>(count)},
            .contestants = {{"treeform", 1, [=] { return own_batch(given()); }},
                            {"treeform", 2, [=] { return own_batch(given()); }},
                            {"treeform single", 1, [=] { return own_single(given()); }},
                            {"treeform lambda", 1,
                             [=] { return own_by_function(given(), node_order::depth_first); }},
                            {"treeform lambda heap", 1,
                             [=] { return own_by_function(given(), node_order::best_first); }},
                            {"paper top_k", 1,
                             [=] { return paper_single<strategy::top_k_sorted>(given()); }},
                            {"paper heap", 1,
                             [=] { return paper_single<strategy::priority_queue>(given()); }},
                            {cgal_name() + " AABB_tree", 1, [=] { return cgal_single(given()); }}},
            .long_runs = 3};
}

struct cloud_input {
    points cloud;
    points queries;
};
using shared_clouds = std::shared_ptr<const cloud_input>;

points uniform(std::size_t count, std::uint64_t seed) {
    test::random random(seed);
    points result;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = random.unit(), y = random.unit();
        result.push_back({x, y, random.unit()});
    }
    return result;
}

std::vector<std::array<double, 3>> arrays_of(const points& given) {
    std::vector<std::array<double, 3>> result;
    for (const point3& p : given) result.push_back({p.x, p.y, p.z});
    return result;
}

double squared_distance_of(const point3& a, const point3& b) {
    const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return x * x + y * y + z * z;
}

/// How many of some lists [Q * k] differ from what asking every point gives.
double wrong_lists(const cloud_input& input, const std::vector<std::uint32_t>& found) {
    const std::size_t step = std::max<std::size_t>(input.queries.size() / 20, 1);
    double wrong = 0;
    for (std::size_t i = 0; i < input.queries.size(); i += step) {
        std::vector<double> all;
        for (const point3& p : input.cloud) all.push_back(squared_distance_of(p, input.queries[i]));
        std::vector<double> mine;
        for (std::size_t j = 0; j < k; ++j) mine.push_back(all.at(found[i * k + j]));
        std::partial_sort(all.begin(), all.begin() + k, all.end());
        wrong += !std::equal(mine.begin(), mine.end(), all.begin());
    }
    return wrong;
}

template <class Ask>
job k_nearest_job(const shared_clouds& input, const Ask& ask) {
    return make_job(ask, [input](const std::vector<std::uint32_t>& found) {
        return wrong_lists(*input, found);
    });
}

job own_k_batch(const shared_clouds& input) {
    const auto search = std::make_shared<const point_search<3>>(input->cloud);
    return k_nearest_job(input, [search, queries = arrays_of(input->queries)] {
        std::vector<std::uint32_t> ids;
        ids.reserve(queries.size() * k);
        for (const near_point& one : search->k_nearest(std::span(queries), k).answers)
            ids.push_back(one.id);
        return ids;
    });
}

job own_k_single(const shared_clouds& input) {
    const auto search = std::make_shared<const point_search<3>>(input->cloud);
    return k_nearest_job(input, [search, queries = arrays_of(input->queries)] {
        std::vector<std::uint32_t> ids;
        ids.reserve(queries.size() * k);
        for (const auto& query : queries)
            for (const near_point& one : search->k_nearest(query, k)) ids.push_back(one.id);
        return ids;
    });
}

contest k_nearest_contest(std::size_t count, std::size_t queries) {
    const auto given = [=] {
        return std::make_shared<const cloud_input>(
            cloud_input{uniform(count, 1), uniform(queries, 2)});
    };
    return {.name = fmt::format("{}_points{}", count, k_nearest_name),
            .size = [=] { return count; },
            .unit = {.name = "us/query", .scale = 1e6 / static_cast<double>(queries)},
            .contestants = {{"treeform", 1, [=] { return own_k_batch(given()); }},
                            {"treeform", 2, [=] { return own_k_batch(given()); }},
                            {"treeform single", 1, [=] { return own_k_single(given()); }},
                            {nanoflann_name(), 1, [=] {
                                 const shared_clouds input = given();
                                 const auto peer =
                                     std::make_shared<const nanoflann_tree>(input->cloud);
                                 return k_nearest_job(input, [input, peer] {
                                     return peer->k_nearest(input->queries, k);
                                 });
                             }}}};
}

contest build_contest(std::size_t count) {
    const auto given = [=] { return std::make_shared<const points>(uniform(count, 1)); };
    const auto own = [=] {
        return make_job([cloud = given()] { return point_search<3>(*cloud); });
    };
    return {.name = fmt::format("{}_points{}", count, build_name),
            .size = [=] { return count; },
            .contestants = {{"treeform", 1, own},
                            {"treeform", 2, own},
                            {nanoflann_name(), 1, [=] {
                                 return make_job([cloud = given()] {
                                     return std::make_unique<nanoflann_tree>(*cloud);
                                 });
                             }}}};
}

/// "treeform takes 1 us a query, 2.0 times as fast as ..." of the last contest of the kind.
std::string sentence(const std::vector<outcome>& outcomes, const std::string& suffix,
                     const std::string& what) {
    const auto last = std::find_if(outcomes.rbegin(), outcomes.rend(),
                                   [&](const outcome& o) { return o.name.ends_with(suffix); });
    if (last == outcomes.rend()) return {};
    const double own = last->value("treeform").value_or(0);
    std::string text = fmt::format("{} takes {:.3g} {}", what, own, last->unit.name);
    for (const measured& row : last->rows)
        if (!row.who.starts_with("treeform"))
            text += fmt::format(", {} {}", compared(own, *last->value(row.who)), row.who);
    return text;
}

}  // namespace

void nearness(const setting& setting, const contest_visitor& visit) {
    std::vector<model> models{{"clean/turbineblade_199k.ply", "200k", 199'000},
                              {"open/bunny_69k.obj", "1.09M", 1'090'000}};
    std::size_t queries = 100'000, cloud = 500'000;
    if (setting.effort == effort::quick) {
        models = {{"clean/armadillo_29k.obj", "50k", 50'000}};
        queries = 20'000;
        cloud = 100'000;
    } else if (setting.effort == effort::tiny) {
        models = {{"", "2k", 2'000}};
        queries = 100;
        cloud = 1'000;
    }
    for (const model& model : models) visit(closest_contest(setting, model, queries));
    visit(k_nearest_contest(cloud, queries));
    visit(build_contest(cloud));
}

section draw_nearness(const std::vector<outcome>& outcomes, const std::string& machine) {
    return {
        .paper = "",
        .ours = fmt::format("on one thread, {}; {}; {}.",
                            sentence(outcomes, closest_name, "the nearest point of a mesh"),
                            sentence(outcomes, k_nearest_name, "the ten nearest points"),
                            sentence(outcomes, build_name, "their tree")),
        .pictures = {
            {"b4_closest_point.svg",
             svg(bars_by_contest(outcomes, closest_name,
                                 {"Nearest point of a mesh, tree given", machine}))},
            {"b4_k_nearest.svg", svg(bars_by_contest(outcomes, k_nearest_name,
                                                     {"Ten nearest points, tree given", machine}))},
            {"b4_build.svg",
             svg(bars_by_contest(outcomes, build_name, {"Tree over points", machine}))}}};
}

}  // namespace treeform::bench
