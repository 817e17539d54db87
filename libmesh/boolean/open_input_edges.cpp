#include <libmesh/base/stars.hpp>
#include <libmesh/boolean/open_input_edges.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace treeform::detail::boolean {
namespace {

struct open_edge_of_input {
    std::uint32_t operand = 0;
    std::array<std::uint32_t, 2> ends{};
    bool misoriented = false;
};

/// The faces of an operand at an edge, seen from its lower end.
struct open_edge_use {
    std::uint32_t operand = 0;
    std::uint32_t end = 0;
    int way = 0;

    [[nodiscard]] bool same_edge(const open_edge_use& other) const {
        return operand == other.operand && end == other.end;
    }
    friend auto operator<=>(const open_edge_use&, const open_edge_use&) = default;
};

/// The edges from `a` to higher points.
void collect_uses(mesh_view joined, std::span<const std::uint32_t> operand_of_face, std::uint32_t a,
                  std::span<const std::uint32_t> star, std::vector<open_edge_use>& uses) {
    uses.clear();
    for (const std::uint32_t id : star) {
        const face& f = joined.faces[id];
        const std::size_t i = f[0] == a ? 0 : f[1] == a ? 1 : 2;
        const std::uint32_t next = f[(i + 1) % 3];
        const std::uint32_t last = f[(i + 2) % 3];
        if (next > a) uses.push_back({operand_of_face[id], next, 1});
        if (last > a) uses.push_back({operand_of_face[id], last, -1});
    }
    std::sort(uses.begin(), uses.end());
}

std::vector<open_edge_of_input> find_edges(mesh_view joined,
                                           std::span<const std::uint32_t> operand_of_face,
                                           std::uint32_t sheet) {
    const base::stars stars(joined.points.size(), joined.faces);
    std::vector<open_edge_of_input> found;
    std::vector<open_edge_use> uses;
    for (std::size_t v = 0; v < stars.size(); ++v) {
        const auto a = static_cast<std::uint32_t>(v);
        collect_uses(joined, operand_of_face, a, stars[v], uses);
        for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
            std::ptrdiff_t net = 0;
            for (; end < uses.size() && uses[end].same_edge(uses[begin]); ++end)
                net += uses[end].way;
            if (net != 0 && uses[begin].operand != sheet)
                found.push_back({uses[begin].operand, {a, uses[begin].end}, net % 2 == 0});
        }
    }
    return found;
}

aabb<double, 3> box_of(points_view points, std::span<const std::uint32_t> corners) {
    aabb<double, 3> box;
    for (const std::uint32_t c : corners) box.include(points[c]);
    return box;
}

/// Whether `p`, which is no end of the edge, lies on it.
bool lies_within(points_view points, std::uint32_t p, const open_edge_of_input& e) {
    const auto [a, b] = e.ends;
    if (p == a || p == b) return false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = points[p][axis];
        const auto [low, high] = std::minmax({points[a][axis], points[b][axis]});
        if (x < low || x > high) return false;
    }
    return collinear(points[a], points[b], points[p]);
}

}  // namespace

std::optional<open_input_edges> count_open_input_edges(
    mesh_view joined, std::span<const std::uint32_t> operand_of_face, std::uint32_t sheet) {
    const std::vector<open_edge_of_input> edges = find_edges(joined, operand_of_face, sheet);
    const tree<3> tree =
        build(edges, [&](const open_edge_of_input& e) { return box_of(joined.points, e.ends); });
    open_input_edges count;
    for (const open_edge_of_input& e : edges) {
        ++(e.misoriented ? count.misoriented : count.boundary);
        for (const std::uint32_t p : e.ends)
            if (search_any(tree, box_of(joined.points, {&p, 1}), [&](std::uint32_t id) {
                    return edges[id].operand == e.operand &&
                           lies_within(joined.points, p, edges[id]);
                }))
                return std::nullopt;
    }
    return count;
}

}  // namespace treeform::detail::boolean
