#pragma once
/// \file
/// The blocks of a LAS or LAZ file, and where each value stands in its point records.
///
/// \source LAS Specification 1.4 R15, ASPRS (2019), "Point Data Record Formats"

#include <libmesh/io/source.hpp>
#include <libmesh/laz/chunk.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

/// The conversion of stored numbers of extra bytes to values.
struct las_scaling {
    double scale = 1.0;
    double offset = 0.0;
    std::optional<double> no_data{};  ///< the stored number that means "no data"

    friend bool operator==(const las_scaling&, const las_scaling&) = default;
};

struct las_dimension {
    std::string name{};
    scalar_type type = scalar_type::uint8;
    std::size_t byte = 0;  ///< position in the record
    unsigned shift = 0;    ///< for values that share a byte
    unsigned bits = 0;     ///< the number of bits of these; 0: all of `type`
    /// For extra bytes with a scale or an offset, whose columns have the scaled values as doubles.
    std::optional<las_scaling> scaling{};

    [[nodiscard]] scalar_type column_type() const { return scaling ? scalar_type::float64 : type; }

    friend bool operator==(const las_dimension&, const las_dimension&) = default;
};

/// Optional data of points, which not all formats have.
struct las_features {
    bool gps_time = false;
    bool color = false;
    bool infrared = false;
    bool wave_packet = false;
    bool extended = false;  ///< more than 7 returns, classes above 31, scanner channels, ...
};

/// The smallest point format with all of these.
[[nodiscard]] unsigned las_format_of(const las_features& features);
[[nodiscard]] las_features features_of(unsigned format);

/// Size of a record in bytes, without extra bytes.
[[nodiscard]] std::size_t las_record_size(unsigned format);

/// The dimensions of a format after X, Y and Z, in the order of the record.
[[nodiscard]] std::vector<las_dimension> las_dimensions(unsigned format);

/// The extra bytes, as described by their record ("LASF_Spec", 4) in 192 bytes each; those without
/// a description come last. Names are unique, with underscores for blanks.
[[nodiscard]] std::vector<las_dimension> extra_dimensions(std::span<const std::byte> descriptions,
                                                          std::size_t first, std::size_t bytes);

/// The column name of an extra byte without a description.
[[nodiscard]] std::string undescribed_name(std::size_t i);

/// The dimensions of one description: one number, or several of one type.
struct extra_group {
    std::vector<std::byte> description{};  ///< 192 bytes
    std::vector<las_dimension> values{};
};

/// The descriptions of `bytes` extra bytes, with their dimensions.
[[nodiscard]] std::vector<extra_group> extra_groups(std::span<const std::byte> descriptions,
                                                    std::size_t first, std::size_t bytes);

/// The 192 bytes that describe a dimension.
[[nodiscard]] std::vector<std::byte> describe_extra(std::string_view name, scalar_type type);

/// The conversion of stored integers to coordinates.
struct las_grid {
    std::array<double, 3> scale{};
    std::array<double, 3> offset{};

    /// The product is rounded, then the sum; compiled without floating-point contraction.
    [[nodiscard]] double coordinate(std::size_t axis, std::int32_t x) const {
        const double product = static_cast<double>(x) * scale[axis];
        return product + offset[axis];
    }
};

/// The columns of the element "vertex": the axes, then the dimensions.
[[nodiscard]] element las_columns(std::span<const las_dimension> dimensions);

/// Appends `rows` consecutive records from `first` on, in parallel.
void append_las_rows(element& vertices, std::vector<point3>& points, std::size_t rows,
                     const char* first, std::size_t record_size, const las_grid& grid,
                     std::span<const las_dimension> dimensions);

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
