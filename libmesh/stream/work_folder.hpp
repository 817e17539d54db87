#pragma once
/// \file
/// The folder in which a cloud larger than memory is welded; what is there outlives the process.

#include <libmesh/stream/cancellable_progress.hpp>
#include <libmesh/stream/state_record.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace treeform::detail::stream {

/// Held by one process at a time, or shared by several. What is stored in it stays until `remove`,
/// so that the same call can go on; a folder without anything ends with its last holder.
class TREEFORM_API work_folder {
  public:
    enum class use : std::uint8_t {
        alone,
        shared,
        member
    };  ///< of several ranks, the root holds it

    /// Makes the folder, or takes over what an earlier run has left. `job` is one word for what is
    /// done there.
    /// \throws io_error when it cannot be made, holds other files, is in use, or is for another
    ///         job
    work_folder(std::filesystem::path path, const std::string& job, use how = use::alone);
    /// Holds it this way from now on. \throws io_error when it is in use; then it is not held
    void hold(use how);
    /// The same alone, for who shares it: waits a little for others that are about to end.
    /// \throws io_error when it is in use; cancelled
    void hold_alone(cancellable_progress& pace);
    ~work_folder();
    work_folder(const work_folder&) = delete;
    work_folder& operator=(const work_folder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path file(const std::string& name) const { return path_ / name; }

    /// What is stored under `name`; none when it is not there or is not whole.
    [[nodiscard]] std::optional<state_reader> load(const std::string& name) const;
    /// A name that nobody else uses, on any machine.
    [[nodiscard]] static std::string own_name(const std::string& name);
    /// Gives the file `from` the name `to`, which it may have already. \throws io_error
    void rename(const std::string& from, const std::string& to) const;
    /// Stores it: whole, or not at all. \throws io_error
    void store(const std::string& name, const state_writer& state) const;

    /// Removes all files but the lock.
    void clear() const;
    /// Removes the folder.
    void remove();

    /// What those say who share a folder. \throws io_error
    [[noreturn]] void fail_without_tiles() const;
    [[noreturn]] void fail_with_other_tiles() const;
    /// Names the first hundred. \pre one at least
    [[noreturn]] void fail_unfinished(const std::vector<std::size_t>& tiles) const;

  private:
    [[nodiscard]] bool try_to(use how) const;
    void remove_unused() noexcept;

    std::filesystem::path path_;
    int lock_ = -1;
    use how_ = use::alone;
};

/// Holds a shared folder alone for its life.
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
