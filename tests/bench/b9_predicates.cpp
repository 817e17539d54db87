/// \file
/// B9: predicates and the classified triangle pair, on every family of hard cases.

#include "bench/peers/versions.hpp"
#include "bench/triangle_askers.hpp"
#include "bench/workload.hpp"
#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/predicates.hpp>

#include <array>
#include <string>

namespace treeform::bench {
namespace {

using test::stress_family;
using test::triangle_pair;
using pair_list = std::shared_ptr<const std::vector<triangle_pair>>;

/// Pairs of proper triangles, since the peers take no others.
pair_list pairs_of(stress_family family, std::size_t count) {
    test::stress_stream stream(family, 1);
    std::vector<triangle_pair> pairs;
    while (pairs.size() < count) {
        const triangle_pair pair = stream.next();
        if (is_proper(pair)) pairs.push_back(pair);
    }
    return std::make_shared<const std::vector<triangle_pair>>(std::move(pairs));
}

/// The same choice of corners as `question`'s for the peers.
int ask(question question, const triangle_pair& pair, predicate_counters* counters) {
    const auto& [a, b] = pair;
    const auto flat = [](const point3& p) { return point2{p.x, p.y}; };
    switch (question) {
        case question::orient2d:
            return orient2d(flat(a[0]), flat(a[1]), flat(b[0]), counters);
        case question::orient3d:
            return orient3d(a[0], a[1], a[2], b[0], counters);
        case question::collinear:
            return collinear(a[0], a[1], b[0], counters) ? 1 : 0;
        case question::compare_along:
            return compare_along(a[0], a[1], b[0], b[1], counters);
        case question::compare_distance:
            return compare_distance(a[0], a[1], b[0], b[1], counters);
        case question::triangles_meet:
            return intersect(a, b, counters).count != 0 ? 1 : 0;
    }
    return 0;
}

/// `ask` with the question known to the compiler, as it is to the peers.
template <question Question>
void ask_all(const std::vector<triangle_pair>& pairs, verdicts& verdicts) {
    for (std::size_t i = 0; i < pairs.size(); ++i)
        verdicts[i] = static_cast<signed char>(ask(Question, pairs[i], nullptr));
}

void ask_all(question question, const std::vector<triangle_pair>& pairs, verdicts& verdicts) {
    constexpr std::array each{
        ask_all<question::orient2d>,         ask_all<question::orient3d>,
        ask_all<question::collinear>,        ask_all<question::compare_along>,
        ask_all<question::compare_distance>, ask_all<question::triangles_meet>};
    each[static_cast<std::size_t>(question)](pairs, verdicts);
}

/// How many predicates a verdict took, how many the filter left open, and at which width these
/// were decided, in per cent of all.
std::vector<figure> cost_of(question question, const std::vector<triangle_pair>& pairs) {
    predicate_counters counters;
    for (const triangle_pair& pair : pairs) ask(question, pair, &counters);
    const auto share = [&](std::uint64_t part) {
        return 100.0 * static_cast<double>(part) /
               static_cast<double>(std::max<std::uint64_t>(counters.calls, 1));
    };
    std::vector<figure> figures{{"predicates/call", static_cast<double>(counters.calls) /
                                                        static_cast<double>(pairs.size())},
                                {"% undecided", share(counters.undecided)}};
    constexpr std::array names{"words",   "1 limb",   "2 limbs", "4 limbs",
                               "8 limbs", "16 limbs", "33 limbs"};
    static_assert(names.size() == predicate_counters::widths);
    for (std::size_t i = 0; i < names.size(); ++i)
        if (counters.by_width[i] != 0)
            figures.push_back({std::string("% in ") + names[i], share(counters.by_width[i])});
    return figures;
}

/// Times `ask` for all pairs; the error is the number of verdicts that the exact kernel denies.
template <class Ask>
job verdict_job(question question, const pair_list& pairs, Ask ask) {
    const auto given = std::make_shared<verdicts>(pairs->size());
    return {.run = [given, ask] { ask(*given); },
            .error =
                [given, question, pairs] {
                    verdicts truth(pairs->size());
                    cgal_exact(question, *pairs)(truth);
                    double wrong = 0;
                    for (std::size_t i = 0; i < truth.size(); ++i) wrong += truth[i] != (*given)[i];
                    return std::optional(wrong);
                }};
}

contest contest_of(question question, const std::string& name, stress_family family,
                   std::size_t count) {
    const auto pairs = [=] { return pairs_of(family, count); };
    const auto ours = [=] {
        const pair_list given = pairs();
        job job = verdict_job(question, given, [question, given](verdicts& verdicts) {
            ask_all(question, *given, verdicts);
        });
        job.figures = [question, given] { return cost_of(question, *given); };
        return job;
    };
    const auto peer = [=](auto convert) {
        return [=] {
            const pair_list given = pairs();
            return verdict_job(question, given, convert(question, *given));
        };
    };
    return {.name = name + "/" + std::string(test::name_of(family)),
            .size = [=] { return count; },
            .unit = {.name = "ns/call", .scale = 1e9 / static_cast<double>(count)},
            .contestants = {{"treeform", 1, ours},
                            {cgal_name() + " EPICK", 1, peer(cgal_filtered)},
                            {cgal_name() + " EPECK", 1, peer(cgal_exact)}}};
}

}  // namespace

void predicates(const setting& setting, const contest_visitor& visit) {
    const std::size_t count = setting.effort == effort::full    ? 20'000
                              : setting.effort == effort::quick ? 2'000
                                                                : 50;
    const std::array questions{std::pair{question::orient2d, "orient2d"},
                               std::pair{question::orient3d, "orient3d"},
                               std::pair{question::collinear, "collinear"},
                               std::pair{question::compare_along, "compare_along"},
                               std::pair{question::compare_distance, "compare_distance"},
                               std::pair{question::triangles_meet, "triangle_triangle"}};
    for (const auto& [question, name] : questions)
        for (std::size_t f = 0; f < test::stress_family_count; ++f)
            visit(contest_of(question, name, static_cast<stress_family>(f), count));
}

}  // namespace treeform::bench
