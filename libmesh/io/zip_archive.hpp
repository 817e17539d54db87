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

/// What an archive holds, as its directory says; each member is checked when it is read.
///
/// Names are those of a package (OPC): without a leading slash, and alike in capitals and small
/// letters.
class zip_archive {
  public:
    /// `in` must outlive the archive.
    ///
    /// \throws io_error unless `in` is an archive whose names are relative, lead nowhere but down
    ///         and differ from each other
    explicit zip_archive(const source& in);
    zip_archive(const zip_archive&) = delete;
    zip_archive& operator=(const zip_archive&) = delete;
    ~zip_archive();

    [[nodiscard]] bool holds(std::string_view name) const;

    /// The bytes of a member. Memory grows with what arrives, not with what the archive announces.
    ///
    /// \throws io_error when there is no such member, when it is encrypted or packed by another
    ///         method than deflate, when the archive announces more than deflate can make of its
    ///         bytes, and when other bytes arrive than were announced
    [[nodiscard]] std::string read(std::string_view name);

  private:
    struct member {
        std::uint64_t directory_place;
        std::uint64_t number;
        std::uint64_t packed;
        std::uint64_t size;
        std::uint32_t flags;
        std::uint32_t method;
    };
    struct stream;

    void list();
    void add_current();
    void check(std::string_view name, const member& m);
    [[noreturn]] void fail(std::string_view name, std::string_view reason) const;

    const source& in_;
    stream* stream_ = nullptr;
    void* file_ = nullptr;                     ///< of the library behind it
    std::map<std::string, member> members_{};  ///< by their names in small letters
    std::uint64_t packed_read_ = 0;
};

}  // namespace treeform::detail::io
