/// \file
/// What every operation that finds a place says of its progress, and how it hears that it should
/// stop.

#include <libmesh/base/face_tree.hpp>
#include <libmesh/place/first_approach.hpp>
#include <libmesh/place/settle.hpp>
#include <treeform/mesh/arrange.hpp>
#include <treeform/mesh/clear.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/first_contact.hpp>
#include <treeform/mesh/fit.hpp>
#include <treeform/mesh/lay.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/relation.hpp>
#include <treeform/mesh/settle_among.hpp>
#include <treeform/mesh/slide.hpp>
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

const tf::point3 down{0.0, 0.0, -1.0};

struct operation {
    std::string name;
    std::function<bool(const tf::progress_callback&)> was_cancelled;
};

/// Every operation, on meshes that keep it busy for a while.
struct operations {
    tf::mesh still = ball(3, 1.0);
    tf::mesh above = moved(ball(3, 0.5), {0.25, 0.125, 4.0});
    tf::mesh inside = moved(ball(3, 0.5), {0.25, 0.125, 0.75});
    tf::mesh beside = moved(ball(3, 1.0), {0.0, 1.5, 0.25});
    tf::tree<3> still_tree = tf::face_tree(still);
    tf::tree<3> above_tree = tf::face_tree(above);
    tf::tree<3> inside_tree = tf::face_tree(inside);
    tf::tree<3> beside_tree = tf::face_tree(beside);
    std::vector<tf::still_part> parts{{still, &still_tree}, {beside, &beside_tree}};
    std::vector<tf::mesh> plate{5, above};
    std::vector<tf::mesh_view> plate_views{plate.begin(), plate.end()};

    [[nodiscard]] std::vector<operation> all() const {
        const auto in = [this](const tf::progress_callback& p) {
            return tf::measure(inside, inside_tree, still, still_tree, {.progress = p});
        };
        return {
            {"relation",
             [this](const auto& p) {
                 return tf::relation(above, above_tree, still, still_tree, p).cancelled;
             }},
            {"relation of what penetrates",
             [this](const auto& p) {
                 return tf::relation(inside, inside_tree, still, still_tree, p).cancelled;
             }},
            {"measure", [in](const auto& p) { return in(p)->relation.cancelled; }},
            {"measure from afar",
             [this](const auto& p) {
                 return tf::measure(above, above_tree, still, still_tree, {.progress = p})
                     ->relation.cancelled;
             }},
            {"first contact",
             [this](const auto& p) {
                 return tf::first_contact(above, above_tree, still, still_tree, down,
                                          {.progress = p})
                     .cancelled;
             }},
            {"first approach",
             [this](const auto& p) {
                 return tf::first_approach(above, above_tree, still, still_tree, down, 0.25,
                                           {.progress = p})
                     .cancelled;
             }},
            {"slide",
             [this](const auto& p) {
                 return tf::slide(above, above_tree, parts, down, {.progress = p}).cancelled;
             }},
            {"slide to a clearance",
             [this](const auto& p) {
                 return tf::slide(above, above_tree, parts, down,
                                  {.clearance = 0.125, .progress = p})
                     .cancelled;
             }},
            {"settle",
             [this](const auto& p) {
                 return tf::settle(above, still, still_tree, down, 3.0, {.progress = p}).cancelled;
             }},
            {"settle among",
             [this](const auto& p) {
                 return tf::settle_among(above, parts, down, 3.0, {.progress = p}).cancelled;
             }},
            {"clear",
             [this](const auto& p) {
                 return tf::clear_moves(inside, inside_tree, parts, {.progress = p}).cancelled;
             }},
            {"convex hull",
             [this](const auto& p) { return tf::convex_hull(still.points, p).cancelled; }},
            {"lay", [this](const auto& p) { return tf::lay(still, {.progress = p})->cancelled; }},
            {"arrange",
             [this](const auto& p) {
                 return tf::arrange(plate_views, {.size = {4, 4, 4}, .progress = p}).cancelled;
             }},
            {"fit",
             [this](const auto& p) {
                 return tf::fit(above.points, still, {.progress = p}).cancelled;
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
    const auto alone = tf::clear_moves(given.inside, given.inside_tree, given.parts);
    const auto watched =
        tf::clear_moves(given.inside, given.inside_tree, given.parts, {.progress = patient});
    REQUIRE(alone.moves.size() == watched.moves.size());
    for (std::size_t i = 0; i < alone.moves.size(); ++i) {
        CHECK(alone.moves[i].time == watched.moves[i].time);
        CHECK(alone.moves[i].direction == watched.moves[i].direction);
    }
    const auto slid = tf::slide(given.above, given.above_tree, given.parts, down);
    CHECK(slid.time ==
          tf::slide(given.above, given.above_tree, given.parts, down, {.progress = patient}).time);
    CHECK(tf::fit(given.above.points, given.still).matrix ==
          tf::fit(given.above.points, given.still, {.progress = patient}).matrix);
}
