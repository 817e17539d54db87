#include "tools/picture/edges.hpp"

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <numeric>

namespace tools {
namespace {

struct side {
    std::uint32_t a, b, face;  ///< a < b
    friend auto operator<=>(const side&, const side&) = default;
};

/// All sides of faces, those of an edge beside each other.
std::vector<side> sides_of(tf::mesh_view mesh) {
    std::vector<side> sides;
    sides.reserve(3 * mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [a, b] = std::minmax(mesh.faces[f][i], mesh.faces[f][(i + 1) % 3]);
            if (a != b) sides.push_back({a, b, f});
        }
    std::sort(sides.begin(), sides.end());
    return sides;
}

}  // namespace

open_edges find_open_edges(tf::mesh_view given) {
    const tf::mesh mesh = tf::join_meshes({&given, 1});
    const std::vector<side> sides = sides_of(mesh);
    std::vector<side> open;
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
        while (end < sides.size() && sides[end].a == sides[i].a && sides[end].b == sides[i].b)
            ++end;
        if (end - i == 1) open.push_back(sides[i]);
    }
    std::sort(open.begin(), open.end(),
              [](const side& x, const side& y) { return x.face < y.face; });
    std::vector<std::uint32_t> root(mesh.points.size());
    std::iota(root.begin(), root.end(), 0U);
    const auto find = [&](std::uint32_t p) {
        while (root[p] != p) p = root[p] = root[root[p]];
        return p;
    };
    for (const side& s : open) root[find(s.a)] = find(s.b);
    open_edges result;
    constexpr std::uint32_t none = 0xffffffffU;
    std::vector<std::uint32_t> number(mesh.points.size(), none);
    for (const side& s : open) {
        std::uint32_t& hole = number[find(s.a)];
        if (hole == none) hole = result.holes++;
        result.ends.push_back({mesh.points[s.a], mesh.points[s.b]});
        result.hole.push_back(hole);
    }
    return result;
}

}  // namespace tools
