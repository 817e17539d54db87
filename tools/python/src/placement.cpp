#include "bindings.hpp"

namespace binding {
namespace {

py::object mate_features(const held_mesh& moving, const held_meshes& fixed, const std::string& kind,
                         const array_of<double>& origin, const array_of<double>& direction,
                         const array_of<double>& fixed_origin,
                         const array_of<double>& fixed_direction, tf::placement_options options) {
    const auto feature = [&](const array_of<double>& at, const array_of<double>& along) {
        tf::mesh_feature made;
        made.kind = choice<tf::feature_kind>("kind", words_of<tf::feature_kind>::all, kind);
        made.origin = point_of(at);
        made.direction = point_of(along);
        return made;
    };
    const tf::mesh_feature mine = feature(origin, direction);
    const tf::mesh_feature other = feature(fixed_origin, fixed_direction);
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::mate_features(moving.ref(), refs_of(fixed), mine, other,
                                                  options);
                     }),
                     moving);
}

py::object pack(const held_meshes& parts, tf::pack_options options) {
    tf::packing packed = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::pack(refs_of(parts), options);
    });
    py::list placed_parts;
    for (std::size_t i = 0; i < parts.size(); ++i)
        placed_parts.append(as_python(std::move(packed.parts[i]), *parts[i]));
    const py::object made = as_python(std::move(packed));
    py::dict(made.attr("__dict__"))["parts"] = placed_parts;
    return made;
}

}  // namespace

void add_placement(py::module_& module) {
    add_job(module, "mate_features", &mate_features);
    add_job(module, "pack", &pack, job_kind::long_work);
}

}  // namespace binding
