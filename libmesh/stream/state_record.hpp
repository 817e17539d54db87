#pragma once
/// \file
/// Serialized state for a restart, with a checksum.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace treeform::detail::stream {

/// Writes numbers, points and texts, each padded to a multiple of eight bytes.
class TREEFORM_API state_writer {
  public:
    void number(std::uint64_t n);
    void real(double x);
    void point(const point3& p);
    void text(std::string_view s);

    /// The serialized values, with their checksum.
    [[nodiscard]] std::string bytes() const;

  private:
    std::string bytes_{};
};

/// Reads the values in the order in which they were written.
class TREEFORM_API state_reader {
  public:
    explicit state_reader(std::string bytes);

    /// Whether the bytes are those of a `state_writer`, and no value beyond their end was read.
    [[nodiscard]] bool whole() const { return whole_; }
    /// At the end, these return 0 or an empty text.
    [[nodiscard]] std::uint64_t number();
    [[nodiscard]] double real();
    [[nodiscard]] point3 point();
    [[nodiscard]] std::string text();

  private:
    std::string bytes_;
    std::size_t at_ = 0;
    std::size_t end_ = 0;
    bool whole_ = false;
};

}  // namespace treeform::detail::stream
