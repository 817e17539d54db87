#include "bindings.hpp"
#include "file_data.hpp"
#include "held_mesh.hpp"
#include "job.hpp"
#include "words.hpp"
#include <treeform/mesh/weld.hpp>

#include <pybind11/stl.h>

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

/// What results of meshes and clouds have in common.
template <class Result>
py::dict common(Result& result, const file_data* data) {
    py::dict made;
    made["index"] = as_array(std::move(result.groups.group_of_point));
    made["source"] = as_array(std::move(result.point_of_group));
    made["statistics"] = statistics_of(result.statistics);
    made["data"] = py::none();
    if (data != nullptr) {
        file_data kept = *data;
        kept.file.attributes = std::move(result.attributes);
        kept.file.stored_face.clear();
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

py::dict weld_mesh(const held_mesh& mesh, const file_data* data, const weld_settings& settings) {
    tf::weld_options options = settings.options;
    options.label = rows_of<std::uint32_t>(settings.label);
    tf::weld_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        if (data != nullptr) return tf::weld(mesh.view(), data->file.attributes, options);
        return mesh.with([&](const auto& m) { return tf::weld(m, options); });
    });
    py::dict made = common(result, data);
    made["face_source"] = as_array(std::move(result.face_of_new));
    made["points"] = as_array(std::move(result.mesh.points));
    made["faces"] = as_array(std::move(result.mesh.faces));
    return made;
}

py::dict weld_cloud(const points_array& points, const file_data* data,
                    const weld_settings& settings) {
    const tf::points_view all = points_of(points);
    tf::weld_options options = settings.options;
    options.label = rows_of<std::uint32_t>(settings.label);
    tf::cloud_weld_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return data == nullptr ? tf::weld(all, options)
                               : tf::weld(all, data->file.attributes, options);
    });
    py::dict made = common(result, data);
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
