#include <libmesh/io/sink.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace treeform::detail::io {

void sink::flush() {
    check_cancelled();
    const char* at = buffer_.data();
    std::size_t left = used_;
    flushed_ += used_;
    used_ = 0;
    if (memory_ != nullptr) {
        memory_->append(at, left);
        return;
    }
    while (left > 0) {
        const ssize_t written = ::write(fd_, at, left);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw io_error(name_, {errno, std::generic_category()});
        at += written;
        left -= static_cast<std::size_t>(written);
    }
}

void sink::skip(std::uint64_t bytes) {
    flush();
    if (bytes > 0 && ::lseek(fd_, static_cast<off_t>(bytes), SEEK_CUR) == static_cast<off_t>(-1))
        throw io_error(name_, {errno, std::generic_category()});
}

bool sink::can_replace() const {
    return memory_ != nullptr || ::lseek(fd_, 0, SEEK_CUR) != static_cast<off_t>(-1);
}

void sink::replace(std::size_t at, std::string_view bytes) {
    flush();
    if (memory_ != nullptr) {
        memory_->replace(at, bytes.size(), bytes);
        return;
    }
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(fd_, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw io_error(name_, {errno, std::generic_category()});
        at += static_cast<std::size_t>(written);
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

output_file::output_file(const std::filesystem::path& path)
    : name_(path == "-" ? std::string("stdout") : path.string()), target_(path) {
    if (path == "-") {
        fd_ = STDOUT_FILENO;
        return;
    }
    std::error_code none;
    const std::filesystem::path real = std::filesystem::canonical(path, none);
    if (!none) target_ = real;  // a link stays a link to what it names
    struct stat status {};
    const bool exists = ::stat(target_.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
    if (exists && !S_ISREG(status.st_mode)) {
        fd_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
        if (fd_ < 0) fail(errno);
        return;
    }
    constexpr int flags = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;
    for (int attempt = 0; fd_ < 0; ++attempt) {
        beside_ = target_;
        beside_ += ".part" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
        fd_ = ::open(beside_.c_str(), flags, 0666);
        if (fd_ < 0 && (errno != EEXIST || attempt == 1000)) {
            beside_.clear();
            fail(errno);
        }
    }
    if (exists) (void)::fchmod(fd_, status.st_mode & 07777);
}

output_file::~output_file() {
    if (fd_ > STDERR_FILENO) ::close(fd_);
    if (!beside_.empty()) ::unlink(beside_.c_str());
}

void output_file::commit() {
    // Closing reports errors that a network file system has put off.
    if (fd_ > STDERR_FILENO && ::close(fd_) != 0) {
        fd_ = -1;
        fail(errno);
    }
    fd_ = -1;
    if (beside_.empty()) return;
    if (std::rename(beside_.c_str(), target_.c_str()) != 0) fail(errno);
    beside_.clear();
}

void output_file::fail(int error) const { throw io_error(name_, {error, std::generic_category()}); }

}  // namespace treeform::detail::io
