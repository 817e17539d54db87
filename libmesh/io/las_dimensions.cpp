#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/las_dimensions.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <utility>

namespace treeform::detail::io {

namespace {

constexpr std::size_t description_size = 192;

/// Types of extra bytes from 1 on. From 11 on they are pairs of these, from 21 on triples.
constexpr std::array extra_types{scalar_type::uint8,  scalar_type::int8,   scalar_type::uint16,
                                 scalar_type::int16,  scalar_type::uint32, scalar_type::int32,
                                 scalar_type::uint64, scalar_type::int64,  scalar_type::float32,
                                 scalar_type::float64};

/// Dimensions one behind the other.
class packed_dimensions {
  public:
    packed_dimensions(std::vector<las_dimension>& to, std::size_t first) : to_(to), at_(first) {}

    void add(std::string name, scalar_type type) {
        to_.push_back({.name = std::move(name), .type = type, .byte = at_});
        at_ += size_of(type);
    }
    /// Values of a byte, from its lowest bit on.
    void add_bits(std::initializer_list<std::pair<const char*, unsigned>> parts) {
        unsigned shift = 0;
        for (const auto& [name, bits] : parts) {
            to_.push_back({name, scalar_type::uint8, at_, shift, bits});
            shift += bits;
        }
        ++at_;
    }
    [[nodiscard]] std::size_t at() const { return at_; }

  private:
    std::vector<las_dimension>& to_;
    std::size_t at_;
};

void add_legacy(packed_dimensions& to) {
    to.add("intensity", scalar_type::uint16);
    to.add_bits({{"return_number", 3},
                 {"number_of_returns", 3},
                 {"scan_direction_flag", 1},
                 {"edge_of_flight_line", 1}});
    to.add_bits({{"classification", 5}, {"synthetic", 1}, {"key_point", 1}, {"withheld", 1}});
    to.add("scan_angle_rank", scalar_type::int8);
    to.add("user_data", scalar_type::uint8);
    to.add("point_source_id", scalar_type::uint16);
}

void add_extended(packed_dimensions& to) {
    to.add("intensity", scalar_type::uint16);
    to.add_bits({{"return_number", 4}, {"number_of_returns", 4}});
    to.add_bits({{"synthetic", 1},
                 {"key_point", 1},
                 {"withheld", 1},
                 {"overlap", 1},
                 {"scanner_channel", 2},
                 {"scan_direction_flag", 1},
                 {"edge_of_flight_line", 1}});
    to.add("classification", scalar_type::uint8);
    to.add("user_data", scalar_type::uint8);
    to.add("scan_angle", scalar_type::int16);
    to.add("point_source_id", scalar_type::uint16);
}

void add_wave_packet(packed_dimensions& to) {
    to.add("wave_packet_index", scalar_type::uint8);
    to.add("wave_packet_offset", scalar_type::uint64);
    to.add("wave_packet_size", scalar_type::uint32);
    for (const char* name : {"wave_return_location", "wave_x", "wave_y", "wave_z"})
        to.add(name, scalar_type::float32);
}

[[nodiscard]] std::string name_in(std::span<const std::byte> description) {
    std::string name;
    for (const std::byte b : description.subspan(4, 32)) {
        if (b == std::byte{0}) break;
        const auto c = static_cast<char>(b);
        name += std::isspace(static_cast<unsigned char>(c)) != 0 ? '_' : c;
    }
    return name.empty() ? "extra" : name;
}

/// The number that stands for "no value", in the widest type of its kind.
[[nodiscard]] double no_data_in(const char* at, scalar_type type) {
    using base::load;
    if (type >= scalar_type::float32) return load<double, std::endian::little>(at);
    const bool is_signed = with_type(type, []<class T>(T) { return std::is_signed_v<T>; });
    return is_signed ? static_cast<double>(load<std::int64_t, std::endian::little>(at))
                     : static_cast<double>(load<std::uint64_t, std::endian::little>(at));
}

/// Of the value `i` of a description.
[[nodiscard]] std::optional<las_scaling> scaling_in(std::span<const std::byte> description,
                                                    scalar_type type, std::size_t i) {
    enum : unsigned { has_no_data = 1, has_scale = 8, has_offset = 16 };
    const auto options = std::to_integer<unsigned>(description[3]);
    const auto* const bytes = reinterpret_cast<const char*>(description.data());
    const auto number = [&](std::size_t at) {
        return base::load<double, std::endian::little>(bytes + at + 8 * i);
    };
    las_scaling s;
    if ((options & has_scale) != 0) s.scale = number(112);
    if ((options & has_offset) != 0) s.offset = number(136);
    const bool usable = std::isfinite(s.scale) && s.scale != 0.0 && std::isfinite(s.offset);
    if (!usable || (s.scale == 1.0 && s.offset == 0.0)) return std::nullopt;
    if ((options & has_no_data) != 0) s.no_data = no_data_in(bytes + 40 + 8 * i, type);
    return s;
}

/// `name`, or with a number behind it what is none of the names of `groups`.
[[nodiscard]] std::string unique_name(const std::vector<extra_group>& groups,
                                      const std::string& name) {
    const auto is_taken = [&](const std::string& wanted) {
        return std::ranges::any_of(groups, [&](const extra_group& g) {
            return std::ranges::count(g.values, wanted, &las_dimension::name) > 0;
        });
    };
    std::string unique = name;
    for (int k = 2; is_taken(unique); ++k) unique = name + '_' + std::to_string(k);
    return unique;
}

/// Some records one behind the other: what the loops below go over.
struct record_run {
    const char* first = nullptr;
    std::size_t size = 0;
    std::size_t count = 0;
};

void read_axes(point3* points, const record_run& from, const las_grid& grid) {
    for (std::size_t i = 0; i < from.count; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            points[i][axis] = grid.coordinate(axis, base::load<std::int32_t, std::endian::little>(
                                                        from.first + i * from.size + 4 * axis));
}

/// As whole numbers of that size, so that no bit of a float changes on its way.
template <class T>
void read_values(std::byte* to, const record_run& from, std::size_t byte) {
    for (std::size_t i = 0; i < from.count; ++i) {
        const T bits = base::load<T, std::endian::little>(from.first + i * from.size + byte);
        std::memcpy(to + i * sizeof(T), &bits, sizeof(T));
    }
}

void read_bits(std::byte* to, const record_run& from, const las_dimension& d) {
    const unsigned mask = (1u << d.bits) - 1;
    for (std::size_t i = 0; i < from.count; ++i) {
        const auto byte = static_cast<unsigned char>(from.first[i * from.size + d.byte]);
        to[i] = static_cast<std::byte>(byte >> d.shift & mask);
    }
}

/// The product is rounded, then the sum; compiled without floating-point contraction.
void read_scaled(std::byte* to, const record_run& from, const las_dimension& d) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    with_type(d.type, [&]<class T>(T) {
        for (std::size_t i = 0; i < from.count; ++i) {
            const auto stored = static_cast<double>(
                base::load<T, std::endian::little>(from.first + i * from.size + d.byte));
            const double product = stored * d.scaling->scale;
            const double value = stored == d.scaling->no_data ? nan : product + d.scaling->offset;
            std::memcpy(to + i * sizeof value, &value, sizeof value);
        }
    });
}

void read_dimension(std::byte* to, const record_run& from, const las_dimension& d) {
    if (d.bits > 0) return read_bits(to, from, d);
    if (d.scaling) return read_scaled(to, from, d);
    with_bits(d.type, [&]<class T>(T) { read_values<T>(to, from, d.byte); });
}

}  // namespace

las_features features_of(unsigned format) {
    return {.gps_time = format == 1 || format >= 3,
            .color = format == 2 || format == 3 || format == 5 || format == 7 || format == 8 ||
                     format == 10,
            .infrared = format == 8 || format == 10,
            .wave_packet = format == 4 || format == 5 || format >= 9,
            .extended = format >= 6};
}

unsigned las_format_of(const las_features& f) {
    if (f.extended || f.infrared) {
        if (f.wave_packet) return f.color || f.infrared ? 10 : 9;
        return f.infrared ? 8 : f.color ? 7 : 6;
    }
    if (f.wave_packet) return f.color ? 5 : 4;
    return (f.gps_time ? 1u : 0u) + (f.color ? 2u : 0u);
}

std::vector<las_dimension> las_dimensions(unsigned format) {
    std::vector<las_dimension> dimensions;
    packed_dimensions to(dimensions, 12);
    const las_features has = features_of(format);
    has.extended ? add_extended(to) : add_legacy(to);
    if (has.gps_time) to.add("gps_time", scalar_type::float64);
    if (has.color)
        for (const char* name : {"red", "green", "blue"}) to.add(name, scalar_type::uint16);
    if (has.infrared) to.add("nir", scalar_type::uint16);
    if (has.wave_packet) add_wave_packet(to);
    return dimensions;
}

std::size_t las_record_size(unsigned format) {
    const auto dimensions = las_dimensions(format);
    return dimensions.back().byte + size_of(dimensions.back().type);
}

std::vector<extra_group> extra_groups(std::span<const std::byte> descriptions, std::size_t first,
                                      std::size_t bytes) {
    std::vector<extra_group> groups;
    std::size_t at = first;
    for (; descriptions.size() >= description_size;
         descriptions = descriptions.subspan(description_size)) {
        const auto type = std::to_integer<unsigned>(descriptions[2]);
        if (type > 3 * extra_types.size()) break;
        const std::size_t count = type == 0 ? std::to_integer<std::size_t>(descriptions[3])
                                            : (type - 1) / extra_types.size() + 1;
        const scalar_type scalar =
            type == 0 ? scalar_type::uint8 : extra_types[(type - 1) % extra_types.size()];
        if (count * size_of(scalar) > first + bytes - at) break;
        const std::string name = name_in(descriptions);
        extra_group group;
        const auto description = descriptions.first(description_size);
        group.description.assign(description.begin(), description.end());
        for (std::size_t i = 0; i < count; ++i) {
            const bool one = type > 0 && count == 1;
            const std::string full = one ? name : name + '[' + std::to_string(i) + ']';
            group.values.push_back({.name = unique_name(groups, full), .type = scalar, .byte = at});
            if (type > 0 && i < 3) group.values.back().scaling = scaling_in(description, scalar, i);
            at += size_of(scalar);
        }
        groups.push_back(std::move(group));
    }
    return groups;
}

std::vector<las_dimension> extra_dimensions(std::span<const std::byte> descriptions,
                                            std::size_t first, std::size_t bytes) {
    std::vector<las_dimension> dimensions;
    std::size_t at = first;
    for (extra_group& group : extra_groups(descriptions, first, bytes))
        for (las_dimension& d : group.values) {
            at += size_of(d.type);
            dimensions.push_back(std::move(d));
        }
    packed_dimensions rest(dimensions, at);
    for (std::size_t i = 0; rest.at() < first + bytes; ++i)
        rest.add(undescribed_name(i), scalar_type::uint8);
    return dimensions;
}

std::string undescribed_name(std::size_t i) { return "extra_bytes[" + std::to_string(i) + ']'; }

std::vector<std::byte> describe_extra(std::string_view name, scalar_type type) {
    std::vector<std::byte> description(description_size);
    const auto* const found = std::find(extra_types.begin(), extra_types.end(), type);
    description[2] = static_cast<std::byte>(found - extra_types.begin() + 1);
    for (std::size_t i = 0; i < std::min<std::size_t>(name.size(), 32); ++i)
        description[4 + i] = static_cast<std::byte>(name[i]);
    return description;
}

element las_columns(std::span<const las_dimension> dimensions) {
    element vertices{.name = "vertex"};
    for (std::size_t axis = 0; axis < 3; ++axis)
        vertices.columns.push_back({.name = std::string(1, "xyz"[axis]),
                                    .type = scalar_type::float64,
                                    .role = role_of_axis(axis)});
    for (const las_dimension& d : dimensions)
        vertices.columns.push_back({.name = d.name, .type = d.column_type()});
    return vertices;
}

void append_las_rows(element& vertices, std::vector<point3>& points, std::size_t rows,
                     const char* first, std::size_t record_size, const las_grid& grid,
                     std::span<const las_dimension> dimensions) {
    const std::size_t before = points.size();
    points.resize(before + rows);
    const std::span<column> data = std::span(vertices.columns).subspan(3);
    std::vector<std::byte*> to(dimensions.size());
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
        std::vector<std::byte>& values = data[d].values;
        const std::size_t size = values.size();
        values.resize(size + rows * size_of(dimensions[d].column_type()));
        to[d] = values.data() + size;
    }
    // A column at a time, over what the first cache holds.
    constexpr std::size_t at_once = 512;
    for_chunks(rows, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t at = begin; at < end; at += at_once) {
            const record_run run{first + at * record_size, record_size,
                                 std::min(at_once, end - at)};
            read_axes(points.data() + before + at, run, grid);
            for (std::size_t d = 0; d < dimensions.size(); ++d)
                read_dimension(to[d] + at * size_of(dimensions[d].column_type()), run,
                               dimensions[d]);
        }
    });
}

}  // namespace treeform::detail::io
