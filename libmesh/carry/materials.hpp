#pragma once
/// \file
/// Materials of the inputs' faces, for the faces of what is made of them, and names of files.

#include <libmesh/carry/corners.hpp>
#include <treeform/mesh/carry.hpp>

#include <span>
#include <string>

namespace treeform::detail::carry {

/// The material of face `face` of an input; empty where it has none.
[[nodiscard]] const std::string& material_of(const carry_source& input, std::uint32_t face);

/// Gives `file` parts with the materials of the faces' sources, and the material files of all
/// inputs. Of a single input, parts keep their names, too: of several, they would name what each
/// piece of a result was once. A face without a source is in the part of a face that it has a
/// corner with. The texture files are those of the first input: of several, `unite_textures` has
/// been asked for one list.
void carry_materials(mesh_file& file, std::span<const carry_source> inputs,
                     const carried_elements& made);

}  // namespace treeform::detail::carry
