#pragma once
/// \file
/// Attributes of inputs, transferred to results; colors.

#include <treeform/c/files.h>

/// An input of an operation.
typedef struct treeform_attribute_source {
    const treeform_file* file;
    /// [F] the triangle in the file of each face of the input (`treeform_usable_mesh`); null: the
    /// same numbers.
    const uint32_t* triangle_of_face;
    size_t face_count;  ///< of `triangle_of_face`
} treeform_attribute_source;

// made of the headers of C++:
//   transfer_attributes() transfer_attributes_of_one() face_groups() corner_groups()
//   add_source_columns() color_distances() color_contacts()
/// Transfers the attributes of the `inputs` [count] to `file`, whose mesh is their result: columns
/// of vertices and faces, texture coordinates and normals, materials; from a single input, also
/// the names of its parts. `face_source` [F], `vertex_source` [V] and `face_of_cut_vertex` ([V] or
/// null) are members of a `treeform_boolean_result`.
TREEFORM_C_API treeform_code treeform_transfer_attributes(
    treeform_file* file, const treeform_attribute_source* inputs, size_t count,
    const treeform_operand_element* face_source, const treeform_operand_element* vertex_source,
    const treeform_operand_element* face_of_cut_vertex);

/// The same for a result of one input: `face_source` [F] and `vertex_source` [V] are members of a
/// `treeform_repair_result`, `treeform_cut_piece` or `treeform_simplify_result`. For the last,
/// also pass its `face_of_new_vertex` [V] and `corner_source` [3 F], else null.
TREEFORM_C_API treeform_code treeform_transfer_attributes_of_one(
    treeform_file* file, const treeform_attribute_source* input, const uint32_t* face_source,
    const uint32_t* vertex_source, const uint32_t* face_of_new_vertex,
    const uint32_t* corner_source);

/// A group for each face of all inputs, for `treeform_boolean_options::face_groups`. With
/// `by_values`, a group has one material and equal values; with `by_input`, faces of one input
/// only.
TREEFORM_C_API treeform_code treeform_face_groups(const treeform_attribute_source* inputs,
                                                  size_t count, int32_t by_values, int32_t by_input,
                                                  treeform_indices** indices);

/// A group for each corner [3 F] of an input, for `treeform_simplify_options::corner_groups`,
/// which preserves seams and borders between materials and values. Empty if all corners at each
/// point would be in one group.
TREEFORM_C_API treeform_code treeform_corner_groups(const treeform_attribute_source* input,
                                                    treeform_indices** indices);

/// Gives faces the columns NAME_mesh and NAME_face: the operand and the face number of each
/// source. A comment names each of `inputs` [count].
TREEFORM_C_API treeform_code treeform_add_source_columns(
    treeform_file* file, const char* name, const treeform_operand_element* face_source,
    const char* const* inputs, size_t count);

/// Gives the vertices of a file the property "distance", and colors from blue (`low` or less) over
/// white (0) to red (`high` or more). `distances` [count] has one value for each point.
TREEFORM_C_API treeform_code treeform_color_distances(treeform_file* file, const double* distances,
                                                      size_t count, double low, double high);

/// Gives the triangles of a file (for a cloud, its points) the property tf_class and its color;
/// `relations` [count] is from `treeform_find_face_relations`. Small disjoint triangles, with
/// edges of at most twice `halo`, get a tint if they are near a triangle that is not disjoint.
TREEFORM_C_API treeform_code treeform_color_contacts(treeform_file* file, const uint8_t* relations,
                                                     size_t count, double halo);
// end
