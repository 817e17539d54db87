#ifndef TREEFORM_C_SHAPES_H
#define TREEFORM_C_SHAPES_H
/// \file
/// Solids grown, shrunk and hollowed, surfaces made thick; fewer faces; how thick walls are; the
/// smallest box around points; lines along which a value has a level.

#include <treeform/c/cuts.h>
#include <treeform/c/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

// made of <mesh/offset.hpp>:
//   thick_side drain offset_options offset_result
/// Where a thickness goes; the front is where faces are counter-clockwise.
typedef int32_t treeform_thick_side;
enum { TREEFORM_THICK_BOTH = 0, TREEFORM_THICK_FRONT = 1, TREEFORM_THICK_BACK = 2 };

/// A hole through the wall of a hollow solid.
typedef struct treeform_drain {
    double at[3];     ///< the point of the surface that is nearest to this is drilled
    double diameter;  ///< a regular prism of 32 sides, whose corners are on this circle
} treeform_drain;

/// How to make a surface at a distance.
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
    double distance;    ///< that was asked for, without its sign
    double resolution;  ///< that was used
    /// Bounds of the distance from any point of the surface made, in its faces too, to the mesh
    /// that it is the offset of: all are in [least, greatest]. Found by branch and bound; each is
    /// within a sixteenth of the resolution of what is there. 0 where there is no surface.
    double least;
    double greatest;
    uint64_t cells;  ///< that the surface may pass through
    /// Of `treeform_hollow`: cavities that nothing leads out of, those of the input, too.
    uint64_t sealed_cavities;
    /// [blind_drain_count] Of `treeform_hollow`: numbers of drains that are not known to lead from
    /// outside into a cavity: an end of their axis is neither there nor there.
    const uint32_t* blind_drains;
    size_t blind_drain_count;
} treeform_offset_result;
// end

/// The solid grown by `distance`, or shrunk where it is negative. The code is that of the
/// certificate.
TREEFORM_C_API treeform_code treeform_offset(const treeform_mesh* mesh, double distance,
                                             const treeform_offset_options* options,
                                             treeform_offset_result** result);

/// The solid without what is further inside than `wall`; `drains` [count] are holes through it. The
/// code is that of the certificate.
TREEFORM_C_API treeform_code treeform_hollow(const treeform_mesh* mesh, double wall,
                                             const treeform_drain* drains, size_t count,
                                             const treeform_offset_options* options,
                                             treeform_offset_result** result);

/// A solid around a surface, which may be open. The code is that of the certificate.
TREEFORM_C_API treeform_code treeform_thicken(const treeform_mesh* mesh, double thickness,
                                              treeform_thick_side side,
                                              const treeform_offset_options* options,
                                              treeform_offset_result** result);

// made of <mesh/simplify.hpp>:
//   simplify_options simplify_result
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
    /// their corners at each of its ends are of one group. Of a file:
    /// `carry_sources::corner_groups`; or null
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
// end

/// The mesh with fewer faces, no point of either surface further than `max_distance` from the
/// other. The code is that of the certificate.
TREEFORM_C_API treeform_code treeform_simplify(const treeform_mesh* mesh, double max_distance,
                                               const treeform_simplify_options* options,
                                               treeform_simplify_result** result);

// made of <mesh/measure.hpp>:
//   thickness_by thickness_options thickness_result
/// How the thickness of a wall is measured at a face.
typedef int32_t treeform_thickness_by;
enum {
    /// along its normal, inward from its center, to the first face that is left there
    TREEFORM_THICKNESS_BY_RAY = 0,
    /// the diameter of the largest ball within that touches its center
    TREEFORM_THICKNESS_BY_SPHERE = 1
};

/// How to measure thickness.
typedef struct treeform_thickness_options {
    size_t size;
    treeform_thickness_by by;
    treeform_progress progress;
    void* progress_data;
} treeform_thickness_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_thickness_options_init(treeform_thickness_options* options,
                                                    size_t size);

/// The thickness at each face, and the least.
typedef struct treeform_thickness_result {
    void* owner;
    /// [F] Infinite where nothing is behind a face, or it has no area.
    const double* of_face;
    double least;       ///< of all faces
    uint32_t thinnest;  ///< the lowest face with that
} treeform_thickness_result;
// end

/// How thick the walls of a solid are, face by face.
TREEFORM_C_API treeform_code treeform_wall_thickness(const treeform_mesh* mesh,
                                                     const treeform_thickness_options* options,
                                                     treeform_thickness_result** result);

// made of <mesh/convex_hull.hpp>:
//   oriented_box
/// A box turned in any way.
typedef struct treeform_oriented_box {
    void* owner;
    double center[3];  ///< of the box
    /// of length 1, right-handed, rounded: along the longest side, the next, the shortest
    double axes[3][3];
    double size[3];  ///< along these
} treeform_oriented_box;
// end

/// The box of least volume around the points of a mesh, of those along sides of their convex hull.
/// *box is null without points.
TREEFORM_C_API treeform_code treeform_find_oriented_box(const treeform_mesh* mesh,
                                                        treeform_oriented_box** box);

// made of <mesh/section.hpp>:
//   isoline isolines_result
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
// end

/// Lines along which a value, `values` [V], linear in each face, has one of the `levels` [count].
TREEFORM_C_API treeform_code treeform_isolines(const treeform_mesh* mesh, const double* values,
                                               const double* levels, size_t count,
                                               treeform_progress progress, void* progress_data,
                                               treeform_isolines_result** lines);

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

#ifdef __cplusplus
}
#endif
#endif
