#pragma once
/// \file
/// The adaptive arithmetic coder of LAZ, in both directions.
///
/// `decoder` and `encoder` have the same calls: each takes a model and a value and returns the
/// value. The encoder writes the one it is given, the decoder returns the one it reads and ignores
/// what it is given. So every code below is written once, for both.
///
/// \source Said, Introduction to Arithmetic Coding, HP Laboratories HPL-2004-76; Isenburg, LASzip:
///         Lossless Compression of LiDAR Data, PE&RS 79 (2013)

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace treeform::detail::laz {

/// Compressed bytes that cannot be what they are said to be.
class damaged : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The share of zeros among the bits seen so far.
class bit_model {
  public:
    static constexpr unsigned scale = 13;  ///< shares are parts of 2^13

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

/// How often each of some symbols was seen. Takes memory when it is first used.
class symbol_model {
  public:
    static constexpr unsigned scale = 15;  ///< shares are parts of 2^15

    /// \pre 2 <= symbols <= 2048
    explicit symbol_model(unsigned symbols) : symbols_(symbols) {}

    void need() {
        if (numbers_.empty()) start();
    }
    [[nodiscard]] unsigned last() const { return symbols_ - 1; }
    /// The share of all symbols below this one. \pre `need` was called
    [[nodiscard]] std::uint32_t below(unsigned symbol) const { return numbers_[symbol]; }
    /// The symbol in whose share this place lies. \pre place < 2^scale
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
    /// [symbols] shares below, [symbols] counts, [2^table_bits + 1] first symbol to look at for the
    /// places whose highest bits are those of the index.
    std::vector<std::uint16_t> numbers_{};
};

/// What both directions know: an interval, whose length stays at or above `least`.
constexpr std::uint32_t least_length = 1u << 24;

class decoder {
  public:
    static constexpr bool writes = false;

    /// \throws damaged when there are fewer than four bytes
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
    /// The bytes of all that was written; the encoder cannot be used again.
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
