// Made by tools/bindings of layouts.h and the headers of C++: see its README.
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/pack.hpp>

#include <tools/c/layouts.hpp>
#include <tools/c/made/structs.hpp>

namespace tf = treeform;

static_assert(TREEFORM_POINT_TO_PLANE == static_cast<int>(tf::align_method::point_to_plane));
static_assert(TREEFORM_POINT_TO_POINT == static_cast<int>(tf::align_method::point_to_point));
static_assert(TREEFORM_ALIGN_AUTOMATIC == static_cast<int>(tf::align_method::automatic));
static_assert(TREEFORM_PLANE_TO_PLANE == static_cast<int>(tf::align_method::plane_to_plane));
static_assert(TREEFORM_ALIGN_CONVERGED == static_cast<int>(tf::align_end::converged));
static_assert(TREEFORM_ALIGN_OUT_OF_ITERATIONS ==
              static_cast<int>(tf::align_end::out_of_iterations));
static_assert(TREEFORM_ALIGN_DOUBTFUL == static_cast<int>(tf::align_end::doubtful));
static_assert(TREEFORM_ALIGN_NOTHING == static_cast<int>(tf::align_end::nothing_to_align));

tf::lay_flat_options glue::read(const treeform_lay_flat_options* options) {
    return read(chosen(options, treeform_lay_flat_options_init));
}
tf::lay_flat_options glue::read(const treeform_lay_flat_options& o) {
    tf::lay_flat_options how;
    how.normal = point_if(o.normal, "normal");
    how.point = point_if(o.point, "point");
    how.most_stable = o.most_stable != 0;
    how.keep_spin = o.keep_spin != 0;
    how.tolerance = o.tolerance;
    how.bed = o.bed;
    how.overhang_angle = o.overhang_angle;
    how.overhang_sides = limit(o.overhang_sides);
    how.precision = choice<tf::precision>(o.precision, 2, "precision");
    how.progress = progress(o);

    return how;
}

void treeform_lay_flat_options_init(treeform_lay_flat_options* options, size_t size) {
    treeform_lay_flat_options to{};
    const tf::lay_flat_options from;
    to.most_stable = from.most_stable;
    to.keep_spin = from.keep_spin;
    to.tolerance = from.tolerance;
    to.bed = from.bed;
    to.overhang_angle = from.overhang_angle;
    to.overhang_sides = from.overhang_sides;
    to.precision = static_cast<treeform_precision>(from.precision);
    glue::init(options, size, to);
}

void glue::fill(keeper& kept, const tf::laid_flat& from, treeform_laid_flat& to) {
    to.points = flat(from.points);
    to.point_count = from.points.size();
    copy(from.matrix, to.matrix);
    to.bed = from.bed;
    to.sides = same<treeform_hull_side>(from.sides);
    to.side_count = from.sides.size();
    to.tip_angles = or_null(from.tip_angles);
    to.center_heights = or_null(from.center_heights);
    to.overhangs = or_null(from.overhangs);
    copy(from.center_of_mass, to.center_of_mass);
    to.mass_dimension = from.mass_dimension;
    to.chosen = from.chosen;
    to.on_bed = or_null(from.on_bed);
    to.on_bed_count = from.on_bed.size();
    to.corrected = from.corrected;
    to.certificate = &filled<treeform_certificate>(kept, from.certificate);
    to.message = kept.keep(from.message()).c_str();
}

tf::pack_options glue::read(const treeform_pack_options* options) {
    return read(chosen(options, treeform_pack_options_init));
}
tf::pack_options glue::read(const treeform_pack_options& o) {
    tf::pack_options how;
    how.size = point(o.plate, "plate");
    how.corner = point(o.corner, "corner");
    how.spacing = o.spacing;
    how.turns = o.turns;
    how.stack = o.stack != 0;
    how.plates = o.plates;
    how.plate_step = point(o.plate_step, "plate_step");
    how.tighten = o.tighten != 0;
    how.seed = o.seed;
    how.tries = o.tries;
    how.seconds = o.seconds;
    how.precision = choice<tf::precision>(o.precision, 2, "precision");
    how.progress = progress(o);

    return how;
}

void treeform_pack_options_init(treeform_pack_options* options, size_t size) {
    treeform_pack_options to{};
    const tf::pack_options from;
    using namespace glue;
    copy(from.size, to.plate);
    copy(from.corner, to.corner);
    to.spacing = from.spacing;
    to.turns = from.turns;
    to.stack = from.stack;
    to.plates = from.plates;
    copy(from.plate_step, to.plate_step);
    to.tighten = from.tighten;
    to.seed = from.seed;
    to.tries = from.tries;
    to.seconds = from.seconds;
    to.precision = static_cast<treeform_precision>(from.precision);
    glue::init(options, size, to);
}

void glue::fill(keeper&, const tf::packed_part& from, treeform_packed_part& to) {
    to.placed = from.placed;
    to.plate = from.plate;
    to.points = flat(from.points);
    to.point_count = from.points.size();
    copy(from.matrix, to.matrix);
}

void glue::fill(keeper& kept, const tf::packing& from, treeform_packing& to) {
    to.parts = list<treeform_packed_part>(kept, from.parts);
    to.part_count = from.parts.size();
    to.not_placed = or_null(from.not_placed);
    to.not_placed_count = from.not_placed.size();
    to.plates_used = from.plates_used;
    to.tries = from.tries;
    to.density = from.density;
    to.pairs_measured = from.pairs_measured;
    to.bed = from.bed;
    to.certificate = &filled<treeform_certificate>(kept, from.certificate);
    to.message = kept.keep(from.message()).c_str();
}

tf::align_options glue::read(const treeform_align_options* options) {
    return read(chosen(options, treeform_align_options_init));
}
tf::align_options glue::read(const treeform_align_options& o) {
    tf::align_options how;
    how.method = choice<tf::align_method>(o.method, 4, "method");
    how.overlap = o.overlap;
    how.robust = o.robust != 0;
    how.max_distance = o.max_distance;
    how.scale = o.scale != 0;
    how.least_scale = o.least_scale;
    how.most_scale = o.most_scale;
    how.max_iterations = o.max_iterations;
    how.tolerance = o.tolerance;
    how.starts = o.starts;
    how.accelerate = o.accelerate != 0;
    how.samples = limit(o.samples);
    how.start = matrix(o.start);
    how.precision = choice<tf::precision>(o.precision, 2, "precision");
    how.progress = progress(o);

    return how;
}

void treeform_align_options_init(treeform_align_options* options, size_t size) {
    treeform_align_options to{};
    const tf::align_options from;
    to.method = static_cast<treeform_align_method>(from.method);
    to.overlap = from.overlap;
    to.robust = from.robust;
    to.max_distance = from.max_distance;
    to.scale = from.scale;
    to.least_scale = from.least_scale;
    to.most_scale = from.most_scale;
    to.max_iterations = from.max_iterations;
    to.tolerance = from.tolerance;
    to.starts = from.starts;
    to.accelerate = from.accelerate;
    to.samples = from.samples;
    to.precision = static_cast<treeform_precision>(from.precision);
    glue::init(options, size, to);
}

static_assert(sizeof(treeform_freedom) == sizeof(tf::align_freedom));
static_assert(offsetof(treeform_freedom, turn) == offsetof(tf::align_freedom, turn));
static_assert(offsetof(treeform_freedom, shift) == offsetof(tf::align_freedom, shift));
static_assert(offsetof(treeform_freedom, stiffness) == offsetof(tf::align_freedom, stiffness));

void glue::fill(keeper& kept, const tf::align_result& from, treeform_align_result& to) {
    to.points = flat(from.points);
    to.point_count = from.points.size();
    copy(from.matrix, to.matrix);
    copy(from.pivot, to.pivot);
    copy(from.pivot_moved, to.pivot_moved);
    to.scale = from.scale;
    to.rms = from.rms;
    to.rms_at_start = from.rms_at_start;
    to.overlap = from.overlap;
    to.inliers = from.inliers;
    to.correlation = from.correlation;
    to.uncertainty = from.uncertainty;
    to.freedoms = same<treeform_freedom>(from.freedoms);
    to.freedom_count = from.freedoms.size();
    to.end = static_cast<treeform_align_end>(from.end);
    to.iterations = from.iterations;
    to.start = from.start;
    to.message = kept.keep(from.message()).c_str();
    to.undetermined = from.undetermined();
}

treeform_code treeform_lay_flat(const treeform_mesh* mesh, const treeform_lay_flat_options* options,
                                treeform_laid_flat** flat) {
    return glue::guard([&] {
        glue::start(flat);
        return glue::give(tf::lay_flat(glue::ref(mesh, "mesh"), glue::read(options)), flat);
    });
}

treeform_code treeform_pack(const treeform_mesh* const* parts, size_t count,
                            const treeform_pack_options* options, treeform_packing** packing) {
    return glue::guard([&] {
        glue::start(packing);
        return glue::give(tf::pack(glue::refs(parts, count, "parts"), glue::read(options)),
                          packing);
    });
}

treeform_code treeform_align(const treeform_mesh* moving, const treeform_mesh* fixed,
                             const treeform_align_options* options,
                             treeform_align_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(
            tf::align(glue::ref(moving, "moving"), glue::ref(fixed, "fixed"), glue::read(options)),
            result);
    });
}
