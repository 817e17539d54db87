#pragma once
/// \file
/// Sections of a mesh by planes; solids cut by planes; parts of meshes; meshes concatenated and
/// transformed.

#include <treeform/c/mesh.h>

/// The plane through a point with a normal of any length except zero.
typedef struct treeform_plane {
    double at[3];
    double normal[3];
} treeform_plane;

// made of the headers of C++:
//   section_loop section_layer section_result section() heights layer_heights()
//   write_section() cut_options cut_piece cut_result cut() cut_to_fit() mesh_part mesh_parts
//   components() concatenate() transform_mesh()
/// A closed polygon, or an open polyline that ends at a border of the mesh.
typedef struct treeform_section_loop {
    size_t first_point;  ///< consecutive; the first is not repeated
    size_t point_count;
    uint8_t closed;
    /// Whether the faces along the loop are consistently oriented. Then the inside is to the left,
    /// seen from above the plane: outer loops run counter-clockwise, holes clockwise.
    uint8_t oriented;
    /// the innermost loop around this one; `TREEFORM_NONE` for open loops
    uint32_t parent;
    uint32_t depth;  ///< number of loops around this one; odd for holes in a solid
    double area;     ///< positive if counter-clockwise; 0 for open loops
    double length;
} treeform_section_loop;

/// The section in one plane.
typedef struct treeform_section_layer {
    double height;
    double at[3];         ///< a point of its plane
    uint32_t first_loop;  ///< number of its first loop; its loops are consecutive
    uint32_t loop_count;
    uint32_t open_count;  ///< open polylines among the loops
    double area;          ///< sum over the loops: the area inside a solid
    double length;
} treeform_section_layer;

/// Sections, in the order of their heights as given.
typedef struct treeform_section_result {
    void* owner;
    const treeform_section_layer* layers;  ///< [layer_count]
    size_t layer_count;
    const treeform_section_loop* loops;  ///< [loop_count]
    size_t loop_count;
    /// [point_count][2] In the plane: (x . p, y . p) for a point p in space, which is accurate to
    /// 2^-45 of its largest coordinate.
    const double* points;
    /// [points] the face in which the segment from each point begins
    const uint32_t* faces;
    size_t point_count;
    double axes[3][3];  ///< the axes x and y, and the normal
} treeform_section_result;

/// Sections of a mesh by the planes at `heights` above `plane`.
///
/// The side of each vertex, the loops and their nesting are decided exactly, on the coordinates as
/// given. Then points are rounded.
///
/// A vertex in a plane counts as above it, so a section shows the mesh just below the plane: a box
/// from height 0 to 1 has no section at 0, and its full top at 1. A point or line in which the
/// mesh touches the plane from below gives no loop. A face in the plane is part of the section if
/// the mesh continues below it.
///
/// If the mesh is closed and consistently oriented, all polylines are closed. Loops may touch
/// where faces touch; at an edge of four or more faces, segments that bound the same wedge of the
/// solid are joined. Where the mesh has a border, polylines are open; across inconsistently
/// oriented neighbors they continue, but are not `oriented`. If faces cross each other, so do
/// loops: `parent` is then the innermost loop around one point of the loop, and areas count as
/// often as the surface winds around them. Corners with equal coordinates are one.
///
/// Where a loop runs straight from one face to a coplanar one, it has no point: the section of a
/// box has four. The segment after a point begins in the face in `faces`, and may continue in
/// others.
///
/// The loops of a layer are in the order of their lowest face numbers.
///
/// A null `plane` means z = 0.
TREEFORM_C_API treeform_code treeform_section(const treeform_mesh* mesh,
                                              const treeform_plane* plane, const double* heights,
                                              size_t count, treeform_progress progress,
                                              void* progress_data,
                                              treeform_section_result** result);

/// A list of heights.
typedef struct treeform_heights {
    void* owner;
    const double* heights;  ///< [count]
    size_t count;
} treeform_heights;

/// Heights above `plane` (null: the plane z = 0) of the middles of layers of this thickness, from
/// the lowest point of the mesh to the highest.
TREEFORM_C_API treeform_code treeform_layer_heights(const treeform_mesh* mesh,
                                                    const treeform_plane* plane, double thickness,
                                                    treeform_heights** heights);

/// Writes sections as svg, dxf, obj or json: `format`, or if null, the extension. `unit` of
/// lengths: mm, cm, m, in, ft or um; if null, SVG has no size on paper.
TREEFORM_C_API treeform_code treeform_write_section(const char* path,
                                                    const treeform_section_result* section,
                                                    const char* format, const char* unit);

/// How to cut.
typedef struct treeform_cut_options {
    size_t struct_size;
    /// Precision of the coordinates returned. float32 values are stored as doubles; default
    /// `TREEFORM_FLOAT64`
    treeform_precision precision;
    double max_displacement;  ///< As in `treeform_boolean_options`; default infinite
    /// As in `treeform_boolean_options`, for a mesh that meets itself. Set it if merging would mix
    /// values.
    int32_t keep_cuts;
    treeform_progress progress;
    void* progress_data;
    /// Close pieces by caps. If false, the mesh is cut as a surface, which may be open, and pieces
    /// are open at the planes; default 1
    int32_t caps;
} treeform_cut_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_cut_options_init(treeform_cut_options* options, size_t size);

/// The part of the mesh between two neighboring planes.
typedef struct treeform_cut_piece {
    treeform_arrays mesh;
    /// [F] input face that contains each face; `TREEFORM_NONE`: a cap
    const uint32_t* face_source;
    /// [V] input vertex equal to each vertex; `TREEFORM_NONE`: new
    const uint32_t* vertex_source;
    /// [F] for faces of a cap, the number of its plane (0: the lowest); else `TREEFORM_NONE`
    const uint32_t* cap;
    /// Status ok means the same as in `treeform_boolean_result`; without caps, edges are not
    /// checked. A piece without faces is ok: the mesh has no part between these planes.
    const treeform_certificate* certificate;
} treeform_cut_piece;

/// The pieces, and their certificate.
typedef struct treeform_cut_result {
    void* owner;
    /// [count] For K planes, K + 1 pieces in order along the normal, from the lowest up. Empty if
    /// the mesh cannot be cut; the certificate has the reason.
    const treeform_cut_piece* pieces;
    size_t count;
    /// The certificate of the first piece that is not ok, or of the mesh if it bounds no solid.
    const treeform_certificate* certificate;
    /// True if faces of the mesh meet. Then the solid that the mesh winds around was cut, with
    /// overlapping parts merged; without caps, the mesh with its faces cut along each other. Not
    /// used by `treeform_cut_along`.
    int32_t resolved;
} treeform_cut_result;

/// The pieces of a mesh below, between and above planes at `heights` above `plane`.
///
/// The side of each vertex is decided exactly, on the coordinates as given. A face in a plane
/// belongs to the piece that it bounds. The section of the solid in a plane becomes a cap, the
/// same on both sides. Only points on cuts are rounded, once; each piece is checked like a result
/// of `treeform_boolean`. Caps perpendicular to an axis stay flat and equal when rounded; others
/// may bend by a unit in the last place.
///
/// `treeform_transfer_attributes` transfers the attributes of a file to pieces.
///
/// With caps, the mesh must bound a solid, like an operand of `treeform_boolean`. If it meets
/// itself, or has parts that are inside out or hidden in others, it is first replaced by the solid
/// that it winds around, rounded; the statements above then hold for that solid. Equal planes
/// count once.
///
/// A null `plane` means z = 0.
TREEFORM_C_API treeform_code treeform_cut(const treeform_mesh* mesh, const treeform_plane* plane,
                                          const double* heights, size_t count,
                                          const treeform_cut_options* options,
                                          treeform_cut_result** result);

/// Pieces that fit into a box of this size. They are cut by planes perpendicular to x, then y,
/// then z: as few as possible for each axis, equally spaced up to rounding, and none for an axis
/// with infinite size. Pieces without faces are omitted; the others are ordered by x, then y, then
/// z. Planes are numbered in the same order. Later cuts cut the rounded pieces of earlier ones.
TREEFORM_C_API treeform_code treeform_cut_to_fit(const treeform_mesh* mesh, const double size[3],
                                                 const treeform_cut_options* options,
                                                 treeform_cut_result** result);

/// A subset of the faces of a mesh, with the points that they use.
typedef struct treeform_mesh_part {
    treeform_arrays mesh;
    const uint32_t* face_source;  ///< [F] the number of each face in the given mesh
    /// [V] the number of each point in the given mesh; ascending
    const uint32_t* vertex_source;
    double volume;  ///< as `treeform_signed_volume`
    double area;    ///< as `treeform_surface_area`
} treeform_mesh_part;

/// Parts of a mesh.
typedef struct treeform_mesh_parts {
    void* owner;
    const treeform_mesh_part* parts;  ///< [count]
    size_t count;
} treeform_mesh_parts;

/// The connected components of a mesh (faces linked by common corners), in the order of their
/// lowest faces; a cavity is returned with the component around it. Parts with a volume below
/// `min_volume` are omitted (open parts have volume 0). If `largest` is not 0, only that many
/// parts are returned, those of the greatest volume.
TREEFORM_C_API treeform_code treeform_components(const treeform_mesh* mesh, double min_volume,
                                                 size_t largest, treeform_mesh_parts** parts);

/// The points and faces of all meshes, one mesh after the other; points are not joined. `index`
/// [F] is the number of each face's mesh.
TREEFORM_C_API treeform_code treeform_concatenate(const treeform_mesh* const* meshes, size_t count,
                                                  treeform_made_mesh** made);

/// The mesh with transformed points. If `by` mirrors, faces are flipped, so that they still point
/// outward.
TREEFORM_C_API treeform_code treeform_transform_mesh(const treeform_mesh* mesh, const double* by,
                                                     treeform_made_mesh** made);
// end
