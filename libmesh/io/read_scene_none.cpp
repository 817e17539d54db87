#include <libmesh/io/readers.hpp>
#include <treeform/mesh/read.hpp>

#include <string>

namespace treeform::detail::io {

bool scene_format(std::string_view) { return false; }

mesh_file read_scene(const source& in, const std::filesystem::path&, std::string_view extension) {
    in.fail("format '" + std::string(extension) + "' needs a build with assimp");
}

}  // namespace treeform::detail::io

bool treeform::reads_scenes() { return false; }
