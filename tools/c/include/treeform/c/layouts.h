#pragma once
/// \file
/// Meshes laid flat, packed on plates, aligned.

#include <treeform/c/properties.h>

// made of the headers of C++:
//   lay_choice lay_flat_options side_stability laid_flat lay_flat() plate_turns pack_options
//   packed_part packing pack() align_method align_options align_freedom align_end align_result
//   align()
/// Which side of the convex hull goes down.
typedef int32_t treeform_lay_choice;
enum {
    /// the side of the largest area
    TREEFORM_LAY_LARGEST = 0,
    /// the side whose outward normal makes the least angle with `toward`
    TREEFORM_LAY_NEAREST_NORMAL = 1,
    /// the side nearest to `toward`: the one that contains it, if one does
    TREEFORM_LAY_HOLDING_POINT = 2,
    /// the side with the largest tip angle
    TREEFORM_LAY_MOST_STABLE = 3
};

/// How to lay a mesh flat.
typedef struct treeform_lay_flat_options {
    size_t size;
    treeform_lay_choice choose;
    /// a direction of any length, or a point, in the coordinates of the mesh
    double toward[3];
    /// Only bring the side down. Otherwise the mesh is also turned about the vertical, by at most
    /// 45 degrees, until the longest edge of the side runs along x or y.
    int32_t keep_spin;
    /// Points at most this far from the plane of a side belong to it. With 0, a side is exactly in
    /// one plane. That fits models in round numbers. A flat face that was turned and rounded
    /// before then falls into many sides; about 1e-6 of the size joins them again.
    double tolerance;
    double bed;                    ///< z of the bed
    double overhang_angle;         ///< in degrees from the vertical, 0 to 90; default 45.0
    uint64_t overhang_sides;       ///< default 32
    treeform_precision precision;  ///< of the points returned; default float64
    treeform_progress progress;
    void* progress_data;
} treeform_lay_flat_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_lay_flat_options_init(treeform_lay_flat_options* options, size_t size);

/// How a mesh stands on a side.
typedef struct treeform_stability {
    /// The least tilt, in degrees, that brings the center of mass over an edge of the side: then
    /// it tips over. 90 where the center is in the plane of the side. Negative where the center is
    /// not over the side: it tips over by itself.
    double tip_angle;
    double height;  ///< of the center of mass over the plane of the side
    /// Area of the faces that would need support: that look down more than `overhang_angle` from
    /// the vertical and are not on the bed. Only known of the first `overhang_sides` sides and the
    /// chosen one, else NaN.
    double overhang;
} treeform_stability;

/// A mesh on the bed.
typedef struct treeform_laid_flat {
    void* owner;
    /// ok, or `cancelled`: then the rest is empty. `max_displacement` includes what was corrected.
    const treeform_certificate* certificate;
    const char* message;   ///< half a sentence for people
    const double* points;  ///< [V] the new points, as they are to be written
    size_t point_count;
    /// new = M * old, a rotation and a translation. `points` differ from it by a few units in the
    /// last place of the largest coordinate, old or new.
    double matrix[12];
    /// z of the points on the bed; with float32, the least one not below it
    double bed;
    /// [side_count] The sides of the convex hull before the turn, largest area first. With a
    /// tolerance, each is a side of the hull together with its neighbors within the tolerance of
    /// its plane.
    const treeform_hull_side* sides;
    const treeform_stability* stability;  ///< of each of `sides`
    size_t side_count;
    size_t chosen;             ///< number in `sides`
    double center_of_mass[3];  ///< before the turn, rounded
    int32_t mass_of;           ///< what that is the center of
    const uint32_t* on_bed;    ///< [on_bed_count] points of that side, ascending
    size_t on_bed_count;
    /// The most that a z was changed, beyond the rotation, to be on the bed or not below it: some
    /// units in the last place; with a tolerance, about as much as that.
    double corrected;
} treeform_laid_flat;

/// Turns `mesh` so that a flat side of its convex hull is on the bed. The center of its box keeps
/// x and y. Null when there is no side: fewer than three points, or all on a line.
///
/// Every point in the plane of the side, exactly or within the tolerance, then has exactly the z
/// of the bed, and no point is below. Areas and angles are rounded; those within 2^-40 of the best
/// are treated as equal. Of equal sides, one that is exactly down already is chosen, else the
/// largest, else the first in `sides`. Points that no face uses move along and are otherwise
/// ignored; a mesh without faces uses all its points.
TREEFORM_C_API treeform_code treeform_lay_flat(const treeform_mesh* mesh,
                                               const treeform_lay_flat_options* options,
                                               treeform_laid_flat** flat);

/// How many turns about the vertical are tried for each part.
typedef int32_t treeform_plate_turns;
enum {
    TREEFORM_TURNS_NONE = 0,
    /// 4, by 90 degrees
    TREEFORM_TURNS_QUARTER = 1,
    /// 8, by 45 degrees
    TREEFORM_TURNS_EIGHTH = 2,
    /// 24, by 15 degrees
    TREEFORM_TURNS_ANY = 3
};

/// The plates, and how to fill them.
typedef struct treeform_pack_options {
    size_t size;
    /// Length, depth and height of the plate or box. The height may be infinite; default infinite
    double plate[3];
    /// corner of the first plate with the lowest x and y; its z is the bed
    double corner[3];
    /// least distance of any two parts; parts may touch the plate's rim; default 2.0
    double spacing;
    treeform_plate_turns turns;  ///< default quarter
    /// Fill the box up to its height: parts also come above, below and inside one another, and
    /// hang in the air. Otherwise each stands on the bed. The height has to be finite.
    int32_t stack;
    uint32_t plates;  ///< most plates used; at least 1; default 1
    /// from the corner of a plate to that of the next; its z is ignored
    double plate_step[3];
    int32_t tighten;  ///< close the gaps that the raster leaves; default 1
    uint64_t seed;    ///< of the orders and turns that are tried when not all parts fit
    uint32_t tries;   ///< at most; at least 1; default 32
    /// No more tries begin after this many seconds. Where that ends the search, the result depends
    /// on the speed of the machine; default infinite
    double seconds;
    treeform_precision precision;  ///< of the points returned; default float64
    treeform_progress progress;
    void* progress_data;
} treeform_pack_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_pack_options_init(treeform_pack_options* options, size_t size);

/// A part on a plate.
typedef struct treeform_packed_part {
    int32_t placed;  ///< it has a place
    uint32_t plate;  ///< number of its plate, from 0
    /// [V] the new points, as they are to be written; unchanged when the part is not placed.
    const double* points;
    size_t point_count;
    /// new = M * old, a turn about z and a translation; the identity when the part is not placed.
    /// `points` differ from it by a few units in the last place of the largest coordinate.
    double matrix[12];
} treeform_packed_part;

/// Filled plates.
typedef struct treeform_packing {
    void* owner;
    /// ok: what `treeform_pack` promises of the points holds, also where parts have no place.
    /// Otherwise `cancelled`, and the rest is empty.
    const treeform_certificate* certificate;
    const char* message;                ///< half a sentence for people
    const treeform_packed_part* parts;  ///< [P] in the order of the input
    size_t part_count;
    /// [not_placed_count] numbers of parts without a place, ascending
    const uint32_t* not_placed;
    size_t not_placed_count;
    uint32_t plates_used;  ///< plates with a part
    uint32_t tries;        ///< made
    /// Share of the plates that the parts on them cover, seen from above, as the raster has it;
    /// with `stack`, of the boxes that their solids with what they enclose fill.
    double density;
    /// Pairs of parts whose faces were compared, because their boxes are nearer than the spacing.
    uint64_t pairs_measured;
    double bed;  ///< least z of a placed part that stands on the bed, as written
} treeform_packing;

/// Puts the parts on plates, each turned about z by one of `turns`. Unless they are stacked, each
/// stands on the bed with its lowest point.
///
/// For the coordinates in `points`, as written:
///
/// - The lowest z of a placed part is exactly that of the bed (with float32, the least one not
/// below it); of a stacked part, not below it.
///
/// - No coordinate is outside the plate or above its height.
///
/// - Any two placed parts of a plate are at least `spacing` apart, by their exact boxes or by
/// `treeform_distance` less its error, and none is inside another's solid. With a spacing of 0,
/// parts may touch only in a plane that separates their boxes.
///
/// A small part may stand in a hole of another, and `tighten` may move a part below an overhang. A
/// void that is closed all around stays empty.
///
/// This is a search, and a part that is not placed may have had a place. In the first try, parts
/// are taken in the order of the area that they cover (stacked, of their volume). Each goes to the
/// first plate that has room, there to the free place of the least (z, then) y, then x, on a
/// raster of about 512 cells a side (stacked, 96), and is then moved down (z,) y and x until
/// something is in the way. While not all are placed, other orders and turns are tried: at random
/// by the seed, and with parts that found no place brought forward. With several plates, tries
/// also go on while more plates are used than the area asks for. The result is the try with the
/// most parts placed, then with the least area left, then with the fewest plates, then the first.
///
/// Parts without faces take no room: they are placed where they are. Points that no face uses move
/// along with their part and are otherwise ignored. Equal parts are prepared once.
TREEFORM_C_API treeform_code treeform_pack(const treeform_mesh* const* parts, size_t count,
                                           const treeform_pack_options* options,
                                           treeform_packing** packing);

/// What each step of ICP makes small.
typedef int32_t treeform_align_method;
enum {
    /// Distances to the planes of the nearest faces, in least squares. Where an edge or a corner
    /// is nearest, the plane through it perpendicular to the way to it. Of a fixed cloud, the
    /// plane fitted to the points around the nearest one. Takes few iterations on surfaces.
    TREEFORM_POINT_TO_PLANE = 0,
    /// Distances to the nearest points, in least squares: for clouds, or where planes say little.
    TREEFORM_POINT_TO_POINT = 1,
    /// `point_to_plane` on a fixed mesh, `plane_to_plane` on a fixed cloud
    TREEFORM_ALIGN_AUTOMATIC = 2,
    /// Of a fixed cloud, distances to the plane between the one at the moving point and the one at
    /// the fixed point, the less the more these disagree; distances across count a thousandth. No
    /// matter how differently dense the sides are, as on the rings around a scanner. On a fixed
    /// mesh the same as `point_to_plane`. Planes are fitted to the 12 nearest points, or where
    /// these are on a line to up to 192.
    TREEFORM_PLANE_TO_PLANE = 3
};

/// How to align.
typedef struct treeform_align_options {
    size_t size;
    treeform_align_method method;  ///< default automatic
    /// Share of the moving points that have a partner, in (0, 1]. Each step uses this share, the
    /// nearest ones, and ignores the rest; default 1.0
    double overlap;
    /// Ignore partners further apart. Not squared, not negative; default infinite
    double max_distance;
    /// Find a uniform scale, too: from that of the start and from the one that makes both sides as
    /// large, up to twice and down to half of it each. Of these, the better one is where points of
    /// both sides, each by its own size, are nearer to the other side.
    int32_t scale;
    uint32_t max_iterations;  ///< from each start; default 100
    /// Converged when in 5 steps in a row the cost falls by less than this share of itself, or
    /// when a step moves no point near the fixed mesh by more than 1e-11 of the diagonal of its
    /// box; default 1e-6
    double tolerance;
    /// Places to start from, at least 1. The first is the present position; then the principal
    /// axes of both sides on each other, in their 4 ways; then turns spread evenly over all turns,
    /// small ones first, with the centers on each other. The best end wins; of equals the first;
    /// default 1
    uint32_t starts;
    /// Anderson acceleration: steps learn from the 5 before them; default 1
    int32_t accelerate;
    /// Use at most this many moving points in the steps, spread evenly over space; 0 is all;
    /// default 100000
    uint64_t samples;
    /// [12] Applied to the moving points first: any affine map; or null
    const double* start;
    treeform_precision precision;  ///< of the points returned; default float64
    treeform_progress progress;
    void* progress_data;
    /// Bounds of `align_result::scale` where it is found: positive, or 0 and infinity for none. A
    /// start beyond them begins at the nearest. Equal ones are the scale, as known.
    double least_scale;
    double most_scale;  ///< default infinite
    /// Partners count less the further apart they are: by exp(-d^2 / 2 v^2) (Welsch). From 3
    /// medians of the distances at the start, v is halved down to where a third of the points is
    /// within 2 v; at the end it is 4.5 medians of what is near. Up to half of the points may have
    /// no partner, and nobody needs to say how many. Otherwise all count alike; default 1
    int32_t robust;
} treeform_align_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_align_options_init(treeform_align_options* options, size_t size);

/// A small motion of the moving points, and how much the distances tell of it: a turn by `turn`
/// (axis times angle) about `align_result::pivot_moved` and a shift, together by 1 in the root
/// mean square over the points.
typedef struct treeform_freedom {
    double turn[3];   ///< axis times angle, about `pivot_moved`
    double shift[3];  ///< after the turn
    /// Share of the motion (of its squares) that is along the normals: near 0 where points slide
    /// on the surface and nothing holds them, as a plane on a plane; 1 at most.
    double stiffness;
} treeform_freedom;

/// How the search ended.
typedef int32_t treeform_align_end;
enum {
    /// at a place that nothing speaks against
    TREEFORM_ALIGN_CONVERGED = 0,
    /// `max_iterations` steps were not enough
    TREEFORM_ALIGN_OUT_OF_ITERATIONS = 1,
    /// Converged, but what remains is not noise: points that are neighbors are off to the same
    /// side, by more than can be told from the right place. Often a wrong local optimum, or parts
    /// without a partner.  Or the scale is at its bound, or the points of a cloud do not tell
    /// where they belong: `uncertainty` is above 0.2% of the diagonal of the fixed box, those not
    /// fitted would move all further than that, or something slides.
    TREEFORM_ALIGN_DOUBTFUL = 2,
    /// no points, or none has a partner
    TREEFORM_ALIGN_NOTHING = 3
};

/// The motion found.
typedef struct treeform_align_result {
    void* owner;
    const double* points;  ///< [V] the moving points, moved by `matrix` and rounded
    size_t point_count;
    /// new = M * old, with `start` included. Far from the origin its last column is large, and so
    /// is its rounding. There, new = `pivot_moved` + (linear part of M) * (old - `pivot`) is more
    /// accurate.
    double matrix[12];
    double pivot[3];        ///< center of the box of the moving points
    double pivot_moved[3];  ///< where the pivot goes
    double scale;           ///< the scale found, in addition to that of `start`
    /// Root mean square of the distances that count, after, by weights if there are; 0 for none.
    /// Of two clouds by `plane_to_plane`, the distances to the planes, as far as both sides agree.
    double rms;
    double rms_at_start;  ///< the same at the start, without weights
    /// Share of all moving points whose nearest fixed point is within `max_distance`, after.
    double overlap;
    /// How many of the moving points are within 4.5 medians of the distances that count.
    uint64_t inliers;
    /// Correlation of the signed distances of neighbors, in [-1, 1]: near 0 where they are noise,
    /// near 1 where whole regions are off to one side.
    double correlation;
    /// [freedom_count] The independent motions, least held first; none without partners.
    const treeform_freedom* freedoms;
    size_t freedom_count;
    size_t undetermined;     ///< how many of `freedoms` nothing holds
    treeform_align_end end;  ///< how the search ended
    uint32_t iterations;     ///< steps from the best start
    uint32_t start;          ///< which start that was: 0 is the present position
    const char* message;     ///< half a sentence for people
    /// How far the points may be from where they belong: the standard deviation that the distances
    /// leave, and how little they hold, as a root mean square over the points; without the motions
    /// that `undetermined` counts.
    double uncertainty;
} treeform_align_result;

/// The rigid motion, with a uniform scale if asked for, that brings the moving points near the
/// fixed mesh, or near its points when it has no faces.
///
/// From each start it is a local optimum: the right one when the motion is small compared with the
/// features of the shape. The result is never worse than the present position; when nothing better
/// is found, it is `start`, grown or shrunk about its center to the bounds of the scale. To
/// compare, the squared distances of all moving points to the nearest fixed points are cut off at
/// `max_distance` squared, and the mean is taken over the `overlap` share that is nearest. With
/// weights, and with an overlap below 1, it is Welsch's function of the distances, by the v of the
/// end: a share that is somewhat too large does no harm. Directions in which the points may slide
/// freely (a plane on a plane) are left alone. Equal points count once on a cloud.
///
/// Along motions that are little held (a stiffness below 0.02, as of a cogwheel about its axis),
/// places up to 6% of the diagonal away are tried, too.
///
/// Whether it is the right place, distances alone do not tell. At the right place they are noise;
/// at a wrong one, regions are off to one side. From 4000 moving points on, every fourth is not
/// fitted, and is what is looked at. Where they are off, by more than noise, places around the
/// start are tried: shifts by 8% of the diagonal, turns by 14 degrees. Where they still are, a
/// cloud is in doubt when they are off by more than 0.6 times of how thick both sides are around
/// their planes. On a mesh, `converged` needs that other starts, tried with few points, do not end
/// better, and that what is off is below 0.2% of the diagonal.
///
/// Without moving or without fixed points, the result is `start`, not converged.
TREEFORM_C_API treeform_code treeform_align(const treeform_mesh* moving, const treeform_mesh* fixed,
                                            const treeform_align_options* options,
                                            treeform_align_result** result);
// end
