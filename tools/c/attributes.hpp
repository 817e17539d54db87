#pragma once
/// \file
/// Attributes transferred to results, and colors, in C.

#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/placement.hpp>

#include <tools/bindings/linked_files.hpp>
#include <tools/c/inputs.hpp>
#include <tools/c/made/structs.hpp>

namespace glue {

inline std::size_t faces_of(const tf::attribute_source& input) {
    return input.file->mesh.faces.size();
}

/// Elements of the operands, checked to be in range; `count_of(input)` is the number of elements of
/// an operand.
template <class CountOf>
std::span<const tf::operand_element> elements(const treeform_operand_element* data,
                                              std::size_t count, const char* name,
                                              std::span<const tf::attribute_source> inputs,
                                              const CountOf& count_of) {
    for (const treeform_operand_element& one : array(data, count, name))
        if (one.operand != TREEFORM_NONE &&
            (one.operand >= inputs.size() || one.index >= count_of(inputs[one.operand])))
            throw std::invalid_argument(std::string(name) + " names element " +
                                        std::to_string(one.index) + " of operand " +
                                        std::to_string(one.operand) + ", which does not exist");
    return rows_of<tf::operand_element>(data, count, name);
}

inline std::span<const std::uint32_t> numbers(const std::uint32_t* data, std::size_t count,
                                              const char* name, std::size_t limit) {
    const std::span all = array(data, count, name);
    for (const std::uint32_t one : all)
        if (one != TREEFORM_NONE && one >= limit)
            throw std::invalid_argument(std::string(name) + " names " + std::to_string(one) +
                                        ", which is out of range");
    return all;
}

/// Transfers the attributes of the `inputs` [count] to `file`, whose mesh is their result: columns
/// of vertices and faces, texture coordinates and normals, materials; from a single input, also the
/// names of its parts. `face_source` [F], `vertex_source` [V] and `face_of_cut_vertex` ([V] or
/// null) are members of a `treeform_boolean_result`.
inline void transfer_attributes(tf::mesh_file& file, const treeform_attribute_source* inputs,
                                std::size_t count, const treeform_operand_element* face_source,
                                const treeform_operand_element* vertex_source,
                                const treeform_operand_element* face_of_cut_vertex) {
    const carry_inputs files(inputs, count);
    const std::span from = files.sources();
    const auto points = [](const tf::attribute_source& s) { return s.file->mesh.points.size(); };
    const std::size_t vertices = file.mesh.points.size();
    std::span<const tf::operand_element> cut;
    if (face_of_cut_vertex)
        cut = elements(face_of_cut_vertex, vertices, "face_of_cut_vertex", from, faces_of);
    const tf::attribute_sources all({from.begin(), from.end()});
    all.transfer(file, elements(face_source, file.mesh.faces.size(), "face_source", from, faces_of),
                 elements(vertex_source, vertices, "vertex_source", from, points), cut);
    tools::warn_of_materials(file, all);
}

/// The same for a result of one input: `face_source` [F] and `vertex_source` [V] are members
/// of a `treeform_repair_result`, `treeform_cut_piece` or `treeform_simplify_result`. For the last,
/// also pass its `face_of_new_vertex` [V] and `corner_source` [3 F], else null.
inline void transfer_attributes_of_one(tf::mesh_file& file, const treeform_attribute_source* input,
                                       const std::uint32_t* face_source,
                                       const std::uint32_t* vertex_source,
                                       const std::uint32_t* face_of_new_vertex,
                                       const std::uint32_t* corner_source) {
    const carry_inputs files(input, 1);
    const tf::attribute_source from = files.sources()[0];
    const std::size_t points = file.mesh.points.size(), faces = file.mesh.faces.size();
    std::span<const std::uint32_t> of_new, corners;
    if (face_of_new_vertex != nullptr)
        of_new = numbers(face_of_new_vertex, points, "face_of_new_vertex", faces_of(from));
    if (corner_source != nullptr)
        corners = numbers(corner_source, 3 * faces, "corner_source", 3 * faces_of(from));
    tf::attribute_sources(from).transfer(
        file, numbers(face_source, faces, "face_source", faces_of(from)),
        numbers(vertex_source, points, "vertex_source", from.file->mesh.points.size()), of_new,
        corners);
}

/// A group for each face of all inputs, for `treeform_boolean_options::face_groups`. With
/// `by_values`, a group has one material and equal values; with `by_input`, faces of one input
/// only.
inline std::vector<std::uint32_t> face_groups(const treeform_attribute_source* inputs,
                                              std::size_t count, bool by_values, bool by_input) {
    const carry_inputs files(inputs, count);
    return tf::attribute_sources({files.sources().begin(), files.sources().end()})
        .face_groups(by_values, by_input);
}

/// A group for each corner [3 F] of an input, for `treeform_simplify_options::corner_groups`, which
/// preserves seams and borders between materials and values. Empty if all corners at each point
/// would be in one group.
inline std::vector<std::uint32_t> corner_groups(const treeform_attribute_source* input) {
    const carry_inputs files(input, 1);
    return tf::attribute_sources({files.sources().begin(), files.sources().end()}).corner_groups();
}

/// Gives faces the columns NAME_mesh and NAME_face: the operand and the face number of each source.
/// A comment names each of `inputs` [count].
inline void add_source_columns(tf::mesh_file& file, const std::string& name,
                               const treeform_operand_element* face_source,
                               std::span<const std::string> inputs) {
    tf::set_source_columns(
        file, name,
        rows_of<tf::operand_element>(face_source, file.mesh.faces.size(), "face_source"), inputs);
}

/// Gives the vertices of a file the property "distance", and colors from blue (`low` or less) over
/// white (0) to red (`high` or more). `distances` [count] has one value for each point.
inline void color_distances(tf::mesh_file& file, std::span<const double> distances, double low,
                            double high) {
    tf::deviation_result::color(file, distances, low, high);
}

/// Gives the triangles of a file (for a cloud, its points) the property tf_class and its color;
/// `relations` [count] is from `treeform_find_face_relations`. Small disjoint triangles, with
/// edges of at most twice `halo`, get a tint if they are near a triangle that is not disjoint.
inline void color_contacts(tf::mesh_file& file, std::span<const std::uint8_t> relations,
                           double halo) {
    std::vector<tf::mesh_relation> all;
    for (const std::uint8_t one : relations)
        all.push_back(choice<tf::mesh_relation>(one, 5, "a relation"));
    tf::placement::color(file, all, halo);
}

}  // namespace glue
