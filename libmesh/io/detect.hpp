#pragma once
/// \file
/// Which format an input has: by its content, then by its name.

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
    pts,  ///< as xyz, with the number of points first
    csv,
    package_3mf,
    gltf,  ///< or GLB
    scene
};

struct detected {
    file_kind kind = file_kind::scene;
    std::string extension{};  ///< in lower case, without its dot; what `read_scene` goes by
};

/// `format` is what the caller asks for and `extension` that of the name; both in lower case
/// without a dot, both may be empty.
///
/// \throws io_error when the content cannot be of any format that is read
[[nodiscard]] detected detect(const source& in, std::string_view format,
                              std::string_view extension);

/// \throws io_error for columns chosen of what is no table of text
void check_chosen_columns(const source& in, const reading& how, file_kind kind);

}  // namespace treeform::detail::io
