#include "bindings.hpp"

namespace binding {
tf::boolean_expression expression_of(const std::string& operation, const std::string& formula,
                                     const std::vector<std::string>& names, std::size_t count) {
    if (operation == "union") return tf::boolean_expression::union_of(count);
    if (operation == "intersection") return tf::boolean_expression::intersection_of(count);
    if (operation == "difference") return tf::boolean_expression::difference_of(count);
    if (operation == "xor") return tf::boolean_expression::xor_of(count);
    return names.empty() ? tf::boolean_expression(formula, count)
                         : tf::boolean_expression(formula, names);
}

void require_faces(const held_meshes& meshes, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < meshes.size(); ++i)
        require_faces(*meshes[i], names.empty() ? "operand " + std::to_string(i) : names[i]);
}

namespace {

/// The objects of a mesh, in order, each with what it has; none where they cannot be told apart.
py::list objects_of(const held_mesh& mesh) {
    py::list objects;
    if (mesh.data().is_none()) return objects;
    if (mesh.data().cast<const file_data&>().file().attributes.parts.size() < 2) return objects;
    const tf::mesh_file whole = file_of(mesh);
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

}  // namespace

void add_booleans(py::module_& module) { module.def("objects_of", &objects_of); }

}  // namespace binding
