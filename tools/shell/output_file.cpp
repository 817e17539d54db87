#include "tools/shell/output_file.hpp"

#include "tools/shell/exit_status.hpp"

#include <fcntl.h>
#include <linux/fs.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <system_error>

namespace tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
    throw failure(bad_output, "output", path.string() + ": " + why);
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

fs::path followed(const fs::path& path) {
    std::error_code error;
    if (!fs::is_symlink(path, error)) return path;
    fs::path target = fs::canonical(path, error);
    return error ? path : target;
}

/// Moves `from` to `to`; without `force` only where nothing is. Filesystems that cannot do so in
/// one step get a link, which fails in the same way where there is something.
bool move_into_place(const fs::path& from, const fs::path& to, bool force) {
    if (force) return rename(from.c_str(), to.c_str()) == 0;
    if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
    if (errno == EEXIST) return false;
    return link(from.c_str(), to.c_str()) == 0 && unlink(from.c_str()) == 0;
}

/// The last call that failed says why.
[[noreturn]] void refuse_by_errno(const fs::path& path) {
    if (errno == ENOMEM) throw std::bad_alloc();
    refuse(path, std::string("cannot be written: ") + std::generic_category().message(errno));
}

}  // namespace

bool written_directly(const fs::path& path) {
    if (path == "-") return true;
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void check_output(const fs::path& path, bool force) {
    if (written_directly(path)) return;
    std::error_code error;
    const fs::path folder = folder_of(path);
    if (!fs::is_directory(folder, error)) refuse(path, "there is no folder " + folder.string());
    if (fs::is_directory(path, error)) refuse(path, "is a folder");
    if (fs::exists(path, error) && !force) refuse(path, "exists; -f overwrites it");
    if (access(folder.c_str(), W_OK) != 0)
        refuse(path, "cannot write to folder " + folder.string() + ": " +
                         std::generic_category().message(errno));
}

output_place::output_place(fs::path path, bool force)
    : path_(std::move(path)), target_(followed(path_)), writable_(path_), force_(force) {
    check_output(path_, force_);
    if (written_directly(path_)) return;
    if (!folder_.make_folder((folder_of(target_) / ".unfinished-XXXXXX").string()))
        refuse_by_errno(path_);
    writable_ = fs::path(folder_.path()) / target_.filename();
}

void output_place::commit() {
    if (folder_.path().empty()) return;
    struct stat before {};
    if (force_ && stat(target_.c_str(), &before) == 0)
        static_cast<void>(chmod(writable_.c_str(), before.st_mode & 07777));
    if (!move_into_place(writable_, target_, force_))
        refuse(path_, errno == EEXIST ? "exists; -f overwrites it"
                                      : std::string("cannot be renamed into place: ") +
                                            std::generic_category().message(errno));
}

std::string output_place::said_of_path(std::string text) const {
    const std::string& name = writable_.native();
    const std::string& shown = path_.native();
    if (name.empty() || name == shown) return text;
    for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; at += shown.size())
        text.replace(at, name.size(), shown);
    return text;
}

output_file::output_file(const fs::path& path, bool force)
    : place_(path, force),
      file_(path == "-" ? stdout : std::fopen(place_.writable().c_str(), "wb")) {
    if (file_ == nullptr) fail();
}

output_file::~output_file() {
    if (file_ != nullptr && file_ != stdout) std::fclose(file_);
}

void output_file::write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail();
}

void output_file::write_full_pieces(std::string& text) {
    constexpr std::size_t piece = std::size_t{1} << 16;
    if (text.size() < piece) return;
    write(text);
    text.clear();
}

void output_file::finish() {
    if (file_ == nullptr) return;
    if (std::fflush(file_) != 0) fail();
    if (file_ == stdout) return;
    const int closed = std::fclose(file_);
    file_ = nullptr;
    if (closed != 0) fail();
}

void output_file::commit() {
    finish();
    place_.commit();
}

void output_file::fail() const {
    refuse_by_errno(place_.path() == "-" ? fs::path("standard output") : place_.path());
}

}  // namespace tools
