#pragma once
/// \file
/// The items of point records in formats 0 to 5, each predicted from the previous point. `code`
/// reads or writes the item at `p`, depending on the coder.
///
/// \source Isenburg, LASzip: Lossless Compression of LiDAR Data, PE&RS 79 (2013); LASzip for LAS
///         1.4, Specification Document, for the tables of return maps and levels

#include <libmesh/laz/entropy.hpp>
#include <libmesh/laz/gps_time_code.hpp>
#include <libmesh/laz/integer_code.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace treeform::detail::laz {

/// For up to 7 returns: up to four returns, each valid combination has its own number.
[[nodiscard]] inline unsigned return_map(unsigned returns, unsigned number) {
    static constexpr std::array<std::array<std::uint8_t, 8>, 8> map{{
        {15, 14, 13, 12, 11, 10, 9, 8},
        {14, 0, 1, 3, 6, 10, 10, 9},
        {13, 1, 2, 4, 7, 11, 11, 10},
        {12, 3, 4, 5, 8, 12, 12, 11},
        {11, 6, 7, 8, 9, 13, 13, 12},
        {10, 10, 11, 12, 13, 14, 14, 13},
        {9, 10, 11, 12, 13, 14, 15, 14},
        {8, 9, 10, 11, 12, 13, 14, 15},
    }};
    return map[returns][number];
}

/// For up to 15 returns: six contexts.
[[nodiscard]] inline unsigned return_map_of_six(unsigned returns, unsigned number) {
    static constexpr std::array<std::array<std::uint8_t, 16>, 16> map{{
        {0, 1, 2, 3, 4, 5, 3, 4, 4, 5, 5, 5, 5, 5, 5, 5},
        {1, 0, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3},
        {2, 1, 2, 4, 4, 4, 4, 4, 4, 4, 4, 3, 3, 3, 3, 3},
        {3, 3, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
        {4, 3, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
        {5, 3, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
        {3, 3, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4},
        {4, 3, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4},
        {4, 3, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4},
        {5, 3, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4},
        {5, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4},
        {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 4, 4, 4},
        {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4, 4},
        {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4},
        {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5},
        {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5},
    }};
    return map[returns][number];
}

/// The distance of a return to the last one of its pulse, at most 7.
[[nodiscard]] inline unsigned return_level(unsigned returns, unsigned number) {
    return std::min(returns > number ? returns - number : number - returns, 7u);
}

/// Five sorted numbers. Each new number replaces the largest or the smallest one. Which of them is
/// replaced switches after a new number on the side of the median that lost one.
class median5 {
  public:
    [[nodiscard]] std::int32_t get() const { return sorted_[2]; }

    void add(std::int32_t x) {
        if (drop_largest_) {
            if (x >= sorted_[2]) drop_largest_ = false;
            int i = 4;
            for (; i > 0 && x < sorted_[at(i - 1)]; --i) sorted_[at(i)] = sorted_[at(i - 1)];
            sorted_[at(i)] = x;
        } else {
            if (x <= sorted_[2]) drop_largest_ = true;
            int i = 0;
            for (; i < 4 && sorted_[at(i + 1)] < x; ++i) sorted_[at(i)] = sorted_[at(i + 1)];
            sorted_[at(i)] = x;
        }
    }

  private:
    [[nodiscard]] static std::size_t at(int i) { return static_cast<std::size_t>(i); }

    std::array<std::int32_t, 5> sorted_{};
    bool drop_largest_ = true;
};

/// Models of contexts. They allocate memory on first use, and most data use few of them.
[[nodiscard]] inline std::vector<symbol_model> models(std::size_t count, unsigned symbols) {
    return std::vector<symbol_model>(count, symbol_model(symbols));
}

/// Coordinates, intensity, flags, classification, scan angle, user data, source: 20 bytes.
class point_item {
  public:
    static constexpr std::size_t size = 20;

    explicit point_item(const std::uint8_t* first) { std::memcpy(last_.data(), first, size); }

    template <class Coder>
    void code(Coder& c, std::uint8_t* p) {
        unsigned changed = 0;
        if constexpr (Coder::writes) changed = changes(p);
        changed = c.symbol(changed_, changed);
        const auto byte = [&](unsigned bit, std::size_t at, symbol_model& model) {
            p[at] = (changed & bit) != 0 ? low_byte(static_cast<int>(c.symbol(model, p[at])))
                                         : last_[at];
        };
        byte(32, flags, flags_[last_[flags]]);
        const unsigned number = p[flags] & 7u;
        const unsigned returns = p[flags] >> 3 & 7u;
        const unsigned map = return_map(returns, number);
        if ((changed & 16) != 0)
            intensity_[map] = low_word(
                intensities_.code(c, intensity_[map], get16(p + intensity), std::min(map, 3u)));
        put16(p + intensity, intensity_[map]);
        byte(8, classification, classes_[last_[classification]]);
        if ((changed & 4) != 0) {
            symbol_model& model = angles_[p[flags] >> 6 & 1u];
            const int by = static_cast<int>(c.symbol(model, low_byte(p[angle] - last_[angle])));
            p[angle] = low_byte(last_[angle] + by);
        } else {
            p[angle] = last_[angle];
        }
        byte(2, user, users_[last_[user]]);
        const std::uint16_t was = get16(last_.data() + source);
        put16(p + source,
              (changed & 1) != 0 ? low_word(sources_.code(c, was, get16(p + source))) : was);
        coordinates(c, p, map, return_level(returns, number), returns == 1 ? 1 : 0);
        std::memcpy(last_.data(), p, size);
    }

  private:
    static constexpr std::size_t intensity = 12, flags = 14, classification = 15, angle = 16,
                                 user = 17, source = 18;

    [[nodiscard]] static std::uint16_t low_word(std::int32_t x) {
        return static_cast<std::uint16_t>(x);
    }

    [[nodiscard]] unsigned changes(const std::uint8_t* p) const {
        const auto differs = [&](std::size_t at) { return p[at] != last_[at] ? 1u : 0u; };
        const unsigned map = return_map(p[flags] >> 3 & 7u, p[flags] & 7u);
        return differs(flags) << 5 | (get16(p + intensity) != intensity_[map] ? 16u : 0u) |
               differs(classification) << 3 | differs(angle) << 2 | differs(user) << 1 |
               (differs(source) | differs(source + 1));
    }

    template <class Coder>
    void coordinates(Coder& c, std::uint8_t* p, unsigned map, unsigned level, unsigned single) {
        const auto step = [&](std::size_t at, integer_code& code, median5& median,
                              unsigned context) {
            const std::int32_t was = get32(last_.data() + at);
            const std::int32_t by =
                code.code(c, median.get(), difference(get32(p + at), was), context);
            put32(p + at, sum(was, by));
            median.add(by);
        };
        step(0, x_, x_steps_[map], single);
        const unsigned x_size = x_.last_size();
        step(4, y_, y_steps_[map], single + std::min(x_size & ~1u, 20u));
        const unsigned size_xy = (x_size + y_.last_size()) / 2;
        z_seen_[level] =
            z_.code(c, z_seen_[level], get32(p + 8), single + std::min(size_xy & ~1u, 18u));
        put32(p + 8, z_seen_[level]);
    }

    std::array<std::uint8_t, size> last_{};
    std::array<std::uint16_t, 16> intensity_{};
    std::array<median5, 16> x_steps_{};
    std::array<median5, 16> y_steps_{};
    std::array<std::int32_t, 8> z_seen_{};
    symbol_model changed_{64};
    std::vector<symbol_model> flags_ = models(256, 256);
    std::vector<symbol_model> classes_ = models(256, 256);
    std::vector<symbol_model> angles_ = models(2, 256);
    std::vector<symbol_model> users_ = models(256, 256);
    integer_code intensities_{16, 4};
    integer_code sources_{16, 1};
    integer_code x_{32, 2};
    integer_code y_{32, 22};
    integer_code z_{32, 20};
};

class gps_time_item {
  public:
    static constexpr std::size_t size = 8;

    explicit gps_time_item(const std::uint8_t* first) : times_(true, get64(first)) {}

    template <class Coder>
    void code(Coder& c, std::uint8_t* p) {
        put64(p, times_.code(c, get64(p)));
    }

  private:
    gps_time_code times_;
};

/// Red, green and blue, two bytes each: predicted from the previous point, green and blue also from
/// the changes of the preceding channels.
class color_item {
  public:
    static constexpr std::size_t size = 6;

    explicit color_item(const std::uint8_t* first) { std::memcpy(last_.data(), first, size); }

    /// Bytes 0, 2, 4 are low bytes; 1, 3, 5 are high bytes.
    template <class Coder>
    void code(Coder& c, std::uint8_t* p) {
        unsigned changed = 0;
        if constexpr (Coder::writes) changed = changes(p);
        changed = c.symbol(changed_, changed);
        red(c, p, changed);
        if ((changed & 64) != 0) {
            others(c, p, changed, 0);
            others(c, p, changed, 1);
        } else {
            std::memcpy(p + 2, p, 2);
            std::memcpy(p + 4, p, 2);
        }
        std::memcpy(last_.data(), p, size);
    }

  private:
    [[nodiscard]] unsigned changes(const std::uint8_t* p) const {
        unsigned changed = get16(p) != get16(p + 2) || get16(p) != get16(p + 4) ? 64u : 0u;
        for (unsigned i = 0; i < size; ++i)
            if (p[i] != last_[i]) changed |= 1u << i;
        return changed;
    }

    template <class Coder>
    void byte(Coder& c, std::uint8_t* p, unsigned changed, std::size_t i, int predicted) {
        if ((changed >> i & 1u) == 0) {
            p[i] = last_[i];
            return;
        }
        const auto by = static_cast<int>(c.symbol(bytes_[i], low_byte(p[i] - predicted)));
        p[i] = low_byte(predicted + by);
    }

    template <class Coder>
    void red(Coder& c, std::uint8_t* p, unsigned changed) {
        byte(c, p, changed, 0, last_[0]);
        byte(c, p, changed, 1, last_[1]);
    }

    template <class Coder>
    void others(Coder& c, std::uint8_t* p, unsigned changed, std::size_t high) {
        const int by_red = p[high] - last_[high];
        byte(c, p, changed, 2 + high, clamp_byte(last_[2 + high] + by_red));
        const int by_both = (by_red + p[2 + high] - last_[2 + high]) / 2;
        byte(c, p, changed, 4 + high, clamp_byte(last_[4 + high] + by_both));
    }

    std::array<std::uint8_t, size> last_{};
    symbol_model changed_{128};
    std::vector<symbol_model> bytes_ = models(6, 256);
};

/// Index of the descriptor, offset and size of the waveform, position of the return in it, and its
/// direction: 29 bytes.
class wave_packet_item {
  public:
    static constexpr std::size_t size = 29;

    explicit wave_packet_item(const std::uint8_t* first) { std::memcpy(last_.data(), first, size); }

    template <class Coder>
    void code(Coder& c, std::uint8_t* p) {
        p[0] = low_byte(static_cast<int>(c.symbol(index_, p[0])));
        put64(p + offset, offset_of(c, get64(p + offset)));
        const auto word = [&](std::size_t at, integer_code& code, unsigned context) {
            put32(p + at, code.code(c, get32(last_.data() + at), get32(p + at), context));
        };
        word(packet_size, sizes_, 0);
        word(place, places_, 0);
        for (unsigned axis = 0; axis < 3; ++axis) word(direction + 4 * axis, directions_, axis);
        std::memcpy(last_.data(), p, size);
    }

  private:
    static constexpr std::size_t offset = 1, packet_size = 9, place = 13, direction = 17;

    template <class Coder>
    std::uint64_t offset_of(Coder& c, std::uint64_t is) {
        const std::uint64_t was = get64(last_.data() + offset);
        const std::uint64_t next =
            was + static_cast<std::uint32_t>(get32(last_.data() + packet_size));
        const auto by64 = static_cast<std::int64_t>(is - was);
        auto by = static_cast<std::int32_t>(static_cast<std::uint32_t>(is - was));
        unsigned kind = 0;
        if constexpr (Coder::writes) kind = is == was ? 0 : is == next ? 1 : by64 == by ? 2 : 3;
        kind = last_kind_ = c.symbol(kinds_[last_kind_], kind);
        if (kind == 0) return was;
        if (kind == 1) return next;
        if (kind == 2) {
            last_step_ = steps_.code(c, last_step_, by);
            return was + static_cast<std::uint64_t>(std::int64_t{last_step_});
        }
        return bits64(c, is);
    }

    std::array<std::uint8_t, size> last_{};
    unsigned last_kind_ = 0;
    std::int32_t last_step_ = 0;
    symbol_model index_{256};
    std::vector<symbol_model> kinds_ = models(4, 4);
    integer_code steps_{32, 1};
    integer_code sizes_{32, 1};
    integer_code places_{32, 1};
    integer_code directions_{32, 3};
};

/// Extra bytes, each predicted from that of the previous point.
class bytes_item {
  public:
    bytes_item(const std::uint8_t* first, std::size_t count)
        : last_(first, first + count), bytes_(models(count, 256)) {}

    template <class Coder>
    void code(Coder& c, std::uint8_t* p) {
        for (std::size_t i = 0; i < last_.size(); ++i) {
            const auto by = static_cast<int>(c.symbol(bytes_[i], low_byte(p[i] - last_[i])));
            p[i] = last_[i] = low_byte(last_[i] + by);
        }
    }

  private:
    std::vector<std::uint8_t> last_;
    std::vector<symbol_model> bytes_;
};

}  // namespace treeform::detail::laz
