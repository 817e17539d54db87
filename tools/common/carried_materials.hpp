#pragma once
/// \file
/// Materials of the inputs' faces, for the faces of what is made of them, and names of files.

#include "tools/common/carried_properties.hpp"
#include "tools/common/run.hpp"
#include <treeform/tf.hpp>

#include <span>
#include <string>

namespace tools {

/// The material of face `face` of an input; empty where it has none.
[[nodiscard]] const std::string& material_of(const property_source& input, std::uint32_t face);

/// Gives `file` parts that have nothing but the materials of the faces' sources, and the material
/// files of all inputs. A face without a source has the material of the one before it. The texture
/// files are those of the first input: of several, `unite_textures` has been asked for one list.
void carry_materials(tf::mesh_file& file, std::span<const property_source> inputs,
                     const carried_to& made);

/// Says which materials inputs with different material files name alike, for an OBJ that is made of
/// them: it has one of a name.
void warn_of_ambiguous_materials(job& work, std::span<const tf::mesh_file* const> inputs);

}  // namespace tools
