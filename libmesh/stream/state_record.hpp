#pragma once
/// \file
/// What is to be known after an interruption, as bytes that tell whether they are whole.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace treeform::detail::stream {

/// Numbers, points and texts, one after the other, each in a multiple of eight bytes.
class TREEFORM_API state_writer {
  public:
    void number(std::uint64_t n);
    void real(double x);
    void point(const point3& p);
    void text(std::string_view s);

    /// All that was put in, and a digest of it.
    [[nodiscard]] std::string bytes() const;

  private:
    std::string bytes_{};
};

/// Gives back what was put in, in the same order.
class TREEFORM_API state_reader {
  public:
    explicit state_reader(std::string bytes);

    /// Whether the bytes are those of a `state_writer`, and nothing beyond them was asked for.
    [[nodiscard]] bool whole() const { return whole_; }
    /// 0, or an empty text, when there is nothing left.
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
