#pragma once
/// \file
/// Intersections of faces: of one mesh, of two meshes, of a mesh and a box; intersection curves;
/// files larger than memory.

#include <treeform/c/files.h>

/// Segments in which pairs of faces meet: pair i has the segments begin[i] ... begin[i + 1] - 1.
typedef struct treeform_segments {
    void* owner;
    const size_t* begin;  ///< [count + 1]
    /// [begin[count]][2][3] ends of the segments; equal if the faces meet in a point
    const double* ends;
    size_t count;  ///< pairs
} treeform_segments;

// made of the headers of C++:
//   pair_kind
/// How two faces meet, one kind a pair. A shared corner is a corner of both
/// (`treeform_vertex_identity`).
typedef int32_t treeform_pair_kind;
enum {
    /// no shared corner; the interiors pass through each other
    TREEFORM_CROSSING = 0,
    /// at most one shared corner; coplanar, with a common area
    TREEFORM_OVERLAP = 1,
    /// a shared edge; coplanar, on the same side of it
    TREEFORM_FOLD = 2,
    /// the same three corners, in either orientation
    TREEFORM_DUPLICATE = 3,
    /// one shared corner; the interiors pass through each other
    TREEFORM_PIERCE = 4,
    /// contact without crossing: a point or a segment on the rim of one face
    TREEFORM_TOUCHING = 5,
    /// the faces meet, and one of them has no area
    TREEFORM_DEGENERATE = 6
};
/// The name of a value, as in reports: "crossing"; "unknown" for others.
TREEFORM_C_API const char* treeform_pair_kind_name(treeform_pair_kind value);
// end

/// All kinds. A set of kinds is a sum of `1u << kind`.
#define TREEFORM_ALL_KINDS 127u

// made of the headers of C++:
//   face_pair face_pair_result face_pair_options self_intersections() intersection_region
//   regions group_pairs() mesh_intersections() intersects() intersects_poses() faces_in_box()
//   intersection_curves() curve_path curve_network intersection_paths() write_curves()
//   color_pairs() file_search_options file_search_result self_intersections_of_file()
//   is_searched_in_tiles()
/// Two faces that meet.
typedef struct treeform_face_pair {
    uint32_t a;  ///< the lower face number
    uint32_t b;
    uint8_t kind;  ///< how they meet (a `treeform_pair_kind`)
} treeform_face_pair;

/// Pairs of faces that meet.
typedef struct treeform_face_pair_result {
    void* owner;
    /// [count] ascending by (a, b); for two meshes, `a` is a face of the first
    const treeform_face_pair* pairs;
    size_t count;
    uint64_t counts[7];  ///< by kind
    uint64_t box_pairs;  ///< pairs of faces whose boxes overlap, as moved
} treeform_face_pair_result;

/// Which pairs to search for, and the positions of meshes. Each function ignores the options that
/// do not concern it.
typedef struct treeform_face_pair_options {
    size_t struct_size;
    /// [12] `treeform_mesh_intersections`: applied to `a` first (`transform_b`: to `b`). The
    /// answer is exact for the moved corners, which are rounded to double. The mesh itself is not
    /// changed; or null
    const double* transform_a;
    const double* transform_b;  ///< [12]; or null
    int32_t first_only;         ///< only the first pair; the same on any number of threads
    uint32_t kinds;             ///< kinds to find; other pairs are neither counted nor listed
    /// list at most this many pairs, the lowest; all are counted; default all
    uint64_t limit;
    treeform_progress progress;
    void* progress_data;
    /// For `treeform_self_intersections`: which corners count as shared.
    treeform_vertex_identity vertices;
    const uint32_t* component_of_face;  ///< [F] for `between` and `within`; or null
    int32_t between;                    ///< only pairs of faces of different components
    int32_t within;                     ///< only pairs of faces of one component
} treeform_face_pair_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_face_pair_options_init(treeform_face_pair_options* options,
                                                    size_t size);

/// All pairs of faces that meet in a point that is neither a shared corner nor on a shared edge.
/// Exact on the coordinates as given.
TREEFORM_C_API treeform_code treeform_self_intersections(const treeform_mesh* mesh,
                                                         const treeform_face_pair_options* options,
                                                         treeform_face_pair_result** result);

/// A connected set of faces that meet.
typedef struct treeform_intersection_region {
    const uint32_t* faces;  ///< [face_count] ascending
    size_t face_count;
    double min[3];  ///< box of these faces
    double max[3];
    /// [pair_count] numbers of its pairs in the list of pairs, ascending
    const uint32_t* pairs;
    size_t pair_count;
} treeform_intersection_region;

/// Regions, in the order of their lowest faces.
typedef struct treeform_regions {
    void* owner;
    const treeform_intersection_region* regions;  ///< [count]
    size_t count;
} treeform_regions;

/// Groups the faces in `pairs` into regions, in the order of their lowest faces. Two of these
/// faces are in one region if a pair or a shared corner links them, directly or through other
/// faces of `pairs`.
TREEFORM_C_API treeform_code treeform_group_pairs(const treeform_mesh* mesh,
                                                  const treeform_face_pair* pairs, size_t count,
                                                  treeform_regions** regions);

/// All pairs of a face of `a` and a face of `b` that have a common point.
///
/// Exact on the coordinates as given, or as moved. The kinds are crossing, overlap, touching and
/// degenerate: two meshes share no corners, so faces that meet in equal corners are
/// `TREEFORM_TOUCHING`, and equal faces `TREEFORM_OVERLAP`. Surfaces count, not solids: a mesh
/// inside the other that does not touch it gives no pair. `a` and `b` may be the same mesh. For
/// meshes without an index, only the faces that reach into the intersection of both bounding boxes
/// (after the transforms) are indexed.
TREEFORM_C_API treeform_code treeform_mesh_intersections(const treeform_mesh* a,
                                                         const treeform_mesh* b,
                                                         const treeform_face_pair_options* options,
                                                         treeform_face_pair_result** result);

/// Whether a face of `a` and a face of `b` have a common point, each moved by a matrix (null: not
/// moved); exact.
TREEFORM_C_API treeform_code treeform_intersects(const treeform_mesh* a, const treeform_mesh* b,
                                                 const double* transform_a,
                                                 const double* transform_b, int32_t* result);

/// The same for many positions, in parallel: `transforms_a` and `transforms_b` are [count][12], or
/// null if the mesh is not moved; `meet` is [count]. Surfaces count; for solids,
/// `treeform_check_poses`.
TREEFORM_C_API treeform_code treeform_intersects_poses(const treeform_mesh* a,
                                                       const treeform_mesh* b,
                                                       const double* transforms_a,
                                                       const double* transforms_b, size_t count,
                                                       uint8_t* meet);

/// The faces, ascending, that have a point in the closed box; exact.
TREEFORM_C_API treeform_code treeform_faces_in_box(const treeform_mesh* mesh,
                                                   const treeform_box* box,
                                                   treeform_indices** indices);

/// [pairs] The intersection of each pair as segments, by their ends: one segment for a crossing,
/// the 3 to 6 sides of the common area for faces that overlap, a segment of length 0 for a single
/// point, none for faces that do not meet.
///
/// Whether there is a segment is exact. Its ends are rounded, and finite.
TREEFORM_C_API treeform_code treeform_intersection_curves(const treeform_mesh* mesh,
                                                          const treeform_face_pair* pairs,
                                                          size_t count,
                                                          treeform_segments** segments);

/// A path of different points, each joined to the next by a segment.
typedef struct treeform_curve_path {
    /// [count] numbers in `treeform_curve_network::points`; one or more
    const uint32_t* points;
    size_t count;
    int32_t closed;  ///< a segment leads from the last point to the first
} treeform_curve_path;

/// All curves of a mesh.
typedef struct treeform_curve_network {
    void* owner;
    const double* points;  ///< [point_count][3]
    size_t point_count;
    /// [path_count] Open paths come first. At each end of an open path, no other segment ends, or
    /// at least two others do. Then closed paths. Last single points: contacts of faces that are
    /// on no segment.
    const treeform_curve_path* paths;
    size_t path_count;
} treeform_curve_network;

/// The segments of `treeform_intersection_curves`, joined into paths where their ends are equal as
/// exact points.
///
/// A segment common to several pairs is listed once. Points are in the order of the edges and
/// faces that define them, paths by the number of their first point. Pairs of kind `degenerate`
/// are skipped: a face without area defines no curve.
TREEFORM_C_API treeform_code treeform_intersection_paths(const treeform_mesh* mesh,
                                                         const treeform_face_pair* pairs,
                                                         size_t count,
                                                         treeform_curve_network** network);

/// Writes the intersection curves of pairs as lines, OBJ or PLY, by `format` or, if null, by the
/// extension of `path`.
TREEFORM_C_API treeform_code treeform_write_curves(const char* path, const treeform_mesh* mesh,
                                                   const treeform_face_pair* pairs, size_t count,
                                                   const char* format);

/// Colors the faces of `file` that meet, and gives faces the properties tf_class and tf_region.
/// `part` is the part of this file that was searched, and `pairs` are pairs of faces of its mesh.
TREEFORM_C_API treeform_code treeform_color_pairs(treeform_file* file,
                                                  const treeform_usable_mesh* part,
                                                  const treeform_face_pair* pairs, size_t count);

/// Options of `treeform_self_intersections_of_file` and `treeform_shared_search`.
typedef struct treeform_file_search_options {
    size_t struct_size;
    /// a `treeform_vertex_identity`; -1: by coordinates for STL, else by index
    int32_t vertices;
    uint32_t kinds;
    const treeform_box* box;  ///< only faces that have a point in the box; or null
    const char* format;       ///< format of the input, as for `treeform_read`
    uint64_t memory;          ///< limit in bytes; 0: three quarters of the machine's memory
    const char* folder;       ///< for the tiles; empty: the input's name and ".search-tiles"
    uint64_t faces_per_tile;  ///< approximate limit; 0: as the memory allows
    treeform_progress progress;
    void* progress_data;
    /// not for `treeform_shared_search`; or null
    const treeform_communicator* communicator;
} treeform_file_search_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_file_search_options_init(treeform_file_search_options* options,
                                                      size_t size);

/// The pairs found in a file.
typedef struct treeform_file_search_result {
    void* owner;
    treeform_arrays mesh;          ///< only the intersecting faces
    const uint32_t* face_in_file;  ///< [F] number of each face in the file
    /// Pairs of faces of `mesh`. Its counters are sums over the tiles.
    const treeform_face_pair_result* found;
    uint64_t stored_faces;  ///< faces of the file
    uint64_t triangles;     ///< triangles of these faces
    uint64_t searched;      ///< finite triangles that meet the box
    uint64_t points;        ///< points of the file; for STL three for each face
    uint64_t degenerate;    ///< number of triangles without area
    size_t tiles;
    size_t finished_tiles;  ///< tiles finished by an earlier run
    uint64_t non_finite;    ///< number of triangles that are not finite
} treeform_file_search_result;

/// The pairs that `treeform_self_intersections` finds in the usable part of a file, for files
/// larger than memory: binary STL, and PLY with vertices before faces. Space is cut into tiles.
/// Each tile gets a copy, on the disk, of the faces that reach into it; they must fit into memory.
/// A pair counts once: in the tile that contains the lowest corner of the intersection of its
/// faces' boxes.
///
/// If the process is killed, the folder stays, and the same call resumes there. With several
/// ranks, rank 0 makes the tiles, all ranks search them, and rank 0 gets the result.
TREEFORM_C_API treeform_code
treeform_self_intersections_of_file(const char* input, const treeform_file_search_options* options,
                                    treeform_file_search_result** result);

/// Whether the file has a format that can be searched in tiles; an error if it cannot be read, or
/// its header is damaged. `format` may be null.
TREEFORM_C_API treeform_code treeform_is_searched_in_tiles(const char* path, const char* format,
                                                           int32_t* result);
// end

/// The search of a file step by step, for many processes that share a folder.
typedef struct treeform_shared_search treeform_shared_search;
// made of the headers of C++:
//   shared_search_create() shared_search_scatter() shared_search_tiles()
//   shared_search_unfinished() shared_search_tile() shared_search_finish()
//   shared_search_remove_folder()
/// Begins a search. All processes must pass the same input and options, except for `progress`.
TREEFORM_C_API treeform_code treeform_shared_search_create(
    const char* path, const treeform_file_search_options* options, treeform_shared_search** search);

/// Writes the faces of each tile, unless already done. `result`, which may be null, is the number
/// of tiles. Called by one process.
TREEFORM_C_API treeform_code treeform_shared_search_scatter(treeform_shared_search* search,
                                                            size_t* result);

/// Number of tiles; an error if no process has completed `scatter`.
TREEFORM_C_API treeform_code treeform_shared_search_tiles(treeform_shared_search* search,
                                                          size_t* result);

/// Numbers of the tiles that are not finished.
TREEFORM_C_API treeform_code treeform_shared_search_unfinished(treeform_shared_search* search,
                                                               treeform_indices** indices);

/// Searches a tile, unless it is finished. Each process calls it for its share of the tiles.
TREEFORM_C_API treeform_code treeform_shared_search_tile(treeform_shared_search* search,
                                                         size_t tile);

/// Combines the results of all tiles; an error unless all tiles are finished. A step that is
/// called too early fails, and ends the search.
TREEFORM_C_API treeform_code treeform_shared_search_finish(treeform_shared_search* search,
                                                           treeform_file_search_result** result);

/// Removes the folder of the tiles.
TREEFORM_C_API treeform_code treeform_shared_search_remove_folder(treeform_shared_search* search);
// end
