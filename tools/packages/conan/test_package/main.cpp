#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <cstdio>

int main() {
    // Two triangles that pass through each other.
    tf::mesh mesh;
    mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {1, 1, 1}};
    mesh.faces = {{0, 1, 2}, {3, 4, 5}};
    const auto found = tf::self_intersections(mesh);
    std::printf("%zu pair\n", found.pairs.size());
    return found.pairs.size() == 1 ? 0 : 1;
}
