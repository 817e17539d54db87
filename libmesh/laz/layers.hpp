#pragma once
/// \file
/// Layers of a chunk in formats 6 to 10: bytes of their own for each kind of value, left out where
/// the value does not change in the chunk.

#include <libmesh/laz/entropy.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::laz {

/// A layer that is read: without a coder, everything in it is as it was.
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

/// A layer that is written: it is there for as long as nobody knows better.
class layer_writer {
  public:
    static constexpr bool writes = true;

    [[nodiscard]] static bool is_there() { return true; }
    [[nodiscard]] encoder& coder() { return coder_; }
    /// Something in it changed, if `changed`.
    void says(bool changed) { changed_ = changed_ || changed; }
    /// Its bytes; none where nothing changed.
    [[nodiscard]] std::vector<std::uint8_t> finish() {
        return changed_ ? coder_.finish() : std::vector<std::uint8_t>{};
    }

  private:
    encoder coder_{};
    bool changed_ = false;
};

}  // namespace treeform::detail::laz
