#pragma once
/// \file
/// What follows the first 30 bytes of point records in formats 6 to 10: colors, near infrared, wave
/// packets, extra bytes, each with a state for each scanner channel. Layers are bytes of their own
/// for each kind of value, left out where the value does not change in the chunk.
///
/// \source LASzip for LAS 1.4 (native extension), Specification Document

#include <libmesh/laz/entropy.hpp>
#include <libmesh/laz/items.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::laz {

/// A layer that is read. Without a coder, its value never changes.
class layer_reader {
  public:
    static constexpr bool writes = false;

    explicit layer_reader(std::span<const std::uint8_t> bytes) {
        if (!bytes.empty()) coder_.emplace(bytes);
    }

    [[nodiscard]] bool is_there() const { return coder_.has_value(); }
    /// \pre `is_there`
    [[nodiscard]] decoder& coder() { return *coder_; }
    void says(bool) {}

  private:
    std::optional<decoder> coder_{};
};

/// A layer that is written. It is always encoded, but `finish` omits it if nothing changed.
class layer_writer {
  public:
    static constexpr bool writes = true;

    [[nodiscard]] static bool is_there() { return true; }
    [[nodiscard]] encoder& coder() { return coder_; }
    /// Records whether the value changed.
    void says(bool changed) { changed_ = changed_ || changed; }
    /// The bytes of the layer; empty if nothing changed.
    [[nodiscard]] std::vector<std::uint8_t> finish() {
        return changed_ ? coder_.finish() : std::vector<std::uint8_t>{};
    }

  private:
    encoder coder_{};
    bool changed_ = false;
};

/// The two bytes of near infrared.
class infrared_item {
  public:
    static constexpr std::size_t size = 2;

    explicit infrared_item(const std::uint8_t* first) { std::memcpy(last_.data(), first, size); }

    template <class Coder>
    void code(Coder& c, std::uint8_t* p) {
        unsigned changed = 0;
        if constexpr (Coder::writes)
            changed = (p[0] != last_[0] ? 1u : 0u) | (p[1] != last_[1] ? 2u : 0u);
        changed = c.symbol(changed_, changed);
        for (unsigned i = 0; i < size; ++i) {
            int by = 0;
            if ((changed >> i & 1u) != 0)
                by = static_cast<int>(c.symbol(bytes_[i], low_byte(p[i] - last_[i])));
            p[i] = last_[i] = low_byte(last_[i] + by);
        }
    }

  private:
    std::array<std::uint8_t, size> last_{};
    symbol_model changed_{4};
    std::vector<symbol_model> bytes_ = models(2, 256);
};

/// One extra byte.
class byte_item {
  public:
    static constexpr std::size_t size = 1;

    explicit byte_item(const std::uint8_t* first) : last_(*first) {}

    template <class Coder>
    void code(Coder& c, std::uint8_t* p) {
        const auto by = static_cast<int>(c.symbol(model_, low_byte(*p - last_)));
        *p = last_ = low_byte(last_ + by);
    }

  private:
    std::uint8_t last_;
    symbol_model model_{256};
};

/// An item in a layer. The state of a new channel starts from the previous point of any channel.
template <class Item>
class layered {
  public:
    static constexpr std::size_t size = Item::size;

    layered(const std::uint8_t* first, unsigned channel) : channel_(channel) {
        start(channel, first);
    }

    template <class Layer>
    void code(Layer& in, std::uint8_t* p, unsigned channel) {
        if (channel != channel_) {
            if (!of_channel_[channel]) start(channel, last_[channel_].data());
            channel_ = channel;
        }
        auto& last = last_[channel];
        in.says(std::memcmp(p, last.data(), size) != 0);
        if (in.is_there())
            of_channel_[channel]->code(in.coder(), p);
        else
            std::memcpy(p, last.data(), size);
        std::memcpy(last.data(), p, size);
    }

  private:
    void start(unsigned channel, const std::uint8_t* from) {
        std::memcpy(last_[channel].data(), from, size);
        of_channel_[channel].emplace(last_[channel].data());
    }

    std::array<std::optional<Item>, 4> of_channel_{};
    std::array<std::array<std::uint8_t, Item::size>, 4> last_{};
    unsigned channel_;
};

}  // namespace treeform::detail::laz
