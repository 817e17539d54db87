#pragma once
/// \file
/// Booleans by formulas, and repair of files, in C.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/repair.hpp>

#include <tools/c/inputs.hpp>
#include <tools/c/made/structs.hpp>

namespace glue {

/// The solid that `expression` defines over the `operands` [count]: a formula of a, b, c, ... with
/// + or | union, * or & intersection, - difference, ^ symmetric difference, and parentheses:
/// "(a-b)*c". Exact, then rounded and checked. Operands are not copied. Each must bound a solid.
inline tf::boolean_result boolean(const tf::mesh_refs& operands, const std::string& expression,
                                  const tf::boolean_options& options) {
    return tf::boolean(operands, expression.c_str(), options);
}

/// The same with `names` [count] instead of letters: "body-(bolt_1+'left bolt')".
inline tf::boolean_result boolean_named(const treeform_mesh* const* operands,
                                        const char* const* names, std::size_t count,
                                        const std::string& expression,
                                        const tf::boolean_options& options) {
    return tf::boolean(refs(operands, count, "operands"),
                       tf::boolean_expression(expression, texts(names, count, "names")), options);
}

/// The names in a formula, each once, in the order of first use.
inline std::vector<std::string> names_in(const std::string& expression) {
    return tf::boolean_expression::names_in(expression);
}

/// Points in `a` but not in `b`.
inline tf::boolean_result difference(const tf::mesh_ref& a, const tf::mesh_ref& b,
                                     const tf::boolean_options& options) {
    return tf::difference(a, b, options);
}

/// The union of all `operands` [count], without a formula.
inline tf::boolean_result unite_all(const tf::mesh_refs& operands,
                                    const tf::boolean_options& options) {
    return tf::unite(operands, options);
}

/// Points in `a` (operand 0) but in none of `others` [count] (operands 1, 2, ...).
inline tf::boolean_result difference_all(const tf::mesh_ref& a, const tf::mesh_refs& others,
                                         const tf::boolean_options& options) {
    return tf::difference(a, others, options);
}

/// An open surface cut by solids: the pieces of operand number `sheet` for which `expression` is
/// true. With the sheet as a, "a-b" keeps the pieces outside of b, and "a*b" those inside.
inline tf::boolean_result clip(const tf::mesh_refs& operands, std::uint32_t sheet,
                               const std::string& expression, const tf::boolean_options& options) {
    return tf::clip(operands, sheet, tf::boolean_expression(expression, operands.size()), options);
}

inline treeform_code give(tf::repaired_file&& repaired, treeform_repair_result** out) {
    const treeform_code code = code_of(repaired.certificate);
    give_file(std::move(repaired), out);
    return code;
}

/// The same for each part of a file, or for all parts as one mesh, with its attributes. The mesh of
/// the file is used as it was read.
inline tf::repaired_file repair_file(const tf::mesh_file& file, const tf::repair_options& options) {
    return tf::repair_file(usable_input(file).source(), options);
}

/// The total defects of the parts of a file. Pairs of faces of different parts do not count.
inline tf::solid_defects find_solid_defects_of_file(const tf::mesh_file& file,
                                                    const tf::progress_callback& progress) {
    const usable_input input(file);
    tf::solid_defects found = tf::find_solid_defects(input.source(), progress);
    found.unusable_faces += input.non_finite();
    return found;
}

}  // namespace glue
