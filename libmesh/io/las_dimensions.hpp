#pragma once
/// \file
/// Where each value stands in a LAS point record.
///
/// \source LAS Specification 1.4 R15, ASPRS (2019), "Point Data Record Formats"

#include <treeform/mesh/attributes.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

/// How the stored numbers of extra bytes stand for values.
struct las_scaling {
    double scale = 1.0;
    double offset = 0.0;
    std::optional<double> no_data{};  ///< the stored number of those that have no value

    friend bool operator==(const las_scaling&, const las_scaling&) = default;
};

struct las_dimension {
    std::string name{};
    scalar_type type = scalar_type::uint8;
    std::size_t byte = 0;  ///< where it begins in the record
    unsigned shift = 0;    ///< of values that share a byte
    unsigned bits = 0;     ///< of these; 0: the whole of `type`
    /// Of extra bytes with a scale or an offset. Their columns hold the values, as doubles.
    std::optional<las_scaling> scaling{};

    [[nodiscard]] scalar_type column_type() const { return scaling ? scalar_type::float64 : type; }

    friend bool operator==(const las_dimension&, const las_dimension&) = default;
};

/// What of a point there can be besides what all formats have.
struct las_features {
    bool gps_time = false;
    bool color = false;
    bool infrared = false;
    bool wave_packet = false;
    bool extended = false;  ///< more than 7 returns, classes above 31, scanner channels, ...
};

/// The smallest format with all of these.
[[nodiscard]] unsigned las_format_of(const las_features& features);
[[nodiscard]] las_features features_of(unsigned format);

/// Bytes of a record without extra ones.
[[nodiscard]] std::size_t las_record_size(unsigned format);

/// What the records of a format have behind X, Y and Z, in the order of the record.
[[nodiscard]] std::vector<las_dimension> las_dimensions(unsigned format);

/// Extra bytes as their record ("LASF_Spec", 4) describes them, in 192 bytes each; those that it
/// does not describe come last. Names are unique, and have underscores for blanks.
[[nodiscard]] std::vector<las_dimension> extra_dimensions(std::span<const std::byte> descriptions,
                                                          std::size_t first, std::size_t bytes);

/// The name of the column of an extra byte that is not described.
[[nodiscard]] std::string undescribed_name(std::size_t i);

/// Dimensions that one description stands for: a number, or several of one type.
struct extra_group {
    std::vector<std::byte> description{};  ///< 192 bytes
    std::vector<las_dimension> values{};
};

/// What of `bytes` extra bytes their record describes.
[[nodiscard]] std::vector<extra_group> extra_groups(std::span<const std::byte> descriptions,
                                                    std::size_t first, std::size_t bytes);

/// The 192 bytes that describe a dimension.
[[nodiscard]] std::vector<std::byte> describe_extra(std::string_view name, scalar_type type);

}  // namespace treeform::detail::io
