#pragma once
/// \file
/// Laying meshes flat, packing them on plates, aligning them.

#include <treeform/c/properties.h>

// made of the headers of C++:
//   lay_flat_options laid_flat lay_flat() pack_options packed_part packing pack() align_method
//   align_options align_freedom align_outcome align_result align()
/// How to lay a mesh flat. At most one of `normal`, `point` and `most_stable` chooses the side of
/// the convex hull that goes down; otherwise the side of the largest area does.
typedef struct treeform_lay_flat_options {
    size_t struct_size;
    /// Do not rotate about the vertical. Otherwise the mesh is also rotated about it, by at most
    /// 45 degrees, so that the longest edge of the side runs along x or y.
    int32_t keep_spin;
    /// Points at most this far from the plane of a side belong to it. With 0, a side is exactly
    /// coplanar, which suits models in round numbers. A flat face that was rotated and rounded
    /// falls into many exactly coplanar sides; about 1e-6 of the size joins them.
    double tolerance;
    double bed;               ///< z of the bed
    double overhang_angle;    ///< in degrees from the vertical, 0 to 90; default 45.0
    uint64_t overhang_sides;  ///< compute the overhangs of this many sides; default 32
    /// of the points returned; default `TREEFORM_FLOAT64`
    treeform_precision precision;
    treeform_progress progress;
    void* progress_data;
    /// [3] The side whose outward normal makes the least angle with this direction, of any length,
    /// in the coordinates of the mesh; or null
    const double* normal;
    /// [3] The side nearest to this point: the one that contains it, if one does; or null
    const double* point;
    int32_t most_stable;  ///< the side with the largest tip angle
} treeform_lay_flat_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_lay_flat_options_init(treeform_lay_flat_options* options, size_t size);

/// A mesh on the bed.
typedef struct treeform_laid_flat {
    void* owner;
    /// ok, or `TREEFORM_STATUS_CANCELLED`: then the rest is empty. `max_displacement` includes
    /// `corrected`.
    const treeform_certificate* certificate;
    const char* message;   ///< the outcome as a clause for people, without a full stop
    const double* points;  ///< [V][3] the new points, as they are to be written
    size_t point_count;
    /// new = M * old, a rotation and a translation. `points` differ from it by a few units in the
    /// last place of the largest coordinate, old or new.
    double matrix[12];
    /// Z of the points on the bed; with float32, the least number not below the bed.
    double bed;
    /// [side_count] The sides of the convex hull before the rotation, largest area first. With a
    /// tolerance, a side includes its neighbors within the tolerance of its plane.
    const treeform_hull_side* sides;
    size_t side_count;
    size_t chosen;             ///< number in `sides`
    double center_of_mass[3];  ///< before the rotation, rounded
    const uint32_t* on_bed;    ///< [on_bed_count] points of the chosen side, ascending
    size_t on_bed_count;
    /// The largest change of a z, after the rotation, that put a point onto the bed: a few units
    /// in the last place; with a tolerance, about the tolerance.
    double corrected;
    /// [S] for each side the least tilt, in degrees, that brings the center of mass over an edge
    /// of it, so that the mesh tips over. 90 if the center is in the plane of the side. Negative
    /// if the center is not over the side: then the mesh tips over by itself.
    const double* tip_angles;
    const double* center_heights;  ///< [S] height of the center of mass above each side
    /// [S] area of the faces that need support if the side is down: faces off the bed that point
    /// down at more than `overhang_angle` from the vertical. Only computed for the first
    /// `overhang_sides` sides and the chosen one, else NaN.
    const double* overhangs;
    /// What the mass is attributed to: 3 for the solid that a closed mesh bounds; 2 for the faces
    /// of an open mesh, as sheets of equal thickness; 0 for the points of a mesh without a face of
    /// positive area.
    int32_t mass_dimension;
} treeform_laid_flat;

/// Rotates `mesh` so that a flat side of its convex hull is on the bed. The center of its box
/// keeps x and y. Null, with `TREEFORM_OK`, if there is no side: fewer than three points, or all
/// on a line.
///
/// Every point in the plane of the side, exactly or within the tolerance, gets exactly the z of
/// the bed, and no point is below. Areas and angles are rounded; values within 2^-40 of the best
/// are treated as equal. Of equal sides, one that is already exactly down is chosen, else the
/// largest, else the first in `sides`. Points without faces move along and are otherwise ignored;
/// a mesh without faces uses all its points.
TREEFORM_C_API treeform_code treeform_lay_flat(const treeform_mesh* mesh,
                                               const treeform_lay_flat_options* options,
                                               treeform_laid_flat** flat);

/// The plates, and options of packing.
typedef struct treeform_pack_options {
    size_t struct_size;
    /// Length, depth and height of the plate or box. An infinite height, or 0, means no limit, so
    /// that {250, 210, 0} is a plate; default infinite
    double size[3];
    /// The corner of the first plate with the lowest x and y; its z is the bed.
    double corner[3];
    /// least distance between parts; parts may touch the plate's rim; default 2.0
    double spacing;
    /// Rotations about the vertical that are tried for each part, evenly over the full circle: 1
    /// (none), 2, 3, 4, 6, 8, 12 or 24; default 4
    uint32_t turns;
    /// Fill the box up to its height, which must be finite: parts may be above, below and inside
    /// one another, and hang in the air. Otherwise each part stands on the bed.
    int32_t stack;
    uint32_t plates;  ///< largest number of plates to use; at least 1; default 1
    /// from the corner of a plate to that of the next; its z is ignored
    double plate_step[3];
    int32_t tighten;  ///< close gaps left by the raster; default 1
    /// Seed of the orders and rotations that are tried if not all parts fit.
    uint64_t seed;
    uint32_t tries;  ///< largest number of tries; at least 1; default 32
    /// Start no more tries after this many seconds. If that ends the search, the result depends on
    /// the speed of the machine; default infinite
    double seconds;
    /// of the points returned; default `TREEFORM_FLOAT64`
    treeform_precision precision;
    treeform_progress progress;
    void* progress_data;
} treeform_pack_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_pack_options_init(treeform_pack_options* options, size_t size);

/// A part on a plate.
typedef struct treeform_packed_part {
    int32_t placed;  ///< whether a position was found
    uint32_t plate;  ///< number of its plate, from 0
    /// [V][3] the new points, rounded to the precision; unchanged if the part is not placed.
    const double* points;
    size_t point_count;
    /// new = M * old, a rotation about z and a translation; the identity if the part is not
    /// placed. `points` differ from it by a few units in the last place of the largest coordinate.
    double matrix[12];
} treeform_packed_part;

/// Filled plates.
typedef struct treeform_packing {
    void* owner;
    /// ok: the guarantees of `treeform_pack` hold for the points, even if some parts have no
    /// place. Otherwise `TREEFORM_STATUS_CANCELLED`, and the rest is empty.
    const treeform_certificate* certificate;
    const char* message;                ///< the outcome as a clause for people, without a full stop
    const treeform_packed_part* parts;  ///< [P] in the order of the input
    size_t part_count;
    /// [not_placed_count] numbers of parts without a position, ascending
    const uint32_t* not_placed;
    size_t not_placed_count;
    uint32_t plates_used;  ///< plates with a part
    uint32_t tries;        ///< number of tries made
    /// Share of the area of the used plates that their parts cover, by the raster; with `stack`,
    /// share of the volume that the solids fill, cavities included.
    double density;
    /// Number of pairs of parts whose faces were compared, since their boxes are nearer than the
    /// spacing.
    uint64_t pairs_measured;
    double bed;  ///< least z of a placed part that stands on the bed, rounded
} treeform_packing;

/// Places the parts on plates, each rotated about z by one of `turns`. Unless stacked, each part
/// stands on the bed with its lowest point.
///
/// For the rounded coordinates in `points`:
///
/// - The lowest z of a placed part is exactly that of the bed (with float32, the least number not
/// below it); of a stacked part, it is not below the bed.
///
/// - No coordinate is outside the plate or above its height.
///
/// - Any two placed parts of a plate are at least `spacing` apart, by their exact boxes or by
/// `treeform_distance` minus its error, and no part is inside another. With a spacing of 0, parts
/// may only touch in a plane that separates their boxes.
///
/// A small part may stand in a hole of another, and `tighten` may move a part below an overhang.
/// No part is placed in a void that is closed all around.
///
/// This is a heuristic search: a place may exist for a part that is not placed. In the first try,
/// parts are placed in descending order of the area that they cover. Each part goes to the first
/// plate with room, to the free position with the least y, then the least x, on a raster of about
/// 512 cells a side. Then it is moved toward lower y and x until it meets an obstacle. With
/// `stack`, the order is by volume, z comes before y, and the raster has about 96 cells a side.
/// While parts are not placed, other orders and rotations are tried: at random by the seed, and
/// with unplaced parts first. With several plates, tries also go on while more plates are used
/// than the area requires. The result is the try with the most parts placed, then with the least
/// area unplaced, then with the fewest plates, then the earliest.
///
/// Empty parts occupy no space: they are placed at their present position. Points that no face
/// uses move along with their part and are otherwise ignored. Equal parts are prepared once.
TREEFORM_C_API treeform_code treeform_pack(const treeform_mesh* const* parts, size_t count,
                                           const treeform_pack_options* options,
                                           treeform_packing** packing);

/// The cost that each step of ICP minimizes.
typedef int32_t treeform_align_method;
enum {
    /// Distances to the planes of the nearest faces, in least squares. If the nearest point is on
    /// an edge or a corner, its plane is perpendicular to the connecting segment; on a fixed
    /// cloud, its plane is fitted to the points around it. Needs few iterations on surfaces.
    TREEFORM_POINT_TO_PLANE = 0,
    /// Distances to the nearest points, in least squares: for clouds, or where planes determine
    /// little.
    TREEFORM_POINT_TO_POINT = 1,
    /// `TREEFORM_POINT_TO_PLANE` on a fixed mesh, `TREEFORM_PLANE_TO_PLANE` on a fixed cloud
    TREEFORM_ALIGN_AUTOMATIC = 2,
    /// For a fixed cloud, distances to the mean of the planes at the moving and at the fixed
    /// point, with less weight if these disagree; distances along the plane have a weight of
    /// 1/1000. Robust to different densities, as in the rings around a scanner. On a fixed mesh
    /// the same as `TREEFORM_POINT_TO_PLANE`. Planes are fitted to the 12 nearest points, or up to
    /// 192 if these are collinear.
    TREEFORM_PLANE_TO_PLANE = 3
};

/// How to align.
typedef struct treeform_align_options {
    size_t struct_size;
    treeform_align_method method;  ///< default `TREEFORM_ALIGN_AUTOMATIC`
    /// Share of the moving points that have a partner (a corresponding fixed point), in (0, 1].
    /// Each step uses this share of the points, those with the nearest partners; default 1.0
    double overlap;
    /// Ignore partners farther apart than this. Not squared, not negative; default infinite
    double max_distance;
    /// Also find a uniform scale. The search tries scales from half to twice that of `start`, and
    /// from half to twice the scale that makes `moving` and `fixed` equally large. It compares
    /// results by the distances between both, relative to their sizes.
    int32_t scale;
    uint32_t max_iterations;  ///< largest number of steps from each start; default 100
    /// Converged if the cost falls by less than this share in each of 5 consecutive steps, or if a
    /// step moves no point near the fixed mesh by more than 1e-11 of the diagonal of the fixed
    /// mesh's box; default 1e-6
    double tolerance;
    /// Number of starts, at least 1. The first is the present position; then the principal axes of
    /// `moving` and `fixed` aligned, in the 4 possible ways; then rotations spread evenly over all
    /// rotations, small ones first, with aligned centers. The best result is returned; of equal
    /// results the first; default 1
    uint32_t starts;
    int32_t accelerate;  ///< Anderson acceleration with the 5 previous steps; default 1
    /// [12] Applied to the moving points first, which gives the "present position"; any affine
    /// map; or null
    const double* start;
    /// of the points returned; default `TREEFORM_FLOAT64`
    treeform_precision precision;
    treeform_progress progress;
    void* progress_data;
    /// Bounds of `treeform_align_result::scale` if `scale` is set: positive, or 0 and infinity for
    /// none. A start outside the bounds is moved to the nearest bound. Equal bounds fix the scale.
    double least_scale;
    double most_scale;  ///< default infinite
    /// Weight partners at distance d by exp(-d^2 / (2 v^2)) (Welsch), so that up to half of the
    /// points may have no partner, without a given `overlap`. v starts at 3 times the median
    /// distance, and is halved while at least a third of the points are within v; finally it is
    /// 4.5 times the median of the near distances. If false, all partners have the same weight;
    /// default 1
    int32_t robust;
    /// Use at most this many moving points in the steps, spread evenly over space; 0 is all;
    /// default 100000
    uint64_t max_samples;
} treeform_align_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_align_options_init(treeform_align_options* options, size_t size);

/// A small motion of the moving points, and how well the distances determine it. It is a rotation
/// about `treeform_align_result::pivot_moved` and a shift, scaled so that the root mean square of
/// the motion over the points is 1.
typedef struct treeform_align_freedom {
    double turn[3];   ///< axis times angle, about `pivot_moved`
    double shift[3];  ///< after the turn
    /// Share of the squared motion along the normals, 0 to 1: near 0 if points slide on the
    /// surface, like a plane on a plane.
    double stiffness;
} treeform_align_freedom;

/// How the search ended.
typedef int32_t treeform_align_outcome;
enum {
    /// converged, and no test of the result failed
    TREEFORM_ALIGN_CONVERGED = 0,
    /// `max_iterations` steps were not enough
    TREEFORM_ALIGN_OUT_OF_ITERATIONS = 1,
    /// Converged, but residuals are more than noise: neighboring points deviate to the same side
    /// by more than in a correct alignment. Often a wrong local optimum, or parts without a
    /// partner.  Also if the scale is at its bound, or the points of a fixed cloud do not
    /// determine the position: `uncertainty` exceeds 0.2% of the diagonal of the fixed box, a fit
    /// to the held-out points would move all points by more than that, or a motion is
    /// undetermined.
    TREEFORM_ALIGN_DOUBTFUL = 2,
    /// there are no points, or no point has a partner
    TREEFORM_ALIGN_NOTHING = 3
};
/// The name of a value, as in reports: "converged"; "unknown" for others.
TREEFORM_C_API const char* treeform_align_outcome_name(treeform_align_outcome value);

/// The motion found.
typedef struct treeform_align_result {
    void* owner;
    const double* points;  ///< [V][3] the moving points, moved by `matrix` and rounded
    size_t point_count;
    /// new = M * old, with `start` included. Far from the origin its last column is large and has
    /// a large rounding error; then new = `pivot_moved` + (linear part of M) * (old - `pivot`) is
    /// more accurate.
    double matrix[12];
    double pivot[3];        ///< center of the box of the moving points
    double pivot_moved[3];  ///< the pivot, moved by `matrix`
    double scale;           ///< the scale found, in addition to that of `start`
    /// Root mean square of the distances at the end, weighted if weights are used; 0 without
    /// partners. For two clouds with `TREEFORM_PLANE_TO_PLANE`: of the distances to the planes,
    /// weighted by the agreement of both planes.
    double rms;
    double rms_at_start;  ///< the same at the start, unweighted
    /// Share of all moving points whose nearest fixed point is within `max_distance`, at the end.
    double overlap;
    /// Number of moving points within 4.5 times the median of the distances used.
    uint64_t inliers;
    /// Correlation of the signed distances of neighbors, in [-1, 1]: near 0 for noise, near 1 if
    /// whole regions deviate to one side.
    double correlation;
    /// [freedom_count] The independent motions, ascending by stiffness; none without partners.
    const treeform_align_freedom* freedoms;
    size_t freedom_count;
    size_t undetermined;             ///< number of `freedoms` that the data do not determine
    treeform_align_outcome outcome;  ///< how the search ended
    uint32_t iterations;             ///< steps from the best start
    uint32_t best_start;             ///< number of the best start; 0 is the present position
    const char* message;             ///< the outcome as a clause for people, without a full stop
    /// Estimated standard deviation of the position, as a root mean square over the points, from
    /// the residuals and the stiffness of the motions. Motions that `undetermined` counts are left
    /// out.
    double uncertainty;
} treeform_align_result;

/// The rigid motion, with a uniform scale if requested, that brings the moving points near the
/// fixed mesh, or near its points if it has no faces.
///
/// From each start this is a local optimum: the right one if the motion is small compared with the
/// features of the shape. The result is never worse than the present position; if nothing better
/// is found, it is `start`, scaled about its center to the bounds of the scale. Results are
/// compared by a mean of squared distances to the nearest fixed points, each at most
/// `max_distance` squared, over the nearest `overlap` share of the points. If `robust`, or with an
/// overlap below 1, they are compared by the mean of Welsch's function with the final v instead,
/// so that an overlap somewhat too large does no harm. Motions in which points slide freely (a
/// plane on a plane) are not made. Equal points of a cloud count once.
///
/// Along motions with a stiffness below 0.02, such as the rotation of a gear about its axis,
/// positions up to 6% of the diagonal away are also tried.
///
/// Small distances alone do not prove that a result is correct. In a correct alignment residuals
/// are noise; in a wrong one, whole regions deviate to one side. With 4000 moving points or more,
/// every fourth is held out of the fit and used for this test. If its residuals are more than
/// noise, other starts around `start` are tried: shifts by 8% of the diagonal, rotations by 14
/// degrees. If residuals are still more than noise: on a fixed cloud, the result is
/// `TREEFORM_ALIGN_DOUBTFUL` if they exceed 0.6 times the thickness of both point sets around
/// their fitted planes. On a fixed mesh, it is `TREEFORM_ALIGN_DOUBTFUL` if another start, tried
/// with few points, ends better, or if the deviation exceeds 0.2% of the diagonal.
///
/// If `moving` or `fixed` has no points, the result is `start`, not converged.
TREEFORM_C_API treeform_code treeform_align(const treeform_mesh* moving, const treeform_mesh* fixed,
                                            const treeform_align_options* options,
                                            treeform_align_result** result);
// end
