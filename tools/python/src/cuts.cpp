#include "bindings.hpp"
#include "held_mesh.hpp"
#include "job.hpp"
#include <treeform/mesh/section.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace binding {
namespace {

tf::oriented_plane plane_of(const std::array<double, 3>& at, const std::array<double, 3>& normal) {
    return {{at[0], at[1], at[2]}, {normal[0], normal[1], normal[2]}};
}

/// Arrays of a section: of layers, of loops, of points.
py::dict arrays_of(const tf::section_result& s) {
    using layer = tf::section_layer;
    using loop = tf::section_loop;
    py::dict made;
    made["heights"] = column(s.layers, [](const layer& l) { return l.height; });
    made["origins"] = column(s.layers, [](const layer& l) { return numbers(l.at); });
    made["areas"] = column(s.layers, [](const layer& l) { return l.area; });
    made["lengths"] = column(s.layers, [](const layer& l) { return l.length; });
    made["open_counts"] = column(s.layers, [](const layer& l) { return l.open_count; });
    made["first_loop"] = column(s.layers, [](const layer& l) { return l.first_loop; });
    made["first_point"] =
        column(s.loops, [](const loop& l) { return static_cast<std::uint64_t>(l.first_point); });
    made["closed"] = column(s.loops, [](const loop& l) { return std::uint8_t{l.closed}; });
    made["oriented"] = column(s.loops, [](const loop& l) { return std::uint8_t{l.oriented}; });
    made["parent"] = column(s.loops, [](const loop& l) { return l.parent; });
    made["depth"] = column(s.loops, [](const loop& l) { return l.depth; });
    made["loop_areas"] = column(s.loops, [](const loop& l) { return l.area; });
    made["loop_lengths"] = column(s.loops, [](const loop& l) { return l.length; });
    made["points"] = as_array<double>(std::vector(s.points));
    made["faces"] = as_array(std::vector(s.faces));
    made["frame"] = column(std::array{s.frame.x, s.frame.y, s.frame.normal},
                           [](const tf::point3& axis) { return numbers(axis); });
    return made;
}

py::tuple section(const held_mesh& mesh, const std::array<double, 3>& at,
                  const std::array<double, 3>& normal, const array_of<double>& heights) {
    const std::span<const double> all = rows_of<double>(heights);
    tf::section_result made = run([&](const tf::progress_callback& report) {
        return mesh.with(
            [&](const auto& m) { return tf::section(m, plane_of(at, normal), all, {report}); });
    });
    py::dict arrays = arrays_of(made);
    return py::make_tuple(std::move(made), arrays);
}

py::array layer_heights(const held_mesh& mesh, const std::array<double, 3>& at,
                        const std::array<double, 3>& normal, double thickness) {
    return as_array<double>(run([&](const tf::progress_callback&) {
        return tf::layer_heights(mesh.view().points, plane_of(at, normal), thickness);
    }));
}

void write_section(const std::filesystem::path& path, const tf::section_result& section,
                   const std::string& format) {
    without_lock([&] { tf::write_section(path, section, format); });
}

}  // namespace

void add_cuts(py::module_& module) {
    py::class_<tf::section_result>(module, "SectionData");
    module.def("section", &section);
    module.def("layer_heights", &layer_heights);
    module.def("write_section", &write_section);
}

}  // namespace binding
