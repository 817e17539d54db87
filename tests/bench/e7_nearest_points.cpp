/// \file
/// E7: the k nearest points: time against neighbors that are none, and pairs in the wrong order.

#include "bench/accuracy.hpp"
#include "bench/peers/nanoflann_points.hpp"
#include "bench/peers/versions.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/point_search.hpp>

#include <fmt/core.h>
#include <gmpxx.h>
#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

namespace treeform::bench {
namespace {

using points = std::vector<point3>;
using answers = std::vector<std::uint32_t>;  // [Q * k]
constexpr std::size_t k = 10;
constexpr const char* missed_name = "not among the nearest";
constexpr const char* order_name = "neighbors out of order";
constexpr const char* excess_name = "largest excess";
constexpr double no_ratio = 1e300;  // to a distance of 0

struct judged_cloud {
    points cloud, queries;
    std::size_t judged = 0;  ///< of the queries
};
using shared_clouds = std::shared_ptr<const judged_cloud>;

mpq_class squared_exactly(const point3& p, const point3& q) {
    mpq_class sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const mpq_class d = mpq_class(p[i]) - mpq_class(q[i]);
        sum += d * d;
    }
    return sum;
}

double squared(const point3& p, const point3& q) {
    const double x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
    return x * x + y * y + z * z;
}

/// The exact square of the distance of the k-th nearest point.
mpq_class exact_reach(const points& cloud, const point3& query) {
    std::vector<double> rough;
    for (const point3& p : cloud) rough.push_back(squared(p, query));
    std::vector<double> sorted = rough;
    std::ranges::nth_element(sorted, sorted.begin() + k - 1);
    const double limit = sorted[k - 1] * (1 + 1e-14);  // rounding moved each by 2^-50 of itself
    std::vector<mpq_class> near;
    for (std::size_t i = 0; i < cloud.size(); ++i)
        if (rough[i] <= limit) near.push_back(squared_exactly(cloud[i], query));
    std::sort(near.begin(), near.end());
    return near[k - 1];
}

struct mistakes {
    double missed = 0, order = 0;
    double excess = 0;  ///< of the square of a distance over the one that ought to stand there
};

double excess_of(const mpq_class& given, const mpq_class& wanted) {
    return wanted == 0 ? no_ratio : mpq_class(given / wanted - 1).get_d();
}

mistakes mistakes_in(const judged_cloud& given, const answers& found) {
    std::vector<mistakes> each(given.judged);
    for_chunks(given.judged, 4, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t q = begin; q < end; ++q) {
            const mpq_class reach = exact_reach(given.cloud, given.queries[q]);
            mpq_class before = 0;
            for (std::size_t i = 0; i < k; ++i) {
                const mpq_class d =
                    squared_exactly(given.cloud.at(found[q * k + i]), given.queries[q]);
                each[q].missed += d > reach;
                each[q].order += d < before;
                if (d > reach) each[q].excess = std::max(each[q].excess, excess_of(d, reach));
                if (d < before) each[q].excess = std::max(each[q].excess, excess_of(before, d));
                before = d;
            }
        }
    });
    mistakes all;
    for (const mistakes& one : each) {
        all.missed += one.missed;
        all.order += one.order;
        all.excess = std::max(all.excess, one.excess);
    }
    return all;
}

job job_of(const shared_clouds& given, const std::function<answers()>& ask) {
    const auto figures = [given](const answers& found) {
        const mistakes all = mistakes_in(*given, found);
        return std::vector<figure>{{missed_name, all.missed},
                                   {order_name, all.order},
                                   {excess_name, all.excess},
                                   {"neighbors judged", static_cast<double>(given->judged * k)}};
    };
    return make_job(ask, no_error{}, figures);
}

/// Clouds that are hard to order: ties, offsets, tiny differences.
enum class cloud_kind { uniform, clusters, lattice, offset_1e6, offset_1e12, sphere };
constexpr std::array kinds{std::pair{cloud_kind::uniform, "uniform"},
                           std::pair{cloud_kind::clusters, "clusters"},
                           std::pair{cloud_kind::lattice, "lattice of 0.1"},
                           std::pair{cloud_kind::offset_1e6, "offset 1e6"},
                           std::pair{cloud_kind::offset_1e12, "offset 1e12"},
                           std::pair{cloud_kind::sphere, "sphere about the query"}};

point3 point_of(cloud_kind kind, test::random& random) {
    const auto somewhere = [&](double from, double size) {
        const double x = from + size * random.unit(), y = from + size * random.unit();
        return point3{x, y, from + size * random.unit()};
    };
    switch (kind) {
        case cloud_kind::uniform:
            break;
        case cloud_kind::clusters: {
            const double center = static_cast<double>(random.below(8));
            return somewhere(center, 1e-6);
        }
        case cloud_kind::lattice: {
            const auto step = [&] { return 0.1 * static_cast<double>(random.below(40)); };
            const double x = step(), y = step();
            return {x, y, step()};
        }
        case cloud_kind::offset_1e6:
            return somewhere(1e6, 1);
        case cloud_kind::offset_1e12:
            return somewhere(1e12, 1);
        case cloud_kind::sphere: {
            const point3 p = somewhere(-1, 2);
            const double length = std::sqrt(squared(p, {}));
            return {p.x / length, p.y / length, p.z / length};
        }
    }
    return somewhere(0, 1);
}

shared_clouds cloud_of(cloud_kind kind, std::size_t count, std::size_t queries,
                       std::size_t judged) {
    auto made = std::make_shared<judged_cloud>();
    test::random random(1);
    for (std::size_t i = 0; i < count; ++i) made->cloud.push_back(point_of(kind, random));
    for (std::size_t i = 0; i < queries; ++i) {
        point3 p = point_of(kind, random);
        if (kind == cloud_kind::sphere) p = {1e-3 * p.x, 1e-3 * p.y, 1e-3 * p.z};
        made->queries.push_back(p);
    }
    made->judged = judged;
    return made;
}

std::vector<std::array<double, 3>> arrays_of(const points& given) {
    std::vector<std::array<double, 3>> result;
    for (const point3& p : given) result.push_back({p.x, p.y, p.z});
    return result;
}

std::function<answers()> own(const shared_clouds& given) {
    const auto search = std::make_shared<const point_search<3>>(given->cloud);
    return [search, queries = arrays_of(given->queries)] {
        answers ids;
        ids.reserve(queries.size() * k);
        for (const near_point& one : search->k_nearest(std::span(queries), k).answers)
            ids.push_back(one.id);
        return ids;
    };
}

template <class Tree>
std::function<answers()> nanoflann(const shared_clouds& given) {
    const auto tree = std::make_shared<const Tree>(given->cloud);
    return [tree, given] { return tree->k_nearest(given->queries, k); };
}

}  // namespace

void nearest_point_errors(const setting& setting, const contest_visitor& visit) {
    std::size_t count = 100'000, queries = 20'000, judged = 300;
    if (setting.effort == effort::quick) count = 20'000, queries = 5'000, judged = 100;
    if (setting.effort == effort::tiny) count = 200, queries = 20, judged = 20;
    for (const auto& [kind, name] : kinds) {
        const auto given = [=, kind = kind] { return cloud_of(kind, count, queries, judged); };
        contest contest{.name = name,
                        .size = [=] { return count; },
                        .unit = {.name = "us/query", .scale = 1e6 / static_cast<double>(queries)},
                        .with_memory = false,
                        .long_runs = 3};
        const auto add = [&](std::string who, const auto& ask) {
            contest.contestants.push_back({std::move(who), 1, [=] {
                                               const shared_clouds clouds = given();
                                               return job_of(clouds, ask(clouds));
                                           }});
        };
        add("treeform", own);
        add(nanoflann_name() + " float", nanoflann<nanoflann_float_tree>);
        add(nanoflann_name() + " double", nanoflann<nanoflann_tree>);
        visit(contest);
    }
}

section draw_nearest_point_errors(const std::vector<outcome>& outcomes,
                                  const std::string& machine) {
    const auto share = [](const char* name) -> error_of {
        return [name](const outcome&, const measured& row) -> std::optional<double> {
            const auto wrong = figure_of(row, name);
            if (!wrong) return {};
            return *wrong / figure_of(row, "neighbors judged").value_or(1);
        };
    };
    const auto chart = [&](const char* title, const char* label, const char* name) {
        return svg(error_chart{{title, machine},
                               "time, us a query",
                               label,
                               dots_by_contest(outcomes, share(name)),
                               "none"});
    };
    auto table =
        summary_of(outcomes, {{missed_name, figure_named(missed_name)},
                              {order_name, figure_named(order_name)},
                              {excess_name, figure_named(excess_name), joined_by::largest, false}});
    for (auto& row : table_of(outcomes, figure_named(missed_name))) {
        if (row[0].empty()) row[0] = missed_name;
        table.push_back(std::move(row));
    }
    return {
        .paper = "",
        .ours = fmt::format("The {} nearest of {} points, judged in rational numbers.", k,
                            outcomes.front().size),
        .pictures = {{"e7_missed.svg", chart("Ten nearest points: wrong ones, a dot for each cloud",
                                             "given, but not among the nearest", missed_name)},
                     {"e7_order.svg", chart("Ten nearest points: wrong order, a dot for each cloud",
                                            "given before a nearer one", order_name)}},
        .table = std::move(table),
        .remarks = {
            "All three compare distances as computed in their own type. treeform's documentation "
            "of point_search says so: a squared distance is right to 2^-50 of itself, and points "
            "whose squares differ by less are as near for it, the one with the lower number first. "
            "Such near ties hardly occur by chance; on a lattice of 0.1, whose points are rounded, "
            "neighbors that ought to be as far differ in the last bits everywhere. A neighbor "
            "that is wrong in double is wrong in that sense alone: the largest excess, by which "
            "the square of a distance is above the one that ought to stand in its place, is then "
            "below 1e-15. In float, points are rounded before anything is asked: offsets and small "
            "clusters lose all their differences, and what is given may be many times as far.",
            "The first table adds up all clouds; the second has the neighbors that are none, by "
            "cloud."}};
}

}  // namespace treeform::bench
