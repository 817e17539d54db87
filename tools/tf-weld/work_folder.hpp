#pragma once
/// \file
/// The folder in which a cloud larger than memory is welded; what is there outlives the process.

#include "tools/common/run.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace tools {

/// Held by one process at a time. It stays until `remove`, so that the same command can go on.
class work_folder {
  public:
    /// Makes the folder, or takes over what an earlier run has left.
    /// \throws failure (bad_output) when it cannot be made, holds other files, or is in use
    explicit work_folder(std::filesystem::path path);
    ~work_folder();
    work_folder(const work_folder&) = delete;
    work_folder& operator=(const work_folder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path file(const std::string& name) const { return path_ / name; }

    /// The object stored under `name`; none when it is not there or is not whole.
    [[nodiscard]] std::optional<json> load(const std::string& name) const;
    /// Stores it: whole, or not at all. \throws failure (bad_output)
    void store(const std::string& name, const json& object) const;

    /// Removes all files but the lock.
    void clear() const;
    /// Removes the folder.
    void remove();

  private:
    std::filesystem::path path_;
    int lock_ = -1;
};

}  // namespace tools
