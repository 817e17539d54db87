#include "bindings.hpp"
#include "carrying.hpp"
#include "held_mesh.hpp"
#include "job.hpp"
#include "words.hpp"
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/section.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <optional>
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

tf::cut_options options_of(bool caps, const std::string& precision, double max_displacement,
                           const carrying& attributes) {
    return {.precision = precision_of(precision),
            .max_displacement = max_displacement,
            .caps = caps,
            .keep_cuts = attributes.mixes()};
}

/// The pieces, and the certificate of all.
py::tuple as_tuple(tf::cut_result&& made, const carrying& attributes) {
    py::list pieces;
    for (tf::cut_piece& piece : made.pieces) {
        py::dict one;
        one["data"] = attributes.to(piece.mesh, piece.face_source, piece.vertex_source);
        one["points"] = as_array(std::move(piece.mesh.points));
        one["faces"] = as_array(std::move(piece.mesh.faces));
        one["face_source"] = as_array(std::move(piece.face_source));
        one["vertex_source"] = as_array(std::move(piece.vertex_source));
        one["cap"] = as_array(std::move(piece.cap));
        one["certificate"] = std::move(piece.certificate);
        pieces.append(one);
    }
    return py::make_tuple(pieces, std::move(made.certificate));
}

py::tuple cut(const held_mesh& mesh, const std::array<double, 3>& at,
              const std::array<double, 3>& normal, const array_of<double>& heights, bool caps,
              const std::string& precision, double max_displacement) {
    const carrying attributes({&mesh});
    const std::span<const double> all = rows_of<double>(heights);
    tf::cut_options options = options_of(caps, precision, max_displacement, attributes);
    return as_tuple(run([&](const tf::progress_callback& report) {
                        options.progress = report;
                        return mesh.with([&](const auto& m) {
                            return tf::cut(m, plane_of(at, normal), all, options);
                        });
                    }),
                    attributes);
}

py::tuple cut_to_fit(const held_mesh& mesh, const std::array<double, 3>& size, bool caps,
                     const std::string& precision, double max_displacement) {
    const carrying attributes({&mesh});
    tf::cut_options options = options_of(caps, precision, max_displacement, attributes);
    return as_tuple(run([&](const tf::progress_callback& report) {
                        options.progress = report;
                        return tf::cut_to_fit(mesh.view(), {size[0], size[1], size[2]}, options);
                    }),
                    attributes);
}

py::dict as_dict(tf::mesh_part&& part, const carrying& attributes) {
    py::dict made;
    made["data"] = attributes.to(part.mesh, part.face_source, part.vertex_source);
    made["points"] = as_array(std::move(part.mesh.points));
    made["faces"] = as_array(std::move(part.mesh.faces));
    made["face_source"] = as_array(std::move(part.face_source));
    made["vertex_source"] = as_array(std::move(part.vertex_source));
    made["volume"] = part.volume;
    made["area"] = part.area;
    return made;
}

py::list components(const held_mesh& mesh, double min_volume, std::optional<std::size_t> largest) {
    const carrying attributes({&mesh});
    tf::components_options options{.min_volume = min_volume};
    if (largest) options.largest = *largest;
    std::vector<tf::mesh_part> parts =
        run([&](const tf::progress_callback&) { return tf::components(mesh.view(), options); });
    py::list made;
    for (tf::mesh_part& part : parts) made.append(as_dict(std::move(part), attributes));
    return made;
}

py::dict submesh(const held_mesh& mesh, const ids_array& faces) {
    const carrying attributes({&mesh});
    return as_dict(run([&](const tf::progress_callback&) {
                       return tf::submesh(mesh.view(), rows_of<std::uint32_t>(faces));
                   }),
                   attributes);
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

py::array moved_points(const held_mesh& mesh, const array_of<double>& matrix) {
    const tf::transform<3> by = transform_of(matrix);
    return as_array(run([&](const tf::progress_callback&) {
        return tf::transform_mesh({mesh.view().points, {}}, by).points;
    }));
}

py::object mass_properties(const held_mesh& mesh) {
    const auto found =
        run([&](const tf::progress_callback&) { return tf::find_mass_properties(mesh.view()); });
    if (!found) return py::none();
    py::dict made;
    made["volume"] = found->volume;
    made["center"] = as_array(found->center);
    made["inertia"] = column(found->inertia, [](const auto& row) { return row; });
    return made;
}

}  // namespace

void add_cuts(py::module_& module) {
    py::class_<tf::section_result>(module, "SectionData");
    module.def("section", &section);
    module.def("layer_heights", &layer_heights);
    module.def("write_section", &write_section);
    module.def("cut", &cut);
    module.def("cut_to_fit", &cut_to_fit);
    module.def("components", &components);
    module.def("submesh", &submesh);
    module.def("concatenate", &concatenate);
    module.def("moved_points", &moved_points);
    module.def("mass_properties", &mass_properties);
}

}  // namespace binding
