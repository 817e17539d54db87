#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <cstdio>

int main() {
    const tf::usable_mesh part = tf::read_mesh("data/two_spheres.stl");
    const tf::face_pair_result found = tf::self_intersections(part);
    for (const tf::face_pair& pair : found.pairs)  // ascending
        if (pair.kind == tf::pair_kind::crossing)
            std::printf("face %u crosses face %u\n", pair.a, pair.b);
    return found.pairs.size() == 78 ? 0 : 1;
}
