#pragma once
/// \file
/// Detects the format of an input, by its content, then by its name.

#include <libmesh/io/reading.hpp>
#include <libmesh/io/source.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace treeform::detail::io {

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

/// \throws io_error if columns are chosen, but the file is not a text table
void check_chosen_columns(const source& in, const reading& how, file_kind kind);

}  // namespace treeform::detail::io
