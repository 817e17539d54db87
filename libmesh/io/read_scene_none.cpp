#include <libmesh/io/detail/readers.hpp>
#include <libmesh/io/read.hpp>

#include <string>

namespace tf::detail {

bool scene_format(std::string_view) { return false; }

mesh_file read_scene(const source& in, const std::filesystem::path&, std::string_view extension) {
    in.fail("format '" + std::string(extension) + "' needs a build with assimp");
}

}  // namespace tf::detail

bool tf::reads_scenes() { return false; }
