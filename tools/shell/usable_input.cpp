#include "tools/shell/usable_input.hpp"

#include "tools/shell/abrupt_exit.hpp"
#include <treeform/mesh/as_mesh.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

namespace tools {
namespace {

namespace fs = std::filesystem;

/// Removes what processes that were killed have left of standard input.
void remove_spooled(const fs::path& beside) {
    const std::string start = beside.filename().string() + "-";
    const fs::path folder = beside.has_parent_path() ? beside.parent_path() : fs::path(".");
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(start)) continue;
        const std::string process = name.substr(start.size());
        if (process.empty() || process.find_first_not_of("0123456789") != std::string::npos)
            continue;
        if (!fs::exists("/proc/" + process, ignored)) fs::remove(entry.path(), ignored);
    }
}

}  // namespace

usable_input read_usable(job& work) {
    usable_input input;
    input.file = work.read();
    const auto timing = work.time("prepare");
    tf::mesh& mesh = input.file.mesh;
    const std::size_t triangles = mesh.faces.size();
    input.triangle_of_face = tf::drop_unusable_faces(mesh);
    input.non_finite = triangles - mesh.faces.size();
    work.warn_of_non_finite(input.non_finite, "face", "faces");
    if (mesh.faces.empty()) throw no_triangles(work.name, triangles, mesh.points.size());
    check_arrangeable(work.name, mesh);
    return input;
}

spooled_input::spooled_input(job& work, const fs::path& beside) : keeper_(work.keeper) {
    remove_spooled(beside);
    path_.set(beside.string() + "-" + std::to_string(::getpid()));
    fs::remove(path());
    std::ofstream spooled(path(), std::ios::binary);
    std::vector<char> bytes(std::size_t{1} << 20);
    while (true) {
        keeper_.check();
        const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw failure(bad_input, "read", "standard input cannot be read");
        if (!spooled.write(bytes.data(), count) || (count == 0 && !spooled.flush()))
            throw failure(
                bad_output, "output",
                path_.path() + ": cannot be written: " + std::generic_category().message(errno));
        if (count == 0) break;
    }
    const int file = ::open(path_.path().c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0 || ::dup2(file, STDIN_FILENO) < 0)
        throw failure(bad_input, "read", path_.path() + ": cannot be read");
    ::close(file);
}

}  // namespace tools
