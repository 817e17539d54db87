#pragma once
/// \file
/// Temporary files shared by all ranks.

#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/record_file.hpp>

#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

namespace treeform::detail::stream {

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
