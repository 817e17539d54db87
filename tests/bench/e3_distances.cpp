/// \file
/// E3: distances of points and triangles: time against units in the last place.

#include "bench/accuracy.hpp"
#include "bench/peers/cgal_distances.hpp"
#include "bench/peers/fcl_triangles.hpp"
#include "bench/peers/plain_distance.hpp"
#include "bench/peers/versions.hpp"
#include "bench/triangle_askers.hpp"
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <treeform/tree/parallel.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

namespace treeform::bench {
namespace {

constexpr const char* touch_errors = "wrong whether they meet";
constexpr const char* ulps_name = "largest error in ulps";
constexpr const char* size_name = "largest error in u L";
constexpr const char* failures = "failures";
constexpr double beyond_count = 1e300;  // as many ulps as are told apart

/// Pairs and their distances, correctly rounded.
struct measured_pairs {
    std::vector<test::triangle_pair> pairs;
    std::vector<true_distance> truth;
    verdicts meet;              ///< [pairs] by the exact kernel: a distance may round to 0
    std::vector<double> sizes;  ///< [pairs] the largest distance of two corners
};
using shared_pairs = std::shared_ptr<const measured_pairs>;

double size_of(const test::triangle_pair& pair) {
    double largest = 0;
    for (const triangle3* s : {&pair.a, &pair.b})
        for (const triangle3* t : {&pair.a, &pair.b})
            for (const point3& p : *s)
                for (const point3& q : *t)
                    largest = std::max(largest, std::hypot(p.x - q.x, p.y - q.y, p.z - q.z));
    return largest;
}

/// Pairs of proper triangles whose squares are in the range of double.
shared_pairs load_pairs(distance_question asked, test::stress_family family, std::size_t count) {
    static std::weak_ptr<const measured_pairs> last;
    static std::pair<distance_question, test::stress_family> key{};
    if (shared_pairs known = last.lock(); known && key == std::pair(asked, family)) return known;
    auto made = std::make_shared<measured_pairs>();
    test::stress_stream stream(family, 1);
    while (made->pairs.size() < count) {
        const test::triangle_pair pair = stream.next();
        const double size = size_of(pair);
        if (!(size > 1e-140 && size < 1e140) || !is_proper(pair)) continue;
        made->pairs.push_back(pair);
        made->sizes.push_back(size);
    }
    made->truth.resize(count);
    for_chunks(count, 500, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::ranges::copy(
            cgal_true_distances(asked, pairs_view(made->pairs).subspan(begin, end - begin)),
            made->truth.begin() + static_cast<std::ptrdiff_t>(begin));
    });
    made->meet.resize(count);
    cgal_exact(question::triangles_meet, made->pairs)(made->meet);
    last = made;
    key = {asked, family};
    return made;
}

double ulp_of(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()) - x; }

struct verdict {
    double touch_errors = 0, ulps = 0, size = 0, failures = 0;
};

/// Of a distance of 0 there is no last place to count in.
verdict judge(const measured_pairs& given, const std::vector<double>& found) {
    verdict all;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto& [rounded, rest] = given.truth[i];
        if (!std::isfinite(found[i])) {
            ++all.failures;
            continue;
        }
        all.touch_errors += (found[i] == 0) != (given.meet[i] != 0);
        const double error = std::abs((found[i] - rounded) - rest);
        all.size = std::max(all.size, error / (0x1p-53 * given.sizes[i]));
        if (rounded != 0 && found[i] != rounded)
            all.ulps = std::max(all.ulps, std::min(error / ulp_of(rounded), beyond_count));
    }
    return all;
}

struct method {
    std::string who;
    std::function<distance_asker(pairs_view)> ask;
};

/// Whether triangles meet is a verdict, which may be wrong; how far a point is, is none.
job job_of(const method& method, const shared_pairs& given, bool is_verdict) {
    const auto found = std::make_shared<std::vector<double>>(given->pairs.size());
    return {.run = [found, ask = method.ask(given->pairs)] { ask(*found); },
            .error = [=]() -> std::optional<double> {
                if (!is_verdict) return {};
                return judge(*given, *found).touch_errors;
            },
            .figures =
                [=] {
                    const verdict all = judge(*given, *found);
                    return std::vector<figure>{{touch_errors, all.touch_errors},
                                               {ulps_name, all.ulps},
                                               {size_name, all.size},
                                               {failures, all.failures}};
                }};
}

/// Calls `one(pair)` for each.
template <class One>
method each(std::string who, One one) {
    return {std::move(who), [one](pairs_view pairs) -> distance_asker {
                return [pairs, one](std::vector<double>& found) {
                    for (std::size_t i = 0; i < pairs.size(); ++i) found[i] = one(pairs[i]);
                };
            }};
}

std::vector<method> methods(distance_question question) {
    using pair = test::triangle_pair;
    std::vector<method> all;
    if (question == distance_question::point_triangle) {
        all.push_back(each("treeform", [](const pair& p) {
            return std::sqrt(closest_point(p.a, p.b[0]).squared_distance);
        }));
        all.push_back(each("naive float", [](const pair& p) {
            return plain_distance<float>::point_triangle(p.b[0], p.a);
        }));
        all.push_back(each("naive double", [](const pair& p) {
            return plain_distance<double>::point_triangle(p.b[0], p.a);
        }));
    } else {
        all.push_back(each("treeform", [](const pair& p) {
            return std::sqrt(closest_pair(p.a, p.b).squared_distance);
        }));
        all.push_back(each("naive float", [](const pair& p) {
            return plain_distance<float>::triangle_triangle(p.a, p.b);
        }));
        all.push_back(each("naive double", [](const pair& p) {
            return plain_distance<double>::triangle_triangle(p.a, p.b);
        }));
        for (const bool in_float : {true, false})
            all.push_back({fcl_name() + (in_float ? " float" : " double"), [=](pairs_view pairs) {
                               return fcl_triangle_distances(pairs, in_float);
                           }});
    }
    all.push_back({cgal_name() + " EPICK",
                   [=](pairs_view pairs) { return cgal_rounded_distances(question, pairs); }});
    all.push_back({cgal_name() + " EPECK",
                   [=](pairs_view pairs) { return cgal_exact_distances(question, pairs); }});
    return all;
}

constexpr const char* point_suffix = "/point_triangle";
constexpr const char* pair_suffix = "/triangle_triangle";

std::vector<outcome> ending_with(const std::vector<outcome>& outcomes, const char* suffix) {
    std::vector<outcome> some;
    for (const outcome& o : outcomes)
        if (o.name.ends_with(suffix)) some.push_back(o);
    return some;
}

}  // namespace

void distances(const setting& setting, const contest_visitor& visit) {
    const std::size_t count = setting.effort == effort::full    ? 2'000
                              : setting.effort == effort::quick ? 1'000
                                                                : 30;
    for (const auto question :
         {distance_question::point_triangle, distance_question::triangle_triangle})
        for (std::size_t f = 0; f < test::stress_family_count; ++f) {
            const auto family = static_cast<test::stress_family>(f);
            const bool of_point = question == distance_question::point_triangle;
            contest contest{.name = std::string(test::name_of(family)) +
                                    (of_point ? point_suffix : pair_suffix),
                            .size = [=] { return count; },
                            .unit = {.name = "ns/pair", .scale = 1e9 / static_cast<double>(count)},
                            .with_memory = false,
                            .long_runs = 3};
            for (const method& method : methods(question))
                contest.contestants.push_back(
                    {method.who, 1, [=] {
                         return job_of(method, load_pairs(question, family, count), !of_point);
                     }});
            visit(contest);
        }
}

section draw_distances(const std::vector<outcome>& outcomes, const std::string& machine) {
    const auto of_points = ending_with(outcomes, point_suffix);
    const auto of_pairs = ending_with(outcomes, pair_suffix);
    const auto chart = [&](const std::string& title, const std::string& label,
                           const std::vector<outcome>& some, const char* figure) {
        return svg(error_chart{{title, machine},
                               "time, ns a pair",
                               label,
                               dots_by_contest(some, figure_named(figure)),
                               "exact"});
    };
    section section{
        .paper = "",
        .ours = fmt::format(
            "{} pairs of each family, measured against the distance of CGAL's exact kernel, "
            "correctly rounded. Whether triangles meet, treeform decides exactly; the distance of "
            "those that do not it rounds, to within 8 units of u = 2^-53 times the size L of the "
            "pair, on every family.",
            outcomes.front().size),
        .pictures = {{"e3_point_size.svg", chart("Point to triangle: a dot for each family",
                                                 "largest error, in u L", of_points, size_name)},
                     {"e3_pair_size.svg", chart("Triangle to triangle: a dot for each family",
                                                "largest error, in u L", of_pairs, size_name)},
                     {"e3_pair_ulps.svg",
                      chart("Triangle to triangle: a dot for each family",
                            "largest error, ulps of the distance", of_pairs, ulps_name)}},
        .table = summary_of(of_pairs,
                            {{"wrong whether they meet", figure_named(touch_errors)},
                             {"largest ulps", figure_named(ulps_name), joined_by::largest, false},
                             {"largest u L", figure_named(size_name), joined_by::largest, false},
                             {"not a number", figure_named(failures)}}),
        .remarks = {
            "Distances of which the square is below 1e-308 round to 0 in CGAL's kernels, exact or "
            "not, when the square is turned into a double: such pairs count as wrong there.",
            "An error of 0 ulps is a distance that is the double nearest to the true one. Where "
            "two triangles nearly touch, coordinates are many times the distance, and a "
            "distance computed in double from differences of them keeps a few units of u L "
            "and no more: that is many ulps of a small distance, for treeform too. It is the only "
            "error that treeform makes here; its bound is in the documentation of "
            "closest_pair, and holds for needles and slivers, where the others lose all digits.",
            "Columns: pairs that meet and were given a distance, or do not and were given none; "
            "the largest error over all families; answers that were NaN or infinite. Pairs whose "
            "size is beyond 1e140 or below 1e-140, whose squares no double holds, are left out for "
            "all."}};
    return section;
}

}  // namespace treeform::bench
