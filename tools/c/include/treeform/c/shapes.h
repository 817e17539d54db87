#pragma once
/// \file
/// Offset, hollow, thickened and wrapped solids; simplification; wall thickness; smallest boxes
/// around points; isolines. Drains of `treeform_hollow` are [count][4]: a point, and a diameter.

#include <treeform/c/cuts.h>
#include <treeform/c/mesh.h>

// made of the headers of C++:
//   offset_options offset_result wrap() offset() hollow() thicken() simplify_options
//   simplify_result simplify() thickness_by thickness_result wall_thickness() oriented_box
//   find_oriented_box() isoline isolines_result isolines() write_isolines() cut_along()
/// Options of `offset`, `treeform_hollow`, `treeform_thicken` and `treeform_wrap`. Each function
/// ignores those that do not concern it.
typedef struct treeform_offset_options {
    size_t struct_size;
    /// Edge length of the cells from which the surface is made, in the mesh's length unit; at most
    /// half of the distance. Every point whose distance differs from the given one by more than
    /// twice the resolution is on the right side of the surface. Smaller details may be lost.
    /// Default: a quarter of the distance, at most 1/64 of the diagonal of the result; larger, up
    /// to half of the distance, if there would be more than about 2^16 cells at the surface
    /// (170,000 faces). `treeform_offset_result` has the value used, and the error; NaN: not given
    double resolution;
    /// Precision of the coordinates returned. float32 values are stored as doubles; default
    /// `TREEFORM_FLOAT64`
    treeform_precision precision;
    treeform_progress progress;
    void* progress_data;
    /// `treeform_wrap`: the distance of the wrap's vertices from the mesh, in its length unit.
    /// Default: a thirtieth of `size`; NaN: not given
    double offset;
    /// `treeform_thicken`: distance by which the surface is first moved toward its front, in its
    /// length unit; if negative, toward its back. With half of the thickness, the input surface
    /// becomes the back of the solid.
    double shift;
} treeform_offset_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_offset_options_init(treeform_offset_options* options, size_t size);

/// The mesh, and its certificate.
typedef struct treeform_offset_result {
    void* owner;
    treeform_arrays mesh;
    /// Status ok means, verified on the coordinates of `mesh`: a closed manifold, oriented
    /// outward, whose faces meet only in common corners and edges. `TREEFORM_STATUS_OPEN_INPUT`:
    /// the input bounds no solid; `open_edges` lists where. `TREEFORM_STATUS_VANISHED`: the result
    /// is empty, since the solid is nowhere thick enough, or exceeds that thickness by less than a
    /// cell.
    const treeform_certificate* certificate;
    /// the given distance, without its sign; for `treeform_wrap`, the offset used
    double distance;
    double resolution;  ///< the resolution used; for `treeform_wrap`, its `size`
    uint64_t cells;     ///< cells that the surface may pass through
    /// For `treeform_hollow`: number of cavities without an opening, including those of the input.
    uint64_t sealed_cavities;
    /// [blind_drain_count] For `treeform_hollow`: numbers of drains that do not lead from outside
    /// into a cavity, judged by the ends of their axes.
    const uint32_t* blind_drains;
    size_t blind_drain_count;
    uint64_t tetrahedra;         ///< for `treeform_wrap`: tetrahedra at the end
    uint64_t tetrahedra_points;  ///< for `treeform_wrap`: points of the tetrahedra
    /// for `treeform_wrap`: tetrahedra filled to make the surface manifold
    uint64_t filled_tetrahedra;
    /// Lower bound of the distance from any point of the new surface, also inside its faces, to
    /// the input surface. For `treeform_hollow`, the new surface is the surface of the cavities;
    /// for `treeform_thicken`, the distance is to the moved surface. By branch and bound: this and
    /// `greatest_distance` are within a sixteenth of the resolution of the true extremes. 0 if
    /// there is no surface, and for `treeform_wrap`.
    double least_distance;
    double greatest_distance;  ///< upper bound of the same distances
} treeform_offset_result;

/// Alpha wrapping: a solid that contains all faces of `mesh`, which may be open, intersecting,
/// inconsistently oriented or degenerate. The wrap is the surface that a ball of radius `size`
/// cannot pass when rolled over the mesh from outside: holes and gaps narrower than the ball are
/// closed, sharp edges are rounded, and cavities without an opening for the ball are filled. A
/// smaller size follows the mesh more closely, with more faces: about area / `size`^2.
///
/// No face of the mesh meets the wrap or is outside of it: this is verified exactly, on the
/// coordinates of both. The wrap's vertices are at the offset from the mesh, up to rounding.
TREEFORM_C_API treeform_code treeform_wrap(const treeform_mesh* mesh, double size,
                                           const treeform_offset_options* options,
                                           treeform_offset_result** result);

/// The solid grown by `distance`: points inside, or at most this far from the surface. If
/// negative, the solid shrunk: points inside, and at least |distance| from the surface.
///
/// Convex edges and corners become round outward. Edges that the exact offset keeps sharp are cut
/// off by at most a cell. The mesh must bound a solid, like an operand of `treeform_boolean`; if
/// it meets itself, the solid that it winds around is used. What is inside is decided exactly.
/// Vertices are at the given distance, up to about a thousandth of a cell.
TREEFORM_C_API treeform_code treeform_offset(const treeform_mesh* mesh, double distance,
                                             const treeform_offset_options* options,
                                             treeform_offset_result** result);

/// Hollows the solid: its points deeper inside than `wall` become cavities; the outer surface
/// stays bit for bit. The status is `TREEFORM_STATUS_VANISHED` if there is no cavity.
///
/// `drains` are holes through the wall: a point and a diameter. Each runs from the nearest point
/// of the surface along the shortest segment to a cavity, as a regular prism of 32 sides; the
/// diameter is that of the circle through its corners. It extends beyond both ends by its
/// diameter, but at most half of the way to the next surface.
TREEFORM_C_API treeform_code treeform_hollow(const treeform_mesh* mesh, double wall,
                                             const double* drains, size_t count,
                                             const treeform_offset_options* options,
                                             treeform_offset_result** result);

/// A solid around any surface: all points at most half of `thickness` away. Its rim is round.
///
/// With a `shift`, the surface is first moved toward its front, the side from which faces are seen
/// counter-clockwise. Each vertex moves so that the planes of its faces move by the shift, on
/// average. This is exact where the surface is flat; where it bends, it becomes rounder. Vertices
/// of sharp folds move by at most twice the shift. Faces must be consistently oriented.
TREEFORM_C_API treeform_code treeform_thicken(const treeform_mesh* mesh, double thickness,
                                              const treeform_offset_options* options,
                                              treeform_offset_result** result);

/// How to simplify.
typedef struct treeform_simplify_options {
    size_t struct_size;
    /// Precision of the returned points. With float32, all points are rounded first, and the
    /// bounds include this; values are stored as doubles; default `TREEFORM_FLOAT64`
    treeform_precision precision;
    uint64_t target_faces;  ///< stop at this number of faces
    /// Edges are features if the normals of their faces differ by more than this, in degrees; 180:
    /// none; default 180.0
    double feature_angle;
    /// [F] or empty: edges between faces of different groups are borders of both; or null
    const uint32_t* face_groups;
    size_t face_group_count;
    treeform_progress progress;
    void* progress_data;
    /// [3 F] or empty: groups of corners. An edge is a seam, and so a border of both faces, unless
    /// at each end the corners of both faces are in one group. `treeform_corner_groups` has the
    /// groups of a file; or null
    const uint32_t* corner_groups;
    size_t corner_group_count;
} treeform_simplify_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_simplify_options_init(treeform_simplify_options* options, size_t size);

/// The simplified mesh, proven distances, and its certificate.
typedef struct treeform_simplify_result {
    void* owner;
    treeform_arrays mesh;
    const uint32_t* face_source;   ///< [F] the input face of each face
    uint64_t collapses;            ///< edges collapsed
    uint64_t refused_by_topology;  ///< edges whose collapse would change the topology
    uint64_t refused_by_turning;   ///< edges whose collapse would turn a face too far
    /// Edges whose collapse was not proven within the distance.
    uint64_t refused_by_distance;
    uint64_t refused_by_contact;  ///< edges whose collapse would make faces meet
    /// Status ok means no worse than the input: no count of `treeform_find_solid_defects` is
    /// larger. A solid is still a solid; faces that met may still meet. Otherwise
    /// `TREEFORM_STATUS_NOT_CERTIFIED` or `TREEFORM_STATUS_CANCELLED`.
    const treeform_certificate* certificate;
    /// [V] input vertex equal to each vertex; `TREEFORM_NONE`: new
    const uint32_t* vertex_source;
    /// [V] for a new vertex, the nearest input face on its side of seams; else `TREEFORM_NONE`
    const uint32_t* face_of_new_vertex;
    /// [3 F] for each corner, an input corner (3 f + i for corner i of face f) at its vertex, on
    /// the same side of seams; none at new vertices
    const uint32_t* corner_source;
    /// Bound of the distance from any input point to the result.
    double input_to_result_bound;
    /// Bound of the distance from any point of the result to the input.
    double result_to_input_bound;
    uint64_t fixed_vertices;  ///< vertices on nonmanifold edges or fans, never removed
} treeform_simplify_result;

/// The mesh with fewer faces, by edge collapses in the order of their quadric error.
///
/// Input and result are within `max_distance` of each other: this is proven for each face, not
/// sampled. No collapse makes faces meet, exactly, on the coordinates returned; faces of the input
/// that meet may still meet. A closed, oriented manifold remains a closed, oriented manifold. The
/// nesting of components is only checked at the end, in the certificate.
///
/// Borders, features, and borders of groups are simplified as polylines, within the same distance:
/// vertices on them are removed, but not moved. Vertices stay where such lines end, branch or
/// cross, at nonmanifold or inconsistently oriented edges, and where their faces are not one fan.
///
/// Nothing is collapsed if the distance is below about 2^-46 of the largest coordinate, which
/// doubles cannot prove, or if squares of coordinates overflow or underflow. Corners with equal
/// coordinates are one vertex; faces with two equal corners are dropped, and distances do not take
/// them into account.
TREEFORM_C_API treeform_code treeform_simplify(const treeform_mesh* mesh, double max_distance,
                                               const treeform_simplify_options* options,
                                               treeform_simplify_result** result);

/// How wall thickness is measured at a face.
typedef int32_t treeform_thickness_by;
enum {
    /// The length of the ray from the center of the face, against its normal, to the first face
    /// through which it leaves the solid.
    TREEFORM_THICKNESS_BY_RAY = 0,
    /// the diameter of the largest inscribed ball that touches the center of the face
    TREEFORM_THICKNESS_BY_SPHERE = 1
};

/// The thickness at each face, and the least thickness.
typedef struct treeform_thickness_result {
    void* owner;
    /// [F] The thickness at each face; infinite if nothing is behind it, or if it has no area.
    const double* of_face;
    double min;         ///< smallest thickness of all faces
    uint32_t thinnest;  ///< The lowest face with the least thickness.
} treeform_thickness_result;

/// The wall thickness of a solid at each face. The face through which a ray leaves is exact, for
/// the rounded center and normal; lengths are rounded. Balls are accurate to 2^-20 of their
/// diameter. Near a sharp edge, balls are small: there, their diameter is not the thickness of a
/// wall.
TREEFORM_C_API treeform_code treeform_wall_thickness(const treeform_mesh* mesh,
                                                     treeform_thickness_by by,
                                                     treeform_progress progress,
                                                     void* progress_data,
                                                     treeform_thickness_result** result);

/// A box in any orientation.
typedef struct treeform_oriented_box {
    void* owner;
    double center[3];  ///< center of the box
    /// Unit axes, right-handed, rounded: along the longest, middle and shortest side.
    double axes[3][3];
    double size[3];  ///< lengths along these axes
} treeform_oriented_box;

/// A box of small volume around points. It is the smallest of these: the axis-aligned box, and all
/// boxes with a side in a side of the convex hull and another along an edge of that side. For
/// coplanar points, the one of least area. Null, with `TREEFORM_OK`, without points. For a hull of
/// more than a few thousand sides, only the largest sides are tried, up to 2^26 corners of sides.
///
/// Axes, center and size are rounded: a point may be outside by 2^-48 of the largest coordinate.
TREEFORM_C_API treeform_code treeform_find_oriented_box(const treeform_mesh* mesh,
                                                        treeform_oriented_box** box);

/// A line on a mesh along which a value equals a level.
typedef struct treeform_isoline {
    double level;        ///< the value along the line
    size_t first_point;  ///< number of its first point; its points are consecutive
    size_t point_count;  ///< number of its points
    /// Whether the last point is joined to the first; otherwise the line ends at borders of the
    /// mesh.
    uint8_t closed;
    /// Whether the faces along it are consistently oriented: seen from outside, larger values are
    /// to its left.
    uint8_t oriented;
    double length;  ///< sum of the lengths of its segments
} treeform_isoline;

/// The isolines of all levels, in the given order of levels.
typedef struct treeform_isolines_result {
    void* owner;
    const treeform_isoline* lines;  ///< [line_count] level after level
    size_t line_count;
    const double* points;  ///< [point_count][3] on edges of the mesh, rounded
    size_t point_count;
    /// [points] the face that contains the segment after each point
    const uint32_t* faces;
} treeform_isolines_result;

/// Isolines: lines along which `values` [V], interpolated linearly in each face, have one of the
/// `levels` [count].
TREEFORM_C_API treeform_code treeform_isolines(const treeform_mesh* mesh, const double* values,
                                               const double* levels, size_t count,
                                               treeform_progress progress, void* progress_data,
                                               treeform_isolines_result** result);

/// Writes isolines in the formats of `treeform_write_section`. SVG shows them as seen against the
/// direction `normal` (null: z).
TREEFORM_C_API treeform_code treeform_write_isolines(const char* path,
                                                     const treeform_isolines_result* lines,
                                                     const double normal[3], const char* format,
                                                     const char* unit);

/// The mesh cut along its isolines: count + 1 pieces, ascending by value.
TREEFORM_C_API treeform_code treeform_cut_along(const treeform_mesh* mesh, const double* values,
                                                const double* levels, size_t count,
                                                const treeform_cut_options* options,
                                                treeform_cut_result** result);
// end
