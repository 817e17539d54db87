#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/solid.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>

#include <memory>
#include <string>
#include <utility>

namespace {

tf::mesh box_at(double at) {
    tf::mesh mesh = test::box(2, 1, 1);
    for (tf::point3& p : mesh.points) p.x += at;
    return mesh;
}
tf::solid box(double at) { return tf::solid(box_at(at)); }

}  // namespace

TEST_CASE("solid: a formula has the volume of its set operations, and is arranged once") {
    const tf::solid a = box(0), b = box(1), c = box(5);
    CHECK(tf::signed_volume((a + b).mesh()) == 3.0);
    CHECK(tf::signed_volume((a * b).mesh()) == 1.0);
    CHECK(tf::signed_volume((a - b).mesh()) == 1.0);
    CHECK(tf::signed_volume((a ^ b).mesh()) == 2.0);
    CHECK((a | b).mesh() == (a + b).mesh());
    CHECK((a & b).mesh() == (a * b).mesh());
    const tf::solid all = (a + b) - a * b + c;
    const tf::boolean_result& first = all.result();
    CHECK(tf::signed_volume(first.value()) == 4.0);
    CHECK(&tf::solid(all).result() == &first);
    CHECK(all.mesh() == tf::boolean({a.mesh(), b.mesh(), c.mesh()}, {"(a+b)-a*b+c", 3}).mesh);
}

TEST_CASE("solid: from the mesh of a file; a formula as a string; names of kinds") {
    const tf::solid read(tf::usable_mesh{.mesh = box_at(0)});
    CHECK(tf::signed_volume(read.mesh()) == 2.0);
    const std::string formula = "a-b";
    CHECK(tf::boolean({box_at(0), box_at(1)}, formula).mesh == (box(0) - box(1)).mesh());
    const auto prepared = tf::prepared_mesh(box_at(0));
    CHECK_FALSE(tf::find_open_edge(prepared).has_value());
    CHECK(tf::name_of(tf::pair_kind::touching) == std::string("touching"));
    CHECK(tf::name_of(tf::placement_outcome::cancelled) == std::string("cancelled"));
    CHECK(tf::name_of(tf::placement_outcome::too_far) == std::string("too-far"));
    CHECK(tf::name_of(tf::location::boundary) == std::string("boundary"));
}

TEST_CASE("solid: an open mesh is refused with the place where it is open") {
    tf::mesh open = box_at(0);
    open.faces.pop_back();
    try {
        const tf::solid none(std::move(open));
        FAIL("an open mesh became a solid");
    } catch (const tf::not_certified_error& error) {
        CHECK(error.why().status == tf::status::open_input);
        CHECK(error.why().open_count == 3);
    }
}

TEST_CASE("solid: a difference of itself is empty, and a shared mesh counts once") {
    const auto shared = std::make_shared<const tf::prepared_mesh>(box_at(0));
    const tf::solid a(shared), again(shared);
    CHECK((a - again).result().mesh.faces.empty());
    CHECK(tf::signed_volume((a + again).mesh()) == 2.0);
}

TEST_CASE("solid: a deep formula is taken apart without recursion") {
    const tf::solid one = box(0);
    tf::solid sum = one;
    for (int i = 0; i < 2'000; ++i) sum = sum + one;
    CHECK(tf::signed_volume(sum.mesh()) == 2.0);
    for (int i = 0; i < 200'000; ++i) sum = one - sum;
    sum = one;
    CHECK(tf::signed_volume(sum.mesh()) == 2.0);
}
