#include <libmesh/stream/record_file.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace treeform::detail::stream {
namespace {

constexpr std::size_t word = 8;

std::uint64_t digest_of(std::string_view bytes) {
    digest d;
    d.add(std::as_bytes(std::span(bytes)));
    return d.value();
}

class descriptor {
  public:
    descriptor(const std::filesystem::path& path, int flags)
        : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
    ~descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    descriptor(const descriptor&) = delete;
    descriptor& operator=(const descriptor&) = delete;
    [[nodiscard]] int get() const { return fd_; }

  private:
    int fd_;
};

using kind = io_error::kind;

[[noreturn]] void fail(kind why, const std::filesystem::path& path) {
    const char* const what = why == kind::tile_write ? "written" : "read";
    throw io_error(
        why, path,
        path.string() + ": cannot be " + what + ": " + std::generic_category().message(errno));
}

}  // namespace

void state_writer::number(std::uint64_t n) {
    char bytes[word];
    std::memcpy(bytes, &n, word);
    bytes_.append(bytes, word);
}

void state_writer::real(double x) { number(std::bit_cast<std::uint64_t>(x)); }

void state_writer::point(const point3& p) {
    for (std::size_t k = 0; k < 3; ++k) real(p[k]);
}

void state_writer::text(std::string_view s) {
    number(s.size());
    bytes_ += s;
    bytes_.append((word - s.size() % word) % word, '\0');
}

std::string state_writer::bytes() const {
    state_writer all = *this;
    all.number(digest_of(bytes_));
    return std::move(all.bytes_);
}

state_reader::state_reader(std::string bytes) : bytes_(std::move(bytes)) {
    if (bytes_.size() < word || bytes_.size() % word != 0) return;
    end_ = bytes_.size() - word;
    std::uint64_t stored = 0;
    std::memcpy(&stored, bytes_.data() + end_, word);
    whole_ = stored == digest_of(std::string_view(bytes_).substr(0, end_));
}

std::uint64_t state_reader::number() {
    whole_ = whole_ && at_ < end_;
    if (!whole_) return 0;
    std::uint64_t n = 0;
    std::memcpy(&n, bytes_.data() + at_, word);
    at_ += word;
    return n;
}

double state_reader::real() { return std::bit_cast<double>(number()); }

point3 state_reader::point() {
    point3 p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = real();
    return p;
}

std::string state_reader::text() {
    const std::uint64_t size = number();
    whole_ = whole_ && size <= end_ - at_;
    if (!whole_) return {};
    std::string s = bytes_.substr(at_, size);
    at_ += size + (word - size % word) % word;
    return s;
}

void digest::add(std::span<const std::byte> bytes) {
    for (std::size_t i = 0; i + 8 <= bytes.size(); i += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + i, 8);
        value_ = std::rotl((value_ ^ word) * 0xd1342543de82ef95, 29);
    }
}

void store_count(const record_count& c, state_writer& state) { state.numbers(c.records, c.digest); }

record_count load_count(state_reader& state) { return {state.number(), state.number()}; }

void store_warnings(const std::vector<io_warning>& warnings, state_writer& state) {
    state.number(warnings.size());
    for (const io_warning& w : warnings) {
        state.text(w.code);
        state.text(w.text);
    }
}

std::vector<io_warning> load_warnings(state_reader& state) {
    std::vector<io_warning> warnings;
    for (std::uint64_t left = state.number(); left > 0 && state.whole(); --left)
        warnings.push_back({state.text(), state.text()});
    return warnings;
}

void append_to(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    const descriptor file(path, O_WRONLY | O_CREAT | O_APPEND);
    if (file.get() < 0) fail(kind::tile_write, path);
    while (!bytes.empty()) {
        const ssize_t count = ::write(file.get(), bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(kind::tile_write, path);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void write_to(const std::filesystem::path& path, std::uint64_t at,
              std::span<const std::byte> bytes) {
    const descriptor file(path, O_WRONLY);
    if (file.get() < 0) fail(kind::tile_write, path);
    while (!bytes.empty()) {
        const ssize_t count =
            ::pwrite(file.get(), bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(kind::tile_write, path);
        at += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void sync_file(const std::filesystem::path& path) {
    const descriptor file(path, O_WRONLY);
    if (file.get() < 0 || ::fdatasync(file.get()) != 0) fail(kind::tile_write, path);
}

open_file::open_file(std::filesystem::path path)
    : path_(std::move(path)), fd_(::open(path_.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (fd_ < 0) fail(kind::tile_read, path_);
}

open_file::~open_file() { ::close(fd_); }

std::size_t open_file::read(std::uint64_t at, std::span<std::byte> bytes) const {
    std::size_t read = 0;
    while (read < bytes.size()) {
        const ssize_t count =
            ::pread(fd_, bytes.data() + read, bytes.size() - read, static_cast<off_t>(at + read));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(kind::tile_read, path_);
        if (count == 0) break;
        read += static_cast<std::size_t>(count);
    }
    return read;
}

std::size_t read_from(const std::filesystem::path& path, std::uint64_t at,
                      std::span<std::byte> bytes) {
    return bytes.empty() ? 0 : open_file(path).read(at, bytes);
}

std::optional<std::uint64_t> size_of(const std::filesystem::path& path) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    return error ? std::nullopt : std::optional(size);
}

void fail_damaged(const std::filesystem::path& path) {
    throw io_error(kind::tile_damaged, path,
                   path.string() + ": damaged; remove the folder and start again");
}

}  // namespace treeform::detail::stream
