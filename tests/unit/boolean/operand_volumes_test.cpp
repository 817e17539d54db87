/// \file
/// `boolean_options::volumes`, in both ways that find them: `simplify` asks for all cells.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cmath>

namespace {

using test::box;
using test::moved;
using test::turned;
using tf::boolean_options;
using tf::mesh;

/// Volumes that both ways and several formulas agree on to `most`.
tf::operand_volumes volumes_of(const mesh& a, const mesh& b, double most) {
    tf::operand_volumes first;
    bool is_first = true;
    for (const char* text : {"a+b", "a*b", "b-a", "a^b"})
        for (const bool simplify : {false, true}) {
            CAPTURE(text);
            CAPTURE(simplify);
            const auto result =
                tf::boolean(std::array<tf::mesh_view, 2>{a, b}, {text, 2},
                            boolean_options{.merge_coplanar = simplify, .volumes = true});
            REQUIRE(result.volumes);
            if (is_first) first = *result.volumes;
            is_first = false;
            CHECK(std::abs(result.volumes->first - first.first) <= most);
            CHECK(std::abs(result.volumes->second - first.second) <= most);
            CHECK(std::abs(result.volumes->either - first.either) <= most);
            CHECK(std::abs(result.volumes->both - first.both) <= most);
        }
    return first;
}

void check(const mesh& a, const mesh& b, std::array<double, 4> expected) {
    const auto [first, second, either, both] = volumes_of(a, b, 0.0);
    CHECK(std::array{first, second, either, both} == expected);
}

}  // namespace

TEST_CASE("volumes: boxes that are apart, touch, overlap, lie in each other, or are not there") {
    const mesh b = box(1, 1, 1);
    check(b, moved(b, {2, 0, 0}), {1, 1, 2, 0});
    check(b, moved(b, {1, 0, 0}), {1, 1, 2, 0});
    check(b, moved(b, {1, 0.5, 0.25}), {1, 1, 2, 0});
    check(b, b, {1, 1, 1, 1});
    check(b, moved(b, {0.5, 0, 0}), {1, 1, 1.5, 0.5});
    check(b, moved(b, {0.5, 0.5, 0.5}), {1, 1, 1.875, 0.125});
    check(b, moved(box(0.5, 0.5, 0.5), {0.25, 0.25, 0.25}), {1, 0.125, 1, 0.125});
    check({}, b, {0, 1, 1, 0});
    check(b, {}, {1, 0, 1, 0});
}

TEST_CASE("volumes: of turned boxes, what the surfaces of the results enclose") {
    test::random source(4);
    for (int round = 0; round < 12; ++round) {
        CAPTURE(round);
        const auto random_box = [&] {
            const mesh b = box(source.in(0.5, 1.5), source.in(0.5, 1.5), source.in(0.5, 1.5));
            return moved(turned(b, {source.in(-1, 1), source.in(-1, 1), 1}, source.in(0, 3)),
                         {source.in(-0.7, 0.7), source.in(-0.7, 0.7), source.in(-0.7, 0.7)});
        };
        const mesh a = random_box(), b = random_box();
        // Vertices on cuts move by units of 2^-53, volumes by areas times that.
        const double most = 0x1p-46;
        const auto found = volumes_of(a, b, most);
        CHECK(std::abs(found.either - tf::signed_volume(tf::unite(a, b).mesh)) <= most);
        CHECK(std::abs(found.both - tf::signed_volume(tf::intersection(a, b).mesh)) <= most);
    }
}

TEST_CASE("volumes: far from the origin, where the cones of faces nearly cancel") {
    const tf::point3 far{0x1p20, -0x1p21, 0x1p20};
    check(moved(box(1, 1, 1), far), moved(box(1, 1, 1), {far.x + 0.5, far.y + 0.5, far.z}),
          {1, 1, 1.75, 0.25});
}
