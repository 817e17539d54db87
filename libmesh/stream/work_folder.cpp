#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/work_folder.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <system_error>

namespace treeform::detail::stream {
namespace {

namespace fs = std::filesystem;

const char* const lock_name = "lock";

using reason = stream_error::reason;

[[noreturn]] void refuse(reason why, const fs::path& path, const std::string& text) {
    throw stream_error(why, path, path.string() + ": " + text);
}

}  // namespace

work_folder::work_folder(fs::path path, const std::string& job, use how)
    : path_(std::move(path)), how_(how) {
    std::error_code error;
    fs::create_directory(path_, error);
    if (error) refuse(reason::folder, path_, "cannot be made: " + error.message());
    const fs::path lock = path_ / lock_name;
    if (!fs::exists(lock) && !fs::is_empty(path_))
        refuse(reason::folder_foreign, path_, "holds files of others");
    lock_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0)
        refuse(reason::folder, path_,
               std::string("cannot be written to: ") + std::generic_category().message(errno));
    try {
        hold(how);
        std::array<char, 32> was{};
        const ssize_t size = ::pread(lock_, was.data(), was.size(), 0);
        if (size > 0 && job != std::string_view(was.data(), static_cast<std::size_t>(size)))
            refuse(reason::folder_foreign, path_, "holds the files of another job");
        if (size <= 0 && ::pwrite(lock_, job.data(), job.size(), 0) < 0)
            refuse(reason::folder, path_,
                   std::string("cannot be written to: ") + std::generic_category().message(errno));
    } catch (...) {
        ::close(lock_);
        throw;
    }
}

void work_folder::hold(use how) {
    if (how == use::member) return;
    const auto try_to = [this](use wanted) {
        return ::flock(lock_, (wanted == use::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0;
    };
    if (!try_to(how)) {
        static_cast<void>(try_to(how_));  // which a lock that could not be had has ended
        refuse(reason::folder_in_use, path_, "is in use by another process");
    }
    how_ = how;
}

held_alone::~held_alone() {
    try {
        folder_.hold(work_folder::use::shared);
    } catch (const stream_error&) {  // another process has it now; what is next will say so
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
    if (error) refuse(reason::folder, file(to), "cannot be written: " + error.message());
}

work_folder::~work_folder() { ::close(lock_); }

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

void work_folder::remove_unused() {
    const fs::directory_iterator all(path_);
    if (std::all_of(begin(all), end(all),
                    [](const auto& entry) { return entry.path().filename() == lock_name; }))
        remove();
}

void work_folder::remove() {
    clear();
    fs::remove(path_ / lock_name);
    std::error_code ignored;
    fs::remove(path_, ignored);
}

}  // namespace treeform::detail::stream
