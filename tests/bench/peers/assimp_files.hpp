#pragma once
/// \file
/// Files through assimp.

#include "bench/peers/file_kind.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <functional>
#include <memory>
#include <string>

namespace Assimp {
class Importer;
}

namespace treeform::bench {

/// A file as assimp reads it, with no step of post-processing: corners are not joined.
using assimp_scene = std::shared_ptr<const Assimp::Importer>;
[[nodiscard]] assimp_scene assimp_read(const std::string& path);
[[nodiscard]] tf::mesh mesh_of(const assimp_scene& scene);

/// Writes `mesh`, which is converted before, to `path`.
[[nodiscard]] std::function<void()> assimp_writer(const tf::mesh& mesh, const std::string& path,
                                                  const file_kind& kind);

}  // namespace treeform::bench
