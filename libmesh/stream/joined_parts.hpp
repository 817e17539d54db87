#pragma once
/// \file
/// One file of the parts that each rank writes.

#include <libmesh/stream/communicator.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace treeform::detail::stream {

/// Copies bytes from one file into another, which is there. \throws io_error
void copy_bytes(const std::filesystem::path& from, std::uint64_t first,
                const std::filesystem::path& to, std::uint64_t at, std::uint64_t count);

/// Where one writes its part of a file, rank 0 the whole: `part` is that of another.
[[nodiscard]] std::filesystem::path part_path(const std::filesystem::path& to,
                                              const communicator* all,
                                              const std::filesystem::path& part);

/// Text on its way to a file.
class text_out {
  public:
    /// `all` are the ranks that write a part each, the others in `part`; none: it is written
    /// here.
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
