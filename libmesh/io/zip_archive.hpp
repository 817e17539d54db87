#pragma once
/// \file
/// Reads the members of a ZIP archive.

#include <libmesh/io/source.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace treeform::detail::io {

/// The members listed in the directory of an archive; each is checked when it is read. Supports
/// 64-bit sizes (ZIP64), and sizes stored after the bytes of a member (streamed archives), since
/// the directory has all sizes.
///
/// Names are those of a package (OPC): without a leading slash, ignoring case. Positions count from
/// the beginning of the archive, which may follow other bytes; it is computed from the end of the
/// directory.
class zip_archive {
  public:
    /// `in` must outlive the archive.
    ///
    /// \throws io_error unless `in` is an archive whose names are relative, do not leave the
    ///         archive, and are unique
    explicit zip_archive(const source& in);

    [[nodiscard]] bool holds(std::string_view name) const;
    [[nodiscard]] std::uint64_t bytes_ahead() const { return ahead_; }

    /// The bytes of a member. Memory grows with the unpacked bytes, not with the announced size.
    ///
    /// \throws io_error if there is no such member, if it is encrypted or compressed by a method
    ///         other than deflate, if the announced size is impossible for deflate, and if size or
    ///         checksum differ from those announced
    [[nodiscard]] std::string read(std::string_view name);

  private:
    struct member {
        std::uint64_t at = 0;  ///< position of its header
        std::uint64_t packed = 0;
        std::uint64_t size = 0;
        std::uint32_t checksum = 0;
        std::uint32_t flags = 0;
        std::uint32_t method = 0;
    };
    struct directory {
        std::uint64_t at = 0;
        std::uint64_t size = 0;
        std::uint64_t count = 0;
        std::uint64_t ahead = 0;  ///< bytes before the archive
    };

    [[nodiscard]] directory find_directory() const;
    [[nodiscard]] directory find_large_directory(std::uint64_t end) const;
    void list(const directory& all);
    [[nodiscard]] std::uint64_t add_member(std::uint64_t at, std::uint64_t end);
    void check(std::string_view name, const member& m);
    [[nodiscard]] std::string_view packed_bytes(std::string_view name, const member& m) const;
    [[nodiscard]] std::string unpacked(std::string_view name, const member& m) const;
    [[noreturn]] void fail(std::string_view name, std::string_view reason) const;

    const source& in_;
    std::uint64_t ahead_ = 0;
    std::uint64_t directory_at_ = 0;           ///< members end before it
    std::map<std::string, member> members_{};  ///< by their names in lower case
    std::uint64_t packed_read_ = 0;
};

/// Writes an archive to a string. Members have no time stamps, so that the same members give the
/// same bytes.
class zip_builder {
  public:
    /// `bytes` must outlive the archive.
    explicit zip_builder(std::string& bytes);
    zip_builder(const zip_builder&) = delete;
    zip_builder& operator=(const zip_builder&) = delete;
    ~zip_builder();

    /// Begins a member of at most `most_bytes` bytes.
    void begin(const char* name, std::size_t most_bytes);
    void put(std::string_view bytes);
    void end();

    /// Writes the directory, which completes the archive.
    void finish();

  private:
    struct stream;

    void check(int status) const;

    stream* stream_;
    void* file_ = nullptr;  ///< handle of the ZIP library
};

}  // namespace treeform::detail::io
