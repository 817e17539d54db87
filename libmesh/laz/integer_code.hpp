#pragma once
/// \file
/// Numbers in point records, which are little endian. Whole numbers by their difference to a
/// prediction: how many bits it takes, then the bits.
///
/// \source Isenburg, LASzip (2013), "Entropy coding"

#include <libmesh/base/byte_order.hpp>
#include <libmesh/laz/entropy.hpp>

#include <bit>
#include <cstdint>
#include <vector>

namespace treeform::detail::laz {

[[nodiscard]] inline std::uint16_t get16(const std::uint8_t* p) {
    return base::load<std::uint16_t, std::endian::little>(reinterpret_cast<const char*>(p));
}
inline void put16(std::uint8_t* p, std::uint32_t x) {
    base::store<std::endian::little>(reinterpret_cast<char*>(p), static_cast<std::uint16_t>(x));
}
[[nodiscard]] inline std::int32_t get32(const std::uint8_t* p) {
    return base::load<std::int32_t, std::endian::little>(reinterpret_cast<const char*>(p));
}
inline void put32(std::uint8_t* p, std::int32_t x) {
    base::store<std::endian::little>(reinterpret_cast<char*>(p), x);
}
[[nodiscard]] inline std::uint64_t get64(const std::uint8_t* p) {
    return base::load<std::uint64_t, std::endian::little>(reinterpret_cast<const char*>(p));
}
inline void put64(std::uint8_t* p, std::uint64_t x) {
    base::store<std::endian::little>(reinterpret_cast<char*>(p), x);
}

/// 32-bit sums and differences, which wrap around.
[[nodiscard]] inline std::int32_t sum(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
[[nodiscard]] inline std::int32_t difference(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}
[[nodiscard]] inline std::int32_t product(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b));
}

/// `x` modulo 256.
[[nodiscard]] inline std::uint8_t low_byte(int x) { return static_cast<std::uint8_t>(x); }
[[nodiscard]] inline int clamp_byte(int x) { return x < 0 ? 0 : x > 255 ? 255 : x; }

/// A number of 64 bits as it is.
template <class Coder>
std::uint64_t bits64(Coder& c, std::uint64_t is) {
    const std::uint32_t low = c.bits(32, static_cast<std::uint32_t>(is));
    return std::uint64_t{c.bits(32, static_cast<std::uint32_t>(is >> 32))} << 32 | low;
}

class integer_code {
  public:
    /// Codes numbers modulo 2^bits. \pre `bits` is 8, 16 or 32
    integer_code(unsigned bits, unsigned contexts) : bits_(bits) {
        size_.assign(contexts, symbol_model(bits + 1));
        rest_.reserve(bits);
        for (unsigned k = 1; k <= bits; ++k) rest_.emplace_back(1u << (k < high ? k : high));
    }

    /// Returns the number, in [0, 2^bits), or as a signed 32-bit number. `real` is the number that
    /// an encoder writes.
    template <class Coder>
    std::int32_t code(Coder& c, std::int32_t predicted, std::int32_t real, unsigned context = 0) {
        std::uint32_t by = 0;
        if constexpr (Coder::writes) by = folded(bits_of(real) - bits_of(predicted));
        by = correction(c, size_[context], by);
        const std::uint32_t is = bits_of(predicted) + by;
        return static_cast<std::int32_t>(bits_ == 32 ? is : is & ((1u << bits_) - 1));
    }

    /// Number of bits of the last correction: a measure of the quality of predictions.
    [[nodiscard]] unsigned last_size() const { return last_size_; }

  private:
    /// number of high bits that have a model; lower bits are stored uncompressed
    static constexpr unsigned high = 8;

    [[nodiscard]] static std::uint32_t bits_of(std::int32_t x) {
        return static_cast<std::uint32_t>(x);
    }
    /// The number modulo 2^bits that is nearest to zero.
    [[nodiscard]] std::uint32_t folded(std::uint32_t x) const {
        const unsigned above = 32 - bits_;
        return bits_of(static_cast<std::int32_t>(x << above) >> above);
    }

    /// A correction of k bits is in [-(2^k - 1), -2^(k-1)] or [2^(k-1) + 1, 2^k]; one of 0 bits is
    /// 0 or 1. The only correction of 32 bits is -2^31.
    template <class Coder>
    std::uint32_t correction(Coder& c, symbol_model& sizes, std::uint32_t by) {
        const auto is_negative = [](std::uint32_t x) { return x >> 31 != 0; };
        unsigned k = 0;
        if constexpr (Coder::writes)
            k = static_cast<unsigned>(std::bit_width(by == 0           ? 0u
                                                     : is_negative(by) ? 0u - by
                                                                       : by - 1));
        k = last_size_ = c.symbol(sizes, k);
        if (k == 0) return c.bit(none_, by);
        if (k == 32) return 0x80000000u;
        std::uint32_t rest = is_negative(by) ? by + ((1u << k) - 1) : by - 1;
        if (k <= high) {
            rest = c.symbol(rest_[k - 1], rest);
        } else {
            const unsigned low = k - high;
            const std::uint32_t top = c.symbol(rest_[k - 1], rest >> low);
            rest = top << low | c.bits(low, rest & ((1u << low) - 1));
        }
        return rest >> (k - 1) != 0 ? rest + 1 : rest - ((1u << k) - 1);
    }

    unsigned bits_;
    unsigned last_size_ = 0;
    bit_model none_{};
    std::vector<symbol_model> size_{};  ///< [contexts]
    std::vector<symbol_model> rest_{};  ///< [bits] models of corrections with 1, 2, ... bits
};

}  // namespace treeform::detail::laz
