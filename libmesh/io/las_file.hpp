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

/// How LASzip has packed the points, by its record ("laszip encoded", 22204).
struct las_packing {
    bool chunked = true;           ///< else all points are one chunk, and there is no table
    std::uint32_t chunk_size = 0;  ///< points; the largest number: sizes vary
    std::vector<laz::item> items{};
    [[nodiscard]] bool sizes_vary() const { return chunk_size == 0xffffffffu; }
};

struct las_file {
    las_header header{};
    std::size_t record_size = 0;
    std::uint64_t count = 0;                  ///< points
    std::vector<las_dimension> dimensions{};  ///< of the record, extra bytes included
    std::uint64_t first_point = 0;            ///< byte of the file
    std::optional<las_packing> packing{};     ///< none: plain records
};

/// Reads everything but the points. What is odd but says nothing of points is a warning: a wrong
/// number of records, records that end behind the points begin.
///
/// \throws io_error
[[nodiscard]] las_file open_las(const source& in, std::vector<io_warning>& warnings);

}  // namespace treeform::detail::io
