#include "bindings.hpp"
#include "carrying.hpp"
#include "file_data.hpp"
#include "held_mesh.hpp"
#include "job.hpp"
#include "words.hpp"
#include <treeform/mesh/weld.hpp>

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace binding {
namespace {

using conditions = std::vector<std::pair<std::string, double>>;

py::dict statistics_of(const tf::weld_statistics& s) {
    py::dict made;
    made["groups"] = s.groups;
    made["non_finite"] = s.non_finite;
    made["collapsed"] = s.collapsed;
    made["degenerate"] = s.degenerate;
    made["max_displacement"] = s.max_displacement;
    made["nonmanifold_before"] = s.nonmanifold_before;
    made["nonmanifold_after"] = s.nonmanifold_after;
    made["flipped"] = s.flipped;
    made["left_alone"] = s.left_alone;
    return made;
}

/// What all results have in common.
template <class Result>
py::dict common(Result& result) {
    py::dict made;
    made["index"] = as_array(std::move(result.groups.group_of_point));
    made["source"] = as_array(std::move(result.point_of_group));
    made["statistics"] = statistics_of(result.statistics);
    made["data"] = py::none();
    return made;
}

/// The same with attributes, which come from `data` where there are any.
template <class Result>
py::dict common(Result& result, const std::optional<file_data>& data) {
    py::dict made = common(result);
    if (data) {
        file_data kept = *data;
        kept.own().attributes = std::move(result.attributes);
        made["data"] = std::move(kept);
    }
    return made;
}

tf::weld_options options_of(double tolerance, const std::string& rule, const std::string& keep,
                            const std::string& keep_by, const std::string& order,
                            const std::string& order_by, const conditions& same,
                            const std::vector<std::string>& across, bool keep_seams,
                            bool only_borders, bool keep_manifold, bool keep_degenerate) {
    tf::weld_options options{.tolerance = tolerance,
                             .rule = choice<tf::weld_rule>("rule", weld_rule_words, rule),
                             .keep_seams = keep_seams,
                             .across = across,
                             .keep = choice<tf::weld_keep>("keep", weld_keep_words, keep),
                             .keep_by = keep_by,
                             .order = choice<tf::weld_order>("order", weld_order_words, order),
                             .order_by = order_by,
                             .only_borders = only_borders,
                             .keep_manifold = keep_manifold,
                             .keep_degenerate = keep_degenerate};
    for (const auto& [name, within] : same) options.same.push_back({name, within});
    return options;
}

/// How to weld, as Python keeps it while it calls one of the two below.
struct weld_settings {
    tf::weld_options options{};
    ids_array label;
};

py::dict with_faces(py::dict made, tf::mesh&& mesh, std::vector<std::uint32_t>&& face_of_new) {
    made["face_source"] = as_array(std::move(face_of_new));
    made["points"] = as_array(std::move(mesh.points));
    made["faces"] = as_array(std::move(mesh.faces));
    return made;
}

/// Attributes of polygons have a row for each polygon, as a file has them.
py::dict weld_polygons(const held_mesh& mesh, const file_data& data, tf::weld_options options) {
    tf::file_weld_result result = run([&](const tf::progress_callback& report) {
        const auto [points, faces] = mesh.view();
        tf::mesh_file file = data.file();
        file.mesh = {{points.begin(), points.end()}, {faces.begin(), faces.end()}};
        file.indexed = true;
        require_rows(file, 0);
        options.progress = report;
        return tf::weld(file, options);
    });
    py::dict made =
        with_faces(common(result), std::move(result.file.mesh), std::move(result.face_of_new));
    result.file.mesh = {};
    made["data"] = file_data(std::move(result.file));
    return made;
}

std::optional<file_data> copy_of(const file_data* data) {
    return data == nullptr ? std::nullopt : std::optional(*data);
}

py::dict weld_mesh(const held_mesh& mesh, const file_data* data, const weld_settings& settings) {
    const std::optional<file_data> kept = copy_of(data);
    tf::weld_options options = settings.options;
    options.label = rows_of<std::uint32_t>(settings.label);
    if (kept && !kept->file().stored_face.empty()) return weld_polygons(mesh, *kept, options);
    tf::weld_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        if (kept) return tf::weld(mesh.view(), kept->file().attributes, options);
        return mesh.with([&](const auto& m) { return tf::weld(m, options); });
    });
    return with_faces(common(result, kept), std::move(result.mesh), std::move(result.face_of_new));
}

py::dict weld_cloud(const points_array& points, const file_data* data,
                    const weld_settings& settings) {
    const std::optional<file_data> kept = copy_of(data);
    const tf::points_view all = points_of(points);
    tf::weld_options options = settings.options;
    options.label = rows_of<std::uint32_t>(settings.label);
    tf::weld_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return kept ? tf::weld(all, kept->file().attributes, options) : tf::weld(all, options);
    });
    py::dict made = common(result, kept);
    made["points"] = as_array(std::move(result.points));
    return made;
}

std::uint64_t count_nearly_equal(const points_array& points, double distance) {
    const tf::points_view all = points_of(points);
    return run([&](const tf::progress_callback&) { return tf::count_nearly_equal(all, distance); });
}

}  // namespace

void add_weld(py::module_& module) {
    py::class_<weld_settings>(module, "WeldSettings")
        .def(py::init([](double tolerance, const std::string& rule, const std::string& keep,
                         const std::string& keep_by, const std::string& order,
                         const std::string& order_by, const conditions& same,
                         const std::vector<std::string>& across, bool keep_seams, bool only_borders,
                         bool keep_manifold, bool keep_degenerate, const ids_array& label) {
            return weld_settings{
                options_of(tolerance, rule, keep, keep_by, order, order_by, same, across,
                           keep_seams, only_borders, keep_manifold, keep_degenerate),
                label};
        }));
    module.def("weld_mesh", &weld_mesh);
    module.def("weld_cloud", &weld_cloud);
    module.def("count_nearly_equal", &count_nearly_equal);
}

}  // namespace binding
