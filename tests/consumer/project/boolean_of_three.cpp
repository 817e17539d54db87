#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <cstdio>

int main() {
    const tf::mesh a = tf::read_mesh("data/two_spheres.stl").mesh;
    const tf::mesh b = tf::read_mesh("data/cube.stl").mesh;
    const tf::mesh c = tf::read_mesh("data/sphere.ply").mesh;
    const tf::boolean_result made = tf::boolean({a, b, c}, "(a-b)*c");
    const double all = tf::signed_volume(tf::unite({a, b, c}).value());
    std::puts(made.certificate.message().c_str());
    const double volume = tf::signed_volume(made.value());  // throws unless it is certified
    std::printf("volume %.3f\n", volume);
    const tf::operand_element source = made.face_source[0];  // operand 0 is a, 1 is b, ...
    std::printf("face 0 is from face %u of operand %u\n", source.index, source.operand);
    return volume > 0 && volume < tf::signed_volume(c) && all > tf::signed_volume(b) ? 0 : 1;
}
