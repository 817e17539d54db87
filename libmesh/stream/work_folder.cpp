#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/work_folder.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <system_error>
#include <thread>

namespace treeform::detail::stream {
namespace {

namespace fs = std::filesystem;

const char* const lock_name = "lock";

using kind = io_error::kind;

[[noreturn]] void refuse(kind why, const fs::path& path, const std::string& text) {
    throw io_error(why, path, path.string() + ": " + text);
}

}  // namespace

work_folder::work_folder(fs::path path, const std::string& job, use how)
    : path_(std::move(path)), how_(how) {
    std::error_code error;
    fs::create_directory(path_, error);
    if (error) refuse(kind::folder, path_, "cannot be created: " + error.message());
    const fs::path lock = path_ / lock_name;
    if (!fs::exists(lock) && !fs::is_empty(path_))
        refuse(kind::folder_foreign, path_, "contains files of other programs");
    lock_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0)
        refuse(kind::folder, path_,
               std::string("cannot be written to: ") + std::generic_category().message(errno));
    try {
        hold(how);
        std::array<char, 32> was{};
        const ssize_t size = ::pread(lock_, was.data(), was.size(), 0);
        if (size > 0 && job != std::string_view(was.data(), static_cast<std::size_t>(size)))
            refuse(kind::folder_foreign, path_, "contains the files of another job");
        if (size <= 0 && ::pwrite(lock_, job.data(), job.size(), 0) < 0)
            refuse(kind::folder, path_,
                   std::string("cannot be written to: ") + std::generic_category().message(errno));
    } catch (...) {
        ::close(lock_);
        throw;
    }
}

bool work_folder::try_to(use how) const {
    return ::flock(lock_, (how == use::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0;
}

void work_folder::hold(use how) {
    if (how != use::member && !try_to(how))
        refuse(kind::folder_in_use, path_, "is in use by another process");
}

/// Several that wait hold nothing meanwhile, so that one of them gets it.
void work_folder::hold_alone(cancellable_progress& pace) {
    constexpr auto pause = std::chrono::milliseconds(20);
    for (int left = 100; !try_to(use::alone); --left) {
        hold(use::shared);
        if (left == 0) refuse(kind::folder_in_use, path_, "is in use by another process");
        ::flock(lock_, LOCK_UN);
        std::this_thread::sleep_for(pause);
        pace.check();
    }
}

held_alone::~held_alone() {
    try {
        folder_.hold(work_folder::use::shared);
    } catch (const io_error&) {  // another process has it now; what is next will say so
    }
}

std::string work_folder::own_name(const std::string& name) {
    std::array<char, 256> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
    static std::atomic<std::uint64_t> used{0};
    return name + "." + host.data() + "." + std::to_string(::getpid()) + "." +
           std::to_string(++used);
}

void work_folder::rename(const std::string& from, const std::string& to) const {
    std::error_code error;
    fs::rename(file(from), file(to), error);
    if (error) refuse(kind::folder, file(to), "cannot be written: " + error.message());
}

work_folder::~work_folder() {
    if (how_ != use::member) remove_unused();
    ::close(lock_);
}

std::optional<state_reader> work_folder::load(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    std::ostringstream bytes;
    if (!in || !(bytes << in.rdbuf())) return std::nullopt;
    state_reader state(bytes.str());
    if (!state.whole()) return std::nullopt;
    return state;
}

void work_folder::store(const std::string& name, const state_writer& state) const {
    const std::string own = own_name(name);
    const fs::path part = file(own);
    fs::remove(part);
    const std::string bytes = state.bytes();
    append_to(part, std::as_bytes(std::span(bytes)));
    sync_file(part);
    rename(own, name);
}

void work_folder::clear() const {
    for (const auto& entry : fs::directory_iterator(path_))
        if (entry.path().filename() != lock_name) fs::remove(entry.path());
}

/// Not where another holds it, or where the folder of that name is another by now.
void work_folder::remove_unused() noexcept {
    const auto is_unused = [&] {
        std::error_code error;
        fs::directory_iterator entries(path_, error);
        for (; !error && entries != fs::directory_iterator(); entries.increment(error))
            if (entries->path().filename() != lock_name) return false;
        return !error;
    };
    if (!is_unused()) return;  // before the lock: others may want a part of it
    struct stat lock {};
    if (!try_to(use::alone) || ::fstat(lock_, &lock) != 0 || lock.st_nlink == 0) return;
    if (!is_unused()) return;
    std::error_code error;
    fs::remove(path_ / lock_name, error);
    fs::remove(path_, error);
}

void work_folder::fail_without_tiles() const {
    refuse(kind::tile_read, path_, "contains no tiles of this input with these options");
}

void work_folder::fail_with_other_tiles() const {
    refuse(kind::folder, path_,
           "contains tiles of another input or other options, or damaged tiles; first remove it");
}

void work_folder::fail_unfinished(const std::vector<std::size_t>& tiles) const {
    constexpr std::size_t most = 100;
    std::string text = tiles.size() == 1 ? "tile " : "tiles ";
    for (std::size_t i = 0; i < std::min(most, tiles.size()); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(tiles[i]);
    if (tiles.size() > most) text += " and " + std::to_string(tiles.size() - most) + " more";
    refuse(kind::tile_read, path_,
           text + (tiles.size() == 1 ? " is" : " are") + " unfinished or damaged");
}

void work_folder::remove() {
    clear();
    fs::remove(path_ / lock_name);
    std::error_code ignored;
    fs::remove(path_, ignored);
}

}  // namespace treeform::detail::stream
