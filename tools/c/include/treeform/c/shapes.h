#pragma once
/// \file
/// Solids grown, shrunk and hollowed, surfaces made thick; fewer faces; how thick walls are; the
/// smallest box around points; lines along which a value has a level.

#include <treeform/c/cuts.h>
#include <treeform/c/mesh.h>

// made of the headers of C++:
//   thick_side drain offset_options offset_result wrap() offset() hollow() thicken()
//   simplify_options simplify_result simplify() thickness_by thickness_result wall_thickness()
//   oriented_box find_oriented_box() isoline isolines_result isolines() write_isolines()
//   cut_along()
/// Where a thickness goes; the front is where faces are counter-clockwise.
typedef int32_t treeform_thick_side;
enum { TREEFORM_THICK_BOTH = 0, TREEFORM_THICK_FRONT = 1, TREEFORM_THICK_BACK = 2 };

/// A hole through the wall of a hollow solid.
typedef struct treeform_drain {
    double at[3];     ///< the point of the surface that is nearest to this is drilled
    double diameter;  ///< a regular prism of 32 sides, whose corners are on this circle
} treeform_drain;

/// How to make a surface at a distance. What an operation has no use for, it ignores.
typedef struct treeform_offset_options {
    size_t size;
    /// Edge of the cells that the surface is made in, in the mesh's length unit: at most half of
    /// the distance. Every point of space whose distance differs from the one asked for by more
    /// than twice this is on the right side of the surface. Details that are smaller may be lost.
    /// Not given: a quarter of the distance, at most a 64th of the diagonal of the result. Where
    /// that would make more than some 2^16 cells at the surface (170,000 faces), cells are larger,
    /// up to half of the distance. `offset_statistics` has the value used, and the error reached;
    /// NaN: not given
    double resolution;
    /// Precision of the coordinates returned. float32 values are stored as doubles; default
    /// float64
    treeform_precision precision;
    treeform_progress progress;
    void* progress_data;
    /// `treeform_wrap`: how far the vertices of the wrap are from the mesh, in its length unit.
    /// Not given: a thirtieth of the size; NaN: not given
    double offset;
} treeform_offset_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_offset_options_init(treeform_offset_options* options, size_t size);

/// The mesh, and what was checked.
typedef struct treeform_offset_result {
    void* owner;
    treeform_arrays mesh;
    /// Status ok says, checked on the coordinates above: a closed manifold, outward, no two faces
    /// of which meet beyond common corners and edges. `open_input`: no solid was given, and `open`
    /// says where. `vanished`: nothing is left, as the solid is nowhere that thick, or by less
    /// than a cell.
    const treeform_certificate* certificate;
    /// that was asked for, without its sign; of `treeform_wrap`, how far its vertices are
    double distance;
    double resolution;  ///< that was used; of `treeform_wrap`, its size
    /// Bounds of the distance from any point of the surface made, in its faces too, to the mesh
    /// that it is the offset of: all are in [least, greatest]. Found by branch and bound; each is
    /// within a sixteenth of the resolution of what is there. 0 where there is no surface, and of
    /// `treeform_wrap`.
    double least;
    double greatest;
    uint64_t cells;  ///< that the surface may pass through
    /// Of `treeform_hollow`: cavities that nothing leads out of, those of the input, too.
    uint64_t sealed_cavities;
    /// [blind_drain_count] Of `treeform_hollow`: numbers of drains that are not known to lead from
    /// outside into a cavity: an end of their axis is neither there nor there.
    const uint32_t* blind_drains;
    size_t blind_drain_count;
    uint64_t points;      ///< of `treeform_wrap`: of the tetrahedra that were made
    uint64_t tetrahedra;  ///< of `treeform_wrap`: at the end
    /// of `treeform_wrap`: tetrahedra filled so that it is a manifold
    uint64_t filled;
} treeform_offset_result;

/// A solid that holds all faces of `mesh`, whatever they are: open, crossing, turned any way, of
/// no area. A ball of diameter 2 `size` is rolled over them from outside, so to speak: it enters
/// no hole or gap that is narrower. So the wrap closes these, rounds what is sharp, and fills
/// cavities that nothing leads to. A smaller size follows the mesh more closely, with more faces,
/// some area / `size`^2 of them.
///
/// No face of the mesh meets the wrap, or is outside of it: that is decided exactly, on the
/// coordinates of both. The distance of its vertices is met as far as rounding allows.
TREEFORM_C_API treeform_code treeform_wrap(const treeform_mesh* mesh, double size,
                                           const treeform_offset_options* options,
                                           treeform_offset_result** result);

/// The solid grown by `distance`, or shrunk where it is negative: all points inside or no further
/// from the surface than that; all points inside and no less far.
///
/// Outward, convex edges and corners become round; inward, they stay sharp in truth, but are cut
/// off by no more than a cell, as are all sharp edges of the result. The mesh has to bound a
/// solid, as an operand of `treeform_boolean`; where it meets itself, it is the solid that it
/// winds around. What is inside is decided exactly; vertices are at the distance to a thousandth
/// of a cell or so.
TREEFORM_C_API treeform_code treeform_offset(const treeform_mesh* mesh, double distance,
                                             const treeform_offset_options* options,
                                             treeform_offset_result** result);

/// The solid without what is further inside than `wall`: its surface stays bit for bit, around
/// cavities. Each drain runs through the wall along the shortest way to a cavity, and as far
/// beyond both ends as it is wide, but not more than half of the way to what is next there.
/// `statistics` are those of the cavities. `vanished` where there is none.
TREEFORM_C_API treeform_code treeform_hollow(const treeform_mesh* mesh, double wall,
                                             const treeform_drain* drains, size_t count,
                                             const treeform_offset_options* options,
                                             treeform_offset_result** result);

/// A solid around a surface, which may be anything: all points no further from it than half of
/// `thickness`. Its rim is round.
///
/// With `front` and `back` the surface is first moved to that side by half of the thickness, each
/// vertex so that planes of faces around it move that far, on average: exact where it is flat,
/// rounded where it bends. Sharp folds move by no more than twice that. `statistics` are of the
/// surface as moved. Faces have to agree in their orientation.
TREEFORM_C_API treeform_code treeform_thicken(const treeform_mesh* mesh, double thickness,
                                              treeform_thick_side side,
                                              const treeform_offset_options* options,
                                              treeform_offset_result** result);

/// How to leave faces out.
typedef struct treeform_simplify_options {
    size_t size;
    /// Precision of points. With float32, all are rounded first, and bounds count that; values are
    /// stored as doubles; default float64
    treeform_precision precision;
    uint64_t target_faces;  ///< stop at so many faces
    /// Edges whose faces turn by more degrees are features; 180: none; default 180.0
    double feature_angle;
    /// [F] or empty: edges between faces of different groups are borders of both; or null
    const uint32_t* face_groups;
    size_t face_group_count;
    treeform_progress progress;
    void* progress_data;
    /// [3 F] or empty: groups of corners. An edge is a seam, and so a border of both faces, unless
    /// their corners at each of its ends are of one group. `treeform_carry` has those of a file;
    /// or null
    const uint32_t* corner_groups;
    size_t corner_group_count;
} treeform_simplify_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_simplify_options_init(treeform_simplify_options* options, size_t size);

/// The mesh with fewer faces, and what was proven and checked.
typedef struct treeform_simplify_result {
    void* owner;
    treeform_arrays mesh;
    const uint32_t* face_source;   ///< [F] the face of the input that each was
    uint64_t collapses;            ///< edges that became a vertex
    uint64_t refused_by_topology;  ///< edges tried whose collapse would change it
    uint64_t refused_by_turning;   ///< edges whose collapse would turn a face about
    uint64_t refused_by_distance;  ///< edges whose collapse was not proven near
    uint64_t refused_by_contact;   ///< edges whose collapse would make faces meet
    double there_at_most;          ///< no point of the input is further from the result
    double back_at_most;           ///< no point of the result is further from the input
    /// Status ok: the result was looked at, and of what `treeform_find_solid_defects` counts
    /// nothing is more than it was. So a solid is one still. Else `not_certified`, or `cancelled`.
    const treeform_certificate* certificate;
    /// [V] vertex of the input that each is; `TREEFORM_NONE`: new
    const uint32_t* vertex_source;
    /// [V] of a new vertex, the face of the input that is nearest to it, on its side of seams;
    /// else none
    const uint32_t* face_of_new_vertex;
    /// [3 F] the corner of the input that each is at (3 f + i for corner i of face f), on its side
    /// of seams; none at new vertices
    const uint32_t* corner_source;
} treeform_simplify_result;

/// The mesh with fewer faces: edges are collapsed, those first that change the surface least.
///
/// Both surfaces are within `max_distance` of each other: each face is proven so, none is sampled.
/// No two faces are made to meet, exactly, on the coordinates returned; where faces of the input
/// meet, they are left to do so. A closed, oriented manifold stays one. What lies inside of what
/// is looked at in the end alone: the certificate says if that has changed.
///
/// Borders, and edges of features and groups, are simplified along themselves: of their vertices,
/// some stay, and they are within the distance of what they were, too. Where they end, branch or
/// cross, at edges of more than two faces or of faces that do not run both ways, and where faces
/// at a vertex are no fan, vertices stay as they are.
///
/// A distance below what doubles can prove, some 2^-46 of the largest coordinate, collapses
/// nothing, nor are coordinates whose squares are no doubles. Corners with equal coordinates are
/// one vertex; faces with two equal corners go, and are no part of either surface.
TREEFORM_C_API treeform_code treeform_simplify(const treeform_mesh* mesh, double max_distance,
                                               const treeform_simplify_options* options,
                                               treeform_simplify_result** result);

/// How the thickness of a wall is measured at a face.
typedef int32_t treeform_thickness_by;
enum {
    /// along its normal, inward from its center, to the first face that is left there
    TREEFORM_THICKNESS_BY_RAY = 0,
    /// the diameter of the largest ball within that touches its center
    TREEFORM_THICKNESS_BY_SPHERE = 1
};

/// The thickness at each face, and the least.
typedef struct treeform_thickness_result {
    void* owner;
    /// [F] Infinite where nothing is behind a face, or it has no area.
    const double* of_face;
    double least;       ///< of all faces
    uint32_t thinnest;  ///< the lowest face with that
} treeform_thickness_result;

/// How thick the walls of a solid are, face by face. Which face a ray leaves through is exact, for
/// the center and normal as rounded; lengths are rounded. A ball is found to 2^-20 of its
/// diameter. Near a sharp edge balls are small: there, they measure the edge.
TREEFORM_C_API treeform_code treeform_wall_thickness(const treeform_mesh* mesh,
                                                     treeform_thickness_by by,
                                                     treeform_progress progress,
                                                     void* progress_data,
                                                     treeform_thickness_result** result);

/// A box turned in any way.
typedef struct treeform_oriented_box {
    void* owner;
    double center[3];  ///< of the box
    /// of length 1, right-handed, rounded: along the longest side, the next, the shortest
    double axes[3][3];
    double size[3];  ///< along these
} treeform_oriented_box;

/// The box of least volume around points, of those with a side in a side of their convex hull, and
/// another along an edge of it, or along the axes of space. Of flat points, the least area. None
/// without points. Of a hull of more than some thousand sides, those of the largest areas are
/// looked at, as many as 2^26 corners of sides allow.
///
/// Axes, center and size are rounded: a point may be outside by 2^-48 of the largest coordinate.
TREEFORM_C_API treeform_code treeform_find_oriented_box(const treeform_mesh* mesh,
                                                        treeform_oriented_box** box);

/// A line on a mesh along which a value has a level.
typedef struct treeform_isoline {
    double level;        ///< of the value, along it
    size_t first_point;  ///< its points follow one another; the first is not repeated
    size_t point_count;  ///< of its points
    uint8_t closed;      ///< otherwise it ends where the mesh does
    /// the faces along it agree: seen from outside, higher is to its left
    uint8_t oriented;
    double length;  ///< of its sides
} treeform_isoline;

/// Lines of all levels, in the order of the levels as given.
typedef struct treeform_isolines_result {
    void* owner;
    const treeform_isoline* lines;  ///< [line_count] one after the other
    size_t line_count;
    const double* points;  ///< [point_count][3] on edges of the mesh, rounded
    size_t point_count;
    /// [points] the face that the side from each point on lies in
    const uint32_t* faces;
} treeform_isolines_result;

/// Lines along which a value, `values` [V], linear in each face, has one of the `levels` [count].
TREEFORM_C_API treeform_code treeform_isolines(const treeform_mesh* mesh, const double* values,
                                               const double* levels, size_t count,
                                               treeform_progress progress, void* progress_data,
                                               treeform_isolines_result** result);

/// Writes isolines as `treeform_write_section` does sections; SVG as seen from where `normal`
/// points (null: z).
TREEFORM_C_API treeform_code treeform_write_isolines(const char* path,
                                                     const treeform_isolines_result* lines,
                                                     const double normal[3], const char* format,
                                                     const char* unit);

/// The mesh cut along these lines: count + 1 pieces, by value, from the lowest up.
TREEFORM_C_API treeform_code treeform_cut_along(const treeform_mesh* mesh, const double* values,
                                                const double* levels, size_t count,
                                                const treeform_cut_options* options,
                                                treeform_cut_result** result);
// end
