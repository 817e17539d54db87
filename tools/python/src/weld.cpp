#include "bindings.hpp"

namespace binding {
namespace {

/// Attributes of polygons have a row for each polygon, as a file has them.
py::object weld_polygons(const held_mesh& mesh, const file_data& data, tf::weld_options options) {
    tf::file_weld_result result = run([&](const tf::progress_callback& report) {
        const auto [points, faces] = mesh.view();
        tf::mesh_file file = data.file();
        file.mesh = {{points.begin(), points.end()}, {faces.begin(), faces.end()}};
        file.indexed = true;
        require_rows(file, 0);
        options.progress = report;
        return tf::weld(file, options);
    });
    tf::weld_result made{std::exchange(result.file.mesh, {}),
                         result.file.attributes,
                         std::move(result.groups),
                         std::move(result.point_of_group),
                         std::move(result.face_of_new),
                         result.statistics};
    const file_data kept(std::move(result.file));
    return object(of_result{}, std::move(made), &kept);
}

std::optional<file_data> copy_of(const file_data* data) {
    return data == nullptr ? std::nullopt : std::optional(*data);
}

py::object weld_mesh(const held_mesh& mesh, const file_data* data, tf::weld_options options,
                     const ids_array& label) {
    const std::optional<file_data> kept = copy_of(data);
    options.label = rows_of<std::uint32_t>(label);
    if (kept && !kept->file().stored_face.empty()) return weld_polygons(mesh, *kept, options);
    tf::weld_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        if (kept) return tf::weld(mesh.view(), kept->file().attributes, options);
        return mesh.with([&](const auto& m) { return tf::weld(m, options); });
    });
    return object(of_result{}, std::move(result), kept ? &*kept : nullptr);
}

py::object weld_cloud(const points_array& points, const file_data* data, tf::weld_options options,
                      const ids_array& label) {
    const std::optional<file_data> kept = copy_of(data);
    const tf::points_view all = points_of(points);
    options.label = rows_of<std::uint32_t>(label);
    tf::weld_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return kept ? tf::weld(all, kept->file().attributes, options) : tf::weld(all, options);
    });
    return object(of_result{}, std::move(result), kept ? &*kept : nullptr);
}

}  // namespace

void add_weld(py::module_& module) {
    add_job(module, "weld_mesh", &weld_mesh);
    add_job(module, "weld_cloud", &weld_cloud);
}

}  // namespace binding
