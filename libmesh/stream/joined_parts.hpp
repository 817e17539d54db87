#pragma once
/// \file
/// One file of the parts that each rank writes; files that all ranks see for some time.

#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/record_file.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

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

/// Rank 0 creates the files, and removes them at the end, also after an exception.
class passing_files {
  public:
    explicit passing_files(const communicator& all) : all_(all) {}
    passing_files(const passing_files&) = delete;
    passing_files& operator=(const passing_files&) = delete;
    ~passing_files() {
        std::error_code ignored;
        for (const std::filesystem::path& file : files_) std::filesystem::remove(file, ignored);
    }

    /// Creates an empty file, replacing one that a killed run left. Other ranks may use it after
    /// the next communication. \throws io_error
    void add(std::filesystem::path file) {
        if (!all_.is_root()) return;
        std::filesystem::remove(file);
        files_.push_back(std::move(file));
        append_to(files_.back(), {});
    }

  private:
    const communicator& all_;
    std::vector<std::filesystem::path> files_{};
};

}  // namespace treeform::detail::stream
