#pragma once
/// \file
/// The end of a process in the middle of its work, also where there is no memory left: nothing here
/// allocates any. From its start on, a process whose memory runs out where nothing may throw, or
/// where what was thrown is not caught, ends so, with status `stopped`; after any other exception
/// that is not caught, with status `bug`.

#include <string>

namespace tools {

/// A file, or a folder with all that is in it, that is removed at the end of this, or at a sudden
/// one: then the first 256 of them, with names of at most 4,095 bytes.
class unfinished_path {
  public:
    unfinished_path() = default;
    ~unfinished_path();
    unfinished_path(const unfinished_path&) = delete;
    unfinished_path& operator=(const unfinished_path&) = delete;

    /// Once; what is there then is removed, too.
    void set(std::string path);
    /// Makes a folder and sets it; its name is `name` with the last six letters, XXXXXX, replaced.
    /// False where that fails, and errno says why.
    [[nodiscard]] bool make_folder(std::string name);
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    void remember();
    std::string path_;
};
[[nodiscard]] bool has_unfinished();

/// What is said where memory runs out, after the name of the program; at most 255 bytes. Nothing
/// where it is empty, as it is once that has been said.
void set_words_for_memory(const std::string& words);

/// Removes what is unfinished, says `words`, if any, after the name of the program, and ends the
/// process. The first thread that comes here does; others wait for the end.
[[noreturn]] void exit_abruptly(int status, const char* words);

}  // namespace tools
