#pragma once
/// \file
/// Several files as one scene.

#include "tools/common/run.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <span>
#include <string>

namespace tools {

struct scene_input {
    std::string path{};
    const tf::mesh_file* file = nullptr;
};

/// All together, with the parts of their files, what their corners have, its materials and
/// textures. Other properties are left out. A file of one part is known by its name.
[[nodiscard]] tf::mesh_file scene_of(job& work, std::span<const scene_input> inputs,
                                     const std::string& format);

}  // namespace tools
