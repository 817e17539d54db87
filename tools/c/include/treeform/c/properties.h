#pragma once
/// \file
/// Properties of a mesh: volume, area, bounds, whether it bounds a solid, defects, components, flat
/// and cylindrical regions, convex hull; the signs of exact predicates.

#include <treeform/c/mesh.h>

// made of the headers of C++:
//   signed_volume() surface_area() mass_properties find_mass_properties() bounding_box()
//   is_solid() check_operand() topology_counts count_topology() face_components()
//   invalid_faces find_invalid_faces() find_open_edge() closing_tolerance() same_triangles()
//   feature_kind mesh_feature features feature_options find_features() feature_at_face()
//   feature_at_point() fit_feature() hull_side
/// The volume inside a closed mesh, in cubic units; negative if it is inside out. For an open
/// mesh, the sum of the signed volumes of the tetrahedra from the origin to its faces. O(F).
TREEFORM_C_API treeform_code treeform_signed_volume(const treeform_mesh* mesh, double* result);

/// The sum of the areas of all faces, in square units, rounded. O(F).
TREEFORM_C_API treeform_code treeform_surface_area(const treeform_mesh* mesh, double* result);

/// Mass properties of a solid of density 1.
typedef struct treeform_mass_properties {
    double volume;     ///< the enclosed volume; negative if the mesh is inside out
    double center[3];  ///< the center of mass
    /// Inertia tensor about the center, in axes x, y and z: the kinetic energy at angular velocity
    /// w is w . (inertia w) / 2.
    double inertia[9];
} treeform_mass_properties;

/// Volume, center of mass and inertia of the solid that a closed mesh bounds. If the volume is 0,
/// or too small compared with the terms of its sum, it is 0, and the others are NaN. O(F).
TREEFORM_C_API treeform_code treeform_find_mass_properties(const treeform_mesh* mesh,
                                                           treeform_mass_properties* result);

/// The smallest box around all finite points; if there are none, min is +infinity and max
/// -infinity. O(V).
TREEFORM_C_API treeform_code treeform_bounding_box(const treeform_mesh* mesh, treeform_box* result);

/// Whether the mesh is a solid: closed, oriented, manifold, free of self-intersections.
TREEFORM_C_API treeform_code treeform_is_solid(const treeform_mesh* mesh, int32_t* result);

/// Whether a mesh can be an operand of `treeform_boolean`: it must be closed, as given or after it
/// is cut along itself. If not, the certificate lists open edges. `treeform_find_solid_defects` is
/// stricter.
TREEFORM_C_API treeform_code treeform_check_operand(const treeform_mesh* mesh,
                                                    treeform_progress progress, void* progress_data,
                                                    treeform_certificate** certificate);

/// Counts over the faces with three different corner numbers. Faces that repeat a corner have no
/// edges here and are counted separately. Faces with collinear corners, and duplicates, are
/// counted like all others. The Euler characteristic is points_used - edges + faces.
typedef struct treeform_topology_counts {
    void* owner;
    uint64_t edges;                  ///< undirected
    uint64_t boundary_edges;         ///< used by one face
    uint64_t nonmanifold_edges;      ///< used by three or more faces
    uint64_t misoriented_edges;      ///< used by two faces in the same direction
    uint64_t nonmanifold_points;     ///< points with more than one fan of faces
    uint64_t components_by_point;    ///< faces linked by a shared corner
    uint64_t components_by_edge;     ///< faces linked by a shared edge
    uint64_t points_used;            ///< points that are a corner of a counted face
    uint64_t faces;                  ///< faces with three different corners
    uint64_t repeated_corner_faces;  ///< faces that repeat a corner
    uint64_t duplicate_faces;        ///< Faces with the same three corners as an earlier one.
    /// Whether there are faces, and every edge has exactly two. Orientation and fans of points do
    /// not matter.
    int32_t closed_manifold;
} treeform_topology_counts;

/// Counts edges, components and defects. Join equal points first (`treeform_join_equal_points`).
TREEFORM_C_API treeform_code treeform_count_topology(const treeform_mesh* mesh,
                                                     treeform_topology_counts** counts);

/// `component` [F]: the connected component of each face, by shared corners; components are
/// numbered in the order of their lowest faces. `count` is their number.
TREEFORM_C_API treeform_code treeform_face_components(const treeform_mesh* mesh,
                                                      uint32_t* component, size_t* count);

/// Faces and points that are invalid, or have no area, ascending. A face is in at most one list.
typedef struct treeform_invalid_faces {
    void* owner;
    /// [nonfinite_point_count] with a NaN or infinite coordinate
    const uint32_t* nonfinite_points;
    size_t nonfinite_point_count;
    /// [nonfinite_face_count] with a corner that is not finite
    const uint32_t* nonfinite_faces;
    size_t nonfinite_face_count;
    /// [degenerate_face_count] finite, with exactly collinear corners
    const uint32_t* degenerate_faces;
    size_t degenerate_face_count;
    /// [out_of_range_face_count] with a corner out of range
    const uint32_t* out_of_range_faces;
    size_t out_of_range_face_count;
} treeform_invalid_faces;

/// Finds faces and points that most operations refuse or ignore. Other defects, such as open
/// edges: `treeform_find_solid_defects`.
///
/// Collinearity is exact: a face with a repeated corner or two equal corners is degenerate, a
/// sliver is not, however thin. A face is first tested for corners out of range, then for corners
/// that are not finite.
TREEFORM_C_API treeform_code treeform_find_invalid_faces(const treeform_mesh* mesh,
                                                         treeform_invalid_faces** faces);

/// The point numbers of the lowest edge at which the mesh is open; both `TREEFORM_NONE` if the
/// mesh is closed, so that winding numbers are defined.
TREEFORM_C_API treeform_code treeform_find_open_edge(const treeform_mesh* mesh, uint32_t edge[2]);

/// `result` is the index of the first of `tolerances` [count] that closes the mesh if points
/// within it are joined; `count` if joining equal points already closes it, or if none does.
TREEFORM_C_API treeform_code treeform_closing_tolerance(const treeform_mesh* mesh,
                                                        const double* tolerances, size_t count,
                                                        size_t* result);

/// Whether two meshes have the same faces with the same orientation. Corners are compared by
/// coordinates (-0 equals +0, NaN equals nothing). With `any_order`, faces may come in any order
/// and start at any corner; otherwise order and first corners must be equal, too.
TREEFORM_C_API treeform_code treeform_same_triangles(const treeform_mesh* a, const treeform_mesh* b,
                                                     int32_t any_order, int32_t* result);

/// The kind of a feature.
typedef int32_t treeform_feature_kind;
enum { TREEFORM_PLANE = 0, TREEFORM_AXIS = 1 };

/// A plane or an axis, fitted to faces by least squares.
typedef struct treeform_mesh_feature {
    treeform_feature_kind kind;  ///< plane or axis
    int32_t hollow;              ///< for a cylinder: the faces point toward the axis, as in a hole
    double origin[3];            ///< center of the faces, on the plane or the axis
    /// of length 1: the outward normal of a plane; along an axis, in either sense
    double direction[3];
    double radius;          ///< of the cylinder; 0 for a plane
    double area;            ///< total area of the faces
    double deviation;       ///< largest distance of a corner from the plane or cylinder
    const uint32_t* faces;  ///< [face_count] the faces that it was fitted to, ascending
    size_t face_count;
} treeform_mesh_feature;

/// Features, largest area first.
typedef struct treeform_features {
    void* owner;
    const treeform_mesh_feature* features;  ///< [count]
    size_t count;
} treeform_features;

/// What counts as flat or cylindrical.
typedef struct treeform_feature_options {
    size_t struct_size;
    /// Largest distance of a corner from the plane or cylinder. Default: 1e-4 of the diagonal;
    /// NaN: not given
    double tolerance;
    /// in degrees: largest angle between a face and the plane; default 1.0
    double plane_angle;
    /// In degrees: largest angle between neighboring faces of a cylinder; default 46.0
    double facet_angle;
    double arc;  ///< in degrees: the least arc of a cylinder; default 60.0
    /// for `treeform_find_features`, which returns nothing if stopped
    treeform_progress progress;
    void* progress_data;
} treeform_feature_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_feature_options_init(treeform_feature_options* options, size_t size);

/// The flat or cylindrical regions of the mesh, largest first. Join equal points first.
TREEFORM_C_API treeform_code treeform_find_features(const treeform_mesh* mesh,
                                                    treeform_feature_kind kind,
                                                    const treeform_feature_options* options,
                                                    treeform_features** features);

/// The region around a face; `count` is 0 if it is neither flat nor cylindrical.
TREEFORM_C_API treeform_code treeform_feature_at_face(const treeform_mesh* mesh,
                                                      treeform_feature_kind kind, uint32_t face,
                                                      const treeform_feature_options* options,
                                                      treeform_features** features);

/// The region around the face nearest to a point.
TREEFORM_C_API treeform_code treeform_feature_at_point(const treeform_mesh* mesh,
                                                       treeform_feature_kind kind,
                                                       const double point[3],
                                                       const treeform_feature_options* options,
                                                       treeform_features** features);

/// The plane or axis fitted to exactly these faces, however large the deviation. Null, with
/// `TREEFORM_OK`, if they have no area, or, for an axis, if they are flat.
TREEFORM_C_API treeform_code treeform_fit_feature(const treeform_mesh* mesh,
                                                  treeform_feature_kind kind, const uint32_t* faces,
                                                  size_t count, treeform_features** features);

/// A flat side of a convex hull: all coplanar faces of one plane.
typedef struct treeform_hull_side {
    /// The first of its faces, in `treeform_hull::faces`; each of them spans the plane.
    uint32_t first_face;
    uint32_t face_count;
    double area;       ///< rounded; infinite on overflow
    double normal[3];  ///< outward, of length 1, rounded
    double center[3];  ///< centroid of its area, rounded
} treeform_hull_side;
// end

/// A convex hull.
typedef struct treeform_hull {
    void* owner;
    int32_t dimension;      ///< 3 in space, 2 in a plane, 1 on a line, 0 one point, -1 none
    const uint32_t* faces;  ///< [face_count][3] by numbers of points, grouped by side
    size_t face_count;
    const treeform_hull_side* sides;  ///< [side_count]
    size_t side_count;
    /// [side_count + 1] corners of side i are corners[corner_begin[i]] ... in order around it
    const size_t* corner_begin;
    const uint32_t* corners;
    treeform_arrays mesh;  ///< the hull as a closed mesh, with the points that it uses
} treeform_hull;

// made of the headers of C++:
//   convex_hull() orient2d() orient3d() compare_distance()
/// The convex hull of the points of a mesh or cloud, exact on the coordinates as given. `progress`
/// may be null.
TREEFORM_C_API treeform_code treeform_convex_hull(const treeform_mesh* mesh,
                                                  treeform_progress progress, void* progress_data,
                                                  treeform_hull** hull);

/// Sign of (b - a) x (c - a): +1 when a, b, c turn left (counter-clockwise), 0 when collinear.
TREEFORM_C_API treeform_code treeform_orient2d(const double a[2], const double b[2],
                                               const double c[2], int32_t* result);

/// Sign of ((b - a) x (c - a)) . (d - a): +1 when d lies on the side of the plane a, b, c that its
/// normal points to, that is, from where a, b, c are seen counter-clockwise; 0 when coplanar.
TREEFORM_C_API treeform_code treeform_orient3d(const double a[3], const double b[3],
                                               const double c[3], const double d[3],
                                               int32_t* result);

/// Sign of |a - b|^2 - |c - d|^2.
TREEFORM_C_API treeform_code treeform_compare_distance(const double a[3], const double b[3],
                                                       const double c[3], const double d[3],
                                                       int32_t* result);
// end

/// The intersection of two triangles.
typedef struct treeform_triangle_contact {
    /// dimension of the intersection: -1 if empty, 0 a point, 1 a segment, 2 an area
    int32_t dimension;
    int32_t coplanar;
    int32_t crossing;  ///< whether they pass through each other
} treeform_triangle_contact;

// made of the headers of C++:
//   intersect_triangles()
/// The intersection of triangles `a` and `b`, three points each; exact.
TREEFORM_C_API treeform_code treeform_intersect_triangles(const double a[9], const double b[9],
                                                          treeform_triangle_contact* result);
// end
