#ifndef TREEFORM_C_PLACEMENT_H
#define TREEFORM_C_PLACEMENT_H
/// \file
/// Where a mesh goes: slid, dropped, mated, turned, separated, laid flat, packed, aligned; when it
/// meets another in motion.
///
/// Placements are checked exactly in the coordinates that they return. Where there is no such
/// place, they return `TREEFORM_NO_PLACE` with a result that says why. `fixed` [fixed_count] are
/// meshes that stay; of a `treeform_mesh_set`, they keep their indexes from call to call.

#include <treeform/c/nearness.h>
#include <treeform/c/properties.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Why a placement ended where it did.
typedef int32_t treeform_placement_end;
enum {
    TREEFORM_END_CONTACT = 0,
    TREEFORM_END_BED = 1,
    TREEFORM_END_STAYS = 2,
    TREEFORM_END_MOVED_APART = 3,
    TREEFORM_END_NOTHING_MET = 4,
    TREEFORM_END_TOO_FAR = 5,
    TREEFORM_END_STARTS_PENETRATING = 6,
    TREEFORM_END_STARTS_TOO_NEAR = 7,
    TREEFORM_END_STARTS_TOUCHING = 8,
    TREEFORM_END_STARTS_BELOW_BED = 9,
    TREEFORM_END_NO_COORDINATES = 10,
    TREEFORM_END_TOO_MANY_STEPS = 11,
    TREEFORM_END_OUT_OF_RANGE = 12
};

/// A pair of faces that meet at the place, or keep the clearance there.
typedef struct treeform_contact {
    double point[3];
    double normal[3];     ///< of length 1, from the fixed to the moving mesh; 0 when there is none
    uint32_t moving;      ///< face of the moving mesh
    uint32_t fixed_face;  ///< `TREEFORM_NONE` when it is the bed
    uint32_t fixed;       ///< number of the fixed mesh
} treeform_contact;

/// Where a mesh goes.
typedef struct treeform_placement {
    void* owner;
    const treeform_certificate* certificate;
    treeform_placement_end end;
    const char* message;   ///< why there is no place; "" when there is one
    const double* points;  ///< [point_count][3] at the place, as they are to be written
    size_t point_count;
    double matrix[12];    ///< new = M * old
    double direction[3];  ///< of the travel, of length 1
    double travel;        ///< a length
    double clearance;     ///< asked for
    double bed;           ///< lowest z allowed; NaN without a bed
    double below_bed;     ///< how far it reached below that at the start
    int32_t on_bed;       ///< the bed stopped it
    treeform_standing at_start;
    treeform_standing at_place;
    uint32_t nearest_fixed;  ///< the fixed mesh that matters most; `TREEFORM_NONE` for none
    const treeform_relation* nearest;  ///< how it lies to the moving one, `a`; or null
    const treeform_contact* contacts;  ///< [contact_listed]
    size_t contact_listed;
    uint64_t contact_count;  ///< listed or not
    uint32_t backed_off;     ///< steps back, where rounding made the mesh penetrate
    uint64_t fixed_culled;   ///< fixed meshes skipped because of their box
    uint64_t pairs_tested;
    double angle;      ///< of `treeform_turn` and `treeform_mate_features`, in degrees; else 0
    double tolerance;  ///< of `treeform_turn`
    uint64_t steps;    ///< of `treeform_turn`
    double offset;     ///< of `treeform_mate_features`: distance of the features' centers
    treeform_search_effort effort;  ///< of `treeform_separate`
} treeform_placement;

/// How to slide, mate, separate, turn. What an operation does not use is ignored.
typedef struct treeform_place_options {
    size_t size;
    double clearance;              ///< the gap to leave; 0: until contact
    double max_travel;             ///< a length; NaN: any
    treeform_precision precision;  ///< of the points returned; default: double
    double bed;                    ///< z of a bed for slide and drop; NaN: none, for drop without
                                   ///< fixed meshes 0
    int32_t close_in;  ///< slide: close a gap that rounding leaves at a contact; default 1
    uint64_t limit;    ///< contacts listed; default 1000
    treeform_vertices vertices;
    uint64_t normals;     ///< separate: normals of faces tried as directions; default 24
    uint64_t face_pairs;  ///< separate: from this many pairs of faces; default 64
    uint64_t effort;      ///< separate: pairs of faces to look at, at most; 0: by the input
    double max_angle;     ///< turn: degrees, up to the default 360
    double tolerance;     ///< turn: the gap that counts as contact; NaN: 2^-32 of the size
    uint64_t max_steps;   ///< turn: default 20000
    int32_t flip;         ///< mate_features: planes look the same way
    treeform_progress progress;
    void* progress_data;
} treeform_place_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_place_options_init(treeform_place_options* options, size_t size);

/// Moves `moving` along `direction` until it first meets one of `fixed`, or comes as near to one as
/// the clearance.
TREEFORM_C_API treeform_code treeform_slide(const treeform_mesh* moving,
                                            const treeform_mesh* const* fixed, size_t fixed_count,
                                            const double direction[3],
                                            const treeform_place_options* options,
                                            treeform_placement** placement);

/// Moves `moving` down, along `direction` (null: 0, 0, -1), onto the bed or one of `fixed`, of
/// which there may be none.
TREEFORM_C_API treeform_code treeform_drop(const treeform_mesh* moving,
                                           const treeform_mesh* const* fixed, size_t fixed_count,
                                           const double* direction,
                                           const treeform_place_options* options,
                                           treeform_placement** placement);

/// Translates `moving` so that its nearest points to `fixed` come together, or to the clearance.
TREEFORM_C_API treeform_code treeform_mate(const treeform_mesh* moving,
                                           const treeform_mesh* const* fixed, size_t fixed_count,
                                           const treeform_place_options* options,
                                           treeform_placement** placement);

/// Translates `moving` to where it penetrates none of `fixed` and keeps the clearance.
TREEFORM_C_API treeform_code treeform_separate(const treeform_mesh* moving,
                                               const treeform_mesh* const* fixed,
                                               size_t fixed_count,
                                               const treeform_place_options* options,
                                               treeform_placement** placement);

/// Turns `moving` about the axis through `origin` along `direction` until it first comes within the
/// tolerance of one of `fixed`, or of the clearance from one.
TREEFORM_C_API treeform_code treeform_turn(const treeform_mesh* moving,
                                           const treeform_mesh* const* fixed, size_t fixed_count,
                                           const double origin[3], const double direction[3],
                                           const treeform_place_options* options,
                                           treeform_placement** placement);

/// Brings two planes, or two axes, together, and slides `moving` until it meets one of `fixed`.
TREEFORM_C_API treeform_code treeform_mate_features(
    const treeform_mesh* moving, const treeform_mesh* const* fixed, size_t fixed_count,
    const treeform_feature* of_moving, const treeform_feature* of_fixed,
    const treeform_place_options* options, treeform_placement** placement);

/// How `moving` lies to all of `fixed` where it is. Moves nothing.
TREEFORM_C_API treeform_code treeform_measure_among(const treeform_mesh* moving,
                                                    const treeform_mesh* const* fixed,
                                                    size_t fixed_count,
                                                    const treeform_place_options* options,
                                                    treeform_placement** placement);

/// The class of each face with `moving` at the place: 0 none, 1 penetrating, 2 touching, 3 near.
typedef struct treeform_contact_classes {
    void* owner;
    const uint8_t* moving;  ///< [F] of the moving mesh
    size_t moving_count;
    const uint8_t* const* fixed;  ///< by mesh: [F], or null when all are 0
    size_t fixed_count;
} treeform_contact_classes;

/// The class of each face; `placement` is one of `moving` among `fixed`.
TREEFORM_C_API treeform_code treeform_classify_contacts(const treeform_mesh* moving,
                                                        const treeform_mesh* const* fixed,
                                                        size_t fixed_count,
                                                        const treeform_placement* placement,
                                                        treeform_contact_classes** classes);

/// A pair of faces that meet when the meshes first do.
typedef struct treeform_impact_contact {
    uint32_t face_a;
    uint32_t face_b;
    uint8_t on_a;  ///< the part of the face, as in `treeform_hit::at`
    uint8_t on_b;
    double point[3];  ///< a common point, on `b`
} treeform_impact_contact;

/// The first contact of two meshes in motion.
typedef struct treeform_impact {
    void* owner;
    int32_t end;  ///< 0 free: they do not meet; 1 contact; 2 they meet where they are
    double time;  ///< the greatest double that is not beyond the time of the contact
    const treeform_impact_contact* contacts;  ///< [contact_listed]
    size_t contact_listed;
    uint64_t contact_count;
    uint64_t pairs_tested;
} treeform_impact;

/// How far to look.
typedef struct treeform_impact_options {
    size_t size;
    const double* move_a;  ///< [12] applied before the motion; or null. Not with a distance
    const double* move_b;
    double latest;   ///< ignore contacts after this time; default: infinite
    uint64_t limit;  ///< contacts listed; default 1000
    treeform_progress progress;
    void* progress_data;
} treeform_impact_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_impact_options_init(treeform_impact_options* options, size_t size);

/// The least t >= 0 at which `a`, moved by t times `motion`, has a point in common with `b`; exact.
TREEFORM_C_API treeform_code treeform_time_of_impact(const treeform_mesh* a, const treeform_mesh* b,
                                                     const double motion[3],
                                                     const treeform_impact_options* options,
                                                     treeform_impact** impact);

/// The first time after which it is nearer to `b` than `distance`, which is greater than 0;
/// rounded.
TREEFORM_C_API treeform_code treeform_time_to_distance(const treeform_mesh* a,
                                                       const treeform_mesh* b,
                                                       const double motion[3], double distance,
                                                       const treeform_impact_options* options,
                                                       treeform_impact** impact);

/// Which side of the convex hull goes down.
typedef int32_t treeform_lay_choice;
enum {
    TREEFORM_LAY_LARGEST = 0,
    TREEFORM_LAY_NEAREST_NORMAL = 1,
    TREEFORM_LAY_HOLDING_POINT = 2,
    TREEFORM_LAY_MOST_STABLE = 3
};

/// How to lay a mesh flat.
typedef struct treeform_lay_flat_options {
    size_t size;
    treeform_lay_choice choose;
    double toward[3];         ///< a direction, or a point, as `choose` needs it
    int32_t keep_spin;        ///< do not turn about the vertical
    double tolerance;         ///< points this far from the plane of a side belong to it; default 0
    double bed;               ///< default 0
    double overhang_angle;    ///< degrees from the vertical; default 45
    uint64_t overhang_sides;  ///< default 32
    treeform_precision precision;
    treeform_progress progress;
    void* progress_data;
} treeform_lay_flat_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_lay_flat_options_init(treeform_lay_flat_options* options, size_t size);

/// How a mesh stands on a side.
typedef struct treeform_stability {
    double tip_angle;  ///< least tilt, in degrees, that tips it over; negative: it tips by itself
    double height;     ///< of the center of mass over the side
    double overhang;   ///< area that would need support; NaN where not known
} treeform_stability;

/// A mesh on the bed.
typedef struct treeform_laid_flat {
    void* owner;
    const treeform_certificate* certificate;
    const char* message;   ///< "on side 0 of 6, of area 24"
    const double* points;  ///< [point_count][3]
    size_t point_count;
    double matrix[12];
    double bed;
    const treeform_hull_side* sides;      ///< [side_count] before the turn, largest first
    const treeform_stability* stability;  ///< [side_count]
    size_t side_count;
    size_t chosen;
    double center_of_mass[3];  ///< before the turn
    int32_t mass_of;           ///< of what: 0 the solid, 1 the surface, 2 the points
    const uint32_t* on_bed;    ///< [on_bed_count] points of the side, ascending
    size_t on_bed_count;
    double corrected;  ///< the most that a z was changed to be on the bed
} treeform_laid_flat;

/// Turns the mesh so that a flat side of its convex hull is on the bed; null when it has none.
TREEFORM_C_API treeform_code treeform_lay_flat(const treeform_mesh* mesh,
                                               const treeform_lay_flat_options* options,
                                               treeform_laid_flat** laid);

/// How many turns about the vertical are tried for each part.
typedef int32_t treeform_plate_turns;
enum {
    TREEFORM_TURNS_NONE = 0,
    TREEFORM_TURNS_QUARTER = 1,
    TREEFORM_TURNS_EIGHTH = 2,
    TREEFORM_TURNS_ANY = 3
};

/// The plates, and how to fill them.
typedef struct treeform_pack_options {
    size_t size;
    double plate[3];   ///< length, depth and height of the plate or box; the height may be infinite
    double corner[3];  ///< of the first plate; its z is the bed
    double spacing;    ///< default 2
    treeform_plate_turns turns;  ///< default: quarter
    int32_t stack;               ///< parts also come above and inside one another
    uint32_t plates;             ///< most plates used; default 1
    double plate_step[3];        ///< from the corner of a plate to that of the next
    int32_t tighten;             ///< default 1
    uint64_t seed;
    uint32_t tries;  ///< default 32
    double seconds;  ///< no more tries begin after this; default: infinite
    treeform_precision precision;
    treeform_progress progress;
    void* progress_data;
} treeform_pack_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_pack_options_init(treeform_pack_options* options, size_t size);

/// A part on a plate.
typedef struct treeform_packed_part {
    int32_t placed;
    uint32_t plate;
    const double* points;  ///< [point_count][3] unchanged when the part is not placed
    size_t point_count;
    double matrix[12];
} treeform_packed_part;

/// Filled plates.
typedef struct treeform_packing {
    void* owner;
    const treeform_certificate* certificate;
    const char* message;                ///< "9 of 9 parts placed"
    const treeform_packed_part* parts;  ///< [part_count] in the order of the input
    size_t part_count;
    const uint32_t* not_placed;  ///< [not_placed_count]
    size_t not_placed_count;
    uint32_t plates_used;
    uint32_t tries;
    double density;
    uint64_t pairs_measured;
    double bed;
} treeform_packing;

/// Puts the parts [count] on plates. Returns `TREEFORM_NO_PLACE`, with a result, when some found
/// none.
TREEFORM_C_API treeform_code treeform_pack(const treeform_mesh* const* parts, size_t count,
                                           const treeform_pack_options* options,
                                           treeform_packing** packing);

/// What each step of ICP makes small, and how pairs count.
typedef int32_t treeform_align_method;
enum {
    TREEFORM_POINT_TO_PLANE = 0,
    TREEFORM_POINT_TO_POINT = 1,
    TREEFORM_ALIGN_AUTOMATIC = 2,  ///< planes of a mesh, planes of both clouds
    TREEFORM_PLANE_TO_PLANE = 3    ///< of both clouds
};
typedef int32_t treeform_align_weights;
enum { TREEFORM_WEIGHTS_EQUAL = 0, TREEFORM_WEIGHTS_WELSCH = 1 };

/// How to align.
typedef struct treeform_align_options {
    size_t size;
    treeform_align_method method;    ///< default: automatic
    double overlap;                  ///< share of the moving points that have a partner; default 1
    treeform_align_weights weights;  ///< default: Welsch's
    double max_distance;             ///< ignore partners further apart; default: infinite
    int32_t scale;                   ///< find a uniform scale, too
    uint32_t max_iterations;         ///< default 100
    double tolerance;                ///< default 1e-6
    uint32_t starts;                 ///< default 1
    int32_t accelerate;              ///< default 1
    uint64_t samples;                ///< default 100000; 0 is all
    const double* start;             ///< [12] applied to the moving points first; or null
    treeform_precision precision;
    treeform_progress progress;
    void* progress_data;
    double least_scale;  ///< bounds of the scale found: positive, or 0
    double most_scale;   ///< and infinite, the defaults, for none
} treeform_align_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_align_options_init(treeform_align_options* options, size_t size);

/// A small motion, and how much the distances tell of it.
typedef struct treeform_freedom {
    double turn[3];
    double shift[3];
    double stiffness;
} treeform_freedom;

/// How the search ended.
typedef int32_t treeform_align_end;
enum {
    TREEFORM_ALIGN_CONVERGED = 0,
    TREEFORM_ALIGN_OUT_OF_ITERATIONS = 1,
    TREEFORM_ALIGN_DOUBTFUL = 2,
    TREEFORM_ALIGN_NOTHING = 3
};

/// The motion found.
typedef struct treeform_align_result {
    void* owner;
    const double* points;  ///< [point_count][3] the moving points, moved
    size_t point_count;
    double matrix[12];
    double pivot[3];
    double pivot_moved[3];
    double scale;
    double rms;
    double rms_at_start;
    double overlap;
    uint64_t inliers;
    double correlation;
    const treeform_freedom* freedoms;  ///< [freedom_count] least held first
    size_t freedom_count;
    size_t undetermined;  ///< how many of them mean nothing
    treeform_align_end end;
    uint32_t iterations;
    uint32_t start;
    const char* message;
    double uncertainty;  ///< how far the points may be off: standard deviation, root mean square
} treeform_align_result;

/// The rigid motion that brings the points of `moving` near `fixed`, a mesh or cloud. Returns
/// `TREEFORM_NO_PLACE`, with a result, when it has not converged.
TREEFORM_C_API treeform_code treeform_align(const treeform_mesh* moving, const treeform_mesh* fixed,
                                            const treeform_align_options* options,
                                            treeform_align_result** result);

#ifdef __cplusplus
}
#endif
#endif
