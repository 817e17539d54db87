#ifndef TREEFORM_C_WELD_H
#define TREEFORM_C_WELD_H
/// \file
/// Points that are within a distance of each other become one: of clouds, meshes and files.

#include <treeform/c/files.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Which points become one.
typedef int32_t treeform_weld_rule;
enum {
    TREEFORM_WELD_FIRST = 0,  ///< a point goes to the nearest earlier kept one within the tolerance
    TREEFORM_WELD_CHAIN = 1   ///< all points linked by steps of at most the tolerance
};

/// Which point of a group is kept.
typedef int32_t treeform_weld_keep;
enum {
    TREEFORM_KEEP_FIRST = 0,
    TREEFORM_KEEP_LAST = 1,
    TREEFORM_KEEP_MEAN = 2,
    TREEFORM_KEEP_LOWEST = 3,  ///< by the property `keep_by`
    TREEFORM_KEEP_HIGHEST = 4
};

/// In which order the rules go through the points.
typedef int32_t treeform_weld_order;
enum {
    TREEFORM_ORDER_GIVEN = 0,
    TREEFORM_ORDER_LOWEST = 1,  ///< by the property `order_by`
    TREEFORM_ORDER_HIGHEST = 2
};

/// A vertex property that must agree, up to a tolerance, for two points to become one.
typedef struct treeform_weld_condition {
    const char* property;
    double tolerance;
} treeform_weld_condition;

/// How to weld. Options of properties are for files.
typedef struct treeform_weld_options {
    size_t size;
    double tolerance;  ///< Euclidean, inclusive; 0, the default: equal coordinates
    treeform_weld_rule rule;
    const uint32_t*
        label;  ///< [label_count] points with different labels are never merged; or null
    size_t label_count;
    /// Whether two points may be merged; or null. Symmetric; called from several threads at once.
    int (*may_merge)(uint32_t a, uint32_t b, void* data);
    void* may_merge_data;
    const treeform_weld_condition* same;  ///< [same_count] properties that must agree
    size_t same_count;
    int32_t keep_seams;         ///< normals, texture coordinates and colors must agree
    const char* const* across;  ///< [across_count] except for these
    size_t across_count;
    treeform_weld_keep keep;
    const char* keep_by;
    treeform_weld_order order;
    const char* order_by;
    int32_t only_borders;     ///< merge only points on edges of exactly one face
    int32_t keep_manifold;    ///< do not make edges or points non-manifold
    int32_t keep_degenerate;  ///< keep faces that repeat a corner
    treeform_progress progress;
    void* progress_data;
} treeform_weld_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_weld_options_init(treeform_weld_options* options, size_t size);

/// What was merged.
typedef struct treeform_weld_result {
    void* owner;
    treeform_arrays mesh;            ///< of a cloud without faces
    const uint32_t* group_of_point;  ///< [point_count] the new number of each input point
    size_t point_count;
    const uint32_t* first_of_group;  ///< [G] the first point of each
    const uint32_t* point_of_group;  ///< [G] the input point that gave its properties; or null
    size_t group_count;
    const uint32_t* face_of_new;  ///< [F] the input face that each face was
    uint64_t merged_groups;       ///< groups of two points or more
    uint64_t non_finite;          ///< points left as they are
    uint64_t collapsed;           ///< faces that repeat a corner now, but did not before
    uint64_t degenerate;          ///< faces that repeated a corner before
    double max_displacement;      ///< the furthest that a point moved
    uint64_t nonmanifold_before;  ///< edges of more than two faces
    uint64_t nonmanifold_after;
    uint64_t flipped;           ///< faces whose normal turned by more than a right angle
    uint64_t left_alone;        ///< groups that `keep_manifold` did not merge whole
    const treeform_file* file;  ///< of `treeform_weld_file`; else null
} treeform_weld_result;

/// The mesh or cloud with the points merged that are within the tolerance of each other: exact.
TREEFORM_C_API treeform_code treeform_weld(const treeform_mesh* mesh,
                                           const treeform_weld_options* options,
                                           treeform_weld_result** result);

/// A file welded, with its attributes, parts and names.
TREEFORM_C_API treeform_code treeform_weld_file(const treeform_file* file,
                                                const treeform_weld_options* options,
                                                treeform_weld_result** result);

/// Only the groups of the points of a mesh or cloud: `mesh` of the result is empty.
TREEFORM_C_API treeform_code treeform_group_points(const treeform_mesh* mesh,
                                                   const treeform_weld_options* options,
                                                   treeform_weld_result** result);

/// How many points would go if those within `distance` were joined, beyond those equal to another.
TREEFORM_C_API treeform_code treeform_count_nearly_equal(const treeform_mesh* mesh, double distance,
                                                         uint64_t* count);

/// How many points of a welded file would be merged if it were written with this precision, read
/// and welded again; `known` is 0 where points stay apart on purpose.
TREEFORM_C_API treeform_code treeform_count_still_within(const treeform_file* welded,
                                                         const treeform_weld_options* options,
                                                         treeform_precision written_as,
                                                         uint64_t* count, int32_t* known);

/// Sets the flag "withheld" of LAS at the points of `file` that `welded`, made of it, does not
/// keep.
TREEFORM_C_API treeform_code treeform_withhold(treeform_file* file,
                                               const treeform_weld_result* welded);

#ifdef __cplusplus
}
#endif
#endif
