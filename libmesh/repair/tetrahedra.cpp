#include <libmesh/repair/tetrahedra.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::repair {
namespace {

using tetrahedron = std::array<std::uint32_t, 4>;

/// A face of a tetrahedron, seen counter-clockwise from outside.
struct side {
    face corners;
    std::uint32_t number;  ///< 4 times the tetrahedron's, plus 0 to 3
};

/// The corners, ascending: faces of two tetrahedra that are one have the same.
face sorted(face f) {
    std::ranges::sort(f);
    return f;
}

/// Whether the corners are in the order of the ascending ones, but for a rotation.
bool is_even(const face& f) {
    const auto first = static_cast<std::size_t>(std::ranges::min_element(f) - f.begin());
    return f[(first + 1) % 3] < f[(first + 2) % 3];
}

/// The tetrahedra that pairs of faces may be; none where not all faces are of a pair, or where not
/// all have a volume of one sign. Of a negative one, two corners are exchanged.
std::vector<tetrahedron> pairs_of(mesh_view mesh) {
    std::vector<tetrahedron> found;
    if (mesh.faces.size() % 2 != 0 || mesh.faces.size() < 4) return found;
    int sign = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); f += 2) {
        const auto [a, b, c] = mesh.faces[f];
        const auto [a2, c2, d] = mesh.faces[f + 1];
        if (a2 != a || c2 != c) return {};
        const int here = orient3d(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]);
        if (here == 0 || here == -sign) return {};
        sign = here;
        found.push_back(sign > 0 ? tetrahedron{a, b, c, d} : tetrahedron{a, c, b, d});
    }
    return found;
}

/// With d where a, b, c are seen counter-clockwise.
std::array<face, 4> faces_of(const tetrahedron& t) {
    const auto [a, b, c, d] = t;
    return {{{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}}};
}

/// The faces that belong to one tetrahedron alone, in the order of the tetrahedra; none where these
/// are not a volume that is cut up.
std::vector<side> boundary_of(std::span<const tetrahedron> all) {
    std::vector<side> sides;
    sides.reserve(4 * all.size());
    for (std::uint32_t t = 0; t < all.size(); ++t)
        for (std::uint32_t i = 0; i < 4; ++i) sides.push_back({faces_of(all[t])[i], 4 * t + i});
    std::ranges::sort(sides, {},
                      [](const side& s) { return std::pair(sorted(s.corners), s.number); });
    std::vector<std::uint8_t> is_joined(all.size(), 0);
    std::vector<side> boundary;
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
        const face here = sorted(sides[i].corners);
        while (end < sides.size() && sorted(sides[end].corners) == here) ++end;
        if (end - i == 1) {
            boundary.push_back(sides[i]);
            continue;
        }
        if (end - i > 2 || is_even(sides[i].corners) == is_even(sides[i + 1].corners)) return {};
        for (std::size_t k = i; k < end; ++k) is_joined[sides[k].number / 4] = 1;
    }
    if (std::ranges::count(is_joined, 0) > 0) return {};
    std::ranges::sort(boundary, {}, &side::number);
    return boundary;
}

}  // namespace

std::uint64_t count_tetrahedra(mesh_view mesh) {
    const std::vector<tetrahedron> all = pairs_of(mesh);
    return boundary_of(all).empty() ? 0 : all.size();
}

std::uint64_t keep_boundary_of_tetrahedra(working_mesh& mesh) {
    const std::vector<tetrahedron> all = pairs_of(mesh.view());
    const std::vector<side> boundary = boundary_of(all);
    if (boundary.empty()) return 0;
    const working_mesh given{{}, std::move(mesh.faces), std::move(mesh.source)};
    mesh.faces.clear();
    mesh.source.clear();
    for (const side& s : boundary) {
        const std::uint32_t first = s.number / 4 * 2;
        const bool is_second = sorted(given.faces[first + 1]) == sorted(s.corners);
        mesh.append(s.corners, given.source[is_second ? first + 1 : first]);
    }
    return all.size();
}

}  // namespace treeform::detail::repair
