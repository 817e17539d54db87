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

/// A closed polygon, or, where the mesh ends, an open polyline.
typedef struct treeform_section_loop {
    size_t first_point;  ///< its points follow one another; the first is not repeated
    size_t point_count;
    uint8_t closed;
    uint8_t oriented;  ///< faces agree: what is inside is to the left, seen from above the plane
    uint32_t parent;   ///< the innermost loop around it; `TREEFORM_NONE` for none
    uint32_t depth;    ///< how many loops are around it
    double area;       ///< positive where it runs counter-clockwise; 0 for open ones
    double length;
} treeform_section_loop;

/// What is in one plane.
typedef struct treeform_section_layer {
    double height;
    double at[3];         ///< of its plane
    uint32_t first_loop;  ///< its loops follow one another
    uint32_t loop_count;
    uint32_t open_count;  ///< of these, open polylines
    double area;          ///< of its loops, added up
    double length;
} treeform_section_layer;

/// Sections, in the order of their heights as given.
typedef struct treeform_section_result {
    void* owner;
    const treeform_section_layer* layers;  ///< [layer_count]
    size_t layer_count;
    const treeform_section_loop* loops;  ///< [loop_count]
    size_t loop_count;
    const double* points;   ///< [point_count][2] in the frame: (x . p, y . p) of p in space
    const uint32_t* faces;  ///< [point_count] the face that the side from each point on lies in
    size_t point_count;
    double x[3], y[3], normal[3];  ///< the frame: axes of length 1, right-handed
} treeform_section_result;

/// Sections of a mesh by the planes at `heights` [count] above `plane` (null: through the origin,
/// across z): along its normal at length 1. Null and 0 heights are the plane itself. All topology
/// is decided exactly; a vertex in a plane counts as above it. Of a mesh that is closed and agrees
/// in its orientation, all loops are closed. `progress` may be null.
TREEFORM_C_API treeform_code treeform_section(const treeform_mesh* mesh,
                                              const treeform_plane* plane, const double* heights,
                                              size_t count, treeform_progress progress,
                                              void* progress_data,
                                              treeform_section_result** section);

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
TREEFORM_C_API treeform_code treeform_write_section(const char* path,
                                                    const treeform_section_result* section,
                                                    const char* format);

/// How to cut.
typedef struct treeform_cut_options {
    size_t size;
    treeform_precision precision;  ///< of the coordinates returned; default: double
    int32_t open;                  ///< cut a surface, which may end anywhere, and make no caps
    double max_displacement;       ///< as of `treeform_boolean_options`; default infinite
    int32_t keep_cuts;             ///< of a mesh that meets itself, do not merge what was cut
    treeform_progress progress;
    void* progress_data;
} treeform_cut_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_cut_options_init(treeform_cut_options* options, size_t size);

/// What is between two planes.
typedef struct treeform_cut_piece {
    treeform_arrays mesh;
    const uint32_t*
        face_source;  ///< [F] the input's face that each lies in; `TREEFORM_NONE`: a cap
    const uint32_t* vertex_source;  ///< [V] the input's vertex that each is; `TREEFORM_NONE`: new
    const uint32_t* cap;            ///< [F] of a cap, the number of its plane; else `TREEFORM_NONE`
    const treeform_certificate* certificate;
} treeform_cut_piece;

/// Pieces, and what was checked.
typedef struct treeform_cut_result {
    void* owner;
    const treeform_cut_piece* pieces;  ///< [count]
    size_t count;
    const treeform_certificate* certificate;  ///< of the first piece that is not ok, or of the mesh
} treeform_cut_result;

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

/// Faces of a mesh by themselves.
typedef struct treeform_mesh_part {
    treeform_arrays mesh;
    const uint32_t* face_source;    ///< [F] the number of each face in the whole
    const uint32_t* vertex_source;  ///< [V] that of each point; ascending
    double volume;
    double area;
} treeform_mesh_part;

/// Parts of a mesh.
typedef struct treeform_mesh_parts {
    void* owner;
    const treeform_mesh_part* parts;  ///< [count]
    size_t count;
} treeform_mesh_parts;

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
