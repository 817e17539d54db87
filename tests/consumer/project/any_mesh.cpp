/// \file
/// Meshes of every kind where a function takes one; exits 0 when the answers are right.

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/solid.hpp>
#include <treeform/tf.hpp>

#include <cmath>
#include <vector>

int main() {
    const tf::mesh_file f = tf::read("data/cube.stl"), g = tf::read("data/sphere.ply");
    const tf::mesh a = tf::as_mesh(f).mesh, b = tf::as_mesh(g).mesh, c = a;
    const tf::prepared_mesh prepared(tf::as_mesh(f));
    const double volume = tf::signed_volume(prepared);

    const bool unions =
        tf::unite(tf::as_mesh(f), tf::as_mesh(g)).mesh ==
            tf::unite(tf::read_mesh("data/cube.stl"), tf::read_mesh("data/sphere.ply")).mesh &&
        tf::unite(a, b).mesh == tf::unite(prepared, b).mesh;
    const bool many = tf::split({a, b}).certificate &&
                      tf::clip({a, b}, 0, {"a*b", 2}).certificate &&
                      tf::boolean(std::vector<tf::mesh>{a, b}, "a+b").certificate &&
                      std::abs(tf::signed_volume(tf::boolean({a, b, c}, "(a-b)*c").value()) -
                               tf::signed_volume(tf::difference(a, b).value())) < 1e-9;
    const bool others = tf::repair(prepared).certificate && tf::distance(a, prepared) == 0.0;

    const tf::mesh part{{{0.25, 0.25, 5}, {0.5, 0.25, 5}, {0.25, 0.5, 5}}, {{0, 1, 2}}};
    const bool placed =
        tf::slide(part, {prepared, b}, {0, 0, -1}) && tf::slide(part, a, {0, 0, -1});
    const tf::solid kept(a);
    return unions && many && others && placed && volume == 1.0 &&
                   tf::signed_volume(kept.mesh()) == 1.0
               ? 0
               : 1;
}
