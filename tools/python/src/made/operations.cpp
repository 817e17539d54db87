// Made by tools/bindings of the headers of C++: see its README.
#include "../bindings.hpp"

namespace binding {

namespace {

py::object boolean_of(const held_meshes& meshes, const std::string& operation,
                      const std::string& formula, const std::vector<std::string>& names,
                      tf::boolean_options options) {
    carrying attributes(meshes);
    attributes.keep_apart(options);
    return as_python(
        run([&](const tf::progress_callback& report) {
            options.progress = report;
            return (require_faces(meshes, names),
                    tf::boolean(refs_of(meshes),
                                expression_of(operation, formula, names, meshes.size()), options));
        }),
        attributes);
}

py::object clip_by(const held_meshes& meshes, const std::string& operation,
                   tf::boolean_options options) {
    carrying attributes(meshes);
    attributes.keep_apart(options);
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return (
                             require_faces(meshes, {}),
                             tf::clip(refs_of(meshes), 0,
                                      expression_of(operation, {}, {}, meshes.size()), options));
                     }),
                     attributes);
}

py::object split(const held_meshes& meshes, tf::boolean_options options) {
    carrying attributes(meshes);
    attributes.keep_apart(options);
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::split(refs_of(meshes), options);
                     }),
                     attributes);
}

py::object cut(const held_mesh& mesh, const array_of<double>& normal, const array_of<double>& at,
               const array_of<double>& heights, tf::cut_options options) {
    carrying attributes({&mesh});
    attributes.keep_apart(options);
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::cut(mesh.ref(), {point_of(at), point_of(normal)},
                                        rows_of<double>(heights), options);
                     }),
                     attributes);
}

py::object cut_to_fit(const held_mesh& mesh, const array_of<double>& size,
                      tf::cut_options options) {
    carrying attributes({&mesh});
    attributes.keep_apart(options);
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::cut_to_fit(mesh.ref(), point_of(size), options);
                     }),
                     attributes);
}

py::object cut_along(const held_mesh& mesh, const array_of<double>& values,
                     const array_of<double>& levels) {
    carrying attributes({&mesh});
    return as_python(run([&](const tf::progress_callback& report) {
                         return tf::cut_along(mesh.ref(), rows_of<double>(values),
                                              rows_of<double>(levels), {.progress = report});
                     }),
                     attributes);
}

py::object components(const held_mesh& mesh, double min_volume, std::size_t largest) {
    carrying attributes({&mesh});
    return as_python(run([&](const tf::progress_callback&) {
                         return tf::components(mesh.ref(), min_volume, largest);
                     }),
                     attributes);
}

py::object submesh(const held_mesh& mesh, const ids_array& faces) {
    carrying attributes({&mesh});
    return as_python(run([&](const tf::progress_callback&) {
                         return tf::submesh(mesh.ref(), rows_of<std::uint32_t>(faces));
                     }),
                     attributes);
}

py::object simplify(const held_mesh& mesh, double max_distance, const ids_array& face_groups,
                    tf::simplify_options options) {
    carrying attributes({&mesh});
    attributes.keep_apart(options);
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return attributes.simplify(mesh.ref(), max_distance,
                                                    rows_of<std::uint32_t>(face_groups), options);
                     }),
                     attributes);
}

py::object resolve_self_intersections(const held_mesh& mesh, const std::string& mode,
                                      tf::resolve_options options) {
    carrying attributes({&mesh});
    attributes.keep_apart(options);
    return as_python(
        run([&](const tf::progress_callback& report) {
            options.progress = report;
            return tf::resolve_self_intersections(
                mesh.ref(), choice<tf::resolve_mode>("mode", words_of<tf::resolve_mode>::all, mode),
                options);
        }),
        attributes);
}

py::object repair(const held_mesh& mesh, tf::repair_options options) {
    carrying attributes({&mesh});
    attributes.keep_apart(options);
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::repair(mesh.ref(), options);
                     }),
                     attributes);
}

py::object slide(const held_mesh& moving, const held_meshes& onto,
                 const array_of<double>& direction, tf::placement_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::slide(moving.ref(), refs_of(onto), point_of(direction),
                                          options);
                     }),
                     moving);
}

py::object drop(const held_mesh& moving, const held_meshes& onto, const array_of<double>& direction,
                tf::placement_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return onto.empty() ? tf::drop(moving.ref(), options, point_of(direction))
                                             : tf::drop(moving.ref(), refs_of(onto), options,
                                                        point_of(direction));
                     }),
                     moving);
}

py::object mate(const held_mesh& moving, const held_meshes& onto, tf::placement_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::mate(moving.ref(), refs_of(onto), options);
                     }),
                     moving);
}

py::object separate(const held_mesh& moving, const held_meshes& fixed,
                    tf::placement_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::separate(moving.ref(), refs_of(fixed), options);
                     }),
                     moving);
}

py::object turn(const held_mesh& moving, const held_meshes& fixed, const array_of<double>& axis,
                const array_of<double>& origin, tf::placement_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::turn(moving.ref(), refs_of(fixed), point_of(origin),
                                         point_of(axis), options);
                     }),
                     moving);
}

py::object lay_flat(const held_mesh& mesh, tf::lay_flat_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::lay_flat(mesh.prepared(), options);
                     }),
                     mesh);
}

py::object align(const held_mesh& moving, const held_mesh& onto, tf::align_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::align(moving.prepared(), onto.prepared(), options);
                     }),
                     moving);
}

py::object mate_features(const held_mesh& moving, const held_meshes& onto,
                         const tf::mesh_feature& of_moving, const tf::mesh_feature& of_fixed,
                         tf::placement_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::mate_features(moving.ref(), refs_of(onto), of_moving, of_fixed,
                                                  options);
                     }),
                     moving);
}

py::object pack(const held_meshes& parts, tf::pack_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
                         options.progress = report;
                         return tf::pack(refs_of(parts), options);
                     }),
                     parts);
}

}  // namespace

void add_operations(py::module_& module) {
    add_job(module, "boolean_of", &boolean_of);
    add_job(module, "clip_by", &clip_by);
    add_job(module, "split", &split);
    add_job(module, "cut", &cut);
    add_job(module, "cut_to_fit", &cut_to_fit);
    add_job(module, "cut_along", &cut_along);
    add_job(module, "components", &components);
    add_job(module, "submesh", &submesh);
    add_job(module, "simplify", &simplify, job_kind::long_work);
    add_job(module, "resolve_self_intersections", &resolve_self_intersections);
    add_job(module, "repair", &repair);
    add_job(module, "slide", &slide);
    add_job(module, "drop", &drop);
    add_job(module, "mate", &mate);
    add_job(module, "separate", &separate);
    add_job(module, "turn", &turn);
    add_job(module, "lay_flat", &lay_flat);
    add_job(module, "align", &align);
    add_job(module, "mate_features", &mate_features);
    add_job(module, "pack", &pack, job_kind::long_work);
}

}  // namespace binding
