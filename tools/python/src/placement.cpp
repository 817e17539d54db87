#include "bindings.hpp"

namespace binding {
namespace {

/// A placement with fields that only its operation has.
template <class... More>
py::object placed(tf::placement&& at, const held_mesh& moving, const More&... more) {
    const py::object made = as_python(std::move(at), moving);
    const py::dict fields = made.attr("__dict__");
    (..., (fields[more.first] = more.second));
    return made;
}

py::object turn(const held_mesh& moving, const held_meshes& fixed, const array_of<double>& axis,
                const array_of<double>& origin, tf::turn_options options) {
    const tf::turn_axis about{point_of(origin), point_of(axis)};
    tf::turn_result turned = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::turn(moving.ref(), refs_of(fixed), about, options);
    });
    return placed(std::move(turned.at), moving, std::pair("angle", turned.angle),
                  std::pair("tolerance", turned.tolerance));
}

py::object mate_features(const held_mesh& moving, const held_meshes& fixed, const std::string& kind,
                         const array_of<double>& origin, const array_of<double>& direction,
                         const array_of<double>& fixed_origin,
                         const array_of<double>& fixed_direction,
                         tf::feature_mate_options options) {
    const auto feature = [&](const array_of<double>& at, const array_of<double>& along) {
        tf::mesh_feature made;
        made.kind = choice<tf::feature_kind>("kind", words_of<tf::feature_kind>::all, kind);
        made.origin = point_of(at);
        made.direction = point_of(along);
        return made;
    };
    const tf::mesh_feature mine = feature(origin, direction);
    const tf::mesh_feature other = feature(fixed_origin, fixed_direction);
    tf::feature_mating mated = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::mate_features(moving.ref(), refs_of(fixed), mine, other, options);
    });
    return placed(std::move(mated.at), moving, std::pair("angle", mated.turn_angle),
                  std::pair("offset", mated.offset));
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
    add_job(module, "turn", &turn);
    add_job(module, "mate_features", &mate_features);
    add_job(module, "pack", &pack, job_kind::long_work);
}

}  // namespace binding
