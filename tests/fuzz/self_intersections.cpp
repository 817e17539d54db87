/// \file
/// Pairs of faces without a common corner that a mesh's search finds, against all pairs.

#include "bytes.hpp"
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <utility>

namespace {

bool share_a_corner(const tf::face& f, const tf::face& g) {
    return std::find_first_of(f.begin(), f.end(), g.begin(), g.end()) != f.end();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tf::fuzz::bytes in(data, size);
    const tf::mesh mesh = in.shape(40, 40);
    const auto corners = [&](const tf::face& f) {
        return tf::triangle3{mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]};
    };
    using pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
    pairs found;
    for (const auto& pair :
         tf::self_intersections(mesh, {.vertices = tf::vertex_identity::by_index}).pairs)
        if (!share_a_corner(mesh.faces[pair.a], mesh.faces[pair.b]))
            found.emplace_back(pair.a, pair.b);
    pairs expected;
    for (std::uint32_t a = 0; a < mesh.faces.size(); ++a)
        for (std::uint32_t b = a + 1; b < mesh.faces.size(); ++b)
            if (!share_a_corner(mesh.faces[a], mesh.faces[b]) &&
                tf::intersect(corners(mesh.faces[a]), corners(mesh.faces[b])).count != 0)
                expected.emplace_back(a, b);
    tf::fuzz::require(found == expected, "the pairs are those that meet");
    return 0;
}
