#pragma once
/// \file
/// The reader of each format, all of which throw io_error; and what those of scenes share.

#include <libmesh/io/source.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tree/aabb.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace treeform::detail::io {

[[nodiscard]] mesh_file read_stl_binary(const source& in);
[[nodiscard]] mesh_file read_stl_text(const source& in);
/// `path` is empty for bytes that have none; then material files cannot be found.
[[nodiscard]] mesh_file read_obj(const source& in, const std::filesystem::path& path);
[[nodiscard]] mesh_file read_ply(const source& in);
[[nodiscard]] mesh_file read_off(const source& in);
[[nodiscard]] mesh_file read_pcd(const source& in);
/// LAS and LAZ.
[[nodiscard]] mesh_file read_las(const source& in);
[[nodiscard]] mesh_file read_3mf(const source& in);
/// glTF 2.0 and GLB. `path` is empty for bytes in memory, which cannot refer to files.
[[nodiscard]] mesh_file read_gltf(const source& in, const std::filesystem::path& path);
/// `format` is "xyz" or "csv", which are read the same way, or "pts", which may begin with a count.
[[nodiscard]] mesh_file read_xyz(const source& in, std::string_view format,
                                 std::span<const std::pair<std::string, std::string>> columns = {});

/// Whether assimp can read files with this extension (without a dot).
[[nodiscard]] bool scene_format(std::string_view extension);
/// Reads a scene by assimp, also glTF 1.0. `path` is empty for bytes in memory, which cannot refer
/// to files.
[[nodiscard]] mesh_file read_scene(const source& in, const std::filesystem::path& path,
                                   std::string_view extension);

/// Makes names unique, since parts with the same name would be one part. The second "gear" becomes
/// "gear (2)".
class name_giver {
  public:
    [[nodiscard]] std::string name(const std::string& wanted) {
        if (taken_.insert(wanted).second) return wanted;
        for (;;) {
            std::string other = wanted + " (" + std::to_string(++times_[wanted] + 1) + ")";
            if (taken_.insert(other).second) return other;
        }
    }

  private:
    std::unordered_set<std::string> taken_{};
    std::unordered_map<std::string, std::size_t> times_{};
};

/// The image of a point, which the identity leaves as it is, -0 included.
[[nodiscard]] inline point3 moved(const transform<3>& by, const point3& p) {
    return by == transform<3>{} ? p : by(p);
}

/// Appends the faces of one of several meshes, whose points come from number `first` on; turned
/// over where a mirror has moved them.
inline void append_faces(std::vector<face>& to, std::span<const face> faces, std::uint32_t first,
                         bool turned) {
    for (const face& f : faces)
        to.push_back({first + f[0], first + f[turned ? 2 : 1], first + f[turned ? 1 : 2]});
}

}  // namespace treeform::detail::io
