/// \file
/// E9: whether two triangles meet, as one thing gets harder step by step: where does each method
/// break down?

#include "bench/accuracy.hpp"
#include "bench/peers/versions.hpp"
#include "bench/triangle_askers.hpp"
#include "support/stress_parts.hpp"
#include "support/stress_placement.hpp"

#include <fmt/core.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace treeform::bench {
namespace {

using namespace test::stress;
using test::random_source;
using test::triangle_pair;

/// What is made harder: pairs whose difficulty is 10^exponent.
struct sweep {
    const char* name;
    const char* what;  ///< of the axis of its chart
    int first, last;   ///< exponents, from easy to hard
    int step;
    triangle_pair (*make)(random_source&, double difficulty);
};

/// Corners that far above or below the plane of a triangle.
triangle_pair tilted(random_source& random, double angle) {
    const triangle3 a = dyadic_triangle(random);
    const point3 normal = cross(a[1] - a[0], a[2] - a[0]);
    const auto corner = [&] {
        const double u = random.unit();
        const double v = random.unit();
        const point3 foot = a[0] + u * (a[1] - a[0]) + v * (a[2] - a[0]);
        return foot + (random.one_in(2) ? angle : -angle) * normal;
    };
    return {a, {corner(), corner(), corner()}};
}

triangle_pair plain(random_source& random) {
    const triangle3 a = random_triangle(random);
    return {a, random_triangle(random)};
}

template <class Change>
triangle_pair both(const triangle_pair& pair, Change change) {
    return {changed(pair.a, change), changed(pair.b, change)};
}

triangle_pair scaled(random_source& random, double by) {
    return both(plain(random), [&](const point3& p) { return by * p; });
}

triangle_pair moved(random_source& random, double by) {
    const point3 away = by * point3{1, -1, 1};
    return both(plain(random), [&](const point3& p) { return p + away; });
}

/// A triangle of that size at a point of another.
triangle_pair small_at(random_source& random, double size) {
    const triangle3 a = random_triangle(random);
    const point3 at = point_of(a, random);
    const point3 middle{0.5, 0.5, 0.5};
    return {a, changed(random_triangle(random),
                       [&](const point3& p) { return at + size * (p - middle); })};
}

/// A needle of that width.
triangle_pair needle(random_source& random, double width) {
    const triangle3 a = random_triangle(random);
    const point3 from = random_point(random);
    const point3 to = random_point(random);
    return {a, {from, to, from + 0.5 * (to - from) + width * random_point(random)}};
}

constexpr std::array sweeps{sweep{"angle", "angle of the planes", 0, -18, 1, tilted},
                            sweep{"offset", "distance from the origin", 0, 15, 1, moved},
                            sweep{"size", "size of one, the other's is 1", 0, -15, 1, small_at},
                            sweep{"width", "width of a needle, its length is 1", 0, -18, 1, needle},
                            sweep{"scale down", "unit of length", 0, -300, 12, scaled},
                            sweep{"scale up", "unit of length", 0, 300, 12, scaled}};

/// From easy to hard.
std::vector<int> exponents_of(const sweep& sweep) {
    const int toward = sweep.last < sweep.first ? -sweep.step : sweep.step;
    std::vector<int> exponents;
    for (int e = sweep.first; e != sweep.last + toward; e += toward) exponents.push_back(e);
    return exponents;
}

/// The pairs of a sweep, `count` a step, and the exact kernel's word on them.
struct judged_sweep {
    std::vector<int> exponents;
    std::size_t count = 0;
    std::vector<triangle_pair> pairs;
    verdicts meet;
};
using shared_sweep = std::shared_ptr<const judged_sweep>;

shared_sweep load(const sweep& sweep, std::size_t count) {
    static std::weak_ptr<const judged_sweep> last;
    static const char* last_name = nullptr;
    if (shared_sweep known = last.lock(); known && last_name == sweep.name) return known;
    auto made = std::make_shared<judged_sweep>();
    made->count = count;
    made->exponents = exponents_of(sweep);
    for (std::size_t step = 0; step < made->exponents.size(); ++step) {
        random_source random(1);
        while (made->pairs.size() < count * (step + 1)) {
            const triangle_pair pair = sweep.make(random, power_of_ten(made->exponents[step]));
            // What rounding makes degenerate is left out, as the peers take none.
            if (is_proper(pair)) made->pairs.push_back(pair);
        }
    }
    made->meet.resize(made->pairs.size());
    cgal_exact(question::triangles_meet, made->pairs)(made->meet);
    last = made;
    last_name = sweep.name;
    return made;
}

struct method {
    std::string who;
    make_asker ask;
};

std::vector<method> methods() {
    std::vector<method> all{{"treeform", asking_treeform()},
                            {"naive float", asking_signs<rounded_signs<float>>()},
                            {"naive double", asking_signs<rounded_signs<double>>()}};
    for (const double eps : {1e-12, 1e-9, 1e-6})
        all.push_back(
            {fmt::format("double eps {:g}", eps), asking_signs<rounded_signs<double>>(eps)});
    all.push_back({cgal_name() + " EPICK", asking_cgal_filtered()});
    return all;
}

std::string unit_of_step(int exponent) { return fmt::format("% wrong at 1e{:+d}", exponent); }
constexpr const char* steps_right = "steps without error";

/// The number of steps ahead of the first wrong verdict, and the share that is wrong where any is.
std::vector<figure> figures_of(const judged_sweep& given, const verdicts& found) {
    std::vector<figure> figures{{steps_right, static_cast<double>(given.exponents.size())}};
    for (std::size_t step = given.exponents.size(); step-- > 0;) {
        std::size_t wrong = 0;
        for (std::size_t i = step * given.count; i < (step + 1) * given.count; ++i)
            wrong += found[i] != given.meet[i];
        if (wrong == 0) continue;
        figures.push_back({unit_of_step(given.exponents[step]),
                           100.0 * static_cast<double>(wrong) / static_cast<double>(given.count)});
        figures[0].value = static_cast<double>(step);
    }
    return figures;
}

job job_of(const method& method, const shared_sweep& given) {
    const auto found = std::make_shared<verdicts>(given->pairs.size());
    return {.run = [found, ask = method.ask(given->pairs)] { ask(*found); },
            .error =
                [=] {
                    double wrong = 0;
                    for (std::size_t i = 0; i < found->size(); ++i)
                        wrong += (*found)[i] != given->meet[i];
                    return std::optional(wrong);
                },
            .figures = [=] { return figures_of(*given, *found); }};
}

contest contest_of(const sweep& sweep, std::size_t count) {
    const std::size_t steps = exponents_of(sweep).size();
    contest contest{.name = sweep.name,
                    .size = [=] { return steps * count; },
                    .unit = {.name = "ns/pair", .scale = 1e9 / static_cast<double>(steps * count)},
                    .with_memory = false,
                    .long_runs = 3};
    for (const method& method : methods())
        contest.contestants.push_back(
            {method.who, 1, [=] { return job_of(method, load(sweep, count)); }});
    return contest;
}

/// Tolerances get the colors of peers that are not here.
int tone_in_chart(const std::string& who) {
    constexpr std::array<std::pair<std::string_view, int>, 3> tolerances{
        {{"1e-12", 2}, {"1e-09", 4}, {"1e-06", 5}}};
    for (const auto& [eps, tone] : tolerances)
        if (who.ends_with(eps)) return tone;
    return tone_of(who);
}

/// Per cent of wrong verdicts by difficulty, a curve each.
std::string chart_of(const outcome& outcome, const sweep& sweep, const std::string& machine) {
    line_chart chart;
    chart.caption = {fmt::format("Wrong verdicts by {}", sweep.name), machine};
    chart.x = {sweep.what, true};
    chart.y = {"of the pairs, per cent", false};
    for (std::size_t who = 0; who < outcome.rows.size(); ++who) {
        const std::string& name = outcome.rows[who].who;
        // Where several are right they lie on each other: dashes show the one below.
        curve curve{name, {}, tone_in_chart(name), name.starts_with("CGAL")};
        for (const int e : exponents_of(sweep))
            curve.points.push_back(
                {power_of_ten(e), figure_of(outcome.rows[who], unit_of_step(e)).value_or(0)});
        chart.curves.push_back(std::move(curve));
    }
    return svg(chart);
}

}  // namespace

void stability(const setting& setting, const contest_visitor& visit) {
    const std::size_t count = setting.effort == effort::full    ? 20'000
                              : setting.effort == effort::quick ? 2'000
                                                                : 20;
    for (const sweep& sweep : sweeps) visit(contest_of(sweep, count));
}

section draw_stability(const std::vector<outcome>& outcomes, const std::string& machine) {
    section section{
        .paper = "",
        .ours =
            "The first step, from easy to hard by factors of ten (of 10^12 for the unit of "
            "length), at which a method gives a wrong verdict on one of the pairs; CGAL's exact "
            "kernel judges. Where nothing stands, there is none."};
    std::vector<std::string> head{""};
    for (const sweep& sweep : sweeps)
        head.push_back(fmt::format("{} ({})", sweep.name, sweep.what));
    section.table.push_back(std::move(head));
    for (const measured& row : outcomes.front().rows) section.table.push_back({row.who});
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        const std::vector<int> exponents = exponents_of(sweeps[i]);
        for (std::size_t who = 0; who < outcomes[i].rows.size(); ++who) {
            const auto right =
                static_cast<std::size_t>(figure_of(outcomes[i].rows[who], steps_right).value_or(0));
            section.table[who + 1].push_back(
                right < exponents.size() ? fmt::format("1e{:+d}", exponents[right]) : "");
        }
        std::string file = fmt::format("e9_{}.svg", sweeps[i].name);
        std::ranges::replace(file, ' ', '_');
        section.pictures.push_back({std::move(file), chart_of(outcomes[i], sweeps[i], machine)});
    }
    section.remarks = {
        "No pair touches, so that in the easy steps any method will do. A method that rounds is "
        "left to chance where a determinant is smaller than its rounding error: nearly coplanar "
        "pairs, small beside large, needles. Far from the origin floats lose the shape, while in "
        "double nothing happens: there the corners are rounded before anybody is asked, and "
        "differences of near numbers are exact. Tolerances are relative to the size of the pair "
        "and so do not depend on the unit of length; they turn near misses into hits long before. "
        "Products of three differences leave the range of float near 1e-15 and 1e12, and that of "
        "double near 1e-108 and 1e102: then signs are zero or come from infinities."};
    return section;
}

}  // namespace treeform::bench
