#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/operand_edges.hpp>
#include <libmesh/boolean/sample_faces.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using test::ball;
using test::box;
using test::moved;

tf::detail::boolean::face_samples samples_of(const std::vector<tf::mesh>& solids,
                                             const tf::boolean_expression& expression) {
    namespace detail = tf::detail::boolean;
    const std::vector<tf::mesh_view> views(solids.begin(), solids.end());
    const auto joined = detail::join_operands(views);
    const auto operand = joined.operand_of_face();
    const detail::surface_components components(joined.all, operand,
                                                detail::find_operand_edges(joined.all, operand));
    return detail::sample_faces(components, {expression, tf::fill_rule::nonzero});
}

}  // namespace

TEST_CASE("face samples: what is in others is hidden, what is apart or touches is not") {
    const auto union_of = [](std::size_t n) { return tf::boolean_expression::union_of(n); };
    const std::vector<tf::mesh> nested{ball(2, 1.0), ball(2, 0.3), ball(2, 0.08)};
    CHECK(samples_of(nested, union_of(3)).neighbors == 0.0);
    CHECK(samples_of(nested, union_of(3)).hidden == doctest::Approx(2.0 / 3).epsilon(0.05));
    CHECK(samples_of(nested, {"a*b*c", 3}).hidden == doctest::Approx(2.0 / 3).epsilon(0.05));
    CHECK(samples_of(nested, {"a^b^c", 3}).hidden == 0.0);
    CHECK(samples_of(nested, {"a-b", 3}).hidden == doctest::Approx(1.0 / 3).epsilon(0.05));

    const std::vector<tf::mesh> apart{ball(2, 1.0), moved(ball(2, 1.0), {3, 0, 0}),
                                      moved(ball(2, 1.0), {6, 0, 0})};
    CHECK(samples_of(apart, union_of(3)).hidden == 0.0);
    CHECK(samples_of(apart, union_of(3)).neighbors == 0.0);
    CHECK(samples_of(apart, {"a*b*c", 3}).hidden == 1.0);

    std::vector<tf::mesh> wall;  // face to face
    for (int i = 0; i < 27; ++i)
        wall.push_back(moved(box(1, 1, 1), {double(i % 3), double(i / 3 % 3), double(i / 9)}));
    CHECK(samples_of(wall, union_of(wall.size())).hidden == 0.0);
    CHECK(samples_of(wall, union_of(wall.size())).neighbors > 4.0);
}

TEST_CASE("face samples: faces that lie half in another solid are not hidden") {
    const std::vector<tf::mesh> cross{box(9, 1, 1), moved(box(1, 9, 1), {4, -4, 0.25}),
                                      moved(box(1, 1, 9), {4.25, 0.25, -4})};
    const auto samples = samples_of(cross, tf::boolean_expression::union_of(3));
    CHECK(samples.hidden == 0.0);
    CHECK(samples.neighbors > 1.0);
}

TEST_CASE("face samples: hidden faces count for what it costs to cut them") {
    // Pins through a plate: half of all faces are their ends, out of it, where nothing is near
    // them.
    std::vector<tf::mesh> drilled{box(8, 8, 0.5)};
    for (int i = 0; i < 64; ++i)
        drilled.push_back(moved(test::prism(32, 0.3, 1.0), {i % 8 + 0.5, i / 8 + 0.5, -0.25}));
    const auto samples = samples_of(drilled, tf::boolean_expression::difference_of(drilled.size()));
    CHECK(samples.hidden > 0.0);
    CHECK(samples.hidden < 0.25);
    // Each face of a side has two large ones of the plate near it, and its fellows have none.
    CHECK(samples.neighbors > 0.9);
}

TEST_CASE("face samples: nothing is known of a face whose normal overflows") {
    std::vector<tf::mesh> huge{box(1, 1, 1), moved(box(2, 0.5, 0.5), {-0.25, 0, 0})};
    for (tf::mesh& one : huge)
        for (tf::point3& p : one.points) p = {p.x * 1e300, p.y * 1e300, p.z * 1e300};
    CHECK(samples_of(huge, tf::boolean_expression::union_of(2)).hidden == 0.0);
    const auto made = tf::unite(huge);
    CHECK(made.certificate.status == tf::status::ok);
    CHECK(!made.mesh.faces.empty());
}
