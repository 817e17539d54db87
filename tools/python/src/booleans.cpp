#include "bindings.hpp"
#include "carrying.hpp"
#include "file_data.hpp"
#include "held_mesh.hpp"
#include "job.hpp"
#include "words.hpp"
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/carry.hpp>

#include <pybind11/stl.h>

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace binding {
namespace {

std::vector<tf::mesh_ref> operands_of(const held_meshes& meshes) {
    std::vector<tf::mesh_ref> all;
    for (const held_mesh* one : meshes)
        one->keep() ? all.emplace_back(one->prepared()) : all.emplace_back(one->view());
    return all;
}

/// What is made of so many operands: by name, or by a formula in letters or names.
tf::boolean_expression expression_of(const std::string& operation, const std::string& formula,
                                     const std::vector<std::string>& names, std::size_t count) {
    if (operation == "union") return tf::boolean_expression::union_of(count);
    if (operation == "intersection") return tf::boolean_expression::intersection_of(count);
    if (operation == "difference") return tf::boolean_expression::difference_of(count);
    if (operation == "xor") return tf::boolean_expression::xor_of(count);
    return names.empty() ? tf::boolean_expression(formula, count)
                         : tf::boolean_expression(formula, names);
}

py::array_t<std::uint32_t> sources(const std::vector<tf::operand_element>& elements) {
    return column(elements, [](const tf::operand_element& element) {
        return std::array<std::uint32_t, 2>{element.operand, element.index};
    });
}

py::dict statistics_of(const tf::boolean_result& result) {
    const tf::boolean_statistics& s = result.statistics;
    py::dict made;
    made["pairs"] = s.pairs;
    made["cut_faces"] = s.cut_faces;
    made["degenerate"] = s.degenerate;
    made["skipped_faces"] = s.skipped_faces;
    made["covered"] = s.covered;
    made["exact_faces"] = s.exact_faces;
    made["split_vertices"] = s.split_vertices;
    made["slivers"] = s.slivers;
    made["rounding_rounds"] = s.rounding_rounds;
    made["small_parts"] = s.small_parts;
    made["small_volume"] = s.small_volume;
    made["filled_faces"] = s.filled_faces;
    made["vanished_components"] = result.vanished_components;
    made["vanished_reach"] = result.vanished_reach;
    return made;
}

py::dict as_dict(tf::boolean_result&& result, const carrying& attributes) {
    py::dict made;
    made["data"] = attributes.to(
        result.mesh, {result.face_source, result.vertex_source, result.face_of_cut_vertex});
    made["face_source"] = sources(result.face_source);
    made["vertex_source"] = sources(result.vertex_source);
    made["volumes"] = py::none();
    if (const auto& v = result.volumes)
        made["volumes"] = py::make_tuple(v->first, v->second, v->either, v->both);
    made["statistics"] = statistics_of(result);
    made["points"] = as_array(std::move(result.mesh.points));
    made["faces"] = as_array(std::move(result.mesh.faces));
    made["certificate"] = std::move(result.certificate);
    return made;
}

tf::boolean_options options_of(const std::string& inside, const std::string& precision,
                               bool keep_cuts, bool simplify, double max_displacement) {
    return {.inside = choice<tf::fill_rule>("inside", fill_rule_words, inside),
            .precision = precision_of(precision),
            .max_displacement = max_displacement,
            .keep_cuts = keep_cuts,
            .simplify = simplify};
}

/// A cloud is no solid, not even the empty one.
void require_faces(const held_mesh& mesh, const std::string& name) {
    const auto [points, faces] = mesh.view();
    if (!points.empty() && faces.empty())
        throw std::invalid_argument(name + ": " + std::to_string(points.size()) +
                                    " points without a face are no solid");
}
void require_faces(const held_meshes& meshes, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < meshes.size(); ++i)
        require_faces(*meshes[i], names.empty() ? "operand " + std::to_string(i) : names[i]);
}

/// The objects of a mesh, in order, each with what it has; none where they cannot be told apart.
py::list objects_of(const held_mesh& mesh) {
    py::list objects;
    if (mesh.data().is_none()) return objects;
    tf::mesh_file whole = mesh.data().cast<const file_data&>().file();
    if (whole.attributes.parts.size() < 2) return objects;
    const auto [points, faces] = mesh.view();
    whole.mesh = {{points.begin(), points.end()}, {faces.begin(), faces.end()}};
    require_rows(whole, 0);
    std::vector<tf::file_part> parts;
    without_lock([&] { parts = tf::split_parts({&whole, {}}); });
    if (parts.size() < 2) return objects;
    for (tf::file_part& part : parts) {
        tf::mesh made = std::exchange(part.file.mesh, {});
        held_mesh object(as_array(std::move(made.points)), as_array(std::move(made.faces)), false);
        object.set_data(py::cast(file_data(std::move(part.file))));
        objects.append(py::cast(std::move(object)));
    }
    return objects;
}

py::dict boolean(const held_meshes& meshes, const std::string& operation,
                 const std::string& formula, const std::vector<std::string>& names,
                 const std::string& inside, const std::string& precision, bool keep_cuts,
                 bool simplify, bool volumes, double max_displacement, double min_volume,
                 double gap) {
    const tf::boolean_expression expression =
        expression_of(operation, formula, names, meshes.size());
    tf::boolean_options options =
        options_of(inside, precision, keep_cuts, simplify, max_displacement);
    options.volumes = volumes;
    options.min_volume = min_volume;
    options.gap = gap;
    require_faces(meshes, names);
    const carrying attributes(meshes);
    attributes.keep_apart(options);
    const std::vector<std::uint32_t> groups = attributes.face_groups();
    options.face_groups = groups;
    const std::vector<tf::mesh_ref> operands = operands_of(meshes);
    return as_dict(run([&](const tf::progress_callback& report) {
                       options.progress = report;
                       return tf::boolean(operands, expression, options);
                   }),
                   attributes);
}

py::dict clip(const held_meshes& meshes, std::uint32_t sheet, const std::string& operation,
              const std::string& formula, const std::vector<std::string>& names,
              const std::string& inside, const std::string& precision, bool keep_cuts,
              double max_displacement) {
    const tf::boolean_expression expression =
        expression_of(operation, formula, names, meshes.size());
    tf::boolean_options options = options_of(inside, precision, keep_cuts, false, max_displacement);
    require_faces(meshes, names);
    const std::vector<tf::mesh_view> operands = views_of(meshes);
    const carrying attributes(meshes);
    attributes.keep_apart(options);
    const std::vector<std::uint32_t> groups = attributes.face_groups();
    options.face_groups = groups;
    return as_dict(run([&](const tf::progress_callback& report) {
                       options.progress = report;
                       return tf::clip(operands, sheet, expression, options);
                   }),
                   attributes);
}

py::dict split(const held_meshes& meshes, const std::string& precision, double max_displacement) {
    tf::boolean_options options = options_of("nonzero", precision, true, false, max_displacement);
    const std::vector<tf::mesh_view> operands = views_of(meshes);
    const carrying attributes(meshes);
    return as_dict(run([&](const tf::progress_callback& report) {
                       options.progress = report;
                       return tf::split(operands, options);
                   }),
                   attributes);
}

tf::certificate check_solid(const held_mesh& mesh) {
    require_faces(mesh, "mesh");
    return run(
        [&](const tf::progress_callback& report) { return tf::check_solid(mesh.view(), report); });
}

}  // namespace

void add_booleans(py::module_& module) {
    module.def("objects_of", &objects_of);
    module.def("boolean", &boolean);
    module.def("clip", &clip);
    module.def("split", &split);
    module.def("check_solid", &check_solid);
}

}  // namespace binding
