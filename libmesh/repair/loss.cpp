#include <libmesh/base/point_math.hpp>
#include <libmesh/repair/border_edges.hpp>
#include <libmesh/repair/edge_parts.hpp>
#include <libmesh/repair/loss.hpp>
#include <libmesh/topology/area.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/weld.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace treeform::detail::repair {
namespace {

/// Those, by vertices, that have no border; nothing where they are not closed for all that.
mesh closed_part(mesh_view of) {
    const std::vector<std::uint32_t> component = face_components(of.points.size(), of.faces);
    std::vector<std::uint8_t> is_open(of.faces.size(), 0);  // by component
    for (const border_edge& e : border_edges(of.points.size(), of.faces))
        is_open[component[e.face]] = 1;
    mesh closed{{of.points.begin(), of.points.end()}, {}};
    for (std::size_t f = 0; f < of.faces.size(); ++f)
        if (is_open[component[f]] == 0) closed.faces.push_back(of.faces[f]);
    return find_open_edge(closed) ? mesh{} : closed;
}

/// [gone] The areas of these faces of `given`; 0 of those that are on `made` or inside its closed
/// components.
std::vector<double> lost_areas(mesh_view given, std::span<const std::uint32_t> gone,
                               mesh_view made) {
    std::vector<double> areas(gone.size(), 0.0);
    if (gone.empty()) return areas;
    std::vector<point3> middles;
    for (const std::uint32_t f : gone) {
        const auto [a, b, c] = base::triangle_of(given.points, given.faces[f]);
        middles.push_back({a.x / 3.0 + b.x / 3.0 + c.x / 3.0, a.y / 3.0 + b.y / 3.0 + c.y / 3.0,
                           a.z / 3.0 + b.z / 3.0 + c.z / 3.0});
    }
    std::vector<std::uint8_t> is_there(gone.size(), 0);
    if (!made.faces.empty()) {
        const auto nearest =
            closest_point(made, middles, 1e-6 * bounding_box(made.points)->diagonal());
        for (std::size_t i = 0; i < gone.size(); ++i) is_there[i] = nearest[i] ? 1 : 0;
    }
    if (const mesh solid = closed_part(made); !solid.faces.empty()) {
        const auto places = locate(solid, middles);
        for (std::size_t i = 0; i < gone.size(); ++i)
            if (places[i].where != location::outside) is_there[i] = 1;
    }
    for (std::size_t i = 0; i < gone.size(); ++i)
        if (is_there[i] == 0) areas[i] = topology::area({given.points, {&given.faces[gone[i]], 1}});
    return areas;
}

}  // namespace

double area_of_distinct(mesh_view mesh) {
    treeform::mesh joined{{mesh.points.begin(), mesh.points.end()},
                          {mesh.faces.begin(), mesh.faces.end()}};
    joined = join_equal_points(std::move(joined));
    for (face& f : joined.faces) std::ranges::sort(f);
    std::ranges::sort(joined.faces);
    joined.faces.erase(std::unique(joined.faces.begin(), joined.faces.end()), joined.faces.end());
    return topology::area(joined);
}

loss find_loss(mesh_view given, std::span<const std::uint8_t> is_kept, mesh_view made,
               const progress_callback& progress) {
    // Beyond this the arrangement takes no coordinates, and volumes are no numbers.
    const bool is_huge = std::ranges::any_of(given.points, [](const point3& p) {
        return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 0x1p300;
    });
    if (is_huge) return {};
    const repair_result meant = treeform::repair(
        given, {.fill = false, .detach = false, .max_loss = 1.0, .progress = progress});
    if (meant.certificate && meant.statistics.tetrahedra == 0)
        return {meant.statistics.volume_after, std::abs(signed_volume(made)), true};
    const double before = area_of_distinct(given);
    const double fall = std::min(before - topology::area(made), lost_area(given, is_kept, made));
    return {before, before - std::max(fall, 0.0), false};
}

double lost_area(mesh_view given, std::span<const std::uint8_t> is_kept, mesh_view made) {
    std::vector<std::uint32_t> gone;
    for (std::uint32_t f = 0; f < given.faces.size(); ++f)
        if (is_kept[f] == 0) gone.push_back(f);
    double sum = 0.0;
    for (const double area : lost_areas(given, gone, made)) sum += area;
    return sum;
}

vanished_parts count_vanished(const working_mesh& mesh, std::span<const std::uint8_t> is_kept,
                              mesh_view made, double largest) {
    const std::vector<std::uint32_t> part = parts_by_edges(mesh);
    std::vector<std::uint8_t> has_face(part.size(), 0);
    for (std::uint32_t f = 0; f < part.size(); ++f)
        if (mesh.source[f] != repair_result::none && is_kept[mesh.source[f]] != 0)
            has_face[part[f]] = 1;
    std::vector<std::uint32_t> gone;
    for (std::uint32_t f = 0; f < part.size(); ++f)
        if (has_face[part[f]] == 0) gone.push_back(f);
    const std::vector<double> lost = lost_areas(mesh.view(), gone, made);
    std::vector<double> lost_of(part.size(), 0.0);
    for (std::size_t i = 0; i < gone.size(); ++i) lost_of[part[gone[i]]] += lost[i];
    std::vector<std::uint8_t> is_whole(part.size(), 1);
    for (const border_edge& e : border_edges(mesh.points.size(), mesh.faces))
        is_whole[part[e.face]] = 0;
    vanished_parts found;
    std::vector<std::uint8_t> is_visited(part.size(), 0);
    for (const std::uint32_t f : gone) {
        const std::uint32_t p = part[f];
        if (is_visited[p] != 0) continue;
        is_visited[p] = 1;
        if (lost_of[p] > largest) ++found.lost;
        if (lost_of[p] == 0.0 && is_whole[p] != 0) ++found.within;
    }
    return found;
}

bool has_inward_component(mesh_view mesh) {
    const std::vector<std::uint32_t> component = face_components(mesh.points.size(), mesh.faces);
    std::uint32_t count = 0;
    for (const std::uint32_t c : component) count = std::max(count, c + 1);
    if (count < 2) return signed_volume(mesh) < 0.0;
    std::vector<std::vector<face>> faces(count);
    for (std::size_t f = 0; f < component.size(); ++f) faces[component[f]].push_back(mesh.faces[f]);
    return std::ranges::any_of(faces, [&](const auto& part) {
        return signed_volume({mesh.points, part}) < 0.0;
    });
}

}  // namespace treeform::detail::repair
