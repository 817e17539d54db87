#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/weld/carried_rows.hpp>
#include <libmesh/weld/conditions.hpp>
#include <libmesh/weld/edge_uses.hpp>
#include <libmesh/weld/kept_values.hpp>
#include <libmesh/weld/manifold_groups.hpp>
#include <libmesh/weld/moves.hpp>
#include <treeform/mesh/weld_mesh.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <utility>

namespace treeform {
namespace {

constexpr std::size_t grain = std::size_t{1} << 16;

[[nodiscard]] point_groups find_groups(mesh_view mesh, const attributes& properties,
                                       const mesh_weld_options& options) {
    detail::buffer<std::uint8_t> border;
    if (options.only_borders) border = detail::weld::border_points(mesh.points.size(), mesh.faces);
    const detail::weld::conditions conditions(mesh.points, properties, options, border.span());
    return weld_points(mesh.points, conditions.options());
}

/// What a chunk of faces comes to.
struct face_counts {
    std::size_t kept = 0;
    std::uint64_t collapsed = 0;
    std::uint64_t degenerate = 0;
};

/// Gives the faces their new corners and leaves out those that repeat one, if asked for.
void carry_faces(std::span<const face> faces, bool keep_collapsed, mesh_weld_result& result) {
    const std::vector<std::uint32_t>& group_of = result.groups.group_of_point;
    const auto welded = [&](const face& f) {
        return face{group_of[f[0]], group_of[f[1]], group_of[f[2]]};
    };
    std::vector<face_counts> counts(chunk_count(faces.size(), grain));
    for_chunks(faces.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        face_counts mine;
        for (std::size_t i = begin; i < end; ++i) {
            const bool three = detail::base::has_three_corners(welded(faces[i]));
            mine.kept += three || keep_collapsed ? 1 : 0;
            if (three) continue;
            ++(detail::base::has_three_corners(faces[i]) ? mine.collapsed : mine.degenerate);
        }
        counts[c] = mine;
    });
    std::size_t total = 0;
    for (face_counts& n : counts) {
        total += std::exchange(n.kept, total);
        result.collapsed += n.collapsed;
        result.degenerate += n.degenerate;
    }
    result.mesh.faces.resize(total);
    result.face_of_new.resize(total);
    for_chunks(faces.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        std::size_t at = counts[c].kept;
        for (std::size_t i = begin; i < end; ++i) {
            const face f = welded(faces[i]);
            if (!keep_collapsed && !detail::base::has_three_corners(f)) continue;
            result.mesh.faces[at] = f;
            result.face_of_new[at++] = static_cast<std::uint32_t>(i);
        }
    });
}

/// Places of the groups, and their properties.
void carry_points(points_view points, const attributes& properties,
                  const mesh_weld_options& options, mesh_weld_result& result) {
    std::vector<point3>& places = result.mesh.points;
    places.resize(result.point_of_group.size());
    for_chunks(places.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t g = begin; g < end; ++g) places[g] = points[result.point_of_group[g]];
    });
    result.attributes = detail::weld::carry_rows(properties, result);
    if (options.keep != weld_keep::mean) return;
    const detail::weld::group_members members(result.groups);
    detail::weld::take_means(points, members, places);
    const element* vertices = find_element(properties, "vertex");
    if (vertices == nullptr) return;
    detail::weld::take_means(*vertices, members,
                             obtain_element(result.attributes, "vertex", places.size()));
}

}  // namespace

mesh_weld_result weld_mesh(mesh_view mesh, const attributes& properties,
                           const mesh_weld_options& options) {
    detail::base::check_faces("weld_mesh", mesh.points.size(), mesh.faces);
    detail::weld::check_rows(properties, mesh.points.size(), mesh.faces.size());
    mesh_weld_result result;
    result.groups = find_groups(mesh, properties, options);
    if (result.groups.stopped) return result;
    if (options.keep_manifold && !mesh.faces.empty()) {
        detail::weld::manifold_groups split = detail::weld::split_to_manifold(mesh, result.groups);
        result.groups = std::move(split.groups);
        result.left_alone = split.split_up;
    }
    result.point_of_group =
        detail::weld::kept_points(mesh.points, properties, options, result.groups);
    carry_faces(mesh.faces, options.keep_collapsed, result);
    carry_points(mesh.points, properties, options, result);
    if (options.points.tolerance > 0.0)  // else nothing has moved
        result.largest_move = detail::weld::largest_move(mesh.points, result.groups.group_of_point,
                                                         result.mesh.points);
    if (mesh.faces.empty()) return result;
    if (result.largest_move > 0.0)
        result.flipped = detail::weld::count_flipped(mesh, result.mesh, result.face_of_new);
    result.nonmanifold_before =
        detail::weld::count_nonmanifold_edges(mesh.points.size(), mesh.faces);
    result.nonmanifold_after =
        detail::weld::count_nonmanifold_edges(result.mesh.points.size(), result.mesh.faces);
    return result;
}

}  // namespace treeform
