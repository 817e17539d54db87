#include <treeform/tf.hpp>
#include <treeform/treeform.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>

#include <functional>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

std::string said_by(const std::function<void()>& call) {
    try {
        call();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "nothing";
}

}  // namespace

TEST_CASE("errors name the function that was called, the operand, and the caller's face") {
    const tf::mesh good = test::box(1, 1, 1);
    tf::mesh wild = good;
    wild.faces[2][1] = 99;
    const std::vector<tf::mesh_view> with_wild{good, wild};
    const auto named = [](const char* function, const char* operand) {
        return std::string("treeform::") + function + ": " + operand +
               "face 2 has a corner out of range: 99, of 8 points numbered from 0";
    };
    const tf::boolean_expression both("a*b", 2);
    const std::vector<std::pair<std::string, std::function<void()>>> calls{
        {named("unite", "operand b: "), [&] { (void)tf::unite(good, wild); }},
        {named("difference", "operand a: "), [&] { (void)tf::difference(wild, good); }},
        {named("intersection", "operand b: "), [&] { (void)tf::intersection(good, wild); }},
        {named("symmetric_difference", "operand b: "),
         [&] { (void)tf::symmetric_difference(good, wild); }},
        {named("boolean", "operand b: "), [&] { (void)tf::boolean(with_wild, both); }},
        {named("clip", "operand b: "), [&] { (void)tf::clip(with_wild, 0, both); }},
        {named("split", "operand b: "), [&] { (void)tf::split(with_wild); }},
        {named("check_operand", ""), [&] { (void)tf::check_operand(wild); }},
        {named("intersection", "operand b: "),
         [&] {
             (void)tf::intersection(tf::prepared_mesh::borrow(good),
                                    tf::prepared_mesh::borrow(wild));
         }},
        {named("solid", ""), [&] { (void)tf::solid(tf::mesh(wild)); }},
        {named("resolve_self_intersections", ""),
         [&] { (void)tf::resolve_self_intersections(wild); }},
        {named("resolve_self_intersections", ""),
         [&] { (void)tf::resolve_self_intersections(wild, tf::resolve_mode::remove); }},
        {named("self_intersections", ""), [&] { (void)tf::self_intersections(wild); }},
        {named("mesh_intersections", "b: "), [&] { (void)tf::mesh_intersections(good, wild); }},
        {named("intersects", "a: "), [&] { (void)tf::intersects(wild, good); }},
        {named("distance", "b: "), [&] { (void)tf::distance(good, wild); }},
        {named("closest_pair", "b: "), [&] { (void)tf::closest_pair(good, wild); }},
        {named("closest_point", ""), [&] { (void)tf::closest_point(wild, tf::point3{}); }},
        {named("locate", ""), [&] { (void)tf::contains(wild, tf::point3{}); }},
        {named("relation", "b: "), [&] { (void)tf::relation(good, wild); }},
        {named("measure", "b: "), [&] { (void)tf::measure(good, wild); }},
        {named("slide", "fixed 0: "),
         [&] {
             (void)tf::slide(good, wild, {0, 0, -1});
         }},
        {named("weld", ""), [&] { (void)tf::weld(wild); }},
        {named("signed_volume", ""), [&] { (void)tf::signed_volume(wild); }},
        {named("count_topology", ""),
         [&] { (void)tf::count_topology(wild.points.size(), wild.faces); }},
        {named("faces_in_box", ""),
         [&] {
             (void)tf::faces_in_box(wild, {0, 0, 0}, {1, 1, 1});
         }},
    };
    for (const auto& [expected, call] : calls) CHECK(said_by(call) == expected);
}

TEST_CASE("errors name the face that is not finite as the caller numbers it") {
    const tf::mesh good = test::box(1, 1, 1);
    tf::mesh bad = good;
    bad.points[7].y = std::numeric_limits<double>::infinity();
    std::size_t lowest = 0;
    while (bad.faces[lowest][0] != 7 && bad.faces[lowest][1] != 7 && bad.faces[lowest][2] != 7)
        ++lowest;
    const std::string face = "face " + std::to_string(lowest) + " has a corner that is not finite";
    CHECK(said_by([&] { (void)tf::unite(good, bad); }) ==
          "treeform::unite: operand b: " + face + " or beyond 2^1000");
    CHECK(said_by([&] { (void)tf::resolve_self_intersections(bad); }) ==
          "treeform::resolve_self_intersections: " + face + " or beyond 2^1000");
    CHECK(said_by([&] { (void)tf::intersects(bad, good); }) == "treeform::intersects: a: " + face);
    CHECK(said_by([&] { (void)tf::distance(good, bad); }) == "treeform::distance: b: " + face);
    CHECK(said_by([&] { (void)tf::relation(good, bad); }) == "treeform::relation: b: " + face);
}

TEST_CASE("name_of: every status has its own name") {
    std::set<std::string> names;
    for (int i = 0; i <= static_cast<int>(tf::status::cancelled); ++i)
        names.insert(tf::name_of(static_cast<tf::status>(i)));
    CHECK(names.size() == 10);
    CHECK(tf::name_of(tf::status::ok) == std::string("ok"));
    CHECK(tf::name_of(tf::status::open_input) == std::string("open-input"));
    CHECK(tf::name_of(tf::status::no_placement) == std::string("no-placement"));
    CHECK(tf::name_of(tf::status::cancelled) == std::string("cancelled"));
}
