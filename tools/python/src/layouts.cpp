#include "bindings.hpp"
#include "held_mesh.hpp"
#include "job.hpp"
#include "words.hpp"
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/lay_flat.hpp>
#include <treeform/mesh/pack.hpp>

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace binding {
namespace {

constexpr words<4> choice_words{"largest", "nearest_normal", "holding_point", "most_stable"};
constexpr words<3> mass_words{"solid", "surface", "points"};
constexpr words<4> method_words{"point_to_plane", "point_to_point", "automatic", "plane_to_plane"};
constexpr words<2> weight_words{"equal", "welsch"};
constexpr words<4> align_words{"converged", "out_of_iterations", "doubtful", "nothing_to_align"};
constexpr words<4> turn_words{"none", "quarter", "eighth", "any"};

py::object lay_flat(const held_mesh& mesh, const std::string& choose,
                    const array_of<double>& toward, bool keep_spin, double tolerance, double bed,
                    double overhang_angle, const std::string& precision) {
    tf::lay_flat_options options{.choose = choice<tf::lay_choice>("choose", choice_words, choose),
                                 .toward = point_of(toward),
                                 .keep_spin = keep_spin,
                                 .tolerance = tolerance,
                                 .bed = bed,
                                 .overhang_angle = overhang_angle,
                                 .precision = precision_of(precision)};
    std::optional<tf::laid_flat> laid = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::lay_flat(mesh.prepared(), options);
    });
    if (!laid) return py::none();
    py::dict made;
    made["message"] = laid->message();
    made["matrix"] = as_array(laid->matrix);
    made["chosen"] = laid->chosen;
    made["areas"] = column(laid->sides, [](const tf::hull_side& s) { return s.area; });
    made["normals"] = column(laid->sides, [](const tf::hull_side& s) { return numbers(s.normal); });
    made["tip_angles"] =
        column(laid->stability, [](const tf::side_stability& s) { return s.tip_angle; });
    made["overhangs"] =
        column(laid->stability, [](const tf::side_stability& s) { return s.overhang; });
    made["center_of_mass"] = as_array(laid->center_of_mass);
    made["mass"] = word_of(mass_words, laid->mass);
    made["on_bed"] = as_array(std::move(laid->on_bed));
    made["certificate"] = std::move(laid->certificate);
    made["points"] = as_array(std::move(laid->points));
    return made;
}

py::dict align(const held_mesh& moving, const held_mesh& fixed, const std::string& method,
               double overlap, const std::string& weights, double max_distance, bool scale,
               double least_scale, double most_scale, unsigned max_iterations, double tolerance,
               unsigned starts, std::size_t samples, const array_of<double>& start,
               const std::string& precision) {
    tf::align_options options{
        .method = choice<tf::align_method>("method", method_words, method),
        .overlap = overlap,
        .weights = choice<tf::align_weights>("weights", weight_words, weights),
        .max_distance = max_distance,
        .scale = scale,
        .least_scale = least_scale,
        .most_scale = most_scale,
        .max_iterations = max_iterations,
        .tolerance = tolerance,
        .starts = starts,
        .samples = samples,
        .start = transform_of(start),
        .precision = precision_of(precision)};
    tf::align_result found = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::align(moving.prepared(), fixed.prepared(), options);
    });
    py::dict made;
    made["message"] = found.message();
    made["matrix"] = as_array(found.matrix);
    made["scale"] = found.scale;
    made["rms"] = found.rms;
    made["rms_at_start"] = found.rms_at_start;
    made["overlap"] = found.overlap;
    made["inliers"] = found.inliers;
    made["correlation"] = found.correlation;
    made["uncertainty"] = found.uncertainty;
    made["end"] = word_of(align_words, found.end);
    made["converged"] = found.converged;
    made["iterations"] = found.iterations;
    made["start"] = found.start;
    made["undetermined"] = found.undetermined();
    made["points"] = as_array(std::move(found.points));
    return made;
}

py::dict pack(const held_meshes& parts, const array_of<double>& size,
              const array_of<double>& corner, double spacing, const std::string& turns, bool stack,
              unsigned plates, const array_of<double>& plate_step, std::uint64_t seed,
              unsigned tries, double seconds, const std::string& precision) {
    tf::pack_options options{.size = point_of(size),
                             .corner = point_of(corner),
                             .spacing = spacing,
                             .turns = choice<tf::plate_turns>("turns", turn_words, turns),
                             .stack = stack,
                             .plates = plates,
                             .plate_step = point_of(plate_step),
                             .seed = seed,
                             .tries = tries,
                             .seconds = seconds,
                             .precision = precision_of(precision)};
    const std::vector<tf::prepared_mesh> all = borrowed(parts);
    tf::packing packed = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::pack(all, options);
    });
    py::dict made;
    made["message"] = packed.message();
    py::list placed;
    for (tf::packed_part& one : packed.parts)
        placed.append(py::make_tuple(one.placed, one.plate, as_array(one.matrix),
                                     as_array(std::move(one.points))));
    made["parts"] = placed;
    made["not_placed"] = as_array(std::move(packed.not_placed));
    made["plates_used"] = packed.plates_used;
    made["tries"] = packed.tries;
    made["density"] = packed.density;
    return made;
}

}  // namespace

void add_layouts(py::module_& module) {
    module.def("lay_flat", &lay_flat);
    module.def("align", &align);
    module.def("pack", &pack);
}

}  // namespace binding
