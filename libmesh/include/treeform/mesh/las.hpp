#pragma once
/// \file
/// What a LAS or LAZ file has besides its points: how coordinates are stored, and its records.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace treeform {

/// A variable length record, plain or extended, such as one that names a coordinate system.
struct las_record {
    std::string user_id{};  ///< "LASF_Projection"; at most 16 bytes, with what stands behind a zero
    std::uint16_t record_id = 0;
    std::string description{};  ///< at most 32 bytes, likewise
    std::uint16_t reserved = 0;
    std::vector<std::byte> data{};
    friend bool operator==(const las_record&, const las_record&) = default;
};

/// The header of a LAS file, and its records. A file is written with the header that was read: with
/// its version, point data format, scale and offset; counts and bounds are those of the points.
///
/// Dimensions of points are columns of the element "vertex": intensity, return_number,
/// number_of_returns, scan_direction_flag, edge_of_flight_line, classification, synthetic,
/// key_point, withheld, overlap, scanner_channel, scan_angle_rank (formats 0 to 5), scan_angle (6 to
/// 10), user_data, point_source_id, gps_time, red, green, blue, nir, wave_packet_index,
/// wave_packet_offset, wave_packet_size, wave_return_location, wave_x, wave_y, wave_z. Extra bytes
/// are columns with the names and types that their record gives them, in the integers that are
/// stored: neither scaled nor shifted. Those that no record describes are "extra_bytes[0]" and so on.
struct las_header {
    std::uint8_t version_minor = 2;  ///< of 1.0 to 1.4
    std::uint8_t point_format = 0;   ///< 0 to 10
    /// Coordinates are (X * scale) + offset for whole numbers X of 32 bits, the product rounded to a
    /// double, then the sum.
    std::array<double, 3> scale{0.001, 0.001, 0.001};
    std::array<double, 3> offset{};
    /// The header block as in the file, with what a version or program has added to it; empty when
    /// there was no file.
    std::vector<std::byte> block{};
    std::vector<las_record> records{};
    std::vector<std::byte> behind_records{};  ///< up to the first point
    std::vector<las_record> extended_records{};
    friend bool operator==(const las_header&, const las_header&) = default;
};

}  // namespace treeform
