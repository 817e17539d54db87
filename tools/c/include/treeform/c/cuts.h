#pragma once
/// \file
/// Sections of a mesh by planes, solids cut by them; parts of meshes, meshes one after the other,
/// moved.

#include <treeform/c/mesh.h>

/// The plane through a point across a normal, whose length does not matter.
typedef struct treeform_plane {
    double at[3];
    double normal[3];
} treeform_plane;

// made of the headers of C++:
//   section_loop section_layer section_result section() heights layer_heights()
//   write_section() cut_options cut_piece cut_result cut() cut_to_fit() mesh_part mesh_parts
//   components() concatenate() transform_mesh()
/// A closed polygon, or, where the mesh ends, an open polyline.
typedef struct treeform_section_loop {
    size_t first_point;  ///< its points follow one another; the first is not repeated
    size_t point_count;
    uint8_t closed;
    /// The faces along it agree in their orientation. What is inside is to the left then, seen
    /// from above the plane: outer loops run counter-clockwise, holes clockwise.
    uint8_t oriented;
    uint32_t parent;  ///< the innermost loop around it; `TREEFORM_NONE` for open ones
    /// how many loops are around it: of a solid, holes have an odd one
    uint32_t depth;
    double area;  ///< positive where it runs counter-clockwise; 0 for open ones
    double length;
} treeform_section_loop;

/// What is in one plane.
typedef struct treeform_section_layer {
    double height;
    double at[3];         ///< of its plane
    uint32_t first_loop;  ///< its loops follow one another
    uint32_t loop_count;
    uint32_t open_count;  ///< of these, open polylines
    double area;          ///< of its loops, added up: what is inside a solid
    double length;
} treeform_section_layer;

/// Sections, in the order of their heights as given.
typedef struct treeform_section_result {
    void* owner;
    const treeform_section_layer* layers;  ///< [layer_count]
    size_t layer_count;
    const treeform_section_loop* loops;  ///< [loop_count]
    size_t loop_count;
    /// [point_count][2] In the frame: of p in space, (x . p, y . p), for p within 2^-45 of its
    /// largest coordinate.
    const double* points;
    /// [points] the face in which the segment from each point begins
    const uint32_t* faces;
    size_t point_count;
    double x[3];
    double y[3];
    double normal[3];
} treeform_section_result;

/// Sections of a mesh by the planes at `heights` above `plane` (`oriented_plane::parallel`).
///
/// Which side of a plane a vertex is on, which segments make a loop, and which loop lies in which
/// are decided exactly, on the coordinates as given. Then points are rounded.
///
/// A vertex in a plane counts as above it. So a section is that of a plane just below: a box from
/// height 0 to 1 has none at 0, and its full top at 1. A point or line in which the mesh only
/// touches the plane from below gives no loop. A face in the plane counts where the mesh goes on
/// below it.
///
/// Of a mesh that is closed and agrees in its orientation, all polylines are closed. Loops may
/// touch where faces do; at an edge of four faces or more, those that bound one wedge of the solid
/// are joined. Where the mesh has a border, polylines are open; where neighbors disagree, they go
/// on, not `oriented`. Loops of faces that cross each other do, too: `parent` is then that of one
/// of their points, and areas are added up as often as the surface winds around them. Corners with
/// equal coordinates are one.
///
/// Where a loop goes straight on from one face to another in the same plane, exactly, there is no
/// point: a box has four. The side from a point on lies in the face named, and may go on in
/// others.
///
/// Loops are in the order of their lowest faces.
TREEFORM_C_API treeform_code treeform_section(const treeform_mesh* mesh,
                                              const treeform_plane* plane, const double* heights,
                                              size_t count, treeform_progress progress,
                                              void* progress_data,
                                              treeform_section_result** result);

/// Numbers.
typedef struct treeform_heights {
    void* owner;
    const double* heights;  ///< [count]
    size_t count;
} treeform_heights;

/// Heights above `plane` (null: as above) of the middles of layers of this thickness, from the
/// lowest point of the mesh to the highest.
TREEFORM_C_API treeform_code treeform_layer_heights(const treeform_mesh* mesh,
                                                    const treeform_plane* plane, double thickness,
                                                    treeform_heights** heights);

/// Writes sections as svg, dxf, obj or json: `format`, or by the extension where that is null.
/// `unit` of lengths: mm, cm, m, in, ft or um, or null: SVG has no size on paper then.
TREEFORM_C_API treeform_code treeform_write_section(const char* path,
                                                    const treeform_section_result* section,
                                                    const char* format, const char* unit);

/// How to cut.
typedef struct treeform_cut_options {
    size_t size;
    /// Precision of the coordinates returned. float32 values are stored as doubles; default
    /// float64
    treeform_precision precision;
    /// As in `treeform_boolean_options`: how far what rounding has broken is joined; default
    /// infinite
    double max_displacement;
    /// Of a mesh that meets itself, as in `treeform_boolean_options`: where merging would mix
    /// values (`carry_sources::merging_mixes_values`), faces that were cut are to stay apart.
    int32_t keep_cuts;
    treeform_progress progress;
    void* progress_data;
    /// Otherwise pieces end at the planes, and the mesh may end anywhere: it is cut as a surface;
    /// default 1
    int32_t caps;
} treeform_cut_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_cut_options_init(treeform_cut_options* options, size_t size);

/// What is between two planes.
typedef struct treeform_cut_piece {
    treeform_arrays mesh;
    /// [F] face of the input that each lies in; `TREEFORM_NONE`: a cap
    const uint32_t* face_source;
    /// [V] vertex of the input that each is; `TREEFORM_NONE`: new
    const uint32_t* vertex_source;
    /// [F] of a cap, the number of its plane, from the lowest; else none
    const uint32_t* cap;
    /// Status ok says what it says of `treeform_boolean_result`; without caps, edges are not
    /// looked at. A piece without faces is ok, too: there is nothing between these planes.
    const treeform_certificate* certificate;
} treeform_cut_piece;

/// Pieces, and what was checked.
typedef struct treeform_cut_result {
    void* owner;
    /// [count] Of K planes, in their order along the normal, K + 1 pieces from the lowest up. None
    /// where the certificate says why.
    const treeform_cut_piece* pieces;
    size_t count;
    /// That of the first piece that is not ok, or of the mesh where it bounds no solid.
    const treeform_certificate* certificate;
    /// Faces of the mesh met: what was cut is the solid that it winds around, where parts that
    /// overlap are one; without caps, the faces cut along each other. Not of `treeform_cut_along`.
    int32_t resolved;
} treeform_cut_result;

/// The mesh below, between and above planes at `heights` above `plane`
/// (`oriented_plane::parallel`).
///
/// Which side of a plane a vertex is on is decided exactly, on the coordinates as given. A face
/// that lies in a plane belongs to the side that its solid is on. What the solid has in the plane
/// is then closed by a cap, the same for both sides. Only points on cuts are rounded, once; each
/// piece is checked as results of `treeform_boolean` are. Caps between axes stay flat and alike
/// when rounded; others may bend by a step of the precision.
///
/// `treeform_carry` gives pieces the attributes of a file, by their sources, and
/// `carry_source::texture_caps` gives caps texture coordinates in their planes.
///
/// The mesh has to bound a solid, as an operand of `treeform_boolean` has to. Where it meets
/// itself, or has parts that are inside out or hidden in others, it is first made the solid that
/// it winds around, rounded: then all that is said here is of that one. Equal planes are one.
TREEFORM_C_API treeform_code treeform_cut(const treeform_mesh* mesh, const treeform_plane* plane,
                                          const double* heights, size_t count,
                                          const treeform_cut_options* options,
                                          treeform_cut_result** result);

/// Pieces that fit into a box of this size: cut by planes across x, then y, then z, as few along
/// each axis as there can be, and equally far apart, to rounding. A size that is infinite is not
/// cut along. Pieces are those with faces, by x, then y, then z; numbers of planes count across x
/// first, then y, then z. Cuts across y and z are of the rounded pieces of the cuts before.
TREEFORM_C_API treeform_code treeform_cut_to_fit(const treeform_mesh* mesh, const double size[3],
                                                 const treeform_cut_options* options,
                                                 treeform_cut_result** result);

/// Faces of a mesh by themselves, with the points that they use.
typedef struct treeform_mesh_part {
    treeform_arrays mesh;
    const uint32_t* face_source;    ///< [F] the number of each face in the whole
    const uint32_t* vertex_source;  ///< [V] that of each point; ascending
    double volume;                  ///< as `signed_volume`
    double area;                    ///< as `surface_area`
} treeform_mesh_part;

/// Parts of a mesh.
typedef struct treeform_mesh_parts {
    void* owner;
    const treeform_mesh_part* parts;  ///< [count]
    size_t count;
} treeform_mesh_parts;

/// The faces that corners link, as meshes, by their lowest faces; a cavity goes with what is
/// around it. Parts of a volume below `min_volume` are left out (open ones have none), and all but
/// the `largest` ones where that is not 0.
TREEFORM_C_API treeform_code treeform_components(const treeform_mesh* mesh, double min_volume,
                                                 size_t largest, treeform_mesh_parts** parts);

/// Points and faces of all meshes, one after the other; nothing is joined. `index` [F] is the mesh
/// that each face is of.
TREEFORM_C_API treeform_code treeform_concatenate(const treeform_mesh* const* meshes, size_t count,
                                                  treeform_made_mesh** made);

/// The mesh with its points moved. Where `by` mirrors, faces are turned over, so that they look
/// outward as before.
TREEFORM_C_API treeform_code treeform_transform_mesh(const treeform_mesh* mesh, const double* by,
                                                     treeform_made_mesh** made);
// end
