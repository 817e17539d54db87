#pragma once
/// \file
/// Meshes from a caller's arrays; joining, selecting and rounding, in C.

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/weld.hpp>

#include <tools/c/made/structs.hpp>

namespace glue {

/// The handle for points and faces, which are in `own` unless that is empty. Checks the numbers of
/// corners, so that functions may rely on them.
inline answer_of<treeform_mesh> mesh_of(tf::mesh own, tf::points_view points,
                                        std::span<const tf::face> faces, std::uint32_t flags) {
    if ((flags & ~std::uint32_t{TREEFORM_COPY | TREEFORM_ONE_USE}) != 0)
        throw std::invalid_argument("flags " + std::to_string(flags) + " are unknown");
    if (!own.points.empty()) points = own.points;
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (const std::uint32_t corner : faces[f])
            if (corner >= points.size())
                throw std::invalid_argument("face " + std::to_string(f) + " has the corner " +
                                            std::to_string(corner) + " of " +
                                            std::to_string(points.size()) + " points");
    auto made = make<treeform_mesh>();
    treeform_mesh& m = made->value;
    m.arrays = std::move(own);
    if ((flags & TREEFORM_COPY) != 0) {
        if (m.arrays.points.empty()) m.arrays.points.assign(points.begin(), points.end());
        m.arrays.faces.assign(faces.begin(), faces.end());
        faces = m.arrays.faces;
    }
    if (!m.arrays.points.empty()) points = m.arrays.points;
    m.mine = tf::prepared_mesh::borrow({points, faces});
    m.prepared = &m.mine;
    m.one_use = (flags & TREEFORM_ONE_USE) != 0;
    return made;
}

/// Checks that 32 bits can number the elements.
inline void check_counts(std::size_t points, std::size_t faces) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
    if (points >= most || faces >= most)
        throw std::length_error(std::to_string(points) + " points and " + std::to_string(faces) +
                                " faces are more than 32-bit numbers can name");
}

inline std::vector<tf::point3> widened(const float* points, std::size_t count) {
    std::vector<tf::point3> result;
    for (const auto& p : rows_of<std::array<float, 3>>(points, count, "points"))
        result.push_back({double{p[0]}, double{p[1]}, double{p[2]}});
    return result;
}

/// A mesh of `points` [point_count][3] and `faces` [face_count][3]; without faces, a point cloud,
/// which can be measured, moved, welded and aligned like a mesh. Queries take each point of a cloud
/// as a degenerate face, so face numbers are point numbers. A cloud bounds no solid.
///
/// Without `TREEFORM_COPY` both arrays are borrowed, not copied: they must stay unchanged as long
/// as the mesh exists. Coordinates may be NaN or infinite; functions that need finite coordinates
/// report an error that names the element. Empty arrays may be null.
///
/// Returns `TREEFORM_INVALID`, naming the face, if a corner is not less than `point_count`. O(F).
inline answer_of<treeform_mesh> mesh_create(const double* points, std::size_t point_count,
                                            const std::uint32_t* faces, std::size_t face_count,
                                            std::uint32_t flags) {
    check_counts(point_count, face_count);
    return mesh_of({}, glue::points(points, point_count, "points"),
                   glue::faces(faces, face_count, "faces"), flags);
}

/// The same for 32-bit floats, which are converted to doubles exactly. Points are copied; faces are
/// borrowed unless `flags` contain `TREEFORM_COPY`.
inline answer_of<treeform_mesh> mesh_create_float(const float* points, std::size_t point_count,
                                                  const std::uint32_t* faces,
                                                  std::size_t face_count, std::uint32_t flags) {
    check_counts(point_count, face_count);
    return mesh_of({widened(points, point_count), {}}, {}, glue::faces(faces, face_count, "faces"),
                   flags);
}

/// A mesh of arrays that a result owns, such as `&result->mesh`; `flags` as in
/// `treeform_mesh_create`.
inline answer_of<treeform_mesh> mesh_of(const treeform_arrays* arrays, std::uint32_t flags) {
    const treeform_arrays& of = need(arrays, "arrays");
    return mesh_create(of.points, of.point_count, of.faces, of.face_count, flags);
}

/// The box as a solid of 8 points and 12 faces.
inline answer_of<treeform_mesh> mesh_of_box(const treeform_box* box) {
    tf::mesh own = glue::box(need(box, "box")).mesh();
    const std::span<const tf::face> faces = own.faces;
    return mesh_of(std::move(own), {}, faces, 0);
}

/// Sets `matrix` [12] to the rotation about an axis through the origin, counterclockwise if the
/// axis points to the viewer. Quarter turns about a coordinate axis are exact.
inline void rotation(const double* axis, double degrees, double* matrix) {
    const tf::point3 a = point(axis, "axis");
    copy(tf::transform<3>::rotation({a.x, a.y, a.z}, degrees).rows, &need(matrix, "matrix"));
}

/// The arrays of a mesh, valid as long as the mesh exists.
inline treeform_arrays mesh_arrays(const treeform_mesh* mesh) { return arrays(view(mesh)); }

/// Whether the mesh is a point cloud: it has points and no faces.
inline bool mesh_is_cloud(const treeform_mesh* mesh) {
    return need(mesh, "mesh").prepared->is_cloud();
}

/// Number of indexes built so far.
inline std::uint64_t mesh_indexes_built(const treeform_mesh* mesh) {
    return need(mesh, "mesh").prepared->indexes_built();
}

/// The mesh with points of equal coordinates joined (-0 equals +0), in the order in which they
/// first appear; faces keep their order. `index` [V] is the new number of each point. O(V + F).
inline made_mesh join_equal_points(tf::mesh_view mesh) {
    tf::point_groups groups = tf::find_equal_points(mesh.points);
    tf::mesh joined = groups.joined(mesh);
    return {std::move(joined), std::move(groups.group_of_point)};
}

/// The faces of all meshes, one mesh after the other, with equal points joined. `index` [F] is the
/// number of each face's mesh. Points that are not finite become 0, and must not be used by a face.
inline made_mesh join_meshes(const treeform_mesh* const* meshes, std::size_t count) {
    std::vector<tf::mesh_view> views;
    for (const treeform_mesh* one : array(meshes, count, "meshes"))
        views.push_back(finite_view(one));
    std::vector<std::uint32_t> mesh_of_face;
    for (std::uint32_t i = 0; i < views.size(); ++i)
        mesh_of_face.resize(mesh_of_face.size() + views[i].faces.size(), i);
    return {tf::join_meshes(views), std::move(mesh_of_face)};
}

/// A mesh of the faces with these numbers, in this order, and of the points that they use.
inline tf::mesh select_faces(const tf::mesh_ref& mesh, std::span<const std::uint32_t> faces) {
    return tf::submesh(mesh, faces).mesh;
}

/// The mesh with each coordinate rounded to the nearest number of the precision; infinite beyond
/// its range. `treeform_find_rounding_effects` finds the defects that this causes.
inline tf::mesh rounded(tf::mesh_view mesh, tf::precision precision) {
    return {tf::rounded(mesh.points, precision), {mesh.faces.begin(), mesh.faces.end()}};
}

/// Compares `placed` [V][3], of precision `after`, with the points of the mesh, of precision
/// `before`, moved by `matrix` [12] (null: not moved). If coordinates became coarser, or with
/// `always_compare`, also finds the faces that became degenerate, and the pairs of faces that newly
/// meet; exact (`treeform_self_intersections`).
inline tf::rounding_effects find_rounding_effects(const treeform_mesh* mesh,
                                                  const tf::transform<3>& matrix,
                                                  const double* placed, tf::precision before,
                                                  tf::precision after, bool always_compare,
                                                  const tf::progress_callback& progress) {
    const tf::mesh_view view = glue::view(mesh);
    const tf::points_view there = points(placed, view.points.size(), "placed");
    tf::rounding_effects found =
        tf::find_rounding_effects(ref(mesh, "mesh"), matrix, there, before, after, progress);
    if (found.status == tf::status::ok && always_compare && !found.compared) {
        const tf::rounding_effects defects = tf::find_rounding_defects(view, there, progress);
        check(defects.status);
        found.compared = true;
        found.collapsed = defects.collapsed;
        found.meeting = defects.meeting;
    }
    return found;
}

}  // namespace glue
