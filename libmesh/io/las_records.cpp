#include <libmesh/base/byte_order.hpp>
#include <libmesh/base/words.hpp>
#include <libmesh/io/las_plan.hpp>
#include <libmesh/io/number.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace treeform::detail::io {

namespace {

constexpr auto nobody = std::numeric_limits<std::size_t>::max();

/// The first point of a chunk that cannot be stored, and why; and what changes of the others.
struct chunk_fault {
    std::size_t point = nobody;
    std::string reason{};
    las_changes changes{};

    void at(std::size_t i, const std::string& why) {
        if (i >= point) return;
        point = i;
        reason = why;
    }
};

[[nodiscard]] std::string too_large(const column& c, double value) {
    return "a value of " + c.name + " is out of range for its LAS field: " + std::to_string(value);
}

void put_axes(std::span<const point3> points, const record_rows& rows, const las_grid& grid,
              chunk_fault& fault) {
    for (std::size_t i = 0; i < rows.count; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = points[rows.first + i][axis];
            if (!std::isfinite(x)) {
                fault.at(rows.first + i, "a coordinate is not finite, which LAS cannot hold");
                continue;
            }
            const double step = nearest_step(grid, axis, x);
            if (!is_las_step(step)) {
                fault.at(rows.first + i, "a coordinate needs more than 32 bits at this scale");
                continue;
            }
            const double by = grid.coordinate(axis, static_cast<std::int32_t>(step)) - x;
            fault.changes.moved = std::max(fault.changes.moved, std::abs(by));
            base::store<std::endian::little>(
                reinterpret_cast<char*>(rows.to + i * rows.size + 4 * axis),
                static_cast<std::int32_t>(step));
        }
    }
}

template <class T>
void put_same(const column& c, const record_rows& rows, std::size_t byte) {
    for (std::size_t i = 0; i < rows.count; ++i) {
        T bits;
        std::memcpy(&bits, c.values.data() + (rows.first + i) * sizeof(T), sizeof(T));
        base::store<std::endian::little>(reinterpret_cast<char*>(rows.to + i * rows.size + byte),
                                         bits);
    }
}

/// Bytes that are a part of a byte in the record.
void put_bytes_as_bits(const column& c, const record_rows& rows, const las_dimension& d,
                       chunk_fault& fault) {
    const unsigned most = (1u << d.bits) - 1;
    for (std::size_t i = 0; i < rows.count; ++i) {
        const auto value = std::to_integer<unsigned>(c.values[rows.first + i]);
        if (value > most) fault.at(rows.first + i, too_large(c, value));
        std::uint8_t* const to = rows.to + i * rows.size + d.byte;
        *to = static_cast<std::uint8_t>(*to | (value & most) << d.shift);
    }
}

/// Colors of 8 bits become the high byte of those of 16, as the standard has it; whole degrees of
/// the old formats become the steps of 0.006 degrees of the new ones.
[[nodiscard]] double in_units_of(const las_dimension& d, const column& c, double value) {
    const bool color = d.name == "red" || d.name == "green" || d.name == "blue";
    if (color && c.type == scalar_type::uint8 && d.type == scalar_type::uint16) return value * 256;
    if (d.name == "scan_angle" && c.name == "scan_angle_rank") return std::nearbyint(value / 0.006);
    return value;
}

/// Whether the whole number in this row is still the same, as `stored`.
[[nodiscard]] bool is_kept(const column& c, std::size_t row, double stored) {
    return with_type(c.type, [&]<class T>(T value) {
        if constexpr (std::is_integral_v<T>) {
            std::memcpy(&value, c.values.data() + row * sizeof value, sizeof value);
            return is_value_of<T>(stored) && static_cast<T>(stored) == value;
        }
        return true;
    });
}

void put_converted(const column& c, const record_rows& rows, const las_dimension& d,
                   chunk_fault& fault) {
    const double most = d.bits > 0 ? (1u << d.bits) - 1 : std::numeric_limits<double>::infinity();
    std::uint64_t rounded = 0;
    with_type(d.type, [&]<class T>(T) {
        for (std::size_t i = 0; i < rows.count; ++i) {
            const double value = in_units_of(d, c, c.number(rows.first + i));
            if constexpr (std::is_integral_v<T>) {
                if (!is_value_of<T>(value) || value > most) {
                    fault.at(rows.first + i, too_large(c, value));
                    continue;
                }
            } else if (!is_kept(c, rows.first + i, static_cast<T>(value))) {
                ++rounded;
            }
            std::uint8_t* const to = rows.to + i * rows.size + d.byte;
            if (d.bits > 0)
                *to = static_cast<std::uint8_t>(*to | static_cast<unsigned>(value) << d.shift);
            else
                base::store<std::endian::little>(reinterpret_cast<char*>(to),
                                                 static_cast<T>(value));
        }
    });
    if (rounded > 0) fault.changes.add({.wholes = rounded, .of_wholes = {c.name}});
}

/// The nearest of the numbers that stand for values, or the one that stands for none.
void put_scaled(const column& c, const record_rows& rows, const las_dimension& d,
                chunk_fault& fault) {
    const las_scaling& s = *d.scaling;
    with_type(d.type, [&]<class T>(T) {
        for (std::size_t i = 0; i < rows.count; ++i) {
            const double value = c.number(rows.first + i);
            double stored = (value - s.offset) / s.scale;
            if constexpr (std::is_integral_v<T>) stored = std::nearbyint(stored);
            if (std::isnan(value)) {
                if (!s.no_data) ++fault.changes.without_value;
                stored = s.no_data.value_or(0.0);
            }
            if constexpr (std::is_integral_v<T>) {
                if (!is_value_of<T>(stored)) {
                    fault.at(rows.first + i, too_large(c, value));
                    continue;
                }
            }
            const double product = stored * s.scale;
            const double by = std::abs(product + s.offset - value);
            constexpr double digits = 1e-12;  // what the rounding of a product and a sum may do
            const bool is_step = by <= digits * (std::abs(value) + std::abs(s.offset));
            if (!is_step && by > fault.changes.rounded_by)
                fault.changes.add({.rounded_by = by, .rounded = c.name});
            base::store<std::endian::little>(
                reinterpret_cast<char*>(rows.to + i * rows.size + d.byte), static_cast<T>(stored));
        }
    });
}

/// One return of one.
void put_single_return(const record_rows& rows, const las_dimension& d) {
    for (std::size_t i = 0; i < rows.count; ++i) {
        std::uint8_t* const to = rows.to + i * rows.size + d.byte;
        *to = static_cast<std::uint8_t>(*to | 1U << d.shift);
    }
}

}  // namespace

void las_changes::add(const las_changes& more) {
    moved = std::max(moved, more.moved);
    if (more.rounded_by > rounded_by) rounded = more.rounded;
    rounded_by = std::max(rounded_by, more.rounded_by);
    wholes += more.wholes;
    for (const std::string& name : more.of_wholes)
        if (std::ranges::count(of_wholes, name) == 0) of_wholes.push_back(name);
    without_value += more.without_value;
}

void las_changes::remark(std::vector<io_warning>& warnings) const {
    if (rounded_by > 0.0)
        warnings.push_back({"extra-bytes", "values of " + rounded +
                                               " are rounded to its scale in the LAS file, by at "
                                               "most " +
                                               std::to_string(rounded_by)});
    if (wholes > 0) {
        std::string names;
        for (const std::string& name : of_wholes) names += (names.empty() ? "" : ", ") + name;
        warnings.push_back({"types", base::counted(wholes, "whole number", "whole numbers") +
                                         " of " + names +
                                         " rounded: LAS stores floating-point numbers there"});
    }
    if (without_value > 0)
        warnings.push_back({"extra-bytes", std::to_string(without_value) +
                                               " values of extra bytes are NaN and are stored as "
                                               "0: their description has no no-data value"});
}

las_tally::las_tally(const las_plan& plan)
    : record_size_(plan.record_size), return_bits_(plan.header.point_format >= 6 ? 4 : 3) {
    low_.fill(std::numeric_limits<std::int32_t>::max());
    high_.fill(std::numeric_limits<std::int32_t>::min());
}

void las_tally::add(const std::uint8_t* records, std::size_t count) {
    seen_ += count;
    for (std::size_t i = 0; i < count; ++i) {
        const char* const r = reinterpret_cast<const char*>(records + i * record_size_);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto x = base::load<std::int32_t, std::endian::little>(r + 4 * axis);
            low_[axis] = std::min(low_[axis], x);
            high_[axis] = std::max(high_[axis], x);
        }
        ++by_return_[static_cast<unsigned char>(r[14]) & ((1u << return_bits_) - 1)];
    }
}

void las_tally::put(las_plan& plan, std::uint64_t count) const {
    const las_grid& grid = plan.grid;
    const unsigned version_minor = plan.header.version_minor;
    const auto at = [&](std::size_t byte, auto value) {
        base::store<std::endian::little>(reinterpret_cast<char*>(plan.header.block.data() + byte),
                                         value);
    };
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    const bool legacy = plan.header.point_format < 6 && count <= most;
    if (!legacy && version_minor < 4)
        throw las_fault("more than 4294967295 points, which need LAS 1.4");
    at(107, static_cast<std::uint32_t>(legacy ? count : 0));
    for (std::size_t r = 0; r < 5; ++r)
        at(111 + 4 * r, static_cast<std::uint32_t>(legacy ? by_return_[r + 1] : 0));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double a = seen_ == 0 ? 0.0 : grid.coordinate(axis, high_[axis]);
        double b = seen_ == 0 ? 0.0 : grid.coordinate(axis, low_[axis]);
        if (a < b) std::swap(a, b);  // the scale is negative
        at(179 + 16 * axis, a);
        at(187 + 16 * axis, b);
    }
    if (version_minor < 4) return;
    at(247, count);
    for (std::size_t r = 0; r < 15; ++r) at(255 + 8 * r, by_return_[r + 1]);
}

void put_records(std::span<const point3> points, const element* vertices, const las_plan& plan,
                 const record_rows& rows, std::uint64_t number, las_tally& tally) {
    std::vector<const column*> data;
    if (vertices != nullptr)
        for (const column& c : vertices->columns)
            if (c.role == column_role::data && !c.list_length) data.push_back(&c);
    constexpr std::size_t at_once = 512;
    std::vector<chunk_fault> faults(chunk_count(rows.count, light_grain));
    for_chunks(rows.count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        chunk_fault& fault = faults[chunk];
        for (std::size_t at = begin; at < end; at += at_once) {
            const record_rows some{rows.first + at, std::min(at_once, end - at),
                                   rows.to + at * rows.size, rows.size};
            put_axes(points, some, plan.grid, fault);
            for (std::size_t d = 0; d < plan.dimensions.size(); ++d) {
                if (!plan.column_of[d]) continue;
                const column& from = *data[*plan.column_of[d]];
                const las_dimension& to = plan.dimensions[d];
                if (to.scaling)
                    put_scaled(from, some, to, fault);
                else if (to.bits == 0 && from.type == to.type)
                    with_bits(to.type, [&]<class T>(T) { put_same<T>(from, some, to.byte); });
                else if (to.bits > 0 && from.type == scalar_type::uint8)
                    put_bytes_as_bits(from, some, to, fault);
                else
                    put_converted(from, some, to, fault);
            }
            for (const las_dimension& d : plan.single_returns) put_single_return(some, d);
        }
    });
    for (const chunk_fault& f : faults) {
        if (f.point != nobody)
            throw las_fault("point " + std::to_string(number + (f.point - rows.first)) + ": " +
                            f.reason);
        tally.changes.add(f.changes);
    }
    tally.add(rows.to, rows.count);
}

}  // namespace treeform::detail::io
