#include "bench/subdivide.hpp"

#include "support/random.hpp"
#include <treeform/mesh/self_intersections.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace treeform::bench {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFF;

point3 plus(const point3& a, const point3& b, double factor) {
    return {a.x + factor * b.x, a.y + factor * b.y, a.z + factor * b.z};
}

double length(const point3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

point3 unit_normal(const mesh& mesh, const face& f) {
    const point3& a = mesh.points[f[0]];
    const point3 u = plus(mesh.points[f[1]], a, -1);
    const point3 v = plus(mesh.points[f[2]], a, -1);
    const point3 n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    const double size = length(n);
    return size > 0 ? point3{n.x / size, n.y / size, n.z / size} : point3{};
}

/// An edge with the sum of the normals of its triangles.
struct edge {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::uint32_t triangles = 0;
    point3 normal{};
};

struct edge_list {
    std::vector<edge> edges;                            ///< [E] ascending by their ends
    std::vector<std::array<std::uint32_t, 3>> of_face;  ///< [F] edge from corner i to i + 1
};

edge_list edges_of(const mesh& mesh) {
    struct side {
        std::uint32_t low, high, face, corner;
    };
    std::vector<side> sides;
    sides.reserve(3 * mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (std::uint32_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(mesh.faces[f][i], mesh.faces[f][(i + 1) % 3]);
            sides.push_back({low, high, f, i});
        }
    std::sort(sides.begin(), sides.end(), [](const side& a, const side& b) {
        return std::array{a.low, a.high, a.face, a.corner} <
               std::array{b.low, b.high, b.face, b.corner};
    });
    edge_list list;
    list.of_face.resize(mesh.faces.size());
    for (const side& s : sides) {
        if (list.edges.empty() || list.edges.back().low != s.low ||
            list.edges.back().high != s.high)
            list.edges.push_back({.low = s.low, .high = s.high});
        edge& e = list.edges.back();
        ++e.triangles;
        e.normal = plus(e.normal, unit_normal(mesh, mesh.faces[s.face]), 1);
        list.of_face[s.face][s.corner] = static_cast<std::uint32_t>(list.edges.size() - 1);
    }
    return list;
}

/// All edges when four times the triangles are wanted, else the longest ones that suffice.
std::vector<std::uint32_t> edges_to_cut(const mesh& mesh, const std::vector<edge>& edges,
                                        std::size_t triangles) {
    std::vector<std::uint32_t> order(edges.size());
    std::iota(order.begin(), order.end(), 0U);
    if (4 * mesh.faces.size() <= triangles) return order;
    std::vector<double> lengths;
    lengths.reserve(edges.size());
    for (const edge& e : edges)
        lengths.push_back(length(plus(mesh.points[e.high], mesh.points[e.low], -1)));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return lengths[a] > lengths[b]; });
    std::size_t have = mesh.faces.size();
    std::size_t count = 0;
    while (count < order.size() && have < triangles) have += edges[order[count++]].triangles;
    order.resize(count);
    std::sort(order.begin(), order.end());
    return order;
}

/// The triangle `f` cut at the points `cut` (none: not) on its edges.
void add_parts(face f, std::array<std::uint32_t, 3> cut, std::vector<face>& parts) {
    const auto cuts = 3 - std::count(cut.begin(), cut.end(), none);
    // Turned so that the first edge is cut, and the last one is not if any is not.
    while (cuts > 0 && cuts < 3 && (cut[0] == none || cut[2] != none)) {
        std::rotate(f.begin(), f.begin() + 1, f.end());
        std::rotate(cut.begin(), cut.begin() + 1, cut.end());
    }
    switch (cuts) {
        case 0:
            parts.push_back(f);
            break;
        case 1:
            parts.push_back({f[0], cut[0], f[2]});
            parts.push_back({cut[0], f[1], f[2]});
            break;
        case 2:
            parts.push_back({f[0], cut[0], cut[1]});
            parts.push_back({cut[0], f[1], cut[1]});
            parts.push_back({f[0], cut[1], f[2]});
            break;
        default:
            parts.push_back({f[0], cut[0], cut[2]});
            parts.push_back({cut[0], f[1], cut[1]});
            parts.push_back({cut[2], cut[1], f[2]});
            parts.push_back({cut[0], cut[1], cut[2]});
    }
}

/// Puts the new points of faces that meet back to `middles`; false when no faces met.
bool move_in_file(mesh& mesh, std::size_t old_points, const std::vector<point3>& middles,
                  bool all) {
    const face_pair_result found =
        self_intersections(mesh, {.vertices = vertex_identity::by_index});
    for (const face_pair& pair : found.pairs)
        for (const std::uint32_t f : {pair.a, pair.b})
            for (const std::uint32_t v : mesh.faces[f])
                if (v >= old_points) mesh.points[v] = middles[v - old_points];
    if (all && !found.pairs.empty())
        std::copy(middles.begin(), middles.end(),
                  mesh.points.begin() + static_cast<std::ptrdiff_t>(old_points));
    return !found.pairs.empty();
}

mesh refined_once(const mesh& base, std::size_t triangles, test::random& random) {
    const edge_list list = edges_of(base);
    mesh result;
    result.points = base.points;
    std::vector<std::uint32_t> point_of_edge(list.edges.size(), none);
    std::vector<point3> middles;
    for (const std::uint32_t e : edges_to_cut(base, list.edges, triangles)) {
        const edge& edge = list.edges[e];
        const point3& a = base.points[edge.low];
        const point3& b = base.points[edge.high];
        middles.push_back({a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2, a.z + (b.z - a.z) / 2});
        const double normal = length(edge.normal);
        const double move = 1e-4 * length(plus(b, a, -1)) * random.in(-1, 1);
        point_of_edge[e] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(
            plus(middles.back(), edge.normal, normal > 0 ? move / normal : 0.0));
    }
    result.faces.reserve(triangles + 2);
    for (std::size_t f = 0; f < base.faces.size(); ++f) {
        const auto& edges = list.of_face[f];
        add_parts(base.faces[f],
                  {point_of_edge[edges[0]], point_of_edge[edges[1]], point_of_edge[edges[2]]},
                  result.faces);
    }
    constexpr int rounds = 6;  // moving a point back can make its neighbors meet
    for (int round = 0; move_in_file(result, base.points.size(), middles, round + 2 >= rounds);)
        if (++round == rounds) throw std::runtime_error("a refined model intersects itself");
    return result;
}

}  // namespace

mesh refined(const mesh& base, std::size_t triangles, std::uint64_t seed) {
    test::random random(seed);
    mesh result = base;
    while (result.faces.size() < triangles) result = refined_once(result, triangles, random);
    return result;
}

mesh turned(mesh m, double angle) {
    const box3 box = bounding_box(m.points).value();
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (box.max[k] - box.min[k] < box.max[axis] - box.min[axis]) axis = k;
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double cu = 0.5 * (box.min[u] + box.max[u]), cv = 0.5 * (box.min[v] + box.max[v]);
    for (point3& p : m.points) {
        const double x = p[u] - cu, y = p[v] - cv;
        p[u] = cu + (std::cos(angle) * x - std::sin(angle) * y);
        p[v] = cv + (std::sin(angle) * x + std::cos(angle) * y);
    }
    return m;
}

}  // namespace treeform::bench
