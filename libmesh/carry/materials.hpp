#pragma once
/// \file
/// Transfers materials of faces, and names of material and texture files, from the inputs to a
/// result.

#include <libmesh/carry/corners.hpp>
#include <treeform/mesh/carry.hpp>

#include <span>
#include <string>

namespace treeform::detail::carry {

/// The material of face `face` of an input; empty if it has none.
[[nodiscard]] const std::string& material_of(const carry_source& input, std::uint32_t face);

/// Sets the parts of `file`, with the materials of the source faces, and the material files of all
/// inputs. With a single input, parts also keep their names; with several, names would only tell
/// the origin of each piece. A face without a source is put into the part of a face with a common
/// corner. Texture files are those of the first input: with several inputs, `unite_textures` must
/// have made one list before.
void carry_materials(mesh_file& file, std::span<const carry_source> inputs,
                     const carried_elements& made);

}  // namespace treeform::detail::carry
