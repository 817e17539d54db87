// Made by tools/bindings of the headers of C++: see its README.
#include "../bindings.hpp"

namespace binding {

namespace {

py::object check_solid(const held_mesh& mesh) {
    return as_python(run([&](const tf::progress_callback& report) {
        return require_faces(mesh, "mesh"), tf::check_solid(mesh.view(), report);
    }));
}

py::object section(const held_mesh& mesh, const array_of<double>& normal,
                   const array_of<double>& at, const array_of<double>& heights) {
    return as_python(run([&](const tf::progress_callback& report) {
        return tf::section(mesh.ref(), {point_of(at), point_of(normal)}, rows_of<double>(heights),
                           report);
    }));
}

py::object layer_heights(const held_mesh& mesh, double thickness, const array_of<double>& normal,
                         const array_of<double>& at) {
    return as_python(run([&](const tf::progress_callback&) {
        return tf::oriented_plane{point_of(at), point_of(normal)}.layer_heights(mesh.view().points,
                                                                                thickness);
    }));
}

py::object mass_properties(const held_mesh& mesh) {
    return as_python(
        run([&](const tf::progress_callback&) { return tf::find_mass_properties(mesh.view()); }));
}

py::object offset(const held_mesh& mesh, double distance, tf::offset_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::offset(mesh.ref(), distance, options);
    }));
}

py::object hollow(const held_mesh& mesh, double wall, const array_of<double>& drains,
                  tf::offset_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::hollow(mesh.ref(), wall, points_and_numbers(drains), options);
    }));
}

py::object thicken(const held_mesh& mesh, double thickness, tf::offset_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::thicken(mesh.ref(), thickness, options);
    }));
}

py::object wall_thickness(const held_mesh& mesh, const std::string& by) {
    return as_python(run([&](const tf::progress_callback& report) {
        return tf::wall_thickness(
            mesh.ref(), choice<tf::thickness_by>("by", words_of<tf::thickness_by>::all, by),
            report);
    }));
}

py::object oriented_box(const points_array& points) {
    return as_python(run(
        [&](const tf::progress_callback&) { return tf::find_oriented_box(points_of(points)); }));
}

py::object isolines(const held_mesh& mesh, const array_of<double>& values,
                    const array_of<double>& levels) {
    return as_python(run([&](const tf::progress_callback& report) {
        return tf::isolines(mesh.ref(), rows_of<double>(values), rows_of<double>(levels), report);
    }));
}

py::object wrap(const held_mesh& mesh, double size, tf::offset_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::wrap(mesh.ref(), size, options);
    }));
}

py::object convex_hull(const points_array& points) {
    return as_python(run([&](const tf::progress_callback& report) {
        return tf::convex_hull(points_of(points), report);
    }));
}

py::object rounded(const points_array& points, const std::string& precision) {
    return as_python(run([&](const tf::progress_callback&) {
        return tf::rounded(
            points_of(points),
            choice<tf::precision>("precision", words_of<tf::precision>::all, precision));
    }));
}

py::object find_rounding_defects(const held_mesh& mesh, const points_array& placed) {
    return as_python(run([&](const tf::progress_callback& report) {
        return tf::find_rounding_defects(mesh.view(), points_of(placed), report);
    }));
}

py::object bounds(const held_mesh& mesh) {
    return as_python(
        run([&](const tf::progress_callback&) { return tf::bounding_box(mesh.view().points); }));
}

py::object signed_volume(const held_mesh& mesh) {
    return as_python(
        run([&](const tf::progress_callback&) { return tf::signed_volume(mesh.view()); }));
}

py::object surface_area(const held_mesh& mesh) {
    return as_python(
        run([&](const tf::progress_callback&) { return tf::surface_area(mesh.view()); }));
}

py::object find_defects(const held_mesh& mesh) {
    return as_python(
        run([&](const tf::progress_callback&) { return tf::find_defects(mesh.view()); }));
}

py::object count_topology(const held_mesh& mesh) {
    return as_python(run([&](const tf::progress_callback&) {
        return tf::count_topology(mesh.view().points.size(), mesh.view().faces);
    }));
}

py::object face_components(const held_mesh& mesh) {
    return as_python(run([&](const tf::progress_callback&) {
        return tf::face_components(mesh.view().points.size(), mesh.view().faces);
    }));
}

py::object count_inside_out(const held_mesh& mesh) {
    return as_python(
        run([&](const tf::progress_callback&) { return tf::count_inside_out(mesh.view()); }));
}

py::object find_features(const held_mesh& mesh, const std::string& kind,
                         tf::feature_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::find_features(
            mesh.view(), choice<tf::feature_kind>("kind", words_of<tf::feature_kind>::all, kind),
            options);
    }));
}

py::object find_solid_defects(const held_mesh& mesh) {
    return as_python(run([&](const tf::progress_callback& report) {
        return tf::find_solid_defects(mesh.ref(), report);
    }));
}

py::object self_intersections(const held_mesh& mesh, tf::intersection_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::self_intersections(mesh.ref(), options);
    }));
}

py::object mesh_intersections(const held_mesh& a, const held_mesh& b,
                              tf::intersection_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::mesh_intersections(a.ref(), b.ref(), options);
    }));
}

py::object faces_in_box(const held_mesh& mesh, const array_of<double>& min,
                        const array_of<double>& max) {
    return as_python(run([&](const tf::progress_callback&) {
        return tf::faces_in_box(mesh.view(), point_of(min), point_of(max));
    }));
}

py::object group_pairs(const held_mesh& mesh, const ids_array& pairs,
                       const array_of<std::uint8_t>& kinds) {
    return as_python(run([&](const tf::progress_callback&) {
        return tf::group_pairs(mesh.view(), pairs_of(pairs, kinds));
    }));
}

py::object intersection_paths(const held_mesh& mesh, const ids_array& pairs,
                              const array_of<std::uint8_t>& kinds) {
    return as_python(run([&](const tf::progress_callback&) {
        return tf::intersection_paths(mesh.view(), pairs_of(pairs, kinds));
    }));
}

py::object count_nearly_equal(const points_array& points, double distance) {
    return as_python(run([&](const tf::progress_callback&) {
        return tf::count_nearly_equal(points_of(points), distance);
    }));
}

py::object closest_point(const held_mesh& mesh, const points_array& points, double radius) {
    return as_python(in_pieces(points_of(points).size(), [&](std::size_t begin, std::size_t end) {
        return tf::closest_point(mesh.prepared(), points_of(points).subspan(begin, end - begin),
                                 radius);
    }));
}

py::object raycast(const held_mesh& mesh, const points_array& origins,
                   const points_array& directions, double t_min, double t_max) {
    return as_python(in_pieces(
        rays(origins, directions, t_min, t_max).size(), [&](std::size_t begin, std::size_t end) {
            return finite(tf::raycast(mesh.prepared(),
                                      rays(origins, directions, t_min, t_max).piece(begin, end)));
        }));
}

py::object raycast_any(const held_mesh& mesh, const points_array& origins,
                       const points_array& directions, double t_min, double t_max) {
    return as_python(in_pieces(
        rays(origins, directions, t_min, t_max).size(), [&](std::size_t begin, std::size_t end) {
            return tf::raycast_any(mesh.prepared(),
                                   rays(origins, directions, t_min, t_max).piece(begin, end));
        }));
}

py::object deviation(const held_mesh& a, const held_mesh& b, tf::deviation_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::deviation(a.prepared(), b.prepared(), options);
    }));
}

py::object locate_points(const held_mesh& mesh, const points_array& points) {
    return as_python(in_pieces(points_of(points).size(), [&](std::size_t begin, std::size_t end) {
        return tf::locate(mesh.prepared(), points_of(points).subspan(begin, end - begin));
    }));
}

py::object measure(const held_mesh& a, const held_mesh& b, tf::measure_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::measure(a.prepared(), b.prepared(), options);
    }));
}

py::object penetration_depth(const held_mesh& a, const held_mesh& b, tf::measure_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::penetration_depth(a.prepared(), b.prepared(), options);
    }));
}

py::object time_of_impact(const held_mesh& a, const held_mesh& b, const array_of<double>& motion,
                          tf::impact_options options) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::time_of_impact(a.prepared(), b.prepared(), point_of(motion), options);
    }));
}

py::object closest_points(const held_mesh& a, const held_mesh& b, const array_of<double>& move_a,
                          const array_of<double>& move_b, double radius) {
    return as_python(run([&](const tf::progress_callback&) {
        return tf::closest_points(a.prepared(), b.prepared(),
                                  {transform_of(move_a), transform_of(move_b), radius});
    }));
}

py::object clash_parts(const held_meshes& parts, tf::clash_options options,
                       const ids_array& ignored) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return (options.ignored = rows_of<tf::part_pair>(ignored),
                tf::clash(borrowed(parts), options));
    }));
}

py::object clash_in_poses(const held_meshes& parts, const array_of<double>& poses,
                          tf::clash_options options, const ids_array& ignored) {
    return as_python(run([&](const tf::progress_callback& report) {
        options.progress = report;
        return (options.ignored = rows_of<tf::part_pair>(ignored),
                tf::check_poses(borrowed(parts), transforms_of(poses), options));
    }));
}

}  // namespace

void add_functions(py::module_& module) {
    add_job(module, "check_solid", &check_solid);
    add_job(module, "section", &section);
    add_job(module, "layer_heights", &layer_heights);
    add_job(module, "mass_properties", &mass_properties);
    add_job(module, "offset", &offset, job_kind::long_work);
    add_job(module, "hollow", &hollow, job_kind::long_work);
    add_job(module, "thicken", &thicken, job_kind::long_work);
    add_job(module, "wall_thickness", &wall_thickness);
    add_job(module, "oriented_box", &oriented_box);
    add_job(module, "isolines", &isolines);
    add_job(module, "wrap", &wrap, job_kind::long_work);
    add_job(module, "convex_hull", &convex_hull);
    add_job(module, "rounded", &rounded);
    add_job(module, "find_rounding_defects", &find_rounding_defects);
    add_job(module, "bounds", &bounds);
    add_job(module, "signed_volume", &signed_volume);
    add_job(module, "surface_area", &surface_area);
    add_job(module, "find_defects", &find_defects);
    add_job(module, "count_topology", &count_topology);
    add_job(module, "face_components", &face_components);
    add_job(module, "count_inside_out", &count_inside_out);
    add_job(module, "find_features", &find_features);
    add_job(module, "find_solid_defects", &find_solid_defects);
    add_job(module, "self_intersections", &self_intersections);
    add_job(module, "mesh_intersections", &mesh_intersections);
    add_job(module, "faces_in_box", &faces_in_box);
    add_job(module, "group_pairs", &group_pairs);
    add_job(module, "intersection_paths", &intersection_paths);
    add_job(module, "count_nearly_equal", &count_nearly_equal);
    add_job(module, "closest_point", &closest_point);
    add_job(module, "raycast", &raycast);
    add_job(module, "raycast_any", &raycast_any);
    add_job(module, "deviation", &deviation);
    add_job(module, "locate_points", &locate_points);
    add_job(module, "measure", &measure);
    add_job(module, "penetration_depth", &penetration_depth);
    add_job(module, "time_of_impact", &time_of_impact);
    add_job(module, "closest_points", &closest_points);
    add_job(module, "clash_parts", &clash_parts);
    add_job(module, "clash_in_poses", &clash_in_poses);
}

}  // namespace binding
