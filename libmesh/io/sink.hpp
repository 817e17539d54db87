#pragma once
/// \file
/// Buffered output of bytes, and of numbers as text.

#include <libmesh/base/byte_order.hpp>

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>

namespace treeform::detail::io {

/// Thrown if `may_continue` returned false.
class writing_stopped {};

/// A buffer for a file descriptor, or for a string.
class sink {
  public:
    explicit sink(std::string& memory) : memory_(&memory) {}
    /// `name` is the file in errors. If `may_continue` returns false, `writing_stopped` is thrown
    /// and nothing more is written.
    sink(int fd, std::string name, std::function<bool()> may_continue = {})
        : fd_(fd), name_(std::move(name)), may_continue_(std::move(may_continue)) {}
    sink(const sink&) = delete;
    sink& operator=(const sink&) = delete;
    ~sink() = default;

    void put(std::string_view bytes) {
        while (bytes.size() > buffer_.size() - used_) {
            const std::size_t part = buffer_.size() - used_;
            bytes.copy(buffer_.data() + used_, part);
            used_ += part;
            bytes.remove_prefix(part);
            flush();
        }
        bytes.copy(buffer_.data() + used_, bytes.size());
        used_ += bytes.size();
    }
    void put(char c) { put(std::string_view(&c, 1)); }

    /// Writes the shortest text that reads back as the same value.
    template <class T>
    requires std::is_arithmetic_v<T>
    void number(T value) {
        constexpr std::size_t longest = 32;
        if (buffer_.size() - used_ < longest) flush();
        char* const at = buffer_.data() + used_;
        used_ += static_cast<std::size_t>(std::to_chars(at, at + longest, value).ptr - at);
    }

    template <std::endian order, class T>
    void raw(T value) {
        if (buffer_.size() - used_ < sizeof(T)) flush();
        base::store<order>(buffer_.data() + used_, value);
        used_ += sizeof(T);
    }

    /// \throws io_error, writing_stopped
    void flush();

    /// Checks for cancellation during long work without output. \throws writing_stopped
    void check_cancelled() const {
        if (may_continue_ && !may_continue_()) throw writing_stopped();
    }

    /// Skips this many bytes in the file. \pre it is a regular file \throws io_error
    void skip(std::uint64_t bytes);

    /// Number of bytes put so far.
    [[nodiscard]] std::uint64_t size() const { return flushed_ + used_; }

    /// The name of the file, for errors.
    [[nodiscard]] std::string_view name() const {
        return memory_ != nullptr ? std::string_view("memory") : std::string_view(name_);
    }

    /// Whether written bytes can be replaced; false for pipes and terminals.
    [[nodiscard]] bool can_replace() const;
    /// Replaces written bytes from position `at` on.
    ///
    /// \pre    `can_replace`, and these bytes were put
    /// \throws io_error
    void replace(std::size_t at, std::string_view bytes);

  private:
    std::array<char, std::size_t{1} << 16> buffer_;
    std::size_t used_ = 0;
    std::uint64_t flushed_ = 0;
    std::string* memory_ = nullptr;
    int fd_ = -1;
    std::string name_{};
    std::function<bool()> may_continue_{};
};

/// An output file that appears at its path only when it is complete: it is written to a temporary
/// file beside it, renamed by `commit`, and removed without `commit`. A path that is not a regular
/// file (a device, a pipe) is written in place; "-" is standard output.
class output_file {
  public:
    /// \throws io_error
    explicit output_file(const std::filesystem::path& path);
    output_file(const output_file&) = delete;
    output_file& operator=(const output_file&) = delete;
    ~output_file();

    [[nodiscard]] int descriptor() const { return fd_; }
    [[nodiscard]] const std::string& name() const { return name_; }
    /// \throws io_error
    void commit();

  private:
    [[noreturn]] void fail(int error) const;

    std::string name_{};
    std::filesystem::path target_{};
    std::filesystem::path beside_{};  ///< empty when written in place
    int fd_ = -1;
};

}  // namespace treeform::detail::io
