#include "bytes.hpp"
#include <treeform/mesh/read.hpp>
#include <treeform/tf.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

/// A file that goes away with the process.
class temporary {
  public:
    temporary()
        : path_(std::filesystem::temp_directory_path() /
                ("treeform-fuzz-" + std::to_string(getpid()) + ".urdf")) {}
    ~temporary() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    temporary(const temporary&) = delete;
    temporary& operator=(const temporary&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

void check(const tf::urdf_robot& robot) {
    const std::size_t links = robot.links.size();
    for (const tf::urdf_joint& one : robot.joints)
        tf::fuzz::require(one.parent < links && one.child < links, "a joint of links");
    for (const tf::urdf_mesh& one : robot.meshes) {
        tf::fuzz::require(one.link < links, "a mesh of a link");
        tf::fuzz::require(one.file.empty() != one.shape.faces.empty(), "a file or a shape");
        for (const tf::point3& p : one.shape.points)
            tf::fuzz::require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                              "finite corners of shapes");
    }
    tf::fuzz::require(robot.link_transforms({}).size() == links, "a place for each link");
    static_cast<void>(robot.adjacent());
}

}  // namespace

/// What `read_urdf` promises for any bytes: a robot whose numbers make sense, or io_error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const temporary file;
    {
        std::ofstream out(file.path(), std::ios::binary);
        out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    }
    try {
        check(tf::read_urdf(file.path()));
    } catch (const tf::io_error&) {
        return -1;  // nothing to learn for the corpus
    }
    return 0;
}
