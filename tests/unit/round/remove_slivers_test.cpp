#include <libmesh/round/remove_slivers.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

using tf::detail::round::remove_slivers;
using tf::detail::round::slivers_removed;

namespace {

std::vector<tf::face_pair> all_meeting(tf::mesh_view mesh) {
    auto pairs = tf::self_intersections(mesh, {.vertices = tf::vertex_identity::by_index}).pairs;
    for (const std::uint32_t f : tf::find_invalid_faces(mesh).degenerate_faces)
        pairs.push_back({f, f});
    return pairs;
}

/// A box whose lower side has an edge with one more corner next to it, in the side above or below:
/// both faces there meet others or not.
tf::mesh with_cap(double height) {
    tf::mesh mesh = test::box(1, 1, 1);
    // Splits the face 0 at a point that is `height` off the middle of its first edge, outward.
    const auto [a, b, c] = mesh.faces[0];
    const tf::point3 p = mesh.points[a], q = mesh.points[b], r = mesh.points[c];
    const tf::point3 middle{(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2};
    const tf::point3 off{(r.x - middle.x) * height, (r.y - middle.y) * height,
                         (r.z - middle.z) * height};
    const auto made = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back({middle.x + off.x, middle.y + off.y, middle.z + off.z});
    mesh.faces[0] = {made, b, c};
    mesh.faces.push_back({a, made, c});
    mesh.faces.push_back({a, b, made});
    return mesh;
}

}  // namespace

TEST_CASE("slivers: where nothing meets and nothing is thin, nothing changes") {
    const tf::mesh mesh = test::box(1, 1, 1);
    const slivers_removed left =
        remove_slivers(mesh, {}, {.reach = 10.0, .thin = 0.1, .solid = true});
    CHECK(left.changes == 0);
    CHECK(left.faces == mesh.faces);
}

TEST_CASE("slivers: a cap that was turned over goes into its neighbor across the long edge") {
    for (const double height : {0.0, -0x1p-20}) {  // without an area; folded over its neighbor
        CAPTURE(height);
        const tf::mesh mesh = with_cap(height);
        const auto meeting = all_meeting(mesh);
        REQUIRE(!meeting.empty());
        const slivers_removed left =
            remove_slivers(mesh, meeting, {.reach = 0x1p-18, .thin = 0.0, .solid = true});
        CHECK(left.changes > 0);
        CHECK(left.moved <= 0x1p-18);
        const tf::mesh now{.points = mesh.points, .faces = left.faces};
        CHECK(all_meeting(now).empty());
        CHECK_FALSE(treeform::find_open_edge(now));
        CHECK(std::abs(tf::signed_volume(now) - 1.0) < 0x1p-18);
        REQUIRE(left.face_of.size() == now.faces.size());
        for (std::size_t f = 0; f < now.faces.size(); ++f)
            if (left.is_new[f] == 0) CHECK(now.faces[f] == mesh.faces[left.face_of[f]]);
    }
}

TEST_CASE("slivers: nothing longer than the reach goes") {
    const tf::mesh mesh = with_cap(-0x1p-10);
    const auto meeting = all_meeting(mesh);
    REQUIRE(!meeting.empty());
    for (const double reach : {0x1p-13, 0x1p-9}) {
        const slivers_removed left = remove_slivers(mesh, meeting, {.reach = reach, .solid = true});
        CHECK(left.moved <= reach);
        const tf::mesh now{.points = mesh.points, .faces = left.faces};
        CHECK(all_meeting(now).empty() == (reach > 0x1p-10));
    }
}

TEST_CASE("slivers: thin faces that are listed go where that leaves fewer") {
    const tf::mesh mesh = with_cap(0x1p-20);
    REQUIRE(all_meeting(mesh).empty());
    std::vector<tf::face_pair> all;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) all.push_back({f, f});
    const slivers_removed left =
        remove_slivers(mesh, all, {.reach = 0x1p-18, .thin = 0x1p-19, .solid = true});
    CHECK(left.changes == 1);
    CHECK(all_meeting(tf::mesh{.points = mesh.points, .faces = left.faces}).empty());
}

TEST_CASE("slivers: needles go, of which two corners all but coincide") {
    // The corner of face 0 gets a twin next to it, on the way to the middle of the opposite edge.
    tf::mesh mesh = test::box(1, 1, 1);
    const auto [a, b, c] = mesh.faces[0];
    const tf::point3 p = mesh.points[a], q = mesh.points[b], r = mesh.points[c];
    tf::point3 twin;
    for (std::size_t k = 0; k < 3; ++k) twin[k] = p[k] + 0x1p-45 * (q[k] + r[k] - 2 * p[k]);
    const auto made = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(twin);
    mesh.faces[0] = {made, b, c};
    mesh.faces.push_back({a, b, made});
    mesh.faces.push_back({made, c, a});
    REQUIRE(tf::self_intersections(mesh).pairs.empty());
    std::vector<tf::face_pair> listed;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) listed.push_back({f, f});
    const slivers_removed left =
        remove_slivers(mesh, listed, {.reach = 1e-9, .thin = 1e-10, .solid = true});
    CHECK(left.faces.size() == 12);
    CHECK(left.changes == 1);
    CHECK(tf::self_intersections(tf::mesh{mesh.points, left.faces}).pairs.empty());
}

TEST_CASE("slivers: thick faces that meet stay for others to cut") {
    const tf::mesh mesh =
        test::together(test::box(1, 1, 1), test::moved(test::box(1, 1, 1), {0.5, 0.25, 0.25}));
    const slivers_removed left =
        remove_slivers(mesh, all_meeting(mesh), {.reach = 0x1p-3, .solid = true});
    CHECK(left.moved == 0.0);  // sides of boxes may be divided otherwise
    const tf::mesh now{.points = mesh.points, .faces = left.faces};
    CHECK(!all_meeting(now).empty());
    CHECK(tf::signed_volume(now) == 2.0);
}
