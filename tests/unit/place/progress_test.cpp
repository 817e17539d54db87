/// \file
/// What every operation that finds a place says of its progress, and how it hears that it should
/// stop.

#include <libmesh/place/separation_search.hpp>
#include <libmesh/place/snap_to_representable.hpp>
#include <libmesh/place/sweep_among.hpp>
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace {

using test::ball;
using test::moved;
using tf::detail::place::shape;

const tf::point3 downwards{0.0, 0.0, -1.0};

struct operation {
    std::string name;
    std::function<bool(const tf::progress_callback&)> was_cancelled;
};

/// Every operation, on meshes that keep it busy for a while.
struct operations {
    tf::prepared_mesh still{ball(3, 1.0)};
    tf::prepared_mesh above{moved(ball(3, 0.5), {0.25, 0.125, 4.0})};
    tf::prepared_mesh inside{moved(ball(3, 0.5), {0.25, 0.125, 0.75})};
    std::vector<tf::prepared_mesh> fixed = [] {
        std::vector<tf::prepared_mesh> both;
        both.emplace_back(ball(3, 1.0));
        both.emplace_back(moved(ball(3, 1.0), {0.0, 1.5, 0.25}));
        return both;
    }();
    std::vector<shape> parts{fixed.begin(), fixed.end()};
    std::vector<tf::mesh> plate{5, moved(ball(3, 0.5), {0.25, 0.125, 4.0})};
    std::vector<tf::mesh_view> plate_views{plate.begin(), plate.end()};

    [[nodiscard]] std::vector<operation> all() const {
        const auto cancelled = [](const auto& result) {
            if constexpr (requires { result.certificate; })
                return result.certificate.status == tf::status::cancelled;
            else
                return result.status == tf::status::cancelled;
        };
        const auto measured = [](const auto& result) {
            return result->status == tf::status::cancelled;
        };
        return {
            {"relation",
             [=, this](const auto& p) {
                 return cancelled(tf::relation(above, still, {.progress = p}));
             }},
            {"relation of what penetrates",
             [=, this](const auto& p) {
                 return cancelled(tf::relation(inside, still, {.progress = p}));
             }},
            {"measure",
             [=, this](const auto& p) {
                 return measured(tf::measure(inside, still, {.progress = p}));
             }},
            {"measure from afar",
             [=, this](const auto& p) {
                 return measured(tf::measure(above, still, {.progress = p}));
             }},
            {"time of impact",
             [=, this](const auto& p) {
                 return cancelled(tf::time_of_impact(above, still, downwards, {.progress = p}));
             }},
            {"time to distance",
             [=, this](const auto& p) {
                 return cancelled(
                     tf::time_to_distance(above, still, downwards, 0.25, {.progress = p}));
             }},
            {"sweep among",
             [=, this](const auto& p) {
                 return cancelled(tf::detail::place::sweep_among(shape(above), parts, downwards,
                                                                 {.progress = p}));
             }},
            {"sweep among to a clearance",
             [=, this](const auto& p) {
                 return cancelled(tf::detail::place::sweep_among(
                     shape(above), parts, downwards, {.clearance = 0.125, .progress = p}));
             }},
            {"settle among",
             [=, this](const auto& p) {
                 return cancelled(tf::detail::place::snap_to_representable(above, parts, downwards,
                                                                           3.0, {.progress = p}));
             }},
            {"moves apart",
             [=, this](const auto& p) {
                 return cancelled(
                     tf::detail::place::search_separations(shape(inside), parts, {.progress = p}));
             }},
            {"slide",
             [=, this](const auto& p) {
                 return cancelled(tf::slide(above, fixed, downwards, {.progress = p}));
             }},
            {"slide to a clearance",
             [=, this](const auto& p) {
                 return cancelled(
                     tf::slide(above, fixed, downwards, {.clearance = 0.125, .progress = p}));
             }},
            {"separate",
             [=, this](const auto& p) {
                 return cancelled(tf::separate(inside, fixed, {.progress = p}));
             }},
            {"convex hull",
             [=, this](const auto& p) {
                 return cancelled(tf::convex_hull(still.indexed_view().points, p));
             }},
            {"lay flat",
             [=, this](const auto& p) { return cancelled(*tf::lay_flat(still, {.progress = p})); }},
            {"pack",
             [=, this](const auto& p) {
                 return cancelled(tf::pack(plate_views, {.size = {4, 4, 4}, .progress = p}));
             }},
            {"align",
             [=, this](const auto& p) {
                 return cancelled(tf::align(above, still, {.progress = p}));
             }},
        };
    }
};

}  // namespace

TEST_CASE("progress of placing goes from 0 to 1 and never back, on any number of threads") {
    const operations given;
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        for (const operation& one : given.all()) {
            CAPTURE(one.name);
            std::vector<double> shares;
            CHECK_FALSE(one.was_cancelled([&](double done) {
                shares.push_back(done);
                return true;
            }));
            REQUIRE(!shares.empty());
            CHECK(shares.front() >= 0.0);
            CHECK(shares.back() == 1.0);
            for (std::size_t i = 1; i < shares.size(); ++i) CHECK(shares[i - 1] <= shares[i]);
        }
    }
}

TEST_CASE("placing stops at the first report that asks for it, and asks no more") {
    const operations given;
    for (const operation& one : given.all()) {
        CAPTURE(one.name);
        std::size_t reports = 0;
        CHECK_FALSE(one.was_cancelled([&](double) { return ++reports > 0; }));
        for (const std::size_t stop_at : {std::size_t{1}, (reports + 1) / 2}) {
            if (stop_at == reports) continue;  // with the last of them it is done
            std::size_t heard = 0;
            CHECK(one.was_cancelled([&](double) { return ++heard < stop_at; }));
            CHECK(heard == stop_at);
        }
    }
}

TEST_CASE("who is told of the progress gets the same answer") {
    const operations given;
    const tf::progress_callback patient = [](double) { return true; };
    const auto alone = tf::separate(given.inside, given.fixed);
    CHECK(alone.points == tf::separate(given.inside, given.fixed, {.progress = patient}).points);
    CHECK(tf::slide(given.above, given.fixed, downwards).points ==
          tf::slide(given.above, given.fixed, downwards, {.progress = patient}).points);
    CHECK(tf::align(given.above, given.still).matrix ==
          tf::align(given.above, given.still, {.progress = patient}).matrix);
}
