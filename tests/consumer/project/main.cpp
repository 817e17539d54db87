/// \file
/// Uses both libraries from two sources; exits 0 when they answer as they should.

#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/version.hpp>

#include <cstdio>

std::size_t crossings_of_other_source();

int main() {
    static_assert(TREEFORM_VERSION >= TREEFORM_VERSION_OF(0, 1, 0));
    if (tf::version() != TREEFORM_VERSION) {
        std::printf("headers and library differ: loaded %s\n", tf::version_string());
        return 1;
    }
    const tf::mesh crossing{
        .points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {2, 1, 1}, {1, 2, 1}},
        .faces = {{0, 1, 2}, {3, 4, 5}}};
    const auto found = tf::self_intersections(crossing);
    std::printf("treeform %s: %zu pair here, %zu there\n", tf::version_string(), found.pairs.size(),
                crossings_of_other_source());
    return found.pairs.size() == 1 && crossings_of_other_source() == 1 ? 0 : 1;
}
