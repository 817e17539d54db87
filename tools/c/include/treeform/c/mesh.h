#pragma once
/// \file
/// Meshes and point clouds from your arrays; joining, selecting faces, rounding.

#include <treeform/c/base.h>

/// A triangle mesh, or a point cloud, with the indexes of queries. The first query that needs an
/// index builds it, later queries reuse it. Queries take a const handle, and may run on several
/// threads at once.
typedef struct treeform_mesh treeform_mesh;

/// How a mesh takes its arrays: flags, combined by addition.
enum {
    TREEFORM_COPY = 1,    ///< copy the arrays; else they are borrowed
    TREEFORM_ONE_USE = 2  ///< keep no index: for a mesh that is used once
};

// made of the headers of C++:
//   mesh_create() mesh_create_float() mesh_of() mesh_of_box() rotation() mesh_arrays()
//   mesh_is_cloud() mesh_indexes_built()
/// A mesh of `points` [point_count][3] and `faces` [face_count][3]; without faces, a point cloud,
/// which can be measured, moved, welded and aligned like a mesh. Queries take each point of a
/// cloud as a degenerate face, so face numbers are point numbers. A cloud bounds no solid.
///
/// Without `TREEFORM_COPY` both arrays are borrowed, not copied: they must stay unchanged as long
/// as the mesh exists. Coordinates may be NaN or infinite; functions that need finite coordinates
/// report an error that names the element. Empty arrays may be null.
///
/// Returns `TREEFORM_INVALID`, naming the face, if a corner is not less than `point_count`. O(F).
TREEFORM_C_API treeform_code treeform_mesh_create(const double* points, size_t point_count,
                                                  const uint32_t* faces, size_t face_count,
                                                  uint32_t flags, treeform_mesh** mesh);

/// The same for 32-bit floats, which are converted to doubles exactly. Points are copied; faces
/// are borrowed unless `flags` contain `TREEFORM_COPY`.
TREEFORM_C_API treeform_code treeform_mesh_create_float(const float* points, size_t point_count,
                                                        const uint32_t* faces, size_t face_count,
                                                        uint32_t flags, treeform_mesh** mesh);

/// A mesh of arrays that a result owns, such as `&result->mesh`; `flags` as in
/// `treeform_mesh_create`.
TREEFORM_C_API treeform_code treeform_mesh_of(const treeform_arrays* arrays, uint32_t flags,
                                              treeform_mesh** mesh);

/// The box as a solid of 8 points and 12 faces.
TREEFORM_C_API treeform_code treeform_mesh_of_box(const treeform_box* box, treeform_mesh** mesh);

/// Sets `matrix` [12] to the rotation about an axis through the origin, counterclockwise if the
/// axis points to the viewer. Quarter turns about a coordinate axis are exact.
TREEFORM_C_API treeform_code treeform_rotation(const double* axis, double degrees, double* matrix);

/// The arrays of a mesh, valid as long as the mesh exists.
TREEFORM_C_API treeform_code treeform_mesh_arrays(const treeform_mesh* mesh,
                                                  treeform_arrays* result);

/// Whether the mesh is a point cloud: it has points and no faces.
TREEFORM_C_API treeform_code treeform_mesh_is_cloud(const treeform_mesh* mesh, int32_t* result);

/// Number of indexes built so far.
TREEFORM_C_API treeform_code treeform_mesh_indexes_built(const treeform_mesh* mesh,
                                                         uint64_t* result);
// end

/// A mesh made from others.
typedef struct treeform_made_mesh {
    void* owner;
    treeform_arrays mesh;
    const uint32_t* index;  ///< [index_count] its meaning depends on the function; or null
    size_t index_count;
} treeform_made_mesh;

// made of the headers of C++:
//   join_equal_points() join_meshes() select_faces() rounded() coordinate_step()
//   rounding_effects find_rounding_effects()
/// The mesh with points of equal coordinates joined (-0 equals +0), in the order in which they
/// first appear; faces keep their order. `index` [V] is the new number of each point. O(V + F).
TREEFORM_C_API treeform_code treeform_join_equal_points(const treeform_mesh* mesh,
                                                        treeform_made_mesh** made);

/// The faces of all meshes, one mesh after the other, with equal points joined. `index` [F] is the
/// number of each face's mesh. Points that are not finite become 0, and must not be used by a
/// face.
TREEFORM_C_API treeform_code treeform_join_meshes(const treeform_mesh* const* meshes, size_t count,
                                                  treeform_made_mesh** made);

/// A mesh of the faces with these numbers, in this order, and of the points that they use.
TREEFORM_C_API treeform_code treeform_select_faces(const treeform_mesh* mesh, const uint32_t* faces,
                                                   size_t count, treeform_made_mesh** made);

/// The mesh with each coordinate rounded to the nearest number of the precision; infinite beyond
/// its range. `treeform_find_rounding_effects` finds the defects that this causes.
TREEFORM_C_API treeform_code treeform_rounded(const treeform_mesh* mesh,
                                              treeform_precision precision,
                                              treeform_made_mesh** made);

/// The unit in the last place, in precision `of`, of the finite coordinate of largest magnitude.
/// The least positive number of that precision if no coordinate is finite, or all are 0.
TREEFORM_C_API treeform_code treeform_coordinate_step(const treeform_mesh* mesh,
                                                      treeform_precision of, double* result);

/// How far rounding moved points, and the defects that it caused.
typedef struct treeform_rounding_effects {
    void* owner;
    double max_displacement;  ///< largest change of a coordinate, after the transform
    double step;              ///< spacing of numbers at the largest written coordinate
    /// True if doubles became float32 and points moved, or if points moved by more than a
    /// millionth of the diagonal of the bounding box.
    int32_t noticeable;
    /// Whether `collapsed` and `meeting` were computed: only if points moved, coordinates became
    /// coarser, and there are faces.
    int32_t compared;
    uint64_t collapsed;  ///< faces that became degenerate
    uint64_t meeting;    ///< new pairs of faces that meet
} treeform_rounding_effects;

/// Compares `placed` [V][3], of precision `after`, with the points of the mesh, of precision
/// `before`, moved by `matrix` [12] (null: not moved). If coordinates became coarser, or with
/// `always_compare`, also finds the faces that became degenerate, and the pairs of faces that
/// newly meet; exact (`treeform_self_intersections`).
TREEFORM_C_API treeform_code treeform_find_rounding_effects(
    const treeform_mesh* mesh, const double* matrix, const double* placed,
    treeform_precision before, treeform_precision after, int32_t always_compare,
    treeform_progress progress, void* progress_data, treeform_rounding_effects** effects);
// end
