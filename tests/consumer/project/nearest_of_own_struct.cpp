#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/nearness.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

struct shop {
    double x, y;
    const char* name;
};

int main() {
    const std::vector<shop> shops{{0, 0, "baker"}, {4, 3, "butcher"}, {1, 2, "grocer"}};
    const auto tree = tf::build(shops, [](const shop& s) {
        return tf::aabb<double, 2>{{s.x, s.y}, {s.x, s.y}};
    });
    const auto two = tf::k_nearest(tree, std::array{1.0, 1.0}, 2, [&](std::uint32_t id) {
        return std::pow(shops[id].x - 1, 2) + std::pow(shops[id].y - 1, 2);  // squared
    });
    for (const auto& near : two) std::puts(shops[near.id].name);
    return two[0].id == 2 && two[1].id == 0 ? 0 : 1;
}
