#pragma once
/// \file
/// Files a tool writes: complete under their name, or not there at all.

#include "tools/shell/abrupt_exit.hpp"

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace tools {

/// Whether `path` is a thing to write into rather than a file to make: "-", a pipe or a device.
[[nodiscard]] bool written_directly(const std::filesystem::path& path);

/// \throws failure (bad_output) when `path` exists as a file and `force` is not set, or its folder
///         is missing. "-", pipes and devices always pass.
void check_output(const std::filesystem::path& path, bool force);

/// Makes the file at `path`, where one is named, of what `write` puts into the `output_file`.
/// \throws failure (bad_output)
template <class Write>
void write_file(const std::filesystem::path& path, bool force, const Write& write);

/// A name in a new folder beside `path` to write to, and the move that makes it final. Without a
/// `commit` nothing stays, also when the process is stopped, whatever else a writer has put into
/// the folder. For "-", pipes and devices the name is `path` itself.
class output_place {
  public:
    /// \throws failure (bad_output) as `check_output` does
    output_place(std::filesystem::path path, bool force);
    output_place(const output_place&) = delete;
    output_place& operator=(const output_place&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] const std::filesystem::path& writable() const { return writable_; }
    /// The new folder, which is all that stays when the process is killed; empty where none is
    /// needed.
    [[nodiscard]] std::filesystem::path folder() const { return folder_.path(); }
    /// \throws failure (bad_output), also when `path` has come into being without `force`
    void commit();

    /// What a writer says of `writable()`, said of `path()`.
    [[nodiscard]] std::string said_of_path(std::string text) const;

  private:
    std::filesystem::path path_;
    std::filesystem::path target_;  ///< `path_` with links followed
    unfinished_path folder_;        ///< made for this; none when written to directly
    std::filesystem::path writable_;
    bool force_;
};

/// A file written from memory.
class output_file {
  public:
    output_file(const std::filesystem::path& path, bool force);
    ~output_file();
    output_file(const output_file&) = delete;
    output_file& operator=(const output_file&) = delete;

    /// As that of an `output_place`.
    [[nodiscard]] std::filesystem::path folder() const { return place_.folder(); }
    /// \throws failure (bad_output) when the device is full or the reader has gone
    void write(std::string_view bytes);
    /// Writes and empties `text` where it is long, so that that of a million lines is never in
    /// memory at once.
    void write_full_pieces(std::string& text);
    /// Hands over all that was written, so that a full device is known of before a `commit` of
    /// another file. \throws failure (bad_output)
    void finish();
    void commit();

  private:
    [[noreturn]] void fail() const;

    output_place place_;
    std::FILE* file_ = nullptr;
};

template <class Write>
void write_file(const std::filesystem::path& path, bool force, const Write& write) {
    if (path.empty()) return;
    output_file file(path, force);
    write(file);
    file.commit();
}

}  // namespace tools
