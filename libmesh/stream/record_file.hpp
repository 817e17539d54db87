#pragma once
/// \file
/// Files of records as they are in memory, written and read front to back, a piece at a time. None
/// is open between two pieces, so there may be any number of them. What is to be known after an
/// interruption, as bytes that tell whether they are whole.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/tree/detail/export.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace treeform::detail::stream {

/// Writes numbers, points and texts, each padded to a multiple of eight bytes.
class TREEFORM_API state_writer {
  public:
    void number(std::uint64_t n);
    template <class... Numbers>
    void numbers(Numbers... n) {
        (number(static_cast<std::uint64_t>(n)), ...);
    }
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

/// A checksum against accidental changes; not cryptographic.
class TREEFORM_API digest {
  public:
    /// Adds bytes; their number must be a multiple of eight.
    void add(std::span<const std::byte> bytes);
    [[nodiscard]] std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0x9e3779b97f4a7c15;
};

/// The number of records and the checksum of a file, to verify that it is complete.
struct record_count {
    std::uint64_t records = 0;
    std::uint64_t digest = 0;
};

void store_count(const record_count& c, state_writer& state);
[[nodiscard]] record_count load_count(state_reader& state);
void store_warnings(const std::vector<io_warning>& warnings, state_writer& state);
[[nodiscard]] std::vector<io_warning> load_warnings(state_reader& state);

/// Whether an error concerns the folder, its files or the memory, not an input or output file.
[[nodiscard]] inline bool is_of_tiles(const io_error& error) {
    return error.why() != io_error::kind::file && error.why() != io_error::kind::blocks;
}

/// Opens a file, appends bytes, and closes it. \throws io_error
TREEFORM_API void append_to(const std::filesystem::path& path, std::span<const std::byte> bytes);
/// Writes bytes into a file, from byte `at` on. \throws io_error
TREEFORM_API void write_to(const std::filesystem::path& path, std::uint64_t at,
                           std::span<const std::byte> bytes);
/// Flushes a file to the disk. \throws io_error
TREEFORM_API void sync_file(const std::filesystem::path& path);
/// Reads from byte `at` on, up to the end of the file; returns the number of bytes read. \throws
/// io_error
[[nodiscard]] TREEFORM_API std::size_t read_from(const std::filesystem::path& path,
                                                 std::uint64_t at, std::span<std::byte> bytes);
/// A file kept open for many short reads.
class TREEFORM_API open_file {
  public:
    /// \throws io_error
    explicit open_file(std::filesystem::path path);
    ~open_file();
    open_file(const open_file&) = delete;
    open_file& operator=(const open_file&) = delete;

    /// As `read_from`.
    [[nodiscard]] std::size_t read(std::uint64_t at, std::span<std::byte> bytes) const;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    int fd_;
};
/// The size of a file in bytes; none if it does not exist.
[[nodiscard]] std::optional<std::uint64_t> size_of(const std::filesystem::path& path);
[[noreturn]] TREEFORM_API void fail_damaged(const std::filesystem::path& path);

template <class Record>
requires(std::is_trivially_copyable_v<Record> && sizeof(Record) % 8 == 0) class record_writer {
  public:
    /// Creates or truncates the file. Buffers at most `bytes`.
    record_writer(std::filesystem::path path, std::size_t bytes)
        : path_(std::move(path)), most_(bytes / sizeof(Record) + 1) {
        std::filesystem::remove(path_);
        append_to(path_, {});
    }

    void put(const Record& record) {
        if (held_.empty()) held_.reserve(most_);
        held_.push_back(record);
        if (held_.size() == most_) flush();
    }
    void put(std::span<const Record> records) {
        if (held_.empty() && !records.empty()) held_.reserve(most_ + records.size());
        held_.insert(held_.end(), records.begin(), records.end());
        if (held_.size() >= most_) flush();
    }
    /// Writes the rest, and flushes it to the disk. \throws io_error
    record_count finish() {
        const record_count all = finish_unsynced();
        sync_file(path_);
        return all;
    }
    /// The same without flushing to the disk, for files that need not outlive the process.
    record_count finish_unsynced() {
        flush();
        held_ = {};
        return {written_, digest_.value()};
    }

  private:
    void flush() {
        const auto bytes = std::as_bytes(std::span(held_));
        digest_.add(bytes);
        append_to(path_, bytes);
        written_ += held_.size();
        held_.clear();
    }

    std::filesystem::path path_;
    std::size_t most_;
    std::vector<Record> held_{};
    std::uint64_t written_ = 0;
    digest digest_{};
};

template <class Record>
class record_reader {
  public:
    /// Reads about `bytes` at a time, a multiple of `together` records.
    record_reader(std::filesystem::path path, record_count expected, std::size_t bytes,
                  std::size_t together = 1)
        : path_(std::move(path)),
          expected_(expected),
          most_((bytes / sizeof(Record) / together + 1) * together) {}
    /// Reads only `count` records from `first` on; the checksum is not verified.
    void narrow(std::uint64_t first, std::uint64_t count) {
        read_ = first;
        expected_.records = first + count;
        is_part_ = true;
    }

    /// The next records, valid until the next call; none at the end.
    /// \throws io_error if the file was changed or is incomplete
    [[nodiscard]] std::span<const Record> next() {
        const std::uint64_t left = expected_.records - read_;
        held_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(left, most_)));
        const auto bytes = std::as_writable_bytes(std::span(held_));
        if (read_from(path_, read_ * sizeof(Record), bytes) != bytes.size()) fail_damaged(path_);
        digest_.add(bytes);
        read_ += held_.size();
        if (read_ == expected_.records && !is_part_ && digest_.value() != expected_.digest)
            fail_damaged(path_);
        return held_;
    }

  private:
    std::filesystem::path path_;
    record_count expected_;
    std::size_t most_;
    std::vector<Record> held_{};
    std::uint64_t read_ = 0;
    bool is_part_ = false;
    digest digest_{};
};

/// Whether the file is complete and unchanged.
template <class Record>
[[nodiscard]] bool is_whole(const std::filesystem::path& path, const record_count& expected) {
    constexpr std::size_t bytes = std::size_t{1} << 20;
    if (size_of(path) != expected.records * sizeof(Record)) return false;
    record_reader<Record> reader(path, expected, bytes);
    try {
        while (!reader.next().empty()) {
        }
    } catch (const io_error&) {
        return false;
    }
    return true;
}

}  // namespace treeform::detail::stream
