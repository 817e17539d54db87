#ifndef TREEFORM_C_SOLIDS_H
#define TREEFORM_C_SOLIDS_H
/// \file
/// Solids: set operations, self-intersections resolved, dirty meshes repaired, wraps.
///
/// These return `TREEFORM_OK` when the certificate of the result holds. Otherwise they return
/// `TREEFORM_NOT_CERTIFIED`, and there is a result all the same, to be looked at and freed.

#include <treeform/c/files.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Which points are inside an operand, by how often its surface winds around them.
typedef int32_t treeform_fill_rule;
enum { TREEFORM_NONZERO = 0, TREEFORM_ODD = 1, TREEFORM_POSITIVE = 2 };

/// How to combine solids.
typedef struct treeform_boolean_options {
    size_t size;
    treeform_fill_rule inside;     ///< default: nonzero
    treeform_precision precision;  ///< of the coordinates returned; default: double
    double
        max_displacement;  ///< nothing longer goes where rounding broke something; default infinite
    int32_t keep_cuts;     ///< leave coplanar faces apart that were cut, or overlap
    int32_t simplify;      ///< merge all coplanar faces of the result, exactly
    int32_t volumes;       ///< compute `volumes`, of two operands
    const uint32_t* face_groups;  ///< merge only faces with equal numbers; or null
    size_t face_group_count;      ///< faces of all operands
    treeform_progress progress;
    void* progress_data;
    double min_volume;  ///< leave out parts of the result, and fill voids, of less; default 0
    double gap;         ///< fill gaps of at most this between operands of a union; default 0
} treeform_boolean_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_boolean_options_init(treeform_boolean_options* options, size_t size);

/// The volumes of two operands, their union and intersection.
typedef struct treeform_volumes {
    double first;
    double second;
    double either;
    double both;
} treeform_volumes;

/// The surface of a solid, and what was checked about it.
typedef struct treeform_boolean_result {
    void* owner;
    treeform_arrays mesh;
    const treeform_element* face_source;    ///< [F] the operand face that each lies in
    const treeform_element* vertex_source;  ///< [V] the operand vertex that each is, or none
    const treeform_element*
        face_of_cut_vertex;  ///< [V] of new ones, an operand face it lies in; or null
    const treeform_certificate* certificate;
    uint64_t vanished_components;  ///< thinner than the coordinates can show
    double vanished_reach;         ///< how far gone vertices of others are from the result, at most
    const double* vanished_at;     ///< [vanished_listed][3] a point of each, at most 100
    size_t vanished_listed;
    const treeform_volumes* volumes;  ///< or null
    uint64_t pairs;                   ///< of faces looked at that meet
    uint64_t cut_faces;
    uint64_t degenerate;     ///< operand faces without area
    uint64_t skipped_faces;  ///< not looked at, as the result cannot be there
    uint64_t covered;        ///< for `treeform_split`: faces that lie entirely on lower ones
    uint64_t exact_faces;    ///< of the result before rounding
    uint64_t split_vertices;
    uint64_t slivers;         ///< thin faces taken out where rounding made faces meet
    int32_t rounding_rounds;  ///< how often what met all the same was cut and rounded again
    uint64_t small_parts;     ///< left out, as their volume is below `min_volume`
    double small_volume;      ///< of these, added up
    uint64_t filled_faces;    ///< of operands, at gaps that were filled
} treeform_boolean_result;

/// The solid that `expression` makes of the `operands` [count]: a formula over a, b, c, ..., with +
/// or | union, * or & intersection, - difference, ^ exclusive or, and brackets: "(a-b)*c". Exact,
/// then rounded and checked. No operand is copied. Each has to bound a solid.
TREEFORM_C_API treeform_code treeform_boolean(const treeform_mesh* const* operands, size_t count,
                                              const char* expression,
                                              const treeform_boolean_options* options,
                                              treeform_boolean_result** result);

/// The same with `names` [count] in place of letters: "body-(bolt_1+'left bolt')".
TREEFORM_C_API treeform_code treeform_boolean_named(const treeform_mesh* const* operands,
                                                    const char* const* names, size_t count,
                                                    const char* expression,
                                                    const treeform_boolean_options* options,
                                                    treeform_boolean_result** result);

/// The names in a formula, each once, in the order in which they come first.
TREEFORM_C_API treeform_code treeform_names_in(const char* expression, treeform_strings** names);

/// What is in `a` or `b`.
TREEFORM_C_API treeform_code treeform_unite(const treeform_mesh* a, const treeform_mesh* b,
                                            const treeform_boolean_options* options,
                                            treeform_boolean_result** result);
/// What is in `a` but not in `b`.
TREEFORM_C_API treeform_code treeform_subtract(const treeform_mesh* a, const treeform_mesh* b,
                                               const treeform_boolean_options* options,
                                               treeform_boolean_result** result);
/// What is in both.
TREEFORM_C_API treeform_code treeform_intersection(const treeform_mesh* a, const treeform_mesh* b,
                                                   const treeform_boolean_options* options,
                                                   treeform_boolean_result** result);
/// What is in exactly one of them.
TREEFORM_C_API treeform_code treeform_symmetric_difference(const treeform_mesh* a,
                                                           const treeform_mesh* b,
                                                           const treeform_boolean_options* options,
                                                           treeform_boolean_result** result);

/// What is in any operand [count], without a formula.
TREEFORM_C_API treeform_code treeform_unite_all(const treeform_mesh* const* operands, size_t count,
                                                const treeform_boolean_options* options,
                                                treeform_boolean_result** result);

/// An open surface cut by solids: the pieces of operand number `sheet` for which `expression` is
/// true.
TREEFORM_C_API treeform_code treeform_clip(const treeform_mesh* const* operands, size_t count,
                                           uint32_t sheet, const char* expression,
                                           const treeform_boolean_options* options,
                                           treeform_boolean_result** result);

/// All faces of the operands, cut along each other and along themselves, each piece once.
TREEFORM_C_API treeform_code treeform_split(const treeform_mesh* const* operands, size_t count,
                                            const treeform_boolean_options* options,
                                            treeform_boolean_result** result);

/// What to do with faces that meet: cut them; cut them and keep what bounds the solid; delete them
/// and fill the holes.
typedef int32_t treeform_resolve_mode;
enum { TREEFORM_RESOLVE_SPLIT = 0, TREEFORM_RESOLVE_OUTER = 1, TREEFORM_RESOLVE_REMOVE = 2 };

/// How to resolve self-intersections.
typedef struct treeform_resolve_options {
    size_t size;
    treeform_fill_rule inside;
    treeform_precision precision;
    double max_displacement;
    int32_t touching;        ///< for `remove`: delete faces that only touch, too
    int32_t removal_rounds;  ///< for `remove`; default 16
    double max_loss;         ///< share of the volume or area that may be lost; default 0.05
    treeform_progress progress;
    void* progress_data;
    int32_t keep_cuts;  ///< for `outer`: leave coplanar faces apart that were cut, or overlap
} treeform_resolve_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_resolve_options_init(treeform_resolve_options* options, size_t size);

/// The mesh without self-intersections.
typedef struct treeform_resolve_result {
    void* owner;
    treeform_arrays mesh;
    const uint32_t* face_source;    ///< [F] input face that each lies in, or `TREEFORM_NONE`
    const uint32_t* vertex_source;  ///< [V] input vertex that each is, or `TREEFORM_NONE`
    const treeform_certificate* certificate;
    uint64_t vanished_components;
    uint64_t removed;    ///< input faces of which no part is left
    uint64_t covered;    ///< for `split`
    uint64_t filled;     ///< faces that fill holes
    uint64_t left_open;  ///< for `remove`: edges that lost their second face
    uint64_t exact_faces;
    uint64_t split_vertices;
} treeform_resolve_result;

/// The mesh without self-intersections; exact, then rounded and checked.
TREEFORM_C_API treeform_code treeform_resolve_self_intersections(
    const treeform_mesh* mesh, treeform_resolve_mode mode, const treeform_resolve_options* options,
    treeform_resolve_result** result);

/// What is inside, for `treeform_repair`.
typedef int32_t treeform_repair_rule;
enum {
    TREEFORM_REPAIR_AUTOMATIC = 0,
    TREEFORM_REPAIR_NONZERO = 1,
    TREEFORM_REPAIR_ODD = 2,
    TREEFORM_REPAIR_POSITIVE = 3
};

/// How to repair. All steps are on by default.
typedef struct treeform_repair_options {
    size_t size;
    int32_t join;           ///< drop degenerate and repeated faces; close cracks
    int32_t orient;         ///< make faces agree and shells outward
    int32_t fill;           ///< fill holes
    int32_t resolve;        ///< cut self-intersections
    int32_t detach;         ///< move apart what touches in an edge or a vertex
    double gap;             ///< widest crack to close; NaN: what leaves the fewest open edges
    uint64_t largest_hole;  ///< fill holes of at most this many edges; default: all
    double strays;  ///< share of the area below which loose pieces are dropped; default 0.001
    treeform_repair_rule inside;
    double max_loss;  ///< default 0.05
    int32_t sheet;    ///< the mesh is an open surface: its border is kept
    treeform_precision precision;
    double max_displacement;
    treeform_progress progress;
    void* progress_data;
    int32_t keep_cuts;  ///< leave coplanar faces apart that were cut, or overlap
} treeform_repair_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_repair_options_init(treeform_repair_options* options, size_t size);

/// What each step has done.
typedef struct treeform_repair_statistics {
    uint64_t tetrahedra;
    uint64_t degenerate;
    uint64_t repeated;
    uint64_t closed_edges;
    uint64_t split_edges;
    double gap;
    double widest;
    uint64_t flipped;
    uint64_t turned;
    uint64_t strays;
    uint64_t holes;
    uint64_t hole_edges;
    uint64_t filled;
    uint64_t sheets;  ///< rims not filled, since they end sheets
    uint64_t open_edges;
    int32_t resolved;
    uint64_t pairs;
    uint64_t labeled_cells;
    double dropped_area;
    double turned_area;
    uint64_t removed;
    uint64_t split_vertices;
    uint64_t detached;
    uint64_t touching;
    uint64_t vanished_components;
    uint64_t dropped_shells;  ///< closed components within the solid, of which nothing is left
    double volume_before;
    double volume_after;
    double area_before;
    double area_after;
    double area_lost;
} treeform_repair_statistics;

/// The mended mesh.
typedef struct treeform_repair_result {
    void* owner;
    treeform_arrays mesh;
    const uint32_t* face_source;    ///< [F] input face that each lies in, or `TREEFORM_NONE`
    const uint32_t* vertex_source;  ///< [V] or null, of a file
    const treeform_certificate* certificate;
    const treeform_repair_statistics* statistics;
    const treeform_file* file;  ///< of `treeform_repair_file`: with attributes; else null
    const uint8_t* is_left;     ///< [faces of the input] 1 where something is left of one
} treeform_repair_result;

/// A solid made of a dirty mesh: closed, oriented, manifold, free of self-intersections.
TREEFORM_C_API treeform_code treeform_repair(const treeform_mesh* mesh,
                                             const treeform_repair_options* options,
                                             treeform_repair_result** result);

/// What of a file is mended at a time.
typedef int32_t treeform_repair_scope;
enum { TREEFORM_EACH_PART = 0, TREEFORM_WHOLE_FILE = 1 };

/// The same of a file, or each of its parts, with its attributes. The mesh of the file is taken as
/// it is read.
TREEFORM_C_API treeform_code treeform_repair_file(const treeform_file* file,
                                                  treeform_repair_scope scope,
                                                  const treeform_repair_options* options,
                                                  treeform_repair_result** result);

/// What keeps a mesh from being a solid.
typedef struct treeform_solid_defects {
    void* owner;
    int32_t any;
    const char* message;          ///< "open at 37 edges, 2 pairs of faces meet"; "none"
    uint64_t nonfinite_vertices;  ///< with a NaN or infinite coordinate, used or not
    uint64_t unusable_faces;      ///< with such a corner, or one that is no vertex
    int32_t without_faces;        ///< there are points, but no face that can be used
    uint64_t tetrahedra;
    uint64_t degenerate;
    uint64_t repeated;
    uint64_t open_edges;
    uint64_t nonmanifold_edges;
    uint64_t misoriented_edges;
    uint64_t nonmanifold_vertices;
    uint64_t meeting_pairs;
    uint64_t inverted;
    int32_t wrongly_nested;
} treeform_solid_defects;

/// What `treeform_repair` would have to mend, and what it does not take. Nothing is changed.
/// `progress` may be null.
TREEFORM_C_API treeform_code treeform_find_solid_defects(const treeform_mesh* mesh,
                                                         treeform_progress progress,
                                                         void* progress_data,
                                                         treeform_solid_defects** defects);

/// The same for `treeform_repair_file`.
TREEFORM_C_API treeform_code treeform_find_solid_defects_of_file(const treeform_file* file,
                                                                 treeform_repair_scope scope,
                                                                 treeform_progress progress,
                                                                 void* progress_data,
                                                                 treeform_solid_defects** defects);

/// How to wrap.
typedef struct treeform_wrap_options {
    size_t size;
    double offset;  ///< distance of the wrap's vertices; NaN: a thirtieth of the size
    treeform_precision precision;
    treeform_progress progress;
    void* progress_data;
} treeform_wrap_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_wrap_options_init(treeform_wrap_options* options, size_t size);

/// A wrap.
typedef struct treeform_wrap_result {
    void* owner;
    treeform_arrays mesh;
    const treeform_certificate* certificate;
    double size;
    double offset;
    double area;  ///< of the mesh that was wrapped
    uint64_t points;
    uint64_t tetrahedra;
    uint64_t filled;
} treeform_wrap_result;

/// A closed surface around all faces of a mesh, whatever they are, which enters no hole or gap
/// narrower than `size`.
TREEFORM_C_API treeform_code treeform_wrap(const treeform_mesh* mesh, double size,
                                           const treeform_wrap_options* options,
                                           treeform_wrap_result** result);

#ifdef __cplusplus
}
#endif
#endif
