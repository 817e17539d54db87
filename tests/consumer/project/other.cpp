#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/tree.hpp>
#include <treeform/tree/version.hpp>

std::size_t crossings_of_other_source() {
    const tf::mesh soup{
        .points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, -1}, {1, 1, 1}},
        .faces = {{0, 1, 2}, {3, 4, 5}}};
    return tf::self_intersections(tf::join_equal_points(soup)).pairs.size();
}
