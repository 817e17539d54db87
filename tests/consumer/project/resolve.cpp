#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <cstdio>

int main() {
    const tf::usable_mesh part = tf::read_mesh("data/two_spheres.stl");
    const tf::repair_result solid = tf::resolve_self_intersections(
        part, tf::resolve_mode::outer, {.precision = tf::precision::float32});
    std::puts(solid.certificate.message().c_str());
    const tf::mesh& clean = solid.value();  // throws unless it is certified
    std::printf("%zu faces, volume %.3f\n", clean.faces.size(), tf::signed_volume(clean));
    return tf::self_intersections(clean).pairs.empty() ? 0 : 1;
}
