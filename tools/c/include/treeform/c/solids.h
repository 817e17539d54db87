#pragma once
/// \file
/// Solids: set operations, resolved self-intersections, repair.
///
/// These functions return `TREEFORM_OK` if the certificate of the result is ok; with
/// `treeform_repair_options::sheet`, also if its status is `TREEFORM_STATUS_SHEET`. Otherwise they
/// return `TREEFORM_NOT_CERTIFIED`, also with a result, which must be freed.

#include <treeform/c/files.h>

// made of the headers of C++:
//   fill_rule boolean_options operand_volumes boolean_result boolean() boolean_named()
//   names_in() unite() difference() intersection() symmetric_difference() unite_all()
//   difference_all() clip() split() resolve_mode resolve_options repair_statistics
//   repair_result resolve_self_intersections() repair_options repair() repair_file()
//   solid_defects find_solid_defects() find_solid_defects_of_file()
/// Which points are inside an operand, by how often its surface winds around them.
typedef int32_t treeform_fill_rule;
enum {
    /// any number of times except 0
    TREEFORM_NONZERO = 0,
    /// an odd number of times
    TREEFORM_EVEN_ODD = 1,
    /// once or more
    TREEFORM_POSITIVE = 2
};

/// How to combine solids.
typedef struct treeform_boolean_options {
    size_t struct_size;
    treeform_fill_rule fill_rule;  ///< what is inside
    /// Precision of the coordinates returned. float32 values are stored as doubles; default
    /// `TREEFORM_FLOAT64`
    treeform_precision precision;
    /// Where rounding makes faces meet, points are joined, but only if they are at most this far
    /// apart, in the mesh's length unit, and at most 2^-10 of the largest coordinate. Not
    /// negative; default infinite
    double max_displacement;
    /// Do not merge coplanar faces that were cut, or that overlap. By default they are merged
    /// before rounding, which removes vertices inside a flat region and on straight edges between
    /// two regions. Uncut faces are not changed.
    int32_t keep_cuts;
    /// merge all coplanar faces of the result, also those not cut
    int32_t merge_coplanar;
    /// Compute `treeform_boolean_result::volumes`; only for two operands, without filled gaps.
    int32_t volumes;
    /// [F of all operands, in order] or empty: only faces of the same group are merged; or null
    const uint32_t* face_groups;
    size_t face_group_count;
    treeform_progress progress;
    void* progress_data;
    /// Parts of the result with a smaller volume, in cubic units, are removed: small solids are
    /// dropped, and small voids are filled, with all that is in them. A part is connected by
    /// edges; its volume is the volume that it encloses. For solids only. Finite and not negative.
    double min_volume;
    /// In a union, fills gaps of at most this width, in the mesh's length unit, between faces of
    /// different operands that face each other across the gap, at an angle of at most 45 degrees.
    /// The width is measured along the normal of either face. Nothing else moves. Where the gap is
    /// wider, the filling tapers off. At an edge between faces that differ by less than 45
    /// degrees, the fillings of both meet midway, without a seam. Finite and not negative.
    double gap;
} treeform_boolean_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_boolean_options_init(treeform_boolean_options* options, size_t size);

/// The volumes of two operands, their union and intersection: first + second = either + both.
typedef struct treeform_operand_volumes {
    /// The magnitude of `treeform_signed_volume`, for an operand that winds once around its
    /// inside. For others the sum over the cells inside, like the volumes below.
    double first;
    double second;
    double either;  ///< in the first or the second
    double both;    ///< in the first and in the second
} treeform_operand_volumes;

/// The surface of a solid in rounded coordinates, with its sources and certificate.
typedef struct treeform_boolean_result {
    void* owner;
    /// Faces are counter-clockwise from outside, in the order of their sources. Vertices of
    /// operands come first, in their order, then new ones on cuts.
    treeform_arrays mesh;
    /// [F] the lowest operand face that contains each face or a part of it. Where rounding made
    /// faces meet, it may be a neighbor of that face. For a face that fills a `gap`, it is the
    /// operand face at or opposite to it; such faces come last.
    const treeform_operand_element* face_source;
    /// [V] the lowest operand vertex equal to each vertex, or `TREEFORM_NONE`
    const treeform_operand_element* vertex_source;
    /// [V] for each new vertex, an operand face that contains it; in a filled `gap`, as in
    /// `face_source`. Empty with `keep_cuts`.
    const treeform_operand_element* face_of_cut_vertex;
    /// Status ok means, verified on the coordinates of `mesh`: any two faces share a corner, an
    /// edge or nothing; no face is degenerate; the signed face count of every edge is zero; and
    /// the inside is behind every face: the surface winds once around points just behind the face,
    /// and not around those in front.
    const treeform_certificate* certificate;
    /// Components of the exact result that have no face left, being too thin for the coordinates.
    uint64_t vanished_components;
    /// The largest distance from `mesh` to a removed vertex of the exact result. It is large if a
    /// component lost a part too thin for the coordinates.
    double vanished_distance;
    /// [vanished_listed][3] one point of each vanished component; at most 100
    const double* vanished_at;
    size_t vanished_listed;
    const treeform_operand_volumes* volumes;
    uint64_t pairs;       ///< pairs of tested faces that meet beyond shared corners
    uint64_t cut_faces;   ///< input faces that were cut or covered by others
    uint64_t degenerate;  ///< input faces without area
    /// input faces skipped, since the result cannot contain them
    uint64_t skipped_faces;
    /// If all pieces are kept: input faces that are entirely covered by faces with lower numbers.
    uint64_t covered;
    /// Faces of the exact result, before rounding. If not 0 while `mesh` has no faces, all of the
    /// result was too thin for the coordinates, or removed as `small_parts`.
    uint64_t exact_faces;
    uint64_t split_vertices;  ///< added where parts touch, so that edges have two faces
    /// how often faces that still met were cut and rounded again
    int32_t rounding_rounds;
    uint64_t small_parts;   ///< number of solids and voids removed by `min_volume`
    double small_volume;    ///< their total volume, in cubic units
    uint64_t filled_faces;  ///< faces of operands at filled gaps (`gap`)
    /// Number of changes that joined points or removed thin faces where rounding made faces meet.
    uint64_t rounding_repairs;
} treeform_boolean_result;

/// The solid that `expression` defines over the `operands` [count]: a formula of a, b, c, ... with
/// + or | union, * or & intersection, - difference, ^ symmetric difference, and parentheses:
/// "(a-b)*c". Exact, then rounded and checked. Operands are not copied. Each must bound a solid.
TREEFORM_C_API treeform_code treeform_boolean(const treeform_mesh* const* operands, size_t count,
                                              const char* expression,
                                              const treeform_boolean_options* options,
                                              treeform_boolean_result** result);

/// The same with `names` [count] instead of letters: "body-(bolt_1+'left bolt')".
TREEFORM_C_API treeform_code treeform_boolean_named(const treeform_mesh* const* operands,
                                                    const char* const* names, size_t count,
                                                    const char* expression,
                                                    const treeform_boolean_options* options,
                                                    treeform_boolean_result** result);

/// The names in a formula, each once, in the order of first use.
TREEFORM_C_API treeform_code treeform_names_in(const char* expression, treeform_strings** strings);

/// Union: points in `a` or `b`.
TREEFORM_C_API treeform_code treeform_unite(const treeform_mesh* a, const treeform_mesh* b,
                                            const treeform_boolean_options* options,
                                            treeform_boolean_result** result);

/// Points in `a` but not in `b`.
TREEFORM_C_API treeform_code treeform_difference(const treeform_mesh* a, const treeform_mesh* b,
                                                 const treeform_boolean_options* options,
                                                 treeform_boolean_result** result);

/// Intersection: points in `a` and in `b`.
TREEFORM_C_API treeform_code treeform_intersection(const treeform_mesh* a, const treeform_mesh* b,
                                                   const treeform_boolean_options* options,
                                                   treeform_boolean_result** result);

/// Symmetric difference: points in exactly one of `a` and `b`.
TREEFORM_C_API treeform_code treeform_symmetric_difference(const treeform_mesh* a,
                                                           const treeform_mesh* b,
                                                           const treeform_boolean_options* options,
                                                           treeform_boolean_result** result);

/// The union of all `operands` [count], without a formula.
TREEFORM_C_API treeform_code treeform_unite_all(const treeform_mesh* const* operands, size_t count,
                                                const treeform_boolean_options* options,
                                                treeform_boolean_result** result);

/// Points in `a` (operand 0) but in none of `others` [count] (operands 1, 2, ...).
TREEFORM_C_API treeform_code treeform_difference_all(const treeform_mesh* a,
                                                     const treeform_mesh* const* others,
                                                     size_t count,
                                                     const treeform_boolean_options* options,
                                                     treeform_boolean_result** result);

/// An open surface cut by solids: the pieces of operand number `sheet` for which `expression` is
/// true. With the sheet as a, "a-b" keeps the pieces outside of b, and "a*b" those inside.
TREEFORM_C_API treeform_code treeform_clip(const treeform_mesh* const* operands, size_t count,
                                           uint32_t sheet, const char* expression,
                                           const treeform_boolean_options* options,
                                           treeform_boolean_result** result);

/// All faces of the operands, cut along each other and along themselves, each piece once. Any two
/// pieces share a corner, an edge or nothing. Operands need not bound solids, and the certificate
/// does not check edges. Where faces overlap, one piece stands for all; its source is the lowest
/// of them. Coplanar pieces are not merged.
TREEFORM_C_API treeform_code treeform_split(const treeform_mesh* const* operands, size_t count,
                                            const treeform_boolean_options* options,
                                            treeform_boolean_result** result);

/// What to do with faces that meet.
typedef int32_t treeform_resolve_mode;
enum {
    /// cut them along the curves where they meet, and keep every piece
    TREEFORM_RESOLVE_SPLIT = 0,
    /// cut them, and keep only the pieces that bound the solid
    TREEFORM_RESOLVE_OUTER = 1,
    /// delete them, and fill the holes
    TREEFORM_RESOLVE_REMOVE = 2
};

/// How to resolve self-intersections.
typedef struct treeform_resolve_options {
    size_t struct_size;
    /// for `TREEFORM_RESOLVE_OUTER`: the rule that defines the inside
    treeform_fill_rule fill_rule;
    /// Precision of the coordinates returned. float32 values are stored as doubles; default
    /// `TREEFORM_FLOAT64`
    treeform_precision precision;
    /// For `TREEFORM_RESOLVE_SPLIT` and `TREEFORM_RESOLVE_OUTER`: as in
    /// `treeform_boolean_options`; default infinite
    double max_displacement;
    /// for `TREEFORM_RESOLVE_REMOVE`: also delete faces that only touch
    int32_t touching;
    /// for `TREEFORM_RESOLVE_REMOVE`: largest number of rounds that make or widen holes; default
    /// 16
    int32_t removal_rounds;
    /// For `TREEFORM_RESOLVE_OUTER` and `TREEFORM_RESOLVE_REMOVE`: losing more than this share
    /// gives the status `TREEFORM_STATUS_EXCESSIVE_LOSS`. The share is of the volume of the solid,
    /// or of the area if the mesh bounds none. 1 allows any loss. The loss is measured from the
    /// solid that `treeform_repair` makes without filling holes; default 0.05
    double max_loss;
    treeform_progress progress;
    void* progress_data;
    /// for `TREEFORM_RESOLVE_OUTER`: as in `treeform_boolean_options`; `TREEFORM_RESOLVE_SPLIT`
    /// keeps all cuts
    int32_t keep_cuts;
} treeform_resolve_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_resolve_options_init(treeform_resolve_options* options, size_t size);

/// Counts of each step's changes. Closed gaps, chosen orientations, filled holes and labeled cells
/// are heuristic.
typedef struct treeform_repair_statistics {
    uint64_t tetrahedra;      ///< tetrahedra formed by faces; only their boundary was kept
    uint64_t degenerate;      ///< dropped faces without area, and slivers dropped with them
    uint64_t repeated;        ///< faces that repeat another, dropped
    uint64_t closed_edges;    ///< pairs of border edges joined into one edge
    uint64_t split_edges;     ///< border edges split at vertices that lie on them
    uint64_t flipped;         ///< faces flipped to agree with their neighbors
    uint64_t strays;          ///< faces of loose and inner pieces, dropped
    uint64_t holes;           ///< holes filled
    uint64_t hole_edges;      ///< edges around them
    uint64_t filled;          ///< faces that fill them
    uint64_t unfilled_rims;   ///< rims not filled, since they are borders of sheets
    uint64_t open_edges;      ///< open edges left after these steps
    int32_t resolved;         ///< whether faces met and were cut
    uint64_t pairs;           ///< pairs of faces that met
    uint64_t labeled_cells;   ///< cells labeled inside or outside, since faces disagreed
    double dropped_area;      ///< area of faces dropped: equal labels on both sides
    double flipped_area;      ///< area of faces flipped by the labels
    uint64_t removed;         ///< input faces that resolving removed entirely
    uint64_t split_vertices;  ///< vertices split where parts of the solid touch
    uint64_t detached;        ///< vertices moved apart
    uint64_t touching;        ///< vertices that still have the coordinates of another
    /// Components (faces linked by vertices) that lost all of their faces; for `treeform_repair`,
    /// only those larger than `treeform_repair_options::stray_share`.
    uint64_t vanished_components;
    /// closed shells inside the solid, dropped; `TREEFORM_EVEN_ODD` makes them cavities
    uint64_t dropped_shells;
    double volume_before;  ///< after `join`, `orient` and `fill`; 0 if that is no solid
    double volume_after;
    double area_before;
    double area_after;
    double area_lost;  ///< as in `treeform_repair_options::max_loss`
    /// For `treeform_resolve_self_intersections` with `TREEFORM_RESOLVE_SPLIT`: input faces that
    /// lie entirely on faces of lower numbers. Their pieces are those of the lower faces, so they
    /// do not count as removed.
    uint64_t covered;
    /// For `treeform_resolve_self_intersections` with `TREEFORM_RESOLVE_REMOVE`: edges that lost
    /// their second face.
    uint64_t left_open;
    /// for `treeform_resolve_self_intersections`: as in `treeform_boolean_result`
    uint64_t exact_faces;
    double gap_limit;         ///< largest width of cracks searched for
    double widest_closed;     ///< widest crack that was closed
    uint64_t turned_outward;  ///< components flipped outward
    const char* message;      ///< what was changed, in words; empty if nothing was
} treeform_repair_statistics;

/// The repaired mesh, its sources, and its certificate.
typedef struct treeform_repair_result {
    void* owner;
    treeform_arrays mesh;
    /// [F'] input face of each face, lowest of those merged; or `TREEFORM_NONE`
    const uint32_t* face_source;
    /// [V'] input vertex of each vertex, or `TREEFORM_NONE`
    const uint32_t* vertex_source;
    /// Status ok means, verified on the coordinates of `mesh`: a closed manifold, the inside
    /// behind every face, and any two faces share a corner, an edge or nothing. Status sheet means
    /// the same for a surface with a border. For `treeform_resolve_self_intersections` with
    /// `TREEFORM_RESOLVE_SPLIT` and `TREEFORM_RESOLVE_REMOVE`, ok only means that any two faces
    /// share a corner, an edge or nothing, and that no face is degenerate; with
    /// `TREEFORM_RESOLVE_REMOVE`, closed parts are still closed, and faces that touched before may
    /// still touch (`treeform_resolve_options::touching`).
    const treeform_certificate* certificate;
    const treeform_repair_statistics* statistics;
    /// for a file: the result with its attributes; else null
    const treeform_file* file;
    const uint8_t* is_kept;  ///< [F] 1 if a part of the input face is left, else 0
} treeform_repair_result;

/// `mesh` without self-intersections. Check the certificate: its status says whether this was
/// possible.
///
/// `TREEFORM_RESOLVE_SPLIT` and `TREEFORM_RESOLVE_OUTER` decide exactly, on the coordinates as
/// given, what is cut and what is inside. Then they round the points on cuts. Faces that meet no
/// other face do not change.
///
/// `TREEFORM_RESOLVE_REMOVE` is for surfaces that bound no solid, and works locally. It deletes
/// the faces that meet or are degenerate. It closes each hole by triangles of the least total area
/// between the vertices of its rim, but not beyond the former border of the mesh. Where the new
/// triangles meet other faces, the hole is widened. A part is a set of faces linked by edges:
///
/// - In a part that has a border, a hole stays open (`left_open`) if widening does not help, or if
/// the hole would surround the border. Then only one face of each pair is deleted.
///
/// - A closed part is not changed where a part with a border passes through it.
///
/// - If every face of a part has a copy, as in a sheet with a back, one copy stays.
TREEFORM_C_API treeform_code treeform_resolve_self_intersections(
    const treeform_mesh* mesh, treeform_resolve_mode mode, const treeform_resolve_options* options,
    treeform_repair_result** result);

/// How to repair. All steps are on by default.
typedef struct treeform_repair_options {
    size_t struct_size;
    /// drop degenerate and duplicate faces; close cracks and T-junctions; default 1
    int32_t join;
    /// orient faces consistently and shells outward; drop strays; default 1
    int32_t orient;
    int32_t fill;  ///< fill holes; default 1
    /// cut self-intersections; drop faces that bound no solid; default 1
    int32_t resolve;
    int32_t detach;  ///< separate parts that touch in an edge or a vertex; default 1
    /// Widest crack to close, in the mesh's length unit. By default the narrowest that leaves the
    /// fewest open edges, out of 0, a unit in the last place of float32, and 1e-6, 1e-5, 1e-4,
    /// 1e-3 of the diagonal of the bounding box; NaN: not given
    double gap;
    uint64_t largest_hole;  ///< Fill holes of at most this many edges; default all
    /// The rule that defines the inside. By default `TREEFORM_POSITIVE` if each shell is outward
    /// after `orient`, else `TREEFORM_NONZERO` or the labels of cells (see `treeform_repair`); a
    /// `treeform_fill_rule`, or -1 for the default
    int32_t fill_rule;
    /// Losing more than this share of the volume (of the area, if there were holes) gives the
    /// status `TREEFORM_STATUS_EXCESSIVE_LOSS`. Faces that remain, or are inside the solid, do not
    /// count as lost. 1 allows any loss; default 0.05
    double max_loss;
    int32_t sheet;  ///< the mesh is an open surface: keep its border, and fill nothing
    /// Precision of the coordinates returned. float32 values are stored as doubles; default
    /// `TREEFORM_FLOAT64`
    treeform_precision precision;
    double max_displacement;  ///< As in `treeform_boolean_options`; default infinite
    treeform_progress progress;
    void* progress_data;
    /// as in `treeform_boolean_options`; faces that fill holes only merge with each other
    int32_t keep_cuts;
    /// for `treeform_repair_file`: all parts of a scene become one solid
    int32_t as_one;
    /// Drops loose open pieces below this share of the area, and loose pieces of one or two faces
    /// below 1% of the area. If a larger component vanishes because it bounds no solid, the status
    /// is `TREEFORM_STATUS_EXCESSIVE_LOSS`, unless `max_loss` is 1; default 0.001
    double stray_share;
} treeform_repair_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_repair_options_init(treeform_repair_options* options, size_t size);

/// Repairs a mesh to a solid: closed, oriented, manifold and free of self-intersections. Check the
/// certificate: its status says whether this was possible, and it lists where it was not.
///
/// The steps are those of `treeform_repair_options`, in this order. Each changes only what is
/// defective: a mesh that is a solid is returned bit for bit. Which faces meet and what is inside
/// is decided exactly. Which cracks are closed, how faces are oriented, and how holes are filled
/// is decided by heuristics, and counted in `statistics`. Points with equal coordinates are one.
/// If faces are the sides of tetrahedra, only the boundary of the tetrahedra is kept. If faces
/// remain inconsistent, a minimum cut labels cells inside or outside, by the orientations of faces
/// and generalized winding numbers. Its result is used if it loses less area than repair without
/// labels, or if there is no certified result otherwise.
///
/// Holes are filled with triangles between their vertices; large holes in smooth surfaces also
/// with new points, which continue the surface smoothly. Sheets are not filled, but reported as
/// open, unless any loss is allowed. A sheet is a part whose fillings would have more than 0.6
/// times its area, unless its border is in a plane and it is on one side of the plane. In a mesh
/// of F > 1000 faces, no hole is filled if more than F / 10 edges have three or more faces and a
/// signed face count that is not zero.
TREEFORM_C_API treeform_code treeform_repair(const treeform_mesh* mesh,
                                             const treeform_repair_options* options,
                                             treeform_repair_result** result);

/// The same for each part of a file, or for all parts as one mesh, with its attributes. The mesh
/// of the file is used as it was read.
TREEFORM_C_API treeform_code treeform_repair_file(const treeform_file* file,
                                                  const treeform_repair_options* options,
                                                  treeform_repair_result** result);

/// The defects that keep a mesh from being a solid. Points with equal coordinates are one.
typedef struct treeform_solid_defects {
    void* owner;
    int32_t any;                    ///< whether there is any defect
    const char* message;            ///< the outcome as a clause for people, without a full stop
    uint64_t nonfinite_vertices;    ///< with a NaN or infinite coordinate, used or not
    uint64_t unusable_faces;        ///< with an invalid corner; ignored by the counts below
    int32_t without_faces;          ///< the mesh has points, but no usable face
    uint64_t tetrahedra;            ///< tetrahedra whose sides are faces, as in a volume mesh
    uint64_t degenerate;            ///< faces without area
    uint64_t repeated;              ///< faces with the same corners as another
    uint64_t boundary_edges;        ///< edges of one face
    uint64_t nonmanifold_edges;     ///< edges of more than two faces
    uint64_t misoriented_edges;     ///< edges of two inconsistently oriented faces
    uint64_t nonmanifold_vertices;  ///< with more than one fan of faces
    uint64_t meeting_pairs;         ///< pairs of faces that meet beyond common corners
    /// closed components that are inside out, without being inside another
    uint64_t inverted;
    /// Disjoint closed components are nested, but not as a solid and its cavities.
    int32_t wrongly_nested;
} treeform_solid_defects;

/// The defects that `treeform_repair` would mend or refuse. A mesh without points is a solid.
TREEFORM_C_API treeform_code treeform_find_solid_defects(const treeform_mesh* mesh,
                                                         treeform_progress progress,
                                                         void* progress_data,
                                                         treeform_solid_defects** defects);

/// The total defects of the parts of a file. Pairs of faces of different parts do not count.
TREEFORM_C_API treeform_code treeform_find_solid_defects_of_file(const treeform_file* file,
                                                                 treeform_progress progress,
                                                                 void* progress_data,
                                                                 treeform_solid_defects** defects);
// end
