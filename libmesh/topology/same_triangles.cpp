#include <treeform/mesh/properties.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace treeform {
namespace {

/// As numbers that compare as lists do; -0 is 0.
using corners = std::array<std::array<double, 3>, 3>;

corners corners_of(mesh_view mesh, std::size_t f) {
    corners c;
    for (std::size_t k = 0; k < 3; ++k) {
        const point3& p = mesh.points[mesh.faces[f][k]];
        c[k] = {p.x + 0.0, p.y + 0.0, p.z + 0.0};
    }
    return c;
}

/// Each from its least corner on, ascending.
std::vector<corners> sorted_corners(mesh_view mesh) {
    std::vector<corners> all(mesh.faces.size());
    for (std::size_t f = 0; f < all.size(); ++f) {
        all[f] = corners_of(mesh, f);
        std::rotate(all[f].begin(), std::min_element(all[f].begin(), all[f].end()), all[f].end());
    }
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace

bool same_triangles(mesh_view a, mesh_view b, bool any_order) {
    if (a.faces.size() != b.faces.size()) return false;
    if (any_order) return sorted_corners(a) == sorted_corners(b);
    for (std::size_t f = 0; f < a.faces.size(); ++f)
        if (corners_of(a, f) != corners_of(b, f)) return false;
    return true;
}

}  // namespace treeform
