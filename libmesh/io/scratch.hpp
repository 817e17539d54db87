#pragma once
/// \file
/// Bytes for the time of an operation: in memory, or in a file without a name.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace treeform::detail::io {

enum class scratch_place : std::uint8_t { memory, file };

/// `size` bytes, zero at first. Those of a file take memory only while they are used.
class scratch {
  public:
    /// `name` stands for the file that they are needed for, in errors. `folder` as for
    /// `open_nameless_file`.
    ///
    /// \throws io_error, std::bad_alloc
    scratch(std::size_t size, scratch_place place, std::string_view name,
            const std::filesystem::path& folder = {});
    scratch(const scratch&) = delete;
    scratch& operator=(const scratch&) = delete;
    ~scratch();

    [[nodiscard]] char* data() const { return data_; }
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Gives the memory of bytes that are in a file back; they can still be read.
    void give_back() const;

  private:
    char* data_ = nullptr;
    std::size_t size_ = 0;
    scratch_place place_;
};

/// A file that nobody else sees and that goes with its descriptor: in `folder`, or else where there
/// is room for large ones. \throws io_error
[[nodiscard]] int open_nameless_file(std::string_view name,
                                     const std::filesystem::path& folder = {});

}  // namespace treeform::detail::io
