#include <libmesh/io/zip_builder.hpp>

#include <minizip/zip.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

namespace treeform::detail::io {

/// A place in the bytes of the archive, which the library moves. It is written in C, so nothing
/// may be thrown through it.
struct zip_builder::stream {
    std::string* bytes;
    std::size_t at = 0;

    static voidpf open(voidpf self, const void*, int) { return self; }
    static uLong read(voidpf self, voidpf, void* to, uLong size) {
        auto& s = *static_cast<stream*>(self);
        const std::size_t count = std::min<std::size_t>(size, s.bytes->size() - s.at);
        std::memcpy(to, s.bytes->data() + s.at, count);
        s.at += count;
        return count;
    }
    static uLong write(voidpf self, voidpf, const void* from, uLong size) {
        auto& s = *static_cast<stream*>(self);
        const std::size_t over = std::min<std::size_t>(size, s.bytes->size() - s.at);
        try {
            s.bytes->replace(s.at, over, static_cast<const char*>(from), size);
        } catch (const std::exception&) {
            return 0;
        }
        s.at += size;
        return size;
    }
    static ZPOS64_T tell(voidpf self, voidpf) { return static_cast<stream*>(self)->at; }
    static long seek(voidpf self, voidpf, ZPOS64_T offset, int origin) {
        auto& s = *static_cast<stream*>(self);
        const std::size_t from = origin == ZLIB_FILEFUNC_SEEK_SET   ? 0
                                 : origin == ZLIB_FILEFUNC_SEEK_CUR ? s.at
                                                                    : s.bytes->size();
        if (offset > s.bytes->size() - from) return -1;
        s.at = from + offset;
        return 0;
    }
    static int close(voidpf, voidpf) { return 0; }
    static int error(voidpf, voidpf) { return 0; }
};

zip_builder::zip_builder(std::string& bytes) {
    auto place = std::make_unique<stream>(stream{.bytes = &bytes});
    zlib_filefunc64_def calls{};
    calls.zopen64_file = stream::open;
    calls.zread_file = stream::read;
    calls.zwrite_file = stream::write;
    calls.ztell64_file = stream::tell;
    calls.zseek64_file = stream::seek;
    calls.zclose_file = stream::close;
    calls.zerror_file = stream::error;
    calls.opaque = place.get();
    file_ = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &calls);
    if (file_ == nullptr) throw std::bad_alloc();
    stream_ = place.release();
}

zip_builder::~zip_builder() {
    if (file_ != nullptr) zipClose(file_, nullptr);
    delete stream_;
}

void zip_builder::begin(const char* name, std::size_t most_bytes) {
    zip_fileinfo about{};
    about.dosDate = 1U << 21 | 1U << 16;  // 1980-01-01 00:00, where the count of years begins
    const int large = most_bytes >= std::numeric_limits<std::uint32_t>::max() ? 1 : 0;
    check(zipOpenNewFileInZip64(file_, name, &about, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED,
                                Z_DEFAULT_COMPRESSION, large));
}

void zip_builder::put(std::string_view bytes) {
    constexpr std::size_t most = std::size_t{1} << 30;  // the library counts in 32 bits
    for (; !bytes.empty(); bytes.remove_prefix(std::min(most, bytes.size())))
        check(zipWriteInFileInZip(file_, bytes.data(),
                                  static_cast<unsigned>(std::min(most, bytes.size()))));
}

void zip_builder::end() { check(zipCloseFileInZip(file_)); }

void zip_builder::finish() {
    void* const file = file_;
    file_ = nullptr;
    check(zipClose(file, nullptr));
}

void zip_builder::check(int status) const {
    // Memory is all that it can lack.
    if (status != ZIP_OK) throw std::bad_alloc();
}

}  // namespace treeform::detail::io
