#pragma once
/// \file
/// Where written bytes go, and numbers as text.

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

/// Thrown where a sink is asked to stop.
class writing_stopped {};

/// A buffer in front of a file descriptor, or of a string that grows.
class sink {
  public:
    explicit sink(std::string& memory) : memory_(&memory) {}
    /// `name` stands for the file in errors. Where `goes_on` returns false, nothing more is
    /// written: `writing_stopped` is thrown.
    sink(int fd, std::string name, std::function<bool()> goes_on = {})
        : fd_(fd), name_(std::move(name)), goes_on_(std::move(goes_on)) {}
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

    /// Shortest text that reads back as the same value.
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

    /// For what takes long before anything is put. \throws writing_stopped
    void go_on() const {
        if (goes_on_ && !goes_on_()) throw writing_stopped();
    }

    /// Leaves a hole of so many bytes in the file. \pre a regular file. \throws io_error
    void skip(std::uint64_t bytes);

    /// Bytes that were put.
    [[nodiscard]] std::uint64_t size() const { return flushed_ + used_; }

    /// The file, for errors.
    [[nodiscard]] std::string_view name() const {
        return memory_ != nullptr ? std::string_view("memory") : std::string_view(name_);
    }

    /// Whether bytes that were put can be replaced: false for pipes and terminals.
    [[nodiscard]] bool can_replace() const;
    /// Replaces bytes from `at` on, counted from the first that was put.
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
    std::function<bool()> goes_on_{};
};

/// A file that appears at its path only when it is whole: written beside it, renamed by `commit`,
/// removed without it. What is no regular file (a device, a pipe) is written in place; "-" is
/// standard output.
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
