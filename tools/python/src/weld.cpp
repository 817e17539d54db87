#include "bindings.hpp"
#include "carrying.hpp"
#include "file_data.hpp"
#include "held_mesh.hpp"
#include "job.hpp"
#include "made/made.hpp"
#include <treeform/mesh/weld.hpp>

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace binding {
namespace {

/// What all results have in common.
template <class Result>
py::dict common(Result& result) {
    py::dict made;
    made["index"] = as_array(std::move(result.groups.group_of_point));
    made["source"] = as_array(std::move(result.point_of_group));
    made["statistics"] = counters(result.statistics);
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

py::dict weld_mesh(const held_mesh& mesh, const file_data* data, tf::weld_options options,
                   const ids_array& label) {
    const std::optional<file_data> kept = copy_of(data);
    options.label = rows_of<std::uint32_t>(label);
    if (kept && !kept->file().stored_face.empty()) return weld_polygons(mesh, *kept, options);
    tf::weld_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        if (kept) return tf::weld(mesh.view(), kept->file().attributes, options);
        return mesh.with([&](const auto& m) { return tf::weld(m, options); });
    });
    return with_faces(common(result, kept), std::move(result.mesh), std::move(result.face_of_new));
}

py::dict weld_cloud(const points_array& points, const file_data* data, tf::weld_options options,
                    const ids_array& label) {
    const std::optional<file_data> kept = copy_of(data);
    const tf::points_view all = points_of(points);
    options.label = rows_of<std::uint32_t>(label);
    tf::weld_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return kept ? tf::weld(all, kept->file().attributes, options) : tf::weld(all, options);
    });
    py::dict made = common(result, kept);
    made["points"] = as_array(std::move(result.mesh.points));
    return made;
}

}  // namespace

void add_weld(py::module_& module) {
    module.def("weld_mesh", &weld_mesh);
    module.def("weld_cloud", &weld_cloud);
}

}  // namespace binding
