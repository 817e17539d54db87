#ifndef TREEFORM_C_CUTS_H
#define TREEFORM_C_CUTS_H
/// \file
/// Sections of a mesh by planes, solids cut by them; parts of meshes, meshes one after the other,
/// moved.

#include <treeform/c/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The plane through a point across a normal, whose length does not matter.
typedef struct treeform_plane {
    double at[3];
    double normal[3];
} treeform_plane;

// made of <mesh/section.hpp>:
//   section_loop section_layer section_result
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
// end

/// Sections of a mesh by the planes at `heights` [count] above `plane` (null: through the origin,
/// across z): along its normal at length 1. Null and 0 heights are the plane itself. All topology
/// is decided exactly; a vertex in a plane counts as above it. Of a mesh that is closed and agrees
/// in its orientation, all loops are closed. `progress` may be null.
TREEFORM_C_API treeform_code treeform_section(const treeform_mesh* mesh,
                                              const treeform_plane* plane, const double* heights,
                                              size_t count, treeform_progress progress,
                                              void* progress_data,
                                              treeform_section_result** section);

// made of lists:
//   heights
/// Numbers.
typedef struct treeform_heights {
    void* owner;
    const double* heights;  ///< [count]
    size_t count;
} treeform_heights;
// end

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

// made of <mesh/cut.hpp>:
//   cut_options cut_piece cut_result
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
// end

/// The mesh below, between and above the planes at `heights` [count] above `plane`, as for
/// `treeform_section`: count + 1 pieces, some perhaps without faces, each closed by caps. The mesh
/// has to bound a solid, unless `open` is set. The code is that of the certificate.
TREEFORM_C_API treeform_code treeform_cut(const treeform_mesh* mesh, const treeform_plane* plane,
                                          const double* heights, size_t count,
                                          const treeform_cut_options* options,
                                          treeform_cut_result** result);

/// Pieces that fit into a box of this size (an infinite one is not cut along), by x, then y, then
/// z; planes are numbered in that order.
TREEFORM_C_API treeform_code treeform_cut_to_fit(const treeform_mesh* mesh, const double size[3],
                                                 const treeform_cut_options* options,
                                                 treeform_cut_result** result);

// made of <mesh/cut.hpp>:
//   mesh_part mesh_parts
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
// end

/// The faces that corners link, as meshes, by their lowest faces; a cavity goes with what is around
/// it. Parts of a volume below `min_volume` are left out (open ones have none), and all but the
/// `largest` ones where that is not 0.
TREEFORM_C_API treeform_code treeform_components(const treeform_mesh* mesh, double min_volume,
                                                 size_t largest, treeform_mesh_parts** parts);

/// Points and faces of all meshes, one after the other; nothing is joined. `index` [F] is the mesh
/// that each face is of.
TREEFORM_C_API treeform_code treeform_concatenate(const treeform_mesh* const* meshes, size_t count,
                                                  treeform_made_mesh** made);

/// The mesh with its points moved by `matrix` [12]: 3 rows of 4. Where that mirrors, faces are
/// turned over.
TREEFORM_C_API treeform_code treeform_transform_mesh(const treeform_mesh* mesh,
                                                     const double* matrix,
                                                     treeform_made_mesh** made);

#ifdef __cplusplus
}
#endif
#endif
