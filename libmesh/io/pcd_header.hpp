#pragma once
/// \file
/// The text ahead of a PCD file's data, and where each value stands in it.

#include <libmesh/io/source.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

enum class pcd_encoding : std::uint8_t { ascii, binary, compressed };

/// "pcd-ascii", ...
[[nodiscard]] std::string_view name_of(pcd_encoding encoding);

/// Where the value of a column stands in its row, and in the blocks of a compressed file, where the
/// values of a field follow one another: `fields_ahead` bytes a point are those of earlier fields.
struct pcd_place {
    std::size_t in_row = 0;
    std::size_t fields_ahead = 0;
    std::size_t in_field = 0;
    std::size_t field_size = 0;
};

/// A field of COUNT n is n columns, "name[0]" to "name[n-1]". Fields called "_" are padding and no
/// columns, but in text.
struct pcd_header {
    pcd_encoding encoding = pcd_encoding::ascii;
    element vertices{.name = "vertex"};  ///< a row a point; columns without values
    std::vector<pcd_place> places{};     ///< [columns]
    std::size_t row_size = 0;            ///< bytes, with padding
    /// Comments; WIDTH, HEIGHT and VIEWPOINT as obj_info "num_cols", "num_rows", "viewpoint" where
    /// they say more than that there are points.
    attributes remarks{};
    const char* body = nullptr;  ///< first byte after the header
};

/// \throws io_error
[[nodiscard]] pcd_header read_pcd_header(const source& in);

/// The points of a compressed file, field by field.
struct packed_pcd {
    std::string_view bytes{};
    std::size_t size = 0;  ///< unpacked
    bool has_bytes_behind = false;

    [[noreturn]] void fail_damaged(const source& in) const {
        in.fail_byte(bytes.data(), "the packed data are damaged");
    }
};

/// \pre    a compressed file
/// \throws io_error where the lengths are not those of the points, or of what is there
[[nodiscard]] packed_pcd find_packed_pcd(const source& in, const pcd_header& header);

}  // namespace treeform::detail::io
