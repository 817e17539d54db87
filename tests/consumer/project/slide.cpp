#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/tf.hpp>

#include <cstdio>

int main() {
    const tf::mesh cube = tf::read_mesh("data/cube.stl").mesh;
    tf::mesh ball = tf::read_mesh("data/sphere.ply").mesh;
    for (tf::point3& p : ball.points) p.z += 10;  // above the cube
    const tf::placement place = tf::slide(ball, cube, {0, 0, -1}, {.clearance = 0.03});
    if (!place) return 1;
    const tf::placed_mesh seated = place.moved(ball);  // as it was checked, for tf::write
    if (seated.value().faces.size() != ball.faces.size()) return 1;
    std::printf("moved by %g\n", place.travel);
    for (const tf::placement_contact& c : place.contacts)
        std::printf("face %u of the ball meets mesh %zu at z = %g\n", c.moving, c.fixed, c.point.z);
    return place.relation == tf::mesh_relation::clear ? 0 : 1;
}
