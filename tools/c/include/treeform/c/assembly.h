#pragma once
/// \file
/// Bodies of files. Clashes: parts of an assembly that penetrate, touch, or are too close, also in
/// many poses.

#include <treeform/c/files.h>
#include <treeform/c/nearness.h>

/// Which parts of a file are bodies.
typedef int32_t treeform_body_kind;
enum {
    TREEFORM_BODY_FILE = 0,   ///< the whole file
    TREEFORM_BODY_PARTS = 1,  ///< each object, group or node; those with common points are combined
    TREEFORM_BODY_NAMED = 2   ///< each object, group or node, even with common points
};

/// A body of a file.
typedef struct treeform_body {
    const treeform_mesh* mesh;  ///< finite faces, equal corners joined; it belongs to the bodies
    uint32_t file;              ///< number of its file
    const char* name;           ///< name of the part; empty if the file has only one
    const char* label;          ///< for messages: the names of the file and the part
    /// [face_count] number of each face in the file; for a cloud, of each point
    const uint32_t* face_in_file;
    size_t face_count;
} treeform_body;

/// Bodies of files.
typedef struct treeform_bodies {
    void* owner;
    const treeform_body* bodies;         ///< [count]
    const treeform_mesh* const* meshes;  ///< [count] meshes of the bodies
    size_t count;
} treeform_bodies;

// made of the headers of C++:
//   bodies_of() move_in_file() clash_options contact_region part_clash clash_result clash()
//   pairs_named() pose_clash
/// The bodies of `files` [count], for `treeform_clash` and all placements. `labels` [count] are
/// the names of the files in messages. Files are copied.
TREEFORM_C_API treeform_code treeform_bodies_of(const treeform_file* const* files,
                                                const char* const* labels, size_t count,
                                                treeform_body_kind kind, treeform_bodies** bodies);

/// Replaces the body's points in its file by `points` [count][3], the points of a placement,
/// transforms all other points of the file by `matrix` [12], and returns the file. The meshes of
/// the bodies do not change.
TREEFORM_C_API treeform_code treeform_move_in_file(treeform_bodies* bodies, size_t body,
                                                   const double* points, size_t count,
                                                   const double* matrix,
                                                   treeform_precision written_as,
                                                   treeform_file** file);

/// Options of `treeform_clash` and `treeform_check_poses`. Only `treeform_clash` uses `volumes`,
/// `depths`, `effort` and `limit`; only `treeform_check_poses` uses `first_only`.
typedef struct treeform_clash_options {
    size_t struct_size;
    double clearance;    ///< parts nearer than this are too close; not squared
    int32_t first_only;  ///< find only the first clash of each pose
    /// [ignored_count][2] pairs of parts to skip; any order; or null
    const uint32_t* ignored;
    size_t ignored_count;
    treeform_vertex_identity vertices;  ///< which corners are the same vertex
    treeform_progress progress;
    void* progress_data;
    /// Compute the volume of the intersection of closed parts; default 1
    int32_t volumes;
    int32_t depths;   ///< compute depths of penetrating parts; default 1
    uint64_t effort;  ///< limit for each depth, as in `treeform_measure_options`
    /// largest number of faces listed for each region and part; default 1000
    uint64_t limit;
} treeform_clash_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_clash_options_init(treeform_clash_options* options, size_t size);

/// A connected contact of two parts: a set of pairs of faces that meet. Two pairs are linked if
/// they have the face of one part in common, and their faces of the other part share a corner.
typedef struct treeform_contact_region {
    treeform_box box;  ///< contains all common points of the surfaces in this region
    uint64_t face_pairs;
    const uint32_t* faces_a;  ///< [face_count_a] ascending; the first `limit`
    size_t face_count_a;
    const uint32_t* faces_b;  ///< [face_count_b]
    size_t face_count_b;
} treeform_contact_region;

/// Two parts that penetrate, touch, or are closer than the clearance.
typedef struct treeform_part_clash {
    uint32_t a;                       ///< the lower number
    uint32_t b;                       ///< number of the second part
    treeform_mesh_relation relation;  ///< touching, penetrating or too close
    int32_t a_inside_b;               ///< as in `treeform_measure`
    int32_t b_inside_a;               ///< the same with `a` and `b` swapped
    double distance;                  ///< distance of the surfaces; 0 if they meet
    double on_a[3];       ///< for parts that are too close: the nearest point on a; else NaN
    double on_b[3];       ///< the same on b
    uint64_t face_pairs;  ///< pairs of faces that meet
    /// [region_count] ordered by their lowest faces
    const treeform_contact_region* regions;
    size_t region_count;
    /// For closed parts that penetrate: the volume of their intersection; NaN: none
    double volume;
    /// For penetrating parts: `treeform_penetration_depth`, the length of `move`; NaN: none
    double depth;
    double move[3];  ///< a short translation that separates `a` from `b`
    /// of `depth`, as in `treeform_penetration_depth`
    treeform_search_effort depth_effort;
} treeform_part_clash;

/// The result of `treeform_clash`.
typedef struct treeform_clash_result {
    void* owner;
    const treeform_part_clash* pairs;  ///< [count] pairs found, ascending
    size_t count;
    uint64_t counts[5];      ///< number of tested pairs, by `treeform_mesh_relation`
    uint64_t boxes_apart;    ///< pairs excluded by their boxes
    uint64_t ignored;        ///< ignored pairs that boxes do not exclude
    uint64_t parts_indexed;  ///< number of parts with an index
    /// Number of pairs that penetrate or are closer than the clearance; with a clearance, also
    /// pairs that touch.
    uint64_t clashes;
} treeform_clash_result;

/// The relations of all pairs of parts of an assembly.
///
/// Exact, like `treeform_relation`: parts penetrate, touch, or are disjoint. Boxes only exclude
/// pairs: linked rings that do not meet are disjoint, although their boxes overlap. Empty parts
/// are disjoint from all. Distances are those of `treeform_distance`, and only computed with a
/// clearance. A part is only indexed if its box is near that of another.
TREEFORM_C_API treeform_code treeform_clash(const treeform_mesh* const* parts, size_t count,
                                            const treeform_clash_options* options,
                                            treeform_clash_result** result);

/// All pairs of a part whose name matches the pattern `first` and one whose name matches `second`;
/// * matches any characters, ? one character. Two numbers for each pair, for
/// `treeform_clash_options::ignored`.
TREEFORM_C_API treeform_code treeform_pairs_named(const char* const* names, size_t count,
                                                  const char* first, const char* second,
                                                  treeform_indices** indices);

/// Two parts that penetrate, touch, or are closer than the clearance in a pose.
typedef struct treeform_pose_clash {
    uint32_t a;  ///< the lower number
    uint32_t b;
    /// `TREEFORM_RELATION_TOUCHING`, `TREEFORM_RELATION_PENETRATING` or
    /// `TREEFORM_RELATION_CLOSER_THAN_CLEARANCE` (a `treeform_mesh_relation`)
    uint8_t relation;
    double distance;  ///< for parts closer than the clearance; else 0
} treeform_pose_clash;
// end

/// The clashes in each pose: those of pose p are clashes[begin[p]] ... clashes[begin[p + 1] - 1].
typedef struct treeform_poses_result {
    void* owner;
    const size_t* begin;  ///< [pose_count + 1]
    const treeform_pose_clash* clashes;
    size_t pose_count;
    uint64_t clashing;  ///< number of poses in collision
    uint64_t boxes_apart;
    /// [pose_count] 1 for a pose with a pair that penetrates or is too close; with a clearance,
    /// also for one with a pair that touches. Else 0.
    const uint8_t* in_collision;
} treeform_poses_result;

// made of the headers of C++:
//   check_poses()
/// The clashes in each of many poses: `poses` [pose_count][count][12] has a matrix for each part,
/// pose after pose. Exact for the moved corners, rounded to double.
TREEFORM_C_API treeform_code treeform_check_poses(const treeform_mesh* const* parts, size_t count,
                                                  const double* poses, size_t pose_count,
                                                  const treeform_clash_options* options,
                                                  treeform_poses_result** result);
// end
