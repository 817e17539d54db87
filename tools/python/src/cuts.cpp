#include "bindings.hpp"

namespace binding {
namespace {

tf::oriented_plane plane_of(const std::array<double, 3>& at, const std::array<double, 3>& normal) {
    return {{at[0], at[1], at[2]}, {normal[0], normal[1], normal[2]}};
}

void write_section(const std::filesystem::path& path, const tf::section_result& section,
                   const std::string& format, const std::string& unit) {
    without_lock([&] { tf::write_section(path, section, format, unit); });
}

void write_isolines(const std::filesystem::path& path, const py::list& lines,
                    const array_of<double>& points, const std::array<double, 3>& normal,
                    const std::string& format, const std::string& unit) {
    tf::isolines_result all;
    for (const py::handle line : lines)
        all.lines.push_back(
            {line.attr("level").cast<double>(), line.attr("first_point").cast<std::size_t>(),
             line.attr("point_count").cast<std::size_t>(), line.attr("closed").cast<bool>(),
             line.attr("oriented").cast<bool>(), line.attr("length").cast<double>()});
    const std::span<const tf::point3> given = rows_of<tf::point3>(points);
    all.points.assign(given.begin(), given.end());
    const tf::plane_frame seen = plane_of({}, normal).frame();
    without_lock([&] { tf::write_isolines(path, all, seen, format, unit); });
}

/// Points, faces, and the attributes of those that have some.
py::tuple concatenate(const held_meshes& meshes) {
    const carrying attributes(meshes);
    const std::vector<tf::mesh_view> views = views_of(meshes);
    tf::mesh made = run([&](const tf::progress_callback&) { return tf::concatenate(views); });
    std::vector<tf::operand_element> faces, vertices;
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        for (std::uint32_t f = 0; f < views[i].faces.size(); ++f) faces.push_back({i, f});
        for (std::uint32_t v = 0; v < views[i].points.size(); ++v) vertices.push_back({i, v});
    }
    const py::object data = attributes.to(made, faces, vertices);
    return py::make_tuple(as_array(std::move(made.points)), as_array(std::move(made.faces)), data);
}

}  // namespace

void add_cuts(py::module_& module) {
    py::class_<tf::section_result>(module, "SectionData");
    add_job(module, "write_section", &write_section, job_kind::writes);
    add_job(module, "write_isolines", &write_isolines, job_kind::writes);
    add_job(module, "concatenate", &concatenate);
}

}  // namespace binding
