#pragma once
/// \file
/// The header of a PCD file, and the positions of values in its data.

#include <libmesh/io/source.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace treeform::detail::io {

enum class pcd_encoding : std::uint8_t { ascii, binary, compressed };

/// "pcd-ascii", ...
[[nodiscard]] constexpr std::string_view name_of(pcd_encoding encoding) {
    constexpr std::string_view names[] = {"pcd-ascii", "pcd-binary", "pcd-binary-compressed"};
    return names[static_cast<std::size_t>(encoding)];
}

/// "F4", "U1", ...
[[nodiscard]] inline std::string type_and_size(scalar_type type) {
    return with_type(type, []<class T>(T) {
        const char kind = std::is_floating_point_v<T> ? 'F' : std::is_signed_v<T> ? 'I' : 'U';
        return kind + std::to_string(sizeof(T));
    });
}

/// The position of a column's value in its row; and in a compressed file, in which the values of
/// each field are contiguous: earlier fields have `fields_ahead` bytes for each point.
struct pcd_place {
    std::size_t in_row = 0;
    std::size_t fields_ahead = 0;
    std::size_t in_field = 0;
    std::size_t field_size = 0;
};

/// A field of COUNT n is n columns, "name[0]" to "name[n-1]". Fields named "_" are padding, and
/// columns only in text files.
struct pcd_header {
    pcd_encoding encoding = pcd_encoding::ascii;
    element vertices{.name = "vertex"};  ///< one row for each point; columns without values
    std::vector<pcd_place> places{};     ///< [columns]
    std::size_t row_size = 0;            ///< in bytes, with padding
    /// Comments; WIDTH, HEIGHT and VIEWPOINT as obj_info "num_cols", "num_rows", "viewpoint",
    /// unless they have their default meaning.
    attributes remarks{};
    const char* body = nullptr;  ///< first byte after the header
};

/// \throws io_error
[[nodiscard]] pcd_header read_pcd_header(const source& in);

/// The compressed points of a file, field by field.
struct packed_pcd {
    std::string_view bytes{};
    std::size_t size = 0;  ///< unpacked size in bytes
    bool has_bytes_behind = false;

    [[noreturn]] void fail_damaged(const source& in) const {
        in.fail_byte(bytes.data(), "the packed data are damaged");
    }
};

/// \pre    the file is compressed
/// \throws io_error if the lengths do not match the points or the file
[[nodiscard]] packed_pcd find_packed_pcd(const source& in, const pcd_header& header);

}  // namespace treeform::detail::io
