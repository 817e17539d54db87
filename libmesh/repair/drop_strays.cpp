#include <libmesh/base/point_math.hpp>
#include <libmesh/repair/drop_strays.hpp>
#include <libmesh/repair/edge_parts.hpp>
#include <libmesh/weld/edge_uses.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace treeform::detail::repair {
namespace {

constexpr double flat = 8.0;
constexpr double share_of_singles = 0.05;  // of the area, all together
constexpr std::size_t single = 2;          // faces: a triangle or a square
constexpr double share_of_single = 0.01;   // of the area

/// Faces linked by edges that two of them have to themselves.
struct patch {
    double area = 0.0;
    std::size_t faces = 0;
    double free_length = 0.0;                  ///< of edges that no other face has
    double rim_length = 0.0;                   ///< of these and of edges of more than two faces
    std::vector<std::uint32_t> nonmanifold{};  ///< edges of more than two faces, once for each face
};

double length(const point3& v) { return std::hypot(v.x, v.y, v.z); }

struct patch_map {
    std::vector<std::uint32_t> patch_of{};  ///< [F]
    std::vector<patch> patches{};
    std::vector<std::uint32_t> count{};  ///< faces at each nonmanifold edge
    double area = 0.0;
    bool has_strays = false;  ///< single faces, so few that they are no mesh that is torn
};

patch_map find_patches(const working_mesh& mesh) {
    patch_map map;
    map.patch_of = patches(mesh);
    std::vector<std::uint32_t> number(mesh.faces.size(), 0);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        if (map.patch_of[f] == f) {
            number[f] = static_cast<std::uint32_t>(map.patches.size());
            map.patches.emplace_back();
        }
        map.patch_of[f] = number[map.patch_of[f]];
        const auto [a, b, c] = base::triangle_of(mesh.points, mesh.faces[f]);
        patch& part = map.patches[map.patch_of[f]];
        const double area = length(base::cross(base::minus(b, a), base::minus(c, a))) / 2.0;
        part.area += area;
        ++part.faces;
        map.area += area;
    }
    const weld::edge_uses edges(mesh.points.size(), mesh.faces, weld::repeated_corners::left_out);
    struct nonmanifold_edge {
        double length;
        std::vector<std::uint32_t> faces;
    };
    std::vector<std::vector<nonmanifold_edge>> nonmanifold(edges.chunks());
    std::vector<std::vector<std::array<std::uint32_t, 3>>> borders(edges.chunks());
    edges.for_each([&](const weld::used_edge& edge, std::size_t chunk) {
        if (edge.uses.size() == 1) borders[chunk].push_back({edge.low, edge.high, edge.face(0)});
        if (edge.uses.size() <= 2) return;
        nonmanifold_edge& found = nonmanifold[chunk].emplace_back();
        found.length = length(base::minus(mesh.points[edge.high], mesh.points[edge.low]));
        for (std::size_t i = 0; i < edge.uses.size(); ++i) found.faces.push_back(edge.face(i));
    });
    for (const auto& part : borders)
        for (const auto& [low, high, f] : part) {
            patch& owner = map.patches[map.patch_of[f]];
            const double there = length(base::minus(mesh.points[high], mesh.points[low]));
            owner.free_length += there;
            owner.rim_length += there;
        }
    for (const auto& part : nonmanifold)
        for (const auto& [there, faces] : part) {
            const auto edge = static_cast<std::uint32_t>(map.count.size());
            map.count.push_back(static_cast<std::uint32_t>(faces.size()));
            for (const std::uint32_t f : faces) {
                patch& owner = map.patches[map.patch_of[f]];
                owner.nonmanifold.push_back(edge);
                owner.rim_length += there;
            }
        }
    return map;
}

/// Whether the edges where it hangs on others have an odd number of faces, and an even one without
/// it.
bool is_surplus(const patch& part, const std::vector<std::uint32_t>& count) {
    const std::vector<std::uint32_t>& edges = part.nonmanifold;  // ascending
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end] == edges[begin]) ++end;
        const std::size_t all = count[edges[begin]], left = all - (end - begin);
        if (all % 2 == 0 || left % 2 != 0 || left == 0) return false;
    }
    return !edges.empty();
}

/// Whether the edges where it hangs on others have two faces without it.
bool is_flap(const patch& part, const std::vector<std::uint32_t>& count) {
    const std::vector<std::uint32_t>& edges = part.nonmanifold;  // ascending
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end] == edges[begin]) ++end;
        if (count[edges[begin]] - (end - begin) < 2) return false;
    }
    return true;
}

bool is_single(const patch& part, const patch_map& map) {
    return part.faces <= single && part.nonmanifold.empty() && part.free_length > 0.0 &&
           part.area < share_of_single * map.area;
}

bool is_stray(const patch& part, const patch_map& map, double share, bool is_sheet, walls inner) {
    if (inner == walls::keep && !part.nonmanifold.empty()) return false;
    if (part.free_length == 0.0) return is_surplus(part, map.count);
    if (is_sheet) return false;
    const bool is_flat = part.rim_length * part.rim_length > flat * part.area;
    const bool is_small = part.area < share * map.area;
    if (part.nonmanifold.empty())
        return is_flat && (is_small || (map.has_strays && is_single(part, map)));
    return (is_flat || is_small) && is_flap(part, map.count);
}

}  // namespace

dropped_strays drop_strays(working_mesh& mesh, double share, bool is_sheet, walls inner) {
    patch_map map = find_patches(mesh);
    double singles = 0.0;
    for (const patch& part : map.patches) singles += is_single(part, map) ? part.area : 0.0;
    map.has_strays = singles < share_of_singles * map.area;
    std::vector<std::uint32_t> order(map.patches.size());
    for (std::uint32_t p = 0; p < order.size(); ++p) order[p] = p;
    std::ranges::stable_sort(order, {}, [&](std::uint32_t p) { return map.patches[p].area; });
    std::vector<std::uint8_t> dropped(map.patches.size(), 0);
    for (const std::uint32_t p : order) {
        if (!is_stray(map.patches[p], map, share, is_sheet, inner)) continue;
        dropped[p] = 1;
        for (const std::uint32_t edge : map.patches[p].nonmanifold) --map.count[edge];
    }
    dropped_strays done;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const std::uint32_t p = map.patch_of[f];
        if (dropped[p] != 0 && map.patches[p].free_length == 0.0)
            done.walls.push_back(mesh.source[f]);
    }
    done.faces = mesh.drop([&](std::uint32_t f) { return dropped[map.patch_of[f]] != 0; });
    return done;
}

}  // namespace treeform::detail::repair
