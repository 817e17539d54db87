#include <libmesh/io/source.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tree/parallel.hpp>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

namespace treeform::detail::io {

namespace {

constexpr std::size_t release_step = std::size_t{8} << 20;

[[noreturn]] void fail_system(const std::string& name, int error) {
    throw io_error(name, {error, std::generic_category()});
}

/// Closes a descriptor that is ours; standard input is not.
class descriptor {
  public:
    explicit descriptor(int fd) : fd_(fd) {}
    descriptor(const descriptor&) = delete;
    descriptor& operator=(const descriptor&) = delete;
    ~descriptor() {
        if (fd_ > STDIN_FILENO) ::close(fd_);
    }
    [[nodiscard]] int get() const { return fd_; }

  private:
    int fd_;
};

struct heap_bytes {
    std::unique_ptr<char, decltype(&std::free)> data{nullptr, &std::free};
    std::size_t size = 0;
};

/// Grows by realloc, which moves large blocks by their pages and needs no second copy.
heap_bytes read_to_end(int fd, const std::string& name) {
    heap_bytes bytes;
    std::size_t capacity = 0;
    for (;;) {
        if (bytes.size == capacity) {
            capacity = capacity == 0 ? std::size_t{1} << 16 : capacity + capacity / 2;
            void* larger = std::realloc(bytes.data.get(), capacity);
            if (larger == nullptr) throw std::bad_alloc();
            (void)bytes.data.release();
            bytes.data.reset(static_cast<char*>(larger));
        }
        const ssize_t got = ::read(fd, bytes.data.get() + bytes.size, capacity - bytes.size);
        if (got == 0) return bytes;
        if (got > 0)
            bytes.size += static_cast<std::size_t>(got);
        else if (errno != EINTR)
            fail_system(name, errno);
    }
}

/// Returns how many bytes there were.
std::size_t copy_to_end(int from, int to, const std::string& name) {
    std::vector<char> buffer(std::size_t{1} << 20);
    for (std::size_t size = 0;;) {
        const ssize_t got = ::read(from, buffer.data(), buffer.size());
        if (got == 0) return size;
        if (got < 0 && errno != EINTR) fail_system(name, errno);
        for (ssize_t put = 0; put < got;) {
            const ssize_t some =
                ::write(to, buffer.data() + put, static_cast<std::size_t>(got - put));
            if (some < 0 && errno != EINTR) fail_system(name + ": scratch file", errno);
            put += std::max<ssize_t>(some, 0);
        }
        size += static_cast<std::size_t>(std::max<ssize_t>(got, 0));
    }
}

}  // namespace

bool source::map(int fd, std::size_t size) {
    void* const map = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0);
    if (map == MAP_FAILED) return false;
    ::madvise(map, size, MADV_SEQUENTIAL);
    begin_ = static_cast<const char*>(map);
    size_ = size;
    owner_ = owner::map;
    rewind();
    return true;
}

source source::open(const std::filesystem::path& path, scratch_place unmapped) {
    source s;
    s.name_ = path == "-" ? std::string("stdin") : path.string();
    const descriptor file(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat status {};
    if (file.get() < 0 || ::fstat(file.get(), &status) != 0) fail_system(s.name_, errno);
    if (S_ISDIR(status.st_mode)) fail_system(s.name_, EISDIR);
    // Files of the proc kind say that they are empty; only reading tells.
    if (S_ISREG(status.st_mode) && status.st_size > 0 && path != "-" &&
        s.map(file.get(), static_cast<std::size_t>(status.st_size)))
        return s;
    if (unmapped == scratch_place::file) {
        const descriptor spool(open_nameless_file(s.name_));
        const std::size_t size = copy_to_end(file.get(), spool.get(), s.name_);
        if (size > 0 && s.map(spool.get(), size)) return s;
        if (size > 0) fail_system(s.name_, errno);
    }
    heap_bytes bytes = read_to_end(file.get(), s.name_);
    s.size_ = bytes.size;
    s.begin_ = bytes.data.release();
    s.owner_ = owner::heap;
    s.rewind();
    return s;
}

source::source(std::span<const std::byte> bytes, std::string_view name)
    : begin_(reinterpret_cast<const char*>(bytes.data())), size_(bytes.size()), name_(name) {
    rewind();
}

source::source(source&& other) noexcept
    : begin_(std::exchange(other.begin_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      name_(std::move(other.name_)),
      owner_(std::exchange(other.owner_, owner::caller)),
      released_(other.released_),
      release_at_(other.release_at_) {}

source::~source() {
    if (owner_ == owner::map) ::munmap(const_cast<char*>(begin_), size_);
    if (owner_ == owner::heap) std::free(const_cast<char*>(begin_));
}

void source::release(const char* at) const {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const std::size_t bytes = static_cast<std::size_t>(at - released_) / page * page;
    if (bytes == 0) return;
    ::madvise(const_cast<char*>(released_), bytes, MADV_DONTNEED);
    released_ += bytes;
    plan_release();
}

void source::rewind() const {
    released_ = begin_;
    plan_release();
}

void source::plan_release() const {
    const bool worth =
        owner_ == owner::map && static_cast<std::size_t>(end() - released_) > release_step;
    release_at_ = worth ? released_ + release_step : end();
}

std::size_t source::count_newlines() const {
    constexpr std::size_t piece = std::size_t{1} << 20;
    constexpr std::size_t at_once = 32 * piece;  // so that memory can be given back on the way
    std::vector<std::size_t> counts(chunk_count(std::min(size_, at_once), piece));
    std::size_t sum = 0;
    for (const char* at = begin_; at < end();) {
        const std::size_t some = std::min(static_cast<std::size_t>(end() - at), at_once);
        for_chunks(some, piece, [&](std::size_t first, std::size_t last, std::size_t chunk) {
            counts[chunk] = static_cast<std::size_t>(std::count(at + first, at + last, '\n'));
        });
        for (std::size_t chunk = 0; chunk < chunk_count(some, piece); ++chunk) sum += counts[chunk];
        at += some;
        release_before(at);
    }
    rewind();
    return sum;
}

std::size_t source::line_of(const char* at) const {
    std::size_t line = 1;
    for (const char* p = begin_; p < at; ++p)
        // A carriage return ends a line unless a line feed does so right after it.
        line += *p == '\n' || (*p == '\r' && (p + 1 == end() || p[1] != '\n')) ? 1U : 0U;
    return line;
}

void source::fail_line(const char* at, std::string_view reason) const {
    throw io_error(name_ + ':' + std::to_string(line_of(at)) + ": " + std::string(reason));
}

void source::fail_byte(const char* at, std::string_view reason) const {
    throw io_error(name_ + ": byte " + std::to_string(at - begin_) + ": " + std::string(reason));
}

void source::fail(std::string_view reason) const {
    throw io_error(name_ + ": " + std::string(reason));
}

}  // namespace treeform::detail::io
