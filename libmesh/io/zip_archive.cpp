#include <libmesh/io/extension.hpp>
#include <libmesh/io/zip_archive.hpp>

#include <minizip/unzip.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

namespace treeform::detail::io {

/// A place in the bytes of the archive, which the library moves.
struct zip_archive::stream {
    const source* bytes;
    std::uint64_t at = 0;
    bool cut_short = false;

    static voidpf open(voidpf self, const void*, int) { return self; }
    static uLong read(voidpf self, voidpf, void* to, uLong size) {
        auto& s = *static_cast<stream*>(self);
        const std::uint64_t count = std::min<std::uint64_t>(size, s.bytes->size() - s.at);
        if (count > 0) std::memcpy(to, s.bytes->begin() + s.at, count);
        s.at += count;
        s.cut_short = count < size;
        return static_cast<uLong>(count);
    }
    static uLong write(voidpf, voidpf, const void*, uLong) { return 0; }
    static ZPOS64_T tell(voidpf self, voidpf) { return static_cast<stream*>(self)->at; }
    static long seek(voidpf self, voidpf, ZPOS64_T offset, int origin) {
        auto& s = *static_cast<stream*>(self);
        const std::uint64_t size = s.bytes->size();
        const std::uint64_t from = origin == ZLIB_FILEFUNC_SEEK_SET   ? 0
                                   : origin == ZLIB_FILEFUNC_SEEK_CUR ? s.at
                                                                      : size;
        if (offset > size - from) return -1;
        s.at = from + offset;
        return 0;
    }
    static int close(voidpf, voidpf) { return 0; }
    /// The library takes what is missing at the end for zeros unless this says otherwise.
    static int error(voidpf self, voidpf) { return static_cast<stream*>(self)->cut_short ? 1 : 0; }
};

namespace {

/// Deflate makes at most 1032 bytes of one; the ends of a small stream are not counted so finely.
constexpr std::uint64_t most_ratio = 1032;
constexpr std::uint64_t ratio_slack = 1024;

constexpr std::uint32_t encrypted_flag = 1;
constexpr std::uint32_t deflated = 8;

/// In small letters and without a slash ahead.
[[nodiscard]] std::string package_name(std::string_view name) {
    if (name.starts_with('/')) name.remove_prefix(1);
    std::string plain(name);
    std::transform(plain.begin(), plain.end(), plain.begin(), to_lower);
    return plain;
}

/// What is wrong with the name of a member; empty when nothing is.
[[nodiscard]] std::string_view fault_of_name(std::string_view name) {
    if (name.empty()) return "an empty name";
    if (name.starts_with('/')) return "an absolute name";
    if (name.find('\\') != name.npos) return "a backslash in a name";
    if (name.find('\0') != name.npos) return "a zero byte in a name";
    for (std::size_t first = 0; first < name.size();) {
        const std::size_t slash = std::min(name.find('/', first), name.size());
        const std::string_view step = name.substr(first, slash - first);
        if (step.empty() || step == "." || step == "..") return "a name that is no plain path";
        first = slash + 1;
    }
    return {};
}

/// A name fit for an error message.
[[nodiscard]] std::string printable(std::string_view name) {
    constexpr std::size_t longest = 80;
    std::string text(name.substr(0, longest));
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return name.size() > longest ? text + "..." : text;
}

}  // namespace

zip_archive::zip_archive(const source& in) : in_(in) {
    auto place = std::make_unique<stream>(stream{.bytes = &in});
    zlib_filefunc64_def calls{};
    calls.zopen64_file = stream::open;
    calls.zread_file = stream::read;
    calls.zwrite_file = stream::write;
    calls.ztell64_file = stream::tell;
    calls.zseek64_file = stream::seek;
    calls.zclose_file = stream::close;
    calls.zerror_file = stream::error;
    calls.opaque = place.get();
    file_ = unzOpen2_64("", &calls);
    if (file_ == nullptr) in.fail("no ZIP archive, or one that is damaged or cut short");
    stream_ = place.release();
    try {
        list();
    } catch (...) {
        unzClose(file_);
        delete stream_;
        throw;
    }
}

zip_archive::~zip_archive() {
    unzClose(file_);
    delete stream_;
}

void zip_archive::list() {
    unz_global_info64 global{};
    if (unzGetGlobalInfo64(file_, &global) != UNZ_OK || global.number_entry == 0)
        in_.fail("an archive without members");
    int status = unzGoToFirstFile(file_);
    for (; status == UNZ_OK; status = unzGoToNextFile(file_)) add_current();
    if (status != UNZ_END_OF_LIST_OF_FILE) in_.fail("the directory of the archive is damaged");
}

void zip_archive::add_current() {
    unz_file_info64 info{};
    if (unzGetCurrentFileInfo64(file_, &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK)
        in_.fail("the directory of the archive is damaged");
    std::string name(info.size_filename, '\0');
    unz64_file_pos place{};
    if (unzGetCurrentFileInfo64(file_, &info, name.data(), info.size_filename, nullptr, 0, nullptr,
                                0) != UNZ_OK ||
        unzGetFilePos64(file_, &place) != UNZ_OK)
        in_.fail("the directory of the archive is damaged");
    if (const auto fault = fault_of_name(name); !fault.empty())
        in_.fail("the archive has " + std::string(fault) + ": '" + printable(name) + "'");
    if (name.ends_with('/')) return;  // a folder
    const member m{.directory_place = place.pos_in_zip_directory,
                   .number = place.num_of_file,
                   .packed = info.compressed_size,
                   .size = info.uncompressed_size,
                   .flags = static_cast<std::uint32_t>(info.flag),
                   .method = static_cast<std::uint32_t>(info.compression_method)};
    if (!members_.emplace(package_name(name), m).second) fail(name, "is twice in the archive");
}

bool zip_archive::holds(std::string_view name) const {
    return members_.contains(package_name(name));
}

void zip_archive::check(std::string_view name, const member& m) {
    if ((m.flags & encrypted_flag) != 0) fail(name, "encrypted");
    if (m.method != 0 && m.method != deflated)
        fail(name, "packed by method " + std::to_string(m.method) + "; only deflate is read");
    // Members that share bytes would be read again and again.
    packed_read_ += std::min<std::uint64_t>(m.packed, in_.size() + std::uint64_t{1});
    if (packed_read_ > in_.size()) fail(name, "announces more bytes than the archive has");
    const std::uint64_t most = m.method == 0 ? m.packed : m.packed * most_ratio + ratio_slack;
    if (m.size > most)
        fail(name, "announces " + std::to_string(m.size) + " bytes, more than " +
                       std::to_string(m.packed) + " packed ones can become");
}

std::string zip_archive::read(std::string_view name) {
    const auto found = members_.find(package_name(name));
    if (found == members_.end()) fail(name, "is not in the archive");
    const member& m = found->second;
    check(name, m);
    const unz64_file_pos place{.pos_in_zip_directory = m.directory_place, .num_of_file = m.number};
    if (unzGoToFilePos64(file_, &place) != UNZ_OK || unzOpenCurrentFile(file_) != UNZ_OK)
        fail(name, "its header does not fit the directory of the archive");
    std::string bytes;
    // Text of numbers becomes a fifth to a tenth when packed.
    bytes.reserve(static_cast<std::size_t>(std::min(m.size, m.packed * 10)));
    std::vector<char> piece(std::size_t{1} << 18);
    int got = 0;
    while ((got = unzReadCurrentFile(file_, piece.data(), static_cast<unsigned>(piece.size()))) >
           0) {
        if (static_cast<std::uint64_t>(got) > m.size - bytes.size()) break;
        bytes.append(piece.data(), static_cast<std::size_t>(got));
    }
    const int closed = unzCloseCurrentFile(file_);
    if (got < 0) fail(name, "cannot be unpacked: damaged");
    if (bytes.size() != m.size)
        fail(name, "unpacks to other than the " + std::to_string(m.size) + " bytes announced");
    if (closed != UNZ_OK) fail(name, "its checksum does not fit: damaged");
    return bytes;
}

void zip_archive::fail(std::string_view name, std::string_view reason) const {
    in_.fail(printable(name) + ": " + std::string(reason));
}

}  // namespace treeform::detail::io
