#include <libmesh/base/point_math.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/round/flat_patches.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace treeform::detail::round {
namespace {

using base::cross;
using base::dot;
using base::minus;

/// Whether two faces at edge `e` lie in one plane except for what is near, facing the same way.
bool flat(const patch_inputs& in, std::uint32_t f, std::uint32_t g, const edge_name& e) {
    if (in.source[in.face_of[f]] == in.source[in.face_of[g]]) return true;
    const auto at = [&](std::uint32_t p) -> const point3& { return in.surface.points[p]; };
    const auto apex = [&](std::uint32_t face_number) {
        for (const std::uint32_t c : in.surface.faces[face_number])
            if (c != e[0] && c != e[1]) return c;
        return e[0];
    };
    const point3 along = minus(at(e[1]), at(e[0]));
    point3 large = minus(at(apex(f)), at(e[0])), small = minus(at(apex(g)), at(e[0]));
    if (length(cross(along, large)) < length(cross(along, small))) std::swap(large, small);
    // The apex of the smaller one as seen from the larger one: how high, and on which side.
    const point3 normal = cross(along, large);
    const double size = length(normal);
    if (!(size > 0.0)) return false;
    const double height = std::abs(dot(normal, small)) / size;
    const double across = dot(normal, cross(along, small)) / size;
    return height <= in.near && across <= in.near * length(along);
}

}  // namespace

flat_patches find_flat_patches(const patch_inputs& in) {
    const auto face_count = static_cast<std::uint32_t>(in.surface.faces.size());
    const auto operand_of = [&](std::uint32_t f) {
        return in.operand.empty() ? 0U : in.operand[in.face_of[f]];
    };
    std::vector<std::pair<std::pair<edge_name, std::uint32_t>, std::uint32_t>> edges;
    for (std::uint32_t f = 0; f < face_count; ++f)
        for (const edge_name& e : edges_of(in.surface.faces[f]))
            edges.push_back({{e, operand_of(f)}, f});
    std::sort(edges.begin(), edges.end());
    base::union_find sets(face_count);
    flat_patches found;
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end].first == edges[begin].first) ++end;
        const std::uint32_t f = edges[begin].second, g = edges[end - 1].second;
        const edge_name& name = edges[begin].first.first;
        if (end - begin == 2 && in.offending[f] != 0 && in.offending[g] != 0 &&
            flat(in, f, g, name))
            sets.join(f, g);
        else
            found.borders.push_back(name);
    }
    for (std::uint32_t f = 0; f < face_count; ++f)
        if (in.offending[f] != 0) found.by_patch.push_back({sets.root(f), f});
    std::sort(found.by_patch.begin(), found.by_patch.end());
    return found;
}

}  // namespace treeform::detail::round
