#include "tools/shell/file_names.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

using names = std::vector<std::string>;

/// A folder that goes with the object.
class touched_folder {
  public:
    touched_folder()
        : path_(std::filesystem::temp_directory_path() /
                ("folder_files_test." + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path_);
    }
    touched_folder(const touched_folder&) = delete;
    touched_folder& operator=(const touched_folder&) = delete;
    ~touched_folder() { std::filesystem::remove_all(path_); }

    [[nodiscard]] std::string operator/(const std::string& name) const {
        return (path_ / name).string();
    }
    void touch(const std::string& name) const { std::ofstream(path_ / name) << "x"; }

  private:
    std::filesystem::path path_;
};

}  // namespace

TEST_CASE("files of a folder: those of a format, by name, and none of what is deeper") {
    const touched_folder in;
    for (const char* const name : {"b.obj", "a.STL", "c.xyz", "notes.txt", "obj", "a10.ply"})
        in.touch(name);
    std::filesystem::create_directories(in / "deep.obj");
    std::filesystem::create_directories(in / "empty");
    in.touch("deep.obj/d.obj");
    const names folder{in / ""};
    const names meshes{"ply", "stl", "obj"}, points{"obj", "ply", "stl", "xyz"};
    CHECK(tools::files_of(folder, meshes) == names{in / "a.STL", in / "a10.ply", in / "b.obj"});
    CHECK(tools::files_of(folder, points) ==
          names{in / "a.STL", in / "a10.ply", in / "b.obj", in / "c.xyz"});
    // Files are as they are named, and in the order in which they are.
    const names mixed{"-", in / "notes.txt", in / "deep.obj", "missing.stl", in / "empty"};
    CHECK(tools::files_of(mixed, meshes) ==
          names{"-", in / "notes.txt", in / "deep.obj/d.obj", "missing.stl", in / "empty"});
    CHECK(tools::files_of({}, meshes).empty());
}
