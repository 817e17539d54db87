#pragma once
/// \file
/// The header of a PLY file.

#include <libmesh/io/source.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

enum class ply_encoding : std::uint8_t { ascii, little_endian, big_endian };

/// As in the file, by `ply_encoding`.
inline constexpr std::array<std::string_view, 3> ply_encodings{"ascii", "binary_little_endian",
                                                               "binary_big_endian"};
[[nodiscard]] std::string_view name_of(scalar_type type);  ///< as in the file: "uchar"

/// After "comment": the name of a texture file follows.
constexpr std::string_view texture_file_keyword = "TextureFile";

struct ply_header {
    ply_encoding encoding = ply_encoding::ascii;
    /// The declared elements, with rows and columns, without values. The columns of coordinates and
    /// corners have their roles.
    std::vector<element> elements{};
    std::vector<std::string> texture_files{};
    std::vector<std::string> comments{};  ///< except for lines of texture files
    std::vector<std::string> obj_info{};
    const char* body = nullptr;  ///< first byte after the header
};

/// \throws io_error
[[nodiscard]] ply_header read_ply_header(const source& in);

/// The usual name of the list, which has u and v of each corner.
inline constexpr std::string_view face_texture_name = "texcoord";

/// Moves the values of that list to `attributes::corners`; the column keeps its position, with
/// `column_role::texture`. Consecutive equal values at corners of a point become one row.
///
/// Changes nothing if a list is neither empty nor two numbers a corner, or if writing it again
/// would give other bytes.
void take_face_texture(mesh_file& file);

}  // namespace treeform::detail::io
