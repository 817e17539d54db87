#pragma once
/// \file
/// Placement: slide, drop, mate, turn, separate; time of impact. `layouts.h` has laying flat,
/// packing and alignment.
///
/// Placements are checked exactly in the returned coordinates. If there is no such position,
/// functions return `TREEFORM_NO_PLACE`, with a result that has the reason. `fixed` [count] are
/// meshes that do not move.

#include <treeform/c/files.h>
#include <treeform/c/layouts.h>
#include <treeform/c/nearness.h>
#include <treeform/c/properties.h>

// made of the headers of C++:
//   placement_outcome placement_contact placement placement_options slide() drop() mate()
//   separate() turn() mate_features() measure_in_place()
/// The reason why a placement ended.
typedef int32_t treeform_placement_outcome;
enum {
    /// stopped by a fixed mesh, or at the clearance from it
    TREEFORM_OUTCOME_CONTACT = 0,
    /// stopped by the bed, or at the clearance above it
    TREEFORM_OUTCOME_BED = 1,
    /// no motion is needed
    TREEFORM_OUTCOME_UNCHANGED = 2,
    /// for `treeform_separate`: moved out of the fixed meshes
    TREEFORM_OUTCOME_MOVED_APART = 3,
    /// no place: nothing is in the way, at least not within `max_travel`
    TREEFORM_OUTCOME_NOTHING_MET = 4,
    /// no place: the necessary motion is longer than `max_travel`
    TREEFORM_OUTCOME_TOO_FAR = 5,
    /// no place: penetrates a fixed mesh at the start
    TREEFORM_OUTCOME_STARTS_PENETRATING = 6,
    /// no place: nearer than the clearance at the start
    TREEFORM_OUTCOME_STARTS_TOO_NEAR = 7,
    /// no place: touches a fixed mesh at the start, and a clearance is given
    TREEFORM_OUTCOME_STARTS_TOUCHING = 8,
    /// no place: below the bed at the start, and there are fixed meshes
    TREEFORM_OUTCOME_STARTS_BELOW_BED = 9,
    /// no place in coordinates of the precision
    TREEFORM_OUTCOME_NOT_REPRESENTABLE = 10,
    /// for `treeform_turn`: undecided, since the mesh passes a fixed mesh too closely
    TREEFORM_OUTCOME_TOO_MANY_STEPS = 11,
    /// no place: coordinates overflow the precision
    TREEFORM_OUTCOME_OUT_OF_RANGE = 12,
    /// stopped by `progress`; the rest is invalid
    TREEFORM_OUTCOME_CANCELLED = 13
};
/// The name of a value, as in reports: "contact"; "unknown" for others.
TREEFORM_C_API const char* treeform_placement_outcome_name(treeform_placement_outcome value);

/// A pair of faces that meet, or are at the clearance, at the place.
typedef struct treeform_placement_contact {
    double point[3];
    /// unit normal from the fixed to the moving mesh; 0 if there is none
    double normal[3];
    uint32_t moving;      ///< face of the moving mesh
    uint32_t fixed_face;  ///< `TREEFORM_NONE` for the bed
    uint32_t fixed;       ///< number of the fixed mesh
} treeform_placement_contact;

/// The result of a placement. "The place" is the new position of the moving mesh, or the present
/// one if it does not move.
typedef struct treeform_placement {
    void* owner;
    /// ok: the mesh has a place, and `points` were checked exactly. Otherwise
    /// `TREEFORM_STATUS_NO_PLACEMENT`, `TREEFORM_STATUS_OUT_OF_RANGE` or
    /// `TREEFORM_STATUS_CANCELLED`. It lists no faces.
    const treeform_certificate* certificate;
    treeform_placement_outcome outcome;
    /// the outcome as a clause for people, without a full stop; empty if the placement succeeded
    const char* message;
    const double* points;  ///< [V][3] at the place, as they are to be written
    size_t point_count;
    /// new = M * old: a translation; for `treeform_turn` and `treeform_mate_features` also a
    /// rotation. `points` are moved by it and rounded once, except for points that are set on the
    /// bed.
    double matrix[12];
    double direction[3];  ///< unit direction of the travel; 0 if there is none
    /// distance moved; for `TREEFORM_OUTCOME_TOO_FAR` the distance needed
    double travel;
    double clearance;  ///< the given clearance
    double bed;        ///< least z allowed, rounded: the bed plus the clearance; NaN: none
    double below_bed;  ///< how far the mesh was below `bed` at the start
    treeform_mesh_relation relation_at_start;  ///< exact
    treeform_mesh_relation relation;           ///< relation at the place
    size_t nearest_fixed;  ///< fixed mesh of `nearest`; the lowest if several qualify
    /// The relation, at the place, of the moving mesh (`a`) to the fixed mesh that it penetrates,
    /// else to one that it touches, else to the nearest. Null if all are too far away.
    const treeform_relation_result* nearest;
    const treeform_placement_contact* contacts;  ///< [contact_listed]
    size_t contact_listed;
    uint64_t contact_count;  ///< number of all contacts, listed or not
    /// number of steps back, since rounding made the mesh penetrate
    uint32_t backed_off;
    uint64_t fixed_culled;  ///< fixed meshes skipped because of their box
    uint64_t pairs_tested;  ///< pairs of faces tested in motion
    /// for `treeform_turn` and `treeform_mate_features`: angle of the rotation, in degrees
    double angle;
    /// for `treeform_turn`: the gap, beyond the clearance, that counts as contact
    double tolerance;
    uint64_t steps;  ///< of `treeform_turn`
    /// For `treeform_mate_features`: the distance of the moving feature's center from the fixed
    /// feature's center at the place, along the direction of the fixed feature. For planes, their
    /// distance.
    double offset;
    /// For `treeform_separate`: the effort of its search. If `skipped_candidates` is not 0, there
    /// may be a shorter translation, or a place although none was found.
    treeform_search_effort effort;
} treeform_placement;

/// Options of the placement functions. Each function ignores those that do not concern it.
typedef struct treeform_placement_options {
    size_t struct_size;
    double clearance;  ///< gap to leave, a distance; 0: contact
    /// largest distance to move; obstacles beyond are ignored; NaN: not given
    double max_travel;
    /// `treeform_mate_features`: let planes face the same way instead of each other; reverse the
    /// axis of `moving`.
    int32_t flip;
    /// `treeform_turn`: in degrees; greater than 0, up to 360; default 360.0
    double max_angle;
    /// `treeform_turn`: the gap, beyond the clearance, that counts as contact; greater than 0.
    /// Default: 2^-32 of the largest distance of a point from the axis; NaN: not given
    double tolerance;
    uint64_t max_steps;  ///< `treeform_turn`; default 20000
    /// of the points returned; default `TREEFORM_FLOAT64`
    treeform_precision precision;
    /// `treeform_slide` and `treeform_drop`: z of a bed, which also stops the mesh. Points that
    /// rest on it have exactly its z (with float32, the least float not below it), and no point is
    /// below. By default none, but 0 for `treeform_drop` without fixed meshes; NaN: not given
    double bed;
    /// `treeform_slide`: close a gap that rounding leaves at a contact, by units in the last
    /// place; default 1
    int32_t close_in;
    /// `treeform_separate`: try at most this many normals of faces; default 24
    uint64_t normals;
    /// `treeform_separate`: take the normals from at most this many pairs of faces for each fixed
    /// mesh; default 64
    uint64_t face_pairs;
    /// `treeform_separate`: largest number of pairs of faces to test; a pair in motion counts as
    /// two. 0: 20 million plus 200 for each face. Distances for a clearance do not count.
    uint64_t effort;
    /// largest number of contacts listed; for `treeform_separate`, for each fixed mesh; default
    /// 1000
    uint64_t limit;
    treeform_vertex_identity vertices;  ///< which corners are the same vertex
    treeform_progress progress;
    void* progress_data;
} treeform_placement_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_placement_options_init(treeform_placement_options* options,
                                                    size_t size);

/// Moves `moving` along `direction` (of any length) until it first meets one of `fixed`, or is at
/// the clearance from one.
///
/// Without a clearance, the time of contact is exact (`treeform_time_of_impact`); with a
/// clearance, it is that of `treeform_time_to_distance`. The returned coordinates are checked
/// again: if rounding made the mesh penetrate, or come nearer than the clearance, it is moved back
/// by units in the last place. A mesh that touches at the start stays there. A mesh that
/// penetrates at the start has no place. Points that no face uses move along and are otherwise
/// ignored; points without any face are a cloud.
///
/// Only fixed meshes on the way are tested and indexed.
TREEFORM_C_API treeform_code treeform_slide(const treeform_mesh* moving,
                                            const treeform_mesh* const* fixed, size_t count,
                                            const double direction[3],
                                            const treeform_placement_options* options,
                                            treeform_placement** placement);

/// Moves `moving` down, along `direction` (null: 0, 0, -1), onto the bed or one of `fixed`;
/// `fixed` may be empty.
TREEFORM_C_API treeform_code treeform_drop(const treeform_mesh* moving,
                                           const treeform_mesh* const* fixed, size_t count,
                                           const double* direction,
                                           const treeform_placement_options* options,
                                           treeform_placement** placement);

/// Translates `moving` so that the nearest points of `moving` and `fixed` meet, or are at the
/// clearance. Coordinates are checked as in `treeform_slide`. A mesh that touches stays; a mesh
/// that penetrates has no place.
TREEFORM_C_API treeform_code treeform_mate(const treeform_mesh* moving,
                                           const treeform_mesh* const* fixed, size_t count,
                                           const treeform_placement_options* options,
                                           treeform_placement** placement);

/// Translates `moving` to a place where it penetrates none of `fixed` and keeps the clearance. If
/// it already does, in coordinates of the precision, it stays.
///
/// About fifty directions are tried: along the axes, away from the nearest points, along normals
/// of faces that meet, and others around the best. The nearest of the places found is returned, if
/// its coordinates pass the check of `treeform_slide`. It need not be the globally nearest place,
/// which is on the boundary of a set with O(n^2 m^2) faces, for meshes of n and m faces. The
/// search is limited by `effort`, and skips candidates that would take much of it, as in
/// `treeform_penetration_depth`; `treeform_placement::effort` counts them.
TREEFORM_C_API treeform_code treeform_separate(const treeform_mesh* moving,
                                               const treeform_mesh* const* fixed, size_t count,
                                               const treeform_placement_options* options,
                                               treeform_placement** placement);

/// Turns `moving` until its distance from one of `fixed` is at most the clearance plus the
/// tolerance. `max_travel` has no effect. The axis is the line through `origin` along `direction`,
/// of any length but 0. Turns are right-handed: counter-clockwise seen against the direction.
///
/// Conservative advancement: bounds on the speed of corners guarantee that no faces meet within a
/// step, up to the rounding of distances. The returned coordinates are checked exactly: they
/// penetrate nothing, and keep the clearance as computed by `treeform_distance`. If rounding
/// violates that, the rotation is reduced by units in the last place. A mesh that touches at the
/// start stays; one that penetrates has no place. With `TREEFORM_OUTCOME_NOTHING_MET`, all of
/// `max_angle` is free. `TREEFORM_OUTCOME_TOO_MANY_STEPS` means undecided: the mesh passes another
/// at a distance that is very small compared with its size, over a long way.
///
/// `travel` is 0, and `points` differ from `matrix` by a few units in the last place of the
/// largest coordinate. `contacts` are the pairs of faces within the tolerance, beyond the
/// clearance. `treeform_placement::relation` is exact: in general disjoint, by at most the
/// tolerance beyond the clearance.
///
/// Points that no face uses turn along and are otherwise ignored; points without any face are a
/// cloud.
TREEFORM_C_API treeform_code treeform_turn(const treeform_mesh* moving,
                                           const treeform_mesh* const* fixed, size_t count,
                                           const double origin[3], const double direction[3],
                                           const treeform_placement_options* options,
                                           treeform_placement** placement);

/// Aligns two planes, or two axes, and slides `moving` until it meets one of `fixed`.
TREEFORM_C_API treeform_code treeform_mate_features(const treeform_mesh* moving,
                                                    const treeform_mesh* const* fixed, size_t count,
                                                    const treeform_mesh_feature* of_moving,
                                                    const treeform_mesh_feature* of_fixed,
                                                    const treeform_placement_options* options,
                                                    treeform_placement** placement);

/// The relation of `moving` to all of `fixed` at its present position. Moves nothing. Meshes
/// nearer than the clearance are `TREEFORM_RELATION_CLOSER_THAN_CLEARANCE`.
TREEFORM_C_API treeform_code treeform_measure_in_place(const treeform_mesh* moving,
                                                       const treeform_mesh* const* fixed,
                                                       size_t count,
                                                       const treeform_placement_options* options,
                                                       treeform_placement** placement);
// end

/// The relation of each face to the other meshes, with `moving` at the place: a
/// `treeform_mesh_relation` for each face.
typedef struct treeform_face_relations {
    void* owner;
    const uint8_t* moving;  ///< [F] of the moving mesh
    size_t moving_count;
    /// [fixed_count] arrays [F], or null if all faces of the mesh are disjoint
    const uint8_t* const* fixed;
    size_t fixed_count;
} treeform_face_relations;

// made of the headers of C++:
//   moved() write_placement() find_face_relations() face_contact impact impact_options
//   time_of_impact() time_to_distance()
/// The mesh that was placed, with the points of the placement. A copy of points and faces.
TREEFORM_C_API treeform_code treeform_moved(const treeform_placement* placement,
                                            const treeform_mesh* moving, treeform_mesh** mesh);

/// Writes `moving` at its place, in the coordinates that were checked. Fails if the format would
/// round them, or if there is no place. `written` may be null.
TREEFORM_C_API treeform_code treeform_write_placement(const char* path, const treeform_mesh* moving,
                                                      const treeform_placement* placement,
                                                      const treeform_write_options* options,
                                                      treeform_written** written);

/// The relation of each face to the other meshes; `placement` is a placement of `moving` among
/// `fixed`.
TREEFORM_C_API treeform_code treeform_find_face_relations(const treeform_mesh* moving,
                                                          const treeform_mesh* const* fixed,
                                                          size_t count,
                                                          const treeform_placement* placement,
                                                          treeform_face_relations** relations);

/// A pair of faces that meet when the meshes first do.
typedef struct treeform_face_contact {
    uint32_t face_a;
    uint32_t face_b;
    /// corner, edge or interior of the face (a `treeform_triangle_feature`)
    uint8_t on_a;
    uint8_t on_b;
    double point[3];  ///< a common point, on `b`, rounded
} treeform_face_contact;

/// The first contact of two meshes.
typedef struct treeform_impact {
    void* owner;
    /// `TREEFORM_OUTCOME_CONTACT`: the meshes meet at a time greater than 0;
    /// `TREEFORM_OUTCOME_STARTS_TOUCHING`: they have a common point at the start;
    /// `TREEFORM_OUTCOME_NOTHING_MET`.
    treeform_placement_outcome outcome;
    /// The greatest double that is not beyond the exact time t of the contact: `a` moved by `time`
    /// times the motion has not passed it. 0 if they meet at the start, infinite if never.
    double time;
    /// [contact_listed] pairs that meet at t, ascending; empty at the start
    const treeform_face_contact* contacts;
    size_t contact_listed;
    uint64_t contact_count;  ///< all pairs that meet at t, listed or not
    uint64_t pairs_tested;   ///< pairs of faces tested; the others were skipped
} treeform_impact;

/// Start positions of the meshes, and limits.
typedef struct treeform_impact_options {
    size_t struct_size;
    /// [12] Applied to each mesh before the motion. The result is exact for the moved corners,
    /// which are rounded to double. The mesh itself is not changed; or null
    const double* transform_a;
    const double* transform_b;  ///< [12]; or null
    double latest;              ///< Ignore contacts after this time; default infinite
    /// List at most this many contacts, those with the lowest face numbers; default 1000
    uint64_t limit;
    treeform_progress progress;
    void* progress_data;
} treeform_impact_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_impact_options_init(treeform_impact_options* options, size_t size);

/// The least t >= 0 at which `a`, moved by t times `motion`, has a common point with `b`.
///
/// Exact on the coordinates as given, or as moved by the options. Times of pairs of faces are
/// compared as exact quotients of determinants, so all simultaneous contacts are found, even of
/// parallel or coplanar faces. Surfaces count, not solids: inside a closed mesh, `a` moves until
/// it meets the surface. Grazing is a contact.
TREEFORM_C_API treeform_code treeform_time_of_impact(const treeform_mesh* a, const treeform_mesh* b,
                                                     const double motion[3],
                                                     const treeform_impact_options* options,
                                                     treeform_impact** impact);

/// The first time t >= 0 after which `a`, moved by t times `motion`, is nearer to `b` than
/// `distance` (not squared).
///
/// Not exact: whether a pair comes nearer than the distance is decided to 2^-48 of the largest
/// coordinate, so a mesh that slides along a wall at exactly the distance is free. The time has
/// errors of that size along the motion, and larger ones if the motion nearly grazes.
/// `treeform_slide` checks its result. For the distance 0, use `treeform_time_of_impact`, which is
/// exact.
///
/// `outcome` is `TREEFORM_OUTCOME_CONTACT` if the meshes are nearer than the distance right after
/// `time`, and `TREEFORM_OUTCOME_STARTS_TOUCHING` if they are nearer at the start. `contacts` are
/// the pairs of faces at the distance, as computed; their points are on `b`, their features have
/// no meaning.
///
/// The distance of two triangles is a convex function of t. So tangents from the left never pass
/// the time at which it falls to a value, and Newton's method finds that time from below.
TREEFORM_C_API treeform_code treeform_time_to_distance(const treeform_mesh* a,
                                                       const treeform_mesh* b,
                                                       const double motion[3], double distance,
                                                       const treeform_impact_options* options,
                                                       treeform_impact** impact);
// end
