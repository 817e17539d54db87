#include "tools/common/console.hpp"
#include "tools/tf-place/outcome.hpp"
#include <treeform/mesh/slide.hpp>
#include <treeform/tf.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace tools {
namespace {

/// Calls the verb of the mode.
tf::placement place_by_verb(const body_set& moving, const body_set& fixed, const place_settings& s,
                            tf::precision precision, const tf::progress_callback& progress) {
    const tf::prepared_mesh& mesh = moving.shapes[0];
    const double diagonal = tf::diagonal(*moving.bodies[0].box);
    const double clearance = s.clearance.used(diagonal);
    std::optional<double> longest;
    if (s.max_travel) longest = s.max_travel->used(diagonal);
    const auto with = [&](auto options) {
        options.clearance = clearance;
        options.max_travel = longest;
        options.precision = precision;
        options.progress = progress;
        return options;
    };
    switch (s.mode) {
        case place_mode::drop: {
            tf::drop_options options = with(tf::drop_options{});
            options.direction = s.direction.value_or(options.direction);
            if (s.has_bed()) {
                options.bed = s.bed.value_or(0.0);
                check_bed(*options.bed + clearance, precision);
            }
            return tf::drop(mesh, fixed.shapes, options);
        }
        case place_mode::slide:
            return tf::slide(mesh, fixed.shapes, s.direction.value_or(tf::point3{0.0, 0.0, -1.0}),
                             with(tf::slide_options{}));
        case place_mode::mate:
            return tf::mate(mesh, fixed.shapes, with(tf::mate_options{}));
        case place_mode::clear:
            return tf::separate(mesh, fixed.shapes, with(tf::separate_options{}));
        default:
            return tf::measure_among(mesh, fixed.shapes,
                                     {.clearance = clearance, .progress = progress});
    }
}

void lay(outcome& found, const body_set& moving, const place_settings& s,
         const tf::progress_callback& progress) {
    tf::lay_flat_options options = s.lay;
    options.bed = s.bed.value_or(0.0);
    check_bed(options.bed, found.at.certificate.precision);
    options.precision = found.at.certificate.precision;
    options.tolerance = found.flatness = s.flatness.used(tf::diagonal(*moving.bodies[0].box));
    options.progress = progress;
    found.laid = tf::lay_flat(moving.shapes[0], options);
    if (!found.laid) {
        found.at.certificate.status = tf::status::no_place;
        found.reason = "has no side: all its points are on a line";
        return;
    }
    found.at = found.laid->as_placement();
}

void fit(outcome& found, const body_set& moving, const body_set& fixed, const place_settings& s,
         const tf::progress_callback& progress) {
    tf::align_options options = s.fit;
    if (s.max_distance)
        options.max_distance = s.max_distance->used(tf::diagonal(*moving.bodies[0].box));
    options.precision = found.at.certificate.precision;
    options.progress = progress;
    found.aligned = tf::align(moving.shapes[0], fixed.shapes[0], options);
    found.at = found.aligned->as_placement();
}

/// What else may be done.
std::string remedy_for(const tf::placement& p) {
    if (p.end == tf::placement_end::starts_penetrating) return "; clear would take it out";
    if (p.end == tf::placement_end::starts_below_bed)
        return "; with --fixed, drop only goes down: drop it without --fixed first";
    if (p.end == tf::placement_end::no_coordinates &&
        p.certificate.precision == tf::precision::float32)
        return "; --precision double, in a format that has it, may find one";
    return {};
}

}  // namespace

void check_bed(double level, tf::precision precision) {
    if (precision == tf::precision::float64 ||
        std::abs(level) <= static_cast<double>(std::numeric_limits<float>::max()))
        return;
    refuse("--bed: " + shortest(level) +
           " is beyond the range of float32, which is what will be written; a format of text, or "
           "--precision double in PLY, has more");
}

outcome place(job& work, const body_set& moving, const body_set& fixed, const place_settings& s,
              tf::precision precision) {
    outcome found;
    found.at.certificate.precision = precision;
    const auto timing = work.time("search");
    const tf::progress_callback progress = work.progress("search");
    try {
        if (s.mode == place_mode::lay)
            lay(found, moving, s, progress);
        else if (s.mode == place_mode::fit)
            fit(found, moving, fixed, s, progress);
        else
            found.at = place_by_verb(moving, fixed, s, precision, progress);
    } catch (const std::overflow_error&) {
        found.at = {.certificate = {.status = tf::status::out_of_range},
                    .end = tf::placement_end::out_of_range};
    }
    work.call_ended();
    found.at.certificate.precision = precision;  // also of what was only measured
    if (!found.at && found.reason.empty())
        found.reason = found.at.message(fixed.labels()) + remedy_for(found.at);
    return found;
}

}  // namespace tools
