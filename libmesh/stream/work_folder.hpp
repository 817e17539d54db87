#pragma once
/// \file
/// The folder of a job in tiles, whose content outlives the process.

#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/record_file.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace treeform::detail::stream {

/// Locked by one process at a time, or shared by several. Stored data stays until `remove`, so that
/// the same call can resume; an empty folder is removed with its last lock.
class TREEFORM_API work_folder {
  public:
    enum class use : std::uint8_t {
        alone,
        shared,
        member
    };  ///< with several ranks, only the root holds the lock

    /// Creates the folder, or takes over that of an earlier run. `job` is a word for the kind of
    /// job.
    /// \throws io_error if it cannot be created, has other files, is in use, or belongs to another
    ///         kind of job
    work_folder(std::filesystem::path path, const std::string& job, use how = use::alone);
    /// Changes the lock. \throws io_error if the folder is in use; it is then not locked
    void hold(use how);
    /// Changes a shared lock to an exclusive one; waits a little for others that are about to end.
    /// \throws io_error if the folder is in use; cancelled
    void hold_alone(cancellable_progress& pace);
    ~work_folder();
    work_folder(const work_folder&) = delete;
    work_folder& operator=(const work_folder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path file(const std::string& name) const { return path_ / name; }

    /// The state stored under `name`; none if it does not exist or is damaged.
    [[nodiscard]] std::optional<state_reader> load(const std::string& name) const;
    /// A name that no other process uses, on any machine.
    [[nodiscard]] static std::string own_name(const std::string& name);
    /// Renames the file `from` to `to`; no error if this was already done. \throws io_error
    void rename(const std::string& from, const std::string& to) const;
    /// Stores a state atomically. \throws io_error
    void store(const std::string& name, const state_writer& state) const;

    /// Removes all files but the lock.
    void clear() const;
    /// Removes the folder.
    void remove();

    /// Errors for processes that share a folder. \throws io_error
    [[noreturn]] void fail_without_tiles() const;
    [[noreturn]] void fail_with_other_tiles() const;
    /// Names the first hundred tiles. \pre `tiles` is not empty
    [[noreturn]] void fail_unfinished(const std::vector<std::size_t>& tiles) const;

  private:
    [[nodiscard]] bool try_to(use how) const;
    void remove_unused() noexcept;

    std::filesystem::path path_;
    int lock_ = -1;
    use how_ = use::alone;
};

/// Locks a shared folder exclusively during its lifetime.
class held_alone {
  public:
    /// \throws as `work_folder::hold_alone`
    held_alone(work_folder& folder, cancellable_progress& pace) : folder_(folder) {
        folder.hold_alone(pace);
    }
    ~held_alone();
    held_alone(const held_alone&) = delete;
    held_alone& operator=(const held_alone&) = delete;

  private:
    work_folder& folder_;
};

}  // namespace treeform::detail::stream
