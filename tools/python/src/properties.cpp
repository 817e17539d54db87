#include "bindings.hpp"
#include "held_mesh.hpp"
#include "job.hpp"
#include "words.hpp"
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace binding {
namespace {

/// `f(mesh)` of the view, off the interpreter's lock.
template <class F>
auto of_view(const held_mesh& mesh, const F& f) {
    return run([&](const tf::progress_callback&) { return f(mesh.view()); });
}

py::object bounds(const held_mesh& mesh) {
    const auto box = of_view(mesh, [](tf::mesh_view m) { return tf::bounding_box(m.points); });
    if (!box) return py::none();
    py::array_t<double> made({2, 3});
    double* to = made.mutable_data();
    for (const tf::point3& corner : {box->min, box->max})
        for (std::size_t k = 0; k < 3; ++k) *to++ = corner[k];
    return made;
}

double signed_volume(const held_mesh& mesh) { return of_view(mesh, &tf::signed_volume); }
double surface_area(const held_mesh& mesh) { return of_view(mesh, &tf::surface_area); }

py::dict find_defects(const held_mesh& mesh) {
    tf::mesh_defects found = of_view(mesh, &tf::find_defects);
    py::dict made;
    made["nonfinite_points"] = as_array(std::move(found.nonfinite_points));
    made["nonfinite_faces"] = as_array(std::move(found.nonfinite_faces));
    made["degenerate_faces"] = as_array(std::move(found.degenerate_faces));
    made["out_of_range_faces"] = as_array(std::move(found.out_of_range_faces));
    return made;
}

py::dict count_topology(const held_mesh& mesh) {
    const tf::topology_counts counts =
        of_view(mesh, [](tf::mesh_view m) { return tf::count_topology(m.points.size(), m.faces); });
    py::dict made;
    made["edges"] = counts.edges;
    made["boundary_edges"] = counts.boundary_edges;
    made["nonmanifold_edges"] = counts.nonmanifold_edges;
    made["misoriented_edges"] = counts.misoriented_edges;
    made["nonmanifold_points"] = counts.nonmanifold_points;
    made["components_by_point"] = counts.components_by_point;
    made["components_by_edge"] = counts.components_by_edge;
    made["points_used"] = counts.points_used;
    made["faces"] = counts.faces;
    made["repeated_corner_faces"] = counts.repeated_corner_faces;
    made["duplicate_faces"] = counts.duplicate_faces;
    made["closed"] = counts.closed;
    return made;
}

py::array face_components(const held_mesh& mesh) {
    return as_array(of_view(
        mesh, [](tf::mesh_view m) { return tf::face_components(m.points.size(), m.faces); }));
}

std::uint64_t count_inside_out(const held_mesh& mesh) {
    return of_view(mesh, [](tf::mesh_view m) { return tf::count_inside_out(m); });
}

py::dict as_dict(tf::mesh_feature&& feature) {
    py::dict made;
    made["kind"] = word_of(feature_words, feature.kind);
    made["origin"] = as_array(feature.origin);
    made["direction"] = as_array(feature.direction);
    made["radius"] = feature.radius;
    made["hollow"] = feature.hollow;
    made["area"] = feature.area;
    made["deviation"] = feature.deviation;
    made["faces"] = as_array(std::move(feature.faces));
    return made;
}

py::list find_features(const held_mesh& mesh, const std::string& kind,
                       std::optional<double> tolerance, double plane_angle, double facet_angle,
                       double arc) {
    tf::feature_options options{
        .tolerance = tolerance, .plane_angle = plane_angle, .facet_angle = facet_angle, .arc = arc};
    const auto which = choice<tf::feature_kind>("kind", feature_words, kind);
    std::vector<tf::mesh_feature> found = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::find_features(mesh.view(), which, options);
    });
    py::list made;
    for (tf::mesh_feature& one : found) made.append(as_dict(std::move(one)));
    return made;
}

py::dict find_solid_defects(const held_mesh& mesh) {
    const tf::solid_defects found = run([&](const tf::progress_callback& report) {
        return tf::find_solid_defects(mesh.view(), report);
    });
    py::dict made;
    made["nonfinite_vertices"] = found.nonfinite_vertices;
    made["unusable_faces"] = found.unusable_faces;
    made["without_faces"] = found.without_faces;
    made["tetrahedra"] = found.tetrahedra;
    made["degenerate"] = found.degenerate;
    made["repeated"] = found.repeated;
    made["open_edges"] = found.open_edges;
    made["nonmanifold_edges"] = found.nonmanifold_edges;
    made["misoriented_edges"] = found.misoriented_edges;
    made["nonmanifold_vertices"] = found.nonmanifold_vertices;
    made["meeting_pairs"] = found.meeting_pairs;
    made["inverted"] = found.inverted;
    made["wrongly_nested"] = found.wrongly_nested;
    made["message"] = found.message();
    return made;
}

}  // namespace

void add_properties(py::module_& module) {
    module.def("bounds", &bounds);
    module.def("signed_volume", &signed_volume);
    module.def("surface_area", &surface_area);
    module.def("find_defects", &find_defects);
    module.def("count_topology", &count_topology);
    module.def("face_components", &face_components);
    module.def("count_inside_out", &count_inside_out);
    module.def("find_features", &find_features);
    module.def("find_solid_defects", &find_solid_defects);
}

}  // namespace binding
