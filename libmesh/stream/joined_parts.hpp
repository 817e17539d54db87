#pragma once
/// \file
/// Joins the parts of a file that the ranks write.

#include <libmesh/stream/communicator.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace treeform::detail::stream {

/// Copies bytes from one file into another, existing file. \throws io_error
void copy_bytes(const std::filesystem::path& from, std::uint64_t first,
                const std::filesystem::path& to, std::uint64_t at, std::uint64_t count);

/// The path to which a rank writes its part of file `to`: rank 0 a temporary file beside it, which
/// becomes the whole; other ranks `part`.
[[nodiscard]] std::filesystem::path part_path(const std::filesystem::path& to,
                                              const communicator* all,
                                              const std::filesystem::path& part);

/// Writes text to a file; ranks write consecutive parts.
class text_out {
  public:
    /// `all`: each rank writes a part, ranks other than 0 to `part`. Null: this process writes all.
    text_out(std::filesystem::path to, const communicator* all, const std::filesystem::path& part);

    /// \throws io_error
    void write(std::string_view text);
    /// Finishes the file. Collective: every rank must call this. \throws io_error
    void commit();

  private:
    void flush();

    std::filesystem::path target_;
    std::filesystem::path path_;
    const communicator* all_;
    std::string held_{};
    std::uint64_t written_ = 0;
};

}  // namespace treeform::detail::stream
