#pragma once
/// \file
/// The layers of a chunk in formats 6 to 10: separate bytes for each kind of value, omitted if the
/// value does not change in the chunk.

#include <libmesh/laz/entropy.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
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

}  // namespace treeform::detail::laz
