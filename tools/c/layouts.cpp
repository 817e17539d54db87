#include <treeform/mesh/align.hpp>
#include <treeform/mesh/lay_flat.hpp>
#include <treeform/mesh/pack.hpp>

#include <tools/c/glue.hpp>

#include <algorithm>

namespace tf = treeform;

namespace {

void fill(glue::answer<treeform_laid_flat>& made, const tf::laid_flat& from) {
    treeform_laid_flat& l = made.value;
    l.certificate = glue::keep(made, from.certificate);
    l.message = made.keep(from.message()).c_str();
    l.points = glue::flat(from.points);
    l.point_count = from.points.size();
    glue::copy(from.matrix, l.matrix);
    l.bed = from.bed;
    l.sides = glue::same<treeform_hull_side>(from.sides);
    l.stability = glue::same<treeform_stability>(from.stability);
    l.side_count = from.sides.size();
    l.chosen = from.chosen;
    glue::copy(from.center_of_mass, l.center_of_mass);
    l.mass_of = static_cast<std::int32_t>(from.mass);
    l.on_bed = from.on_bed.data();
    l.on_bed_count = from.on_bed.size();
    l.corrected = from.corrected;
}

void fill(glue::answer<treeform_packing>& made, const tf::packing& from) {
    std::vector<treeform_packed_part> parts;
    for (const tf::packed_part& one : from.parts) {
        treeform_packed_part& part = parts.emplace_back();
        part.placed = one.placed;
        part.plate = one.plate;
        part.points = glue::flat(one.points);
        part.point_count = one.points.size();
        glue::copy(one.matrix, part.matrix);
    }
    treeform_packing& p = made.value;
    p.certificate = glue::keep(made, from.certificate);
    p.message = made.keep(from.message()).c_str();
    p.parts = made.keep(std::move(parts)).data();
    p.part_count = from.parts.size();
    p.not_placed = from.not_placed.data();
    p.not_placed_count = from.not_placed.size();
    p.plates_used = from.plates_used;
    p.tries = from.tries;
    p.density = from.density;
    p.pairs_measured = from.pairs_measured;
    p.bed = from.bed;
}

tf::pack_options options_of(const treeform_pack_options* options) {
    const auto o = glue::chosen(options, treeform_pack_options_init);
    tf::pack_options how;
    how.size = glue::point(o.plate, "plate");
    how.corner = glue::point(o.corner, "corner");
    how.spacing = o.spacing;
    how.turns = glue::choice<tf::plate_turns>(o.turns, 4, "turns");
    how.stack = o.stack != 0;
    how.plates = o.plates;
    how.plate_step = glue::point(o.plate_step, "plate_step");
    how.tighten = o.tighten != 0;
    how.seed = o.seed;
    how.tries = o.tries;
    how.seconds = o.seconds;
    how.precision = glue::precision(o.precision);
    how.progress = glue::progress(o);
    return how;
}

tf::align_options options_of(const treeform_align_options* options) {
    const auto o = glue::chosen(options, treeform_align_options_init);
    tf::align_options how;
    how.method = glue::choice<tf::align_method>(o.method, 4, "method");
    how.overlap = o.overlap;
    how.weights = glue::choice<tf::align_weights>(o.weights, 2, "weights");
    how.max_distance = o.max_distance;
    how.scale = o.scale != 0;
    how.least_scale = o.least_scale;
    how.most_scale = o.most_scale;
    how.max_iterations = o.max_iterations;
    how.tolerance = o.tolerance;
    how.starts = o.starts;
    how.accelerate = o.accelerate != 0;
    how.samples = glue::limit(o.samples);
    how.start = glue::matrix(o.start);
    how.precision = glue::precision(o.precision);
    how.progress = glue::progress(o);
    return how;
}

void fill(glue::answer<treeform_align_result>& made, const tf::align_result& from) {
    treeform_align_result& r = made.value;
    r.points = glue::flat(from.points);
    r.point_count = from.points.size();
    glue::copy(from.matrix, r.matrix);
    glue::copy(from.pivot, r.pivot);
    glue::copy(from.pivot_moved, r.pivot_moved);
    r.scale = from.scale;
    r.rms = from.rms;
    r.rms_at_start = from.rms_at_start;
    r.overlap = from.overlap;
    r.inliers = from.inliers;
    r.correlation = from.correlation;
    r.freedoms = glue::same<treeform_freedom>(from.freedoms);
    r.freedom_count = from.freedoms.size();
    r.undetermined = from.undetermined();
    r.end = static_cast<treeform_align_end>(from.end);
    r.iterations = from.iterations;
    r.start = from.start;
    r.message = made.keep(from.message()).c_str();
    r.uncertainty = from.uncertainty;
}

}  // namespace

void treeform_lay_flat_options_init(treeform_lay_flat_options* options, size_t size) {
    const tf::lay_flat_options from;
    treeform_lay_flat_options defaults{};
    defaults.overhang_angle = from.overhang_angle;
    defaults.overhang_sides = from.overhang_sides;
    defaults.precision = TREEFORM_FLOAT64;
    glue::init(options, size, defaults);
}

treeform_code treeform_lay_flat(const treeform_mesh* mesh, const treeform_lay_flat_options* options,
                                treeform_laid_flat** laid) {
    return glue::guard([&] {
        glue::start(laid);
        const auto o = glue::chosen(options, treeform_lay_flat_options_init);
        tf::lay_flat_options how;
        how.choose = glue::choice<tf::lay_choice>(o.choose, 4, "choose");
        how.toward = glue::point(o.toward, "toward");
        how.keep_spin = o.keep_spin != 0;
        how.tolerance = o.tolerance;
        how.bed = o.bed;
        how.overhang_angle = o.overhang_angle;
        how.overhang_sides = glue::limit(o.overhang_sides);
        how.precision = glue::precision(o.precision);
        how.progress = glue::progress(o);
        auto found = glue::asked(mesh, [&](const auto& m) { return tf::lay_flat(m, how); });
        if (!found) return;
        if (found->certificate.status == tf::status::cancelled) throw glue::cancelled{};
        auto made = glue::make<treeform_laid_flat>();
        fill(*made, made->keep(std::move(*found)));
        glue::give(std::move(made), laid);
    });
}

void treeform_pack_options_init(treeform_pack_options* options, size_t size) {
    const tf::pack_options from;
    treeform_pack_options defaults{};
    defaults.plate[2] = glue::infinity;
    defaults.spacing = from.spacing;
    defaults.turns = TREEFORM_TURNS_QUARTER;
    defaults.plates = from.plates;
    defaults.tighten = from.tighten;
    defaults.tries = from.tries;
    defaults.seconds = from.seconds;
    defaults.precision = TREEFORM_FLOAT64;
    glue::init(options, size, defaults);
}

treeform_code treeform_pack(const treeform_mesh* const* parts, size_t count,
                            const treeform_pack_options* options, treeform_packing** packing) {
    return glue::guard([&] {
        glue::start(packing);
        const tf::mesh_refs row = glue::refs(parts, count, "parts");
        auto made = glue::make<treeform_packing>();
        const tf::packing& found = made->keep(tf::pack(row, options_of(options)));
        if (found.certificate.status == tf::status::cancelled) throw glue::cancelled{};
        fill(*made, found);
        const bool all_placed = found.not_placed.empty();
        if (!all_placed) glue::say(made->value.message);
        glue::give(std::move(made), packing);
        return all_placed ? TREEFORM_OK : TREEFORM_NO_PLACE;
    });
}

void treeform_align_options_init(treeform_align_options* options, size_t size) {
    const tf::align_options from;
    treeform_align_options defaults{};
    defaults.method = TREEFORM_ALIGN_AUTOMATIC;
    defaults.weights = TREEFORM_WEIGHTS_WELSCH;
    defaults.overlap = from.overlap;
    defaults.max_distance = from.max_distance;
    defaults.max_iterations = from.max_iterations;
    defaults.tolerance = from.tolerance;
    defaults.starts = from.starts;
    defaults.accelerate = from.accelerate;
    defaults.samples = from.samples;
    defaults.least_scale = from.least_scale;
    defaults.most_scale = from.most_scale;
    defaults.precision = TREEFORM_FLOAT64;
    glue::init(options, size, defaults);
}

treeform_code treeform_align(const treeform_mesh* moving, const treeform_mesh* fixed,
                             const treeform_align_options* options,
                             treeform_align_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const tf::prepared_mesh& m = *glue::need(moving, "moving").prepared;
        const tf::prepared_mesh& f = *glue::need(fixed, "fixed").prepared;
        auto made = glue::make<treeform_align_result>();
        const tf::align_result& found = made->keep(tf::align(m, f, options_of(options)));
        if (found.status == tf::status::cancelled) throw glue::cancelled{};
        fill(*made, found);
        const bool converged = found.converged;
        if (!converged)
            glue::say((std::string(tf::name_of(found.end)) + ": " + found.message()).c_str());
        glue::give(std::move(made), result);
        return converged ? TREEFORM_OK : TREEFORM_NO_PLACE;
    });
}
