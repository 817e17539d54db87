#pragma once
/// \file
/// Materials of the inputs' faces, for the faces of what is made of them.

#include "tools/common/carried_properties.hpp"

#include <string>

namespace tools {

/// The material of face `face` of an input; empty where it has none.
[[nodiscard]] const std::string& material_of(const property_source& input, std::uint32_t face);

/// Gives `file` parts that have nothing but the materials of the faces' sources, and the material
/// files of all inputs. A face without a source has the material of the one before it.
void carry_materials(tf::mesh_file& file, std::span<const property_source> inputs,
                     const carried_to& made);

/// The materials that inputs with different material files name alike, which a file can have only
/// once.
[[nodiscard]] std::vector<std::string> ambiguous_materials(std::span<const property_source> inputs);

}  // namespace tools
