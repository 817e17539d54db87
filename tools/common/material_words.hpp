#pragma once
/// \file
/// Materials that a result cannot tell apart, in words.

#include "tools/common/run.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <span>

namespace tools {

/// Says which materials inputs with different material files name alike, for an OBJ that is made of
/// them: it has one of a name.
void warn_of_ambiguous_materials(job& work, std::span<const tf::mesh_file* const> inputs);

}  // namespace tools
