#pragma once
/// \file
/// The bytes of an input: a mapped file, the content of a pipe, or the caller's memory.

#include <libmesh/io/scratch.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace treeform::detail::io {

class source {
  public:
    /// Opens the file at `path`; "-" is standard input. A regular file is mapped; other input is
    /// read to its end, into memory or into an unnamed mapped file.
    ///
    /// \throws io_error
    [[nodiscard]] static source open(const std::filesystem::path& path,
                                     scratch_place unmapped = scratch_place::memory);
    /// The caller's bytes, which must outlive the source.
    source(std::span<const std::byte> bytes, std::string_view name);
    source(source&& other) noexcept;
    source(const source&) = delete;
    source& operator=(const source&) = delete;
    source& operator=(source&&) = delete;
    ~source();

    [[nodiscard]] const char* begin() const { return begin_; }
    [[nodiscard]] const char* end() const { return begin_ + size_; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::string_view name() const { return name_; }

    /// Releases the memory of the bytes before `at` of a mapped file. They can still be read.
    void release_before(const char* at) const {
        if (at > release_at_) release(at);
    }

    /// Resets `release_before`, for another pass.
    void rewind() const;

    /// Number of line feeds; a separate pass, several times as fast as parsing.
    [[nodiscard]] std::size_t count_newlines() const;

    /// Number of the line that contains `at`, from 1; counts the lines before.
    [[nodiscard]] std::size_t line_of(const char* at) const;

    /// Throws io_error "name:line: reason" for the line that contains `at`.
    [[noreturn]] void fail_line(const char* at, std::string_view reason) const;
    /// Throws io_error "name: byte N: reason".
    [[noreturn]] void fail_byte(const char* at, std::string_view reason) const;
    /// Throws io_error "name: reason".
    [[noreturn]] void fail(std::string_view reason) const;

  private:
    enum class owner : std::uint8_t { caller, map, heap };

    source() = default;
    [[nodiscard]] bool map(int fd, std::size_t size);
    void release(const char* at) const;
    void plan_release() const;

    const char* begin_ = nullptr;
    std::size_t size_ = 0;
    std::string name_{};
    owner owner_ = owner::caller;
    /// end of the released bytes; a multiple of the page size
    mutable const char* released_ = nullptr;
    mutable const char* release_at_ = nullptr;  ///< next position worth a system call
};

/// Part `rank` of `size` parts of nearly equal counts.
struct file_part {
    std::uint64_t rank = 0;
    std::uint64_t size = 1;

    [[nodiscard]] std::uint64_t first(std::uint64_t count) const {
        return count / size * rank + count % size * rank / size;
    }
    [[nodiscard]] std::uint64_t last(std::uint64_t count) const {
        return file_part{rank + 1, size}.first(count);
    }
    [[nodiscard]] bool is_last() const { return rank + 1 == size; }
};

/// A row after the points, counted over all elements there, and the byte of the file at which it
/// begins.
struct row_place {
    std::uint64_t row = 0;
    std::uint64_t byte = 0;
};

}  // namespace treeform::detail::io
