#pragma once
/// \file
/// The members of a ZIP archive.

#include <libmesh/io/source.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace treeform::detail::io {

/// What an archive holds, as its directory says; each member is checked when it is read. Sizes may
/// have 64 bits (ZIP64) and may stand behind the bytes of a member, as where it was streamed: the
/// directory has them all.
///
/// Names are those of a package (OPC): without a leading slash, and alike in capitals and small
/// letters. Places count from where the archive begins, which may be behind other bytes: the
/// directory ends where its last record is.
class zip_archive {
  public:
    /// `in` must outlive the archive.
    ///
    /// \throws io_error unless `in` is an archive whose names are relative, lead nowhere but down
    ///         and differ from each other
    explicit zip_archive(const source& in);

    [[nodiscard]] bool holds(std::string_view name) const;
    [[nodiscard]] std::uint64_t bytes_ahead() const { return ahead_; }

    /// The bytes of a member. Memory grows with what arrives, not with what the archive announces.
    ///
    /// \throws io_error when there is no such member, when it is encrypted or packed by another
    ///         method than deflate, when the archive announces more than deflate can make of its
    ///         bytes, and when other bytes arrive than were announced
    [[nodiscard]] std::string read(std::string_view name);

  private:
    struct member {
        std::uint64_t at = 0;  ///< of its own header
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
        std::uint64_t ahead = 0;  ///< bytes, where `at` is counted from
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
    std::uint64_t directory_at_ = 0;           ///< behind these
    std::map<std::string, member> members_{};  ///< by their names in small letters
    std::uint64_t packed_read_ = 0;
};

}  // namespace treeform::detail::io
