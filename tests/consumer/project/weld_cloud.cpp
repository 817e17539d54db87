#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <cstdio>
#include <vector>

int main() {
    const std::vector<tf::point3> scan{{0, 0, 0}, {0.004, 0, 0}, {1, 0, 0}, {1, 0.01, 0}};
    const tf::weld_result welded = tf::weld(scan, {.tolerance = 0.01});  // inclusive
    for (const tf::point3& p : welded.mesh.points) std::printf("%g %g %g\n", p.x, p.y, p.z);
    const std::vector<std::uint32_t> expected{0, 0, 1, 1};  // the new number of each point
    return welded.groups.group_of_point == expected ? 0 : 1;
}
