#pragma once
/// \file
/// A folder for the files of a test.

#include <unistd.h>

#include <filesystem>
#include <string>

namespace test {

/// In the folder for temporary files, empty at first; it goes with this.
class own_folder {
  public:
    explicit own_folder(const std::string& name)
        : path(std::filesystem::temp_directory_path() / (name + "." + std::to_string(::getpid()))) {
        std::filesystem::remove_all(path);
        std::filesystem::create_directories(path);
    }
    own_folder(const own_folder&) = delete;
    own_folder& operator=(const own_folder&) = delete;
    ~own_folder() { std::filesystem::remove_all(path); }

    const std::filesystem::path path;
};

}  // namespace test
