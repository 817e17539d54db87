/// \file
/// E6: when a moving triangle first meets another: time against units in the last place, contacts
/// missed, and contacts passed.

#include "bench/accuracy.hpp"
#include "bench/peers/fcl_sweep.hpp"
#include "bench/peers/plain_sweep.hpp"
#include "bench/peers/versions.hpp"
#include "bench/triangle_askers.hpp"
#include <libmesh/geometry/contact_order.hpp>
#include <libmesh/place/sweep_among.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tree/parallel.hpp>

#include <fmt/core.h>
#include <support/reference_sweep.hpp>
#include <support/stress_families.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace treeform::bench {
namespace {

constexpr const char* missed_name = "missed or made up";
constexpr const char* passed_name = "contacts passed";
constexpr const char* ulps_name = "largest error in ulps";
constexpr const char* depth_name = "largest penetration";
constexpr const char* failures_name = "failures";

/// A triangle, its motion within a time of 1, and what it may meet.
struct motion {
    triangle3 a, b;
    point3 d;
    double size = 0.0;                ///< of b
    std::optional<mpq_class> time{};  ///< exact; none where they do not meet
};
using motions = std::vector<motion>;
using shared_motions = std::shared_ptr<const motions>;
using found_time = std::optional<double>;

double distance(const point3& p, const point3& q) {
    return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
}

/// From a corner or the middle of an edge of one to the like of the other, and as far beyond.
point3 direction_for(const test::triangle_pair& pair, test::random_source& random) {
    const auto place = [&](const triangle3& t) {
        const point3 p = t[random.below(3)], q = t[random.below(3)];
        const double s = random.one_in(2) ? random.unit() : 0.0;
        return point3{p.x + s * (q.x - p.x), p.y + s * (q.y - p.y), p.z + s * (q.z - p.z)};
    };
    const point3 to = place(pair.b), from = place(pair.a);
    return {2 * (to.x - from.x), 2 * (to.y - from.y), 2 * (to.z - from.z)};
}

shared_motions load_motions(test::stress_family family, std::size_t count) {
    static std::weak_ptr<const motions> last;
    static test::stress_family last_family{};
    if (shared_motions known = last.lock(); known && last_family == family) return known;
    const auto made = std::make_shared<motions>();
    test::stress_stream stream(family, 1);
    test::random_source random(2);
    while (made->size() < count) {
        const test::triangle_pair pair = stream.next();
        const point3 d = direction_for(pair, random);
        const double size =
            std::max(distance(pair.b[0], pair.b[1]), distance(pair.b[0], pair.b[2]));
        const double length = std::hypot(d.x, d.y, d.z);
        const auto usable = [](double x) { return x > 1e-140 && x < 1e140; };
        if (!usable(size) || !usable(length) || !is_proper(pair)) continue;
        if (intersect(pair.a, pair.b).count != 0) continue;
        made->push_back({pair.a, pair.b, d, size});
    }
    for_chunks(count, 16, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            motion& m = (*made)[i];
            m.time = test::first_time(m.a, m.b, m.d);
            if (m.time && *m.time > 1) m.time.reset();
        }
    });
    last = made;
    last_family = family;
    return made;
}

struct verdict {
    double missed = 0, passed = 0, ulps = 0, depth = 0, failures = 0;
};

verdict judge(const motions& given, const std::vector<found_time>& found) {
    verdict all;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const motion& m = given[i];
        if (found[i] && !std::isfinite(*found[i])) {
            ++all.failures;
            continue;
        }
        all.missed += m.time.has_value() != found[i].has_value();
        if (!m.time || !found[i]) continue;
        const double late = mpq_class(mpq_class(*found[i]) - *m.time).get_d();
        const double exact = m.time->get_d();
        const double ulp = std::nextafter(exact, std::numeric_limits<double>::infinity()) - exact;
        all.ulps = std::max(all.ulps, std::abs(late) / ulp);
        all.passed += late > 0;
        all.depth = std::max(all.depth, late * std::hypot(m.d.x, m.d.y, m.d.z) / m.size);
    }
    return all;
}

template <class Ask>
job job_of(const shared_motions& given, Ask ask) {
    const auto found = std::make_shared<std::vector<found_time>>(given->size());
    return {.run =
                [=] {
                    for (std::size_t i = 0; i < given->size(); ++i) (*found)[i] = ask((*given)[i]);
                },
            .error = [=] { return std::optional(judge(*given, *found).missed); },
            .figures =
                [=] {
                    const verdict all = judge(*given, *found);
                    return std::vector<figure>{{missed_name, all.missed},
                                               {passed_name, all.passed},
                                               {ulps_name, all.ulps},
                                               {depth_name, all.depth},
                                               {failures_name, all.failures}};
                }};
}

found_time own(const motion& m) {
    const auto contact = first_contact(m.a, m.b, m.d);
    if (!contact) return {};
    const double time = detail::place::time_not_beyond(*contact, m.d);
    return time <= 1 ? found_time(time) : std::nullopt;
}

}  // namespace

void first_contact_errors(const setting& setting, const contest_visitor& visit) {
    const std::size_t count = setting.effort == effort::full    ? 1'000
                              : setting.effort == effort::quick ? 200
                                                                : 10;
    for (std::size_t f = 0; f < test::stress_family_count; ++f) {
        const auto family = static_cast<test::stress_family>(f);
        contest contest{.name = std::string(test::name_of(family)),
                        .size = [=] { return count; },
                        .unit = {.name = "ns/pair", .scale = 1e9 / static_cast<double>(count)},
                        .with_memory = false,
                        .long_runs = 3};
        const auto add = [&](std::string who, auto ask) {
            contest.contestants.push_back(
                {std::move(who), 1, [=] { return job_of(load_motions(family, count), ask); }});
        };
        add("treeform", own);
        add("naive float",
            [](const motion& m) { return plain_sweep<float>::first_contact(m.a, m.b, m.d); });
        add("naive double",
            [](const motion& m) { return plain_sweep<double>::first_contact(m.a, m.b, m.d); });
        for (const double near : {1e-3, 1e-6, 1e-9})
            add(fmt::format("advancement eps {:g}", near),
                [=](const motion& m) { return advanced_to_contact(m.a, m.b, m.d, near); });
        add(fcl_name() + " VF EE",
            [](const motion& m) { return fcl_first_contact(m.a, m.b, m.d); });
        visit(contest);
    }
}

section draw_first_contact_errors(const std::vector<outcome>& outcomes,
                                  const std::string& machine) {
    const error_of share = [](const outcome& o, const measured& row) -> std::optional<double> {
        return row.error ? std::optional(*row.error / static_cast<double>(o.size)) : std::nullopt;
    };
    const auto chart = [&](const char* title, const char* label, std::vector<error_series> series) {
        return svg(error_chart{{title, machine}, "time, ns a pair", label, std::move(series)});
    };
    return {
        .paper = "",
        .ours = fmt::format(
            "{} triangles of each family in straight motion, judged in rational numbers. treeform "
            "finds every contact, and stops at the last double before it: it is never beyond.",
            outcomes.front().size),
        .pictures = {{"e6_missed.svg",
                      chart("First contact: all families", "contacts missed or made up, a pair",
                            dots_by_method(outcomes, share, joined_by::mean))},
                     {"e6_ulps.svg", chart("First contact: a dot for each family",
                                           "largest error of the time, ulps",
                                           dots_by_contest(outcomes, figure_named(ulps_name)))}},
        .table = summary_of(
            outcomes, {{"missed or made up", figure_named(missed_name)},
                       {"passed", figure_named(passed_name)},
                       {"largest ulps", figure_named(ulps_name), joined_by::largest, false},
                       {"deepest, in sizes", figure_named(depth_name), joined_by::largest, false},
                       {"not a number", figure_named(failures_name)}}),
        .remarks = {
            "treeform's time is the last double that is not beyond the exact one: within 1 ulp of "
            "it, never past it. Passed are contacts at which a method stops too late, so that the "
            "triangles penetrate; the depth is in sizes of the triangle that is hit.",
            "Where the naive formula divides by a determinant that ought to be 0, because the "
            "motion runs along a face or edges are parallel, it finds a time by chance or none; "
            "motion in the plane of both triangles it does not know at all. Conservative "
            "advancement stops where the distance is within eps of the size, so it is early by "
            "design, and its distance has the errors of E3. FCL's tests solve the cubic of the "
            "general case and accept roots within constants of its own, in [0, 1]."}};
}

}  // namespace treeform::bench
