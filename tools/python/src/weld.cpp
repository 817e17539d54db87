#include "bindings.hpp"

namespace binding {
namespace {

/// Attributes of polygons have a row for each polygon, as a file has them.
tf::weld_result weld_file(tf::mesh_file& file, const tf::weld_options& options) {
    file.indexed = true;
    require_rows(file, 0);
    tf::file_weld_result made = tf::weld(file, options);
    file = std::move(made.file);
    return {std::exchange(file.mesh, {}), file.attributes,
            std::move(made.groups),       std::move(made.point_of_group),
            std::move(made.face_of_new),  made.statistics};
}

py::object weld(const held_mesh& mesh, tf::weld_options options, const ids_array& label) {
    options.label = rows_of<std::uint32_t>(label);
    const auto [points, faces] = mesh.view();
    std::optional<tf::mesh_file> file;
    if (!mesh.data().is_none()) file = file_of(mesh);
    tf::weld_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return file            ? weld_file(*file, options)
               : faces.empty() ? tf::weld(points, options)
                               : tf::weld(mesh.ref(), options);
    });
    if (!file) return object(of_result{}, std::move(result), nullptr);
    const file_data kept(std::move(*file));
    return object(of_result{}, std::move(result), &kept);
}

}  // namespace

void add_weld(py::module_& module) { add_job(module, "weld", &weld); }

}  // namespace binding
