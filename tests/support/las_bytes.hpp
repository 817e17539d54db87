#pragma once
/// \file
/// LAS files put together byte by byte, after the standard and not with the writer.

#include <support/random.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace test {

/// The machine is little endian where these tests run, as the format is.
template <class T>
void put(std::string& bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
}

template <class T>
T get(std::string_view bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

struct las_bytes {
    unsigned minor = 2;
    unsigned format = 0;
    std::size_t record_size = 20;
    double scale = 0.01;
    double offset = 0.0;
    std::string records{};  ///< whole records, with their heads
    std::uint32_t record_count = 0;
    std::string extended{};
    std::uint32_t extended_count = 0;

    [[nodiscard]] std::size_t header_size() const {
        return minor == 4 ? 375 : minor == 3 ? 235 : 227;
    }

    void add_record(std::string_view user, std::uint16_t id, std::string_view data) {
        std::string r(54, '\0');
        user.copy(r.data() + 2, 16);
        put(r, 18, id);
        put(r, 20, static_cast<std::uint16_t>(data.size()));
        std::string_view("made by a test").copy(r.data() + 22, 32);
        records += r;
        records += data;
        ++record_count;
    }
    void add_extended(std::string_view user, std::uint16_t id, std::string_view data) {
        std::string r(60, '\0');
        user.copy(r.data() + 2, 16);
        put(r, 18, id);
        put(r, 20, std::uint64_t{data.size()});
        extended += r;
        extended += data;
        ++extended_count;
    }

    /// The file with these points.
    [[nodiscard]] std::string file(std::string_view points) const {
        std::string h(header_size(), '\0');
        std::string_view("LASF").copy(h.data(), 4);
        h[24] = 1;
        h[25] = static_cast<char>(minor);
        std::string_view("a test").copy(h.data() + 26, 32);
        put(h, 94, static_cast<std::uint16_t>(h.size()));
        put(h, 96, static_cast<std::uint32_t>(h.size() + records.size()));
        put(h, 100, record_count);
        h[104] = static_cast<char>(format);
        put(h, 105, static_cast<std::uint16_t>(record_size));
        const std::size_t count = points.size() / record_size;
        if (format < 6) put(h, 107, static_cast<std::uint32_t>(count));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            put(h, 131 + 8 * axis, scale);
            put(h, 155 + 8 * axis, offset);
        }
        if (minor == 4) {
            put(h, 235,
                std::uint64_t{extended.empty() ? 0 : h.size() + records.size() + points.size()});
            put(h, 243, extended_count);
            put(h, 247, std::uint64_t{count});
        }
        return h + records + std::string(points) + extended;
    }
};

/// Bytes of the points in a LAS file that is not packed.
inline std::string_view points_of(std::string_view file) {
    const auto size = get<std::uint16_t>(file, 105);
    std::uint64_t count = get<std::uint32_t>(file, 107);
    if (file[25] == 4) count = get<std::uint64_t>(file, 247);
    return file.substr(get<std::uint32_t>(file, 96), static_cast<std::size_t>(count) * size);
}

/// How records look: like a scan, all equal, or any bytes at all.
enum class las_family : std::uint8_t { scan, equal, noise };

/// `count` records of that format and size.
inline std::string las_points(las_family family, unsigned format, std::size_t size,
                              std::size_t count, std::uint64_t seed) {
    random numbers(seed);
    std::string points(size * count, '\0');
    std::int32_t x = 1000000;
    std::int32_t y = -2000000;
    double time = 1234.5;
    const std::size_t time_at = format >= 6 ? 22 : 20;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = i * size;
        if (family == las_family::noise || (family == las_family::equal && i == 0)) {
            for (std::size_t b = 0; b < size; ++b)
                points[at + b] = static_cast<char>(numbers.below(256));
            continue;
        }
        if (family == las_family::equal) {
            std::memcpy(points.data() + at, points.data(), size);
            continue;
        }
        if (i > 0) std::memcpy(points.data() + at, points.data() + at - size, size);
        x += static_cast<std::int32_t>(numbers.below(40)) + 80;
        y += static_cast<std::int32_t>(numbers.below(9)) - 4;
        put(points, at, x);
        put(points, at + 4, y);
        put(points, at + 8, static_cast<std::int32_t>(numbers.below(500)));
        put(points, at + 12, static_cast<std::uint16_t>(numbers.below(300)));
        const std::size_t returns = 1 + numbers.below(format >= 6 ? 15 : 5);
        const std::size_t number = 1 + numbers.below(returns);
        points[at + 14] = static_cast<char>(returns << (format >= 6 ? 4 : 3) | number);
        if (numbers.below(20) == 0) points[at + 15] = static_cast<char>(numbers.below(256));
        if (numbers.below(3) == 0) points[at + 16] = static_cast<char>(numbers.below(256));
        const bool has_time = format == 1 || format >= 3;
        if (has_time && numbers.below(3) != 0) {
            time += numbers.below(50) == 0 ? 1e6 * numbers.unit() : 1e-5;
            put(points, at + time_at, time);
        }
        for (std::size_t b = time_at + (has_time ? 8 : 0); b < size; ++b)
            if (numbers.below(4) == 0)
                points[at + b] =
                    static_cast<char>(points[at + b] + static_cast<int>(numbers.below(3)));
    }
    return points;
}

/// Bytes of a record in each format without extra ones, by the standard's tables.
inline constexpr std::size_t las_sizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

}  // namespace test
