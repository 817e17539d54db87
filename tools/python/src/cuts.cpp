#include "bindings.hpp"

namespace binding {
namespace {

tf::oriented_plane plane_of(const std::array<double, 3>& at, const std::array<double, 3>& normal) {
    return {{at[0], at[1], at[2]}, {normal[0], normal[1], normal[2]}};
}

/// A section as columns: of layers, of loops, of points.
py::object section_object(tf::section_result&& s) {
    using layer = tf::section_layer;
    using loop = tf::section_loop;
    py::dict made, loops;
    made["heights"] = column(s.layers, [](const layer& l) { return l.height; });
    made["origins"] = column(s.layers, [](const layer& l) { return numbers(l.at); });
    made["areas"] = column(s.layers, [](const layer& l) { return l.area; });
    made["lengths"] = column(s.layers, [](const layer& l) { return l.length; });
    made["open_counts"] = column(s.layers, [](const layer& l) { return l.open_count; });
    loops["first_loop"] = column(s.layers, [](const layer& l) { return l.first_loop; });
    loops["first_point"] =
        column(s.loops, [](const loop& l) { return static_cast<std::uint64_t>(l.first_point); });
    loops["closed"] = column(s.loops, [](const loop& l) { return std::uint8_t{l.closed}; });
    loops["oriented"] = column(s.loops, [](const loop& l) { return std::uint8_t{l.oriented}; });
    loops["parent"] = column(s.loops, [](const loop& l) { return l.parent; });
    loops["depth"] = column(s.loops, [](const loop& l) { return l.depth; });
    loops["loop_areas"] = column(s.loops, [](const loop& l) { return l.area; });
    loops["loop_lengths"] = column(s.loops, [](const loop& l) { return l.length; });
    made["points"] = as_array<double>(std::vector(s.points));
    made["faces"] = as_array(std::vector(s.faces));
    made["frame"] = column(std::array{s.frame.x, s.frame.y, s.frame.normal},
                           [](const tf::point3& axis) { return numbers(axis); });
    made["_loops"] = loops;
    made["_data"] = std::move(s);
    return object_of("treeform._cuts", "Section", made);
}

py::object section(const held_mesh& mesh, const std::array<double, 3>& at,
                   const std::array<double, 3>& normal, const array_of<double>& heights) {
    const std::span<const double> all = rows_of<double>(heights);
    tf::section_result made = run([&](const tf::progress_callback& report) {
        return tf::section(mesh.ref(), plane_of(at, normal), all, {report});
    });
    return section_object(std::move(made));
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

/// The pieces, and the certificate of all.
template <class Cut>
py::tuple pieces_of(const held_mesh& mesh, tf::cut_options options, const Cut& cut) {
    const carrying attributes({&mesh});
    options.keep_cuts = attributes.mixes();
    tf::cut_result made = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return cut(options);
    });
    const py::object pieces = as_python(std::move(made.pieces), attributes);
    return py::make_tuple(pieces, std::move(made.certificate));
}

py::tuple cut(const held_mesh& mesh, const std::array<double, 3>& at,
              const std::array<double, 3>& normal, const array_of<double>& heights,
              const tf::cut_options& options) {
    const std::span<const double> all = rows_of<double>(heights);
    return pieces_of(mesh, options, [&](const tf::cut_options& how) {
        return tf::cut(mesh.ref(), plane_of(at, normal), all, how);
    });
}

py::tuple cut_to_fit(const held_mesh& mesh, const std::array<double, 3>& size,
                     const tf::cut_options& options) {
    return pieces_of(mesh, options, [&](const tf::cut_options& how) {
        return tf::cut_to_fit(mesh.ref(), {size[0], size[1], size[2]}, how);
    });
}

py::tuple cut_along(const held_mesh& mesh, const array_of<double>& values,
                    const array_of<double>& levels, const tf::cut_options& options) {
    const std::span<const double> at = rows_of<double>(values), all = rows_of<double>(levels);
    return pieces_of(mesh, options, [&](const tf::cut_options& how) {
        return tf::cut_along(mesh.ref(), at, all, how);
    });
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
    const py::object data = attributes.to(made, {faces, vertices});
    return py::make_tuple(as_array(std::move(made.points)), as_array(std::move(made.faces)), data);
}

}  // namespace

void add_cuts(py::module_& module) {
    py::class_<tf::section_result>(module, "SectionData");
    add_job(module, "section", &section);
    add_job(module, "write_section", &write_section, job_kind::writes);
    add_job(module, "write_isolines", &write_isolines, job_kind::writes);
    add_job(module, "cut", &cut);
    add_job(module, "cut_to_fit", &cut_to_fit);
    add_job(module, "cut_along", &cut_along);
    add_job(module, "concatenate", &concatenate);
}

}  // namespace binding
