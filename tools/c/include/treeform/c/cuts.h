#ifndef TREEFORM_C_CUTS_H
#define TREEFORM_C_CUTS_H
/// \file
/// Sections of a mesh by planes.

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

/// Sections of a mesh by the planes at `heights` [count] above `plane` (null: through the origin, across
/// z): along its normal at length 1. Null and 0 heights are the plane itself. All topology is decided
/// exactly; a vertex in a plane counts as above it. Of a mesh that is closed and agrees in its orientation,
/// all loops are closed. `progress` may be null.
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

/// Heights above `plane` (null: as above) of the middles of layers of this thickness, from the lowest point
/// of the mesh to the highest.
TREEFORM_C_API treeform_code treeform_layer_heights(const treeform_mesh* mesh,
                                                    const treeform_plane* plane, double thickness,
                                                    treeform_heights** heights);

/// Writes sections as svg, dxf, obj or json: `format`, or by the extension where that is null.
TREEFORM_C_API treeform_code treeform_write_section(const char* path,
                                                    const treeform_section_result* section,
                                                    const char* format);

#ifdef __cplusplus
}
#endif
#endif
