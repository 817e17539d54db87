#pragma once
/// \file
/// The reader of each format. All of them throw io_error.

#include <libmesh/io/source.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace treeform::detail::io {

[[nodiscard]] mesh_file read_stl_binary(const source& in);
[[nodiscard]] mesh_file read_stl_text(const source& in);
[[nodiscard]] mesh_file read_obj(const source& in);
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

}  // namespace treeform::detail::io
