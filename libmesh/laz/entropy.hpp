#pragma once
/// \file
/// The adaptive arithmetic coder of LAZ, in both directions.
///
/// `decoder` and `encoder` have the same functions, which take a model and a value and return a
/// value. The encoder writes and returns the given value; the decoder ignores it and returns the
/// value read. So every code is written once, for both directions.
///
/// \source Said, Introduction to Arithmetic Coding, HP Laboratories HPL-2004-76; Isenburg, LASzip:
///         Lossless Compression of LiDAR Data, PE&RS 79 (2013)

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace treeform::detail::laz {

/// Thrown for invalid compressed data.
class damaged : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Adaptive model of a bit: the share of zeros among the bits seen so far.
class bit_model {
  public:
    static constexpr unsigned scale = 13;  ///< shares are in units of 2^-13

    [[nodiscard]] std::uint32_t zeros() const { return zeros_; }
    void saw(bool one) {
        zero_count_ += one ? 0 : 1;
        if (--left_ == 0) update();
    }

  private:
    void update();

    std::uint32_t zeros_ = 1u << (scale - 1);
    std::uint32_t zero_count_ = 1;
    std::uint32_t count_ = 2;
    std::uint32_t cycle_ = 4;
    std::uint32_t left_ = 4;
};

/// Adaptive model of symbols: the frequency of each. Allocates memory on first use.
class symbol_model {
  public:
    static constexpr unsigned scale = 15;  ///< shares are in units of 2^-15

    /// \pre 2 <= symbols <= 2048
    explicit symbol_model(unsigned symbols) : symbols_(symbols) {}

    void need() {
        if (numbers_.empty()) start();
    }
    [[nodiscard]] unsigned last() const { return symbols_ - 1; }
    /// The sum of the shares of all lower symbols. \pre `need` was called
    [[nodiscard]] std::uint32_t below(unsigned symbol) const { return numbers_[symbol]; }
    /// The symbol whose share contains `place`. \pre place < 2^scale
    [[nodiscard]] unsigned at(std::uint32_t place) const;
    void saw(unsigned symbol) {
        ++numbers_[symbols_ + symbol];
        if (--left_ == 0) update();
    }

  private:
    void start();
    void update();

    unsigned symbols_;
    unsigned table_bits_ = 0;
    std::uint32_t total_ = 0;
    std::uint32_t cycle_ = 0;
    std::uint32_t left_ = 0;
    /// [symbols] sums of lower shares, [symbols] counts, and [2^table_bits + 1] a lookup table: the
    /// first symbol to test for places whose highest bits are the index.
    std::vector<std::uint16_t> numbers_{};
};

/// The least length of the interval that is the state of both directions.
constexpr std::uint32_t least_length = 1u << 24;

class decoder {
  public:
    static constexpr bool writes = false;

    /// \throws damaged for fewer than four bytes
    explicit decoder(std::span<const std::uint8_t> bytes);

    std::uint32_t symbol(symbol_model& model, std::uint32_t = 0);
    std::uint32_t bit(bit_model& model, std::uint32_t = 0);
    /// \pre 1 <= count <= 32
    std::uint32_t bits(unsigned count, std::uint32_t = 0);

  private:
    std::uint32_t few_bits(unsigned count);
    void shift();

    const std::uint8_t* at_;
    const std::uint8_t* end_;
    std::uint32_t value_ = 0;
    std::uint32_t length_ = 0xffffffffu;
};

class encoder {
  public:
    static constexpr bool writes = true;

    std::uint32_t symbol(symbol_model& model, std::uint32_t value);
    std::uint32_t bit(bit_model& model, std::uint32_t value);
    /// \pre 1 <= count <= 32, value < 2^count
    std::uint32_t bits(unsigned count, std::uint32_t value);
    /// The bytes of everything written; the encoder cannot be used afterwards.
    [[nodiscard]] std::vector<std::uint8_t> finish();

  private:
    void few_bits(unsigned count, std::uint32_t value);
    void add(std::uint32_t to_base);
    void shift();

    std::vector<std::uint8_t> bytes_{};
    std::uint32_t base_ = 0;
    std::uint32_t length_ = 0xffffffffu;
};

}  // namespace treeform::detail::laz
