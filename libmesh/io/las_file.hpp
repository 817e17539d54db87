#pragma once
/// \file
/// The blocks of a LAS or LAZ file: header, records, points, extended records.
///
/// \source LAS Specification 1.4 R15, ASPRS (2019)

#include <libmesh/io/las_dimensions.hpp>
#include <libmesh/io/source.hpp>
#include <libmesh/laz/chunk.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::io {

/// The compression of the points by LASzip, from its record ("laszip encoded", 22204).
struct las_packing {
    bool chunked = true;           ///< if false, all points are one chunk, without a table
    std::uint32_t chunk_size = 0;  ///< in points; 0xffffffff: sizes vary
    std::vector<laz::item> items{};
    [[nodiscard]] bool sizes_vary() const { return chunk_size == 0xffffffffu; }
};

struct las_file {
    las_header header{};
    std::size_t record_size = 0;
    std::uint64_t count = 0;                  ///< points
    std::vector<las_dimension> dimensions{};  ///< dimensions of the record, extra bytes included
    std::uint64_t first_point = 0;            ///< byte of the file at which the points begin
    std::optional<las_packing> packing{};     ///< none: plain records
};

/// Reads everything except the points. Irregularities that do not affect points are warnings: a
/// wrong number of records, records that overlap the points.
///
/// \throws io_error
[[nodiscard]] las_file open_las(const source& in, std::vector<io_warning>& warnings);

}  // namespace treeform::detail::io
