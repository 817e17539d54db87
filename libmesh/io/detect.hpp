#pragma once
/// \file
/// Detects the format of an input, by its content, then by its name.

#include <libmesh/io/number.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace treeform::detail::io {

/// `format` is an extension without its dot, or empty.
struct reading {
    std::string format{};
    read_options options{};
};

enum class file_kind : std::uint8_t {
    stl_binary,
    stl_text,
    obj,
    ply,
    off,
    pcd,
    las,  ///< or LAZ
    xyz,
    pts,  ///< like xyz, but begins with the number of points
    csv,
    package_3mf,
    gltf,  ///< or GLB
    scene
};

struct detected {
    file_kind kind = file_kind::scene;
    std::string extension{};  ///< in lower case, without its dot; for `read_scene`
};

/// `format` is the one requested, `extension` that of the name; both in lower case without a dot,
/// or empty.
///
/// \throws io_error if the content has no supported format
[[nodiscard]] detected detect(const source& in, std::string_view format,
                              std::string_view extension);

/// "xyz", "pts" or "csv"; empty for what is no table of text.
[[nodiscard]] std::string_view table_name(file_kind kind);

/// \throws io_error if columns are chosen, but the file is not a text table
void check_chosen_columns(const source& in, const reading& how, file_kind kind);

/// In lower case and without its dot.
[[nodiscard]] inline std::string plain_extension(std::string_view extension) {
    if (extension.starts_with('.')) extension.remove_prefix(1);
    std::string plain(extension);
    std::transform(plain.begin(), plain.end(), plain.begin(), to_lower);
    return plain;
}

[[nodiscard]] inline std::string extension_of(const std::filesystem::path& path) {
    return plain_extension(path.extension().string());
}

}  // namespace treeform::detail::io
