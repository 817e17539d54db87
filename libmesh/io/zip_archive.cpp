#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/detect.hpp>
#include <libmesh/io/zip_archive.hpp>

#include <minizip/zip.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

namespace treeform::detail::io {

namespace {

/// Deflate makes at most 1032 bytes of one; the ends of a small stream are not counted so finely.
constexpr std::uint64_t most_ratio = 1032;
constexpr std::uint64_t ratio_slack = 1024;

constexpr std::uint32_t encrypted_flag = 1;
constexpr std::uint32_t deflated = 8;

/// Signatures and sizes of records, the latter without what is of any length.
constexpr std::uint32_t member_mark = 0x04034b50;
constexpr std::uint64_t member_size = 30;
constexpr std::uint32_t entry_mark = 0x02014b50;
constexpr std::uint64_t entry_size = 46;
constexpr std::uint32_t end_mark = 0x06054b50;
constexpr std::uint64_t end_size = 22;
constexpr std::uint32_t large_end_mark = 0x06064b50;
constexpr std::uint64_t large_end_size = 56;
constexpr std::uint32_t locator_mark = 0x07064b50;
constexpr std::uint64_t locator_size = 20;

constexpr std::uint32_t large_sizes = 1;  ///< the extra field of values with 64 bits
/// In place of values that are there.
constexpr std::uint16_t elsewhere16 = std::numeric_limits<std::uint16_t>::max();
constexpr std::uint32_t elsewhere32 = std::numeric_limits<std::uint32_t>::max();

template <class T>
[[nodiscard]] T field(const char* record, std::uint64_t at) {
    return base::load<T, std::endian::little>(record + at);
}
[[nodiscard]] std::uint64_t field16(const char* record, std::uint64_t at) {
    return field<std::uint16_t>(record, at);
}
[[nodiscard]] std::uint32_t field32(const char* record, std::uint64_t at) {
    return field<std::uint32_t>(record, at);
}
[[nodiscard]] std::uint64_t field64(const char* record, std::uint64_t at) {
    return field<std::uint64_t>(record, at);
}

/// The values with 64 bits of an entry, one after the other; empty where it has none.
[[nodiscard]] std::string_view large_values(std::string_view extra) {
    while (extra.size() >= 4) {
        const std::uint64_t size = field16(extra.data(), 2);
        if (size > extra.size() - 4) return {};
        if (field16(extra.data(), 0) == large_sizes) return extra.substr(4, size);
        extra.remove_prefix(4 + size);
    }
    return {};
}

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
        if (step.empty() || step == "." || step == "..") return "a name that is not a plain path";
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

/// Unpacks what deflate has packed. It is written in C, and knows bytes by 32-bit counts.
class inflater {
  public:
    inflater() {
        if (inflateInit2(&stream_, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
    }
    inflater(const inflater&) = delete;
    inflater& operator=(const inflater&) = delete;
    ~inflater() { inflateEnd(&stream_); }

    /// Appends what `packed` becomes; false where it is damaged, or becomes other than `size`
    /// bytes.
    [[nodiscard]] bool unpack(std::string_view packed, std::uint64_t size, std::string& bytes) {
        std::vector<char> piece(std::size_t{1} << 18);
        int status = Z_OK;
        while (status == Z_OK) {
            if (stream_.avail_in == 0) {
                constexpr std::size_t most = std::size_t{1} << 30;
                const std::string_view next = packed.substr(0, most);
                packed.remove_prefix(next.size());
                // Bytes that are read, though the type does not say so.
                stream_.next_in =
                    reinterpret_cast<Bytef*>(const_cast<char*>(next.data()));  // NOLINT
                stream_.avail_in = static_cast<uInt>(next.size());
            }
            stream_.next_out = reinterpret_cast<Bytef*>(piece.data());
            stream_.avail_out = static_cast<uInt>(piece.size());
            status = inflate(&stream_, Z_NO_FLUSH);
            if (status == Z_MEM_ERROR) throw std::bad_alloc();
            const std::size_t got = piece.size() - stream_.avail_out;
            if (got > size - bytes.size()) return false;
            bytes.append(piece.data(), got);
        }
        return status == Z_STREAM_END && stream_.avail_in == 0 && packed.empty() &&
               bytes.size() == size;
    }

  private:
    z_stream stream_{};
};

[[nodiscard]] std::uint32_t checksum_of(std::string_view bytes) {
    return static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

zip_archive::zip_archive(const source& in) : in_(in) { list(find_directory()); }

/// By the last record of the file, behind which a comment may stand.
zip_archive::directory zip_archive::find_directory() const {
    constexpr std::uint64_t longest_comment = std::numeric_limits<std::uint16_t>::max();
    for (std::uint64_t tail = end_size; tail <= in_.size() && tail <= end_size + longest_comment;
         ++tail) {
        const char* const end = in_.end() - tail;
        if (field32(end, 0) != end_mark || field16(end, 20) > tail - end_size) continue;
        directory all{.at = field32(end, 16), .size = field32(end, 12), .count = field16(end, 10)};
        const std::uint64_t place = in_.size() - tail;
        if (all.at == elsewhere32 || all.size == elsewhere32 || all.count == elsewhere16)
            return find_large_directory(place);
        if (field16(end, 4) != 0 || field16(end, 6) != 0 || field16(end, 8) != all.count)
            in_.fail("an archive split into several files is not supported");
        if (all.size > place || all.at > place - all.size)
            in_.fail("the directory of the archive is damaged");
        // Something else may stand between the directory and its last record.
        if (all.size >= 4 && field32(end - all.size, 0) == entry_mark)
            all.ahead = place - all.size - all.at;
        return all;
    }
    in_.fail("not a ZIP archive, or one that is damaged or truncated");
}

/// That of ZIP64, by the record before the last one.
zip_archive::directory zip_archive::find_large_directory(std::uint64_t end) const {
    const auto damaged = [&] { in_.fail("the directory of the archive is damaged"); };
    if (end < locator_size || field32(in_.begin() + end - locator_size, 0) != locator_mark)
        damaged();
    const char* const locator = in_.begin() + end - locator_size;
    const std::uint64_t place = field64(locator, 8);
    if (field32(locator, 4) != 0 || field32(locator, 16) > 1)
        in_.fail("an archive split into several files is not supported");
    if (end - locator_size < large_end_size || place > end - locator_size - large_end_size)
        damaged();
    const char* record = in_.begin() + place;
    if (field32(record, 0) != large_end_mark) record = locator - large_end_size;
    if (field32(record, 0) != large_end_mark) damaged();
    const directory all{.at = field64(record, 48),
                        .size = field64(record, 40),
                        .count = field64(record, 32),
                        .ahead = static_cast<std::uint64_t>(record - in_.begin()) - place};
    if (all.size > place || all.at > place - all.size) damaged();
    return all;
}

void zip_archive::list(const directory& all) {
    if (all.count == 0) in_.fail("an archive without members");
    ahead_ = all.ahead;
    directory_at_ = all.ahead + all.at;
    const std::uint64_t end = directory_at_ + all.size;
    std::uint64_t count = 0;
    for (std::uint64_t at = directory_at_; at < end; ++count) at = add_member(at, end);
    if (count != all.count) in_.fail("the directory of the archive is damaged");
}

/// Returns where the entry behind this one is.
std::uint64_t zip_archive::add_member(std::uint64_t at, std::uint64_t end) {
    const char* const entry = in_.begin() + at;
    if (end - at < entry_size || field32(entry, 0) != entry_mark)
        in_.fail("the directory of the archive is damaged");
    const std::uint64_t name_size = field16(entry, 28);
    const std::uint64_t extra_size = field16(entry, 30);
    const std::uint64_t whole = entry_size + name_size + extra_size + field16(entry, 32);
    if (whole > end - at) in_.fail("the directory of the archive is damaged");
    const std::string_view name(entry + entry_size, name_size);
    if (const auto fault = fault_of_name(name); !fault.empty())
        in_.fail("the archive has " + std::string(fault) + ": '" + printable(name) + "'");
    if (name.ends_with('/')) return at + whole;  // a folder
    member m{.at = field32(entry, 42),
             .packed = field32(entry, 20),
             .size = field32(entry, 24),
             .checksum = field32(entry, 16),
             .flags = static_cast<std::uint32_t>(field16(entry, 8)),
             .method = static_cast<std::uint32_t>(field16(entry, 10))};
    // Only the values that are elsewhere are there, in this order.
    std::string_view values = large_values({name.data() + name_size, extra_size});
    for (std::uint64_t* const value : {&m.size, &m.packed, &m.at}) {
        if (*value != elsewhere32 || values.size() < 8) continue;
        *value = field64(values.data(), 0);
        values.remove_prefix(8);
    }
    if (!members_.emplace(package_name(name), m).second) fail(name, "is in the archive twice");
    return at + whole;
}

bool zip_archive::holds(std::string_view name) const {
    return members_.contains(package_name(name));
}

void zip_archive::check(std::string_view name, const member& m) {
    if ((m.flags & encrypted_flag) != 0) fail(name, "encrypted");
    if (m.method != 0 && m.method != deflated)
        fail(name,
             "compressed by method " + std::to_string(m.method) + "; only deflate is supported");
    // Members that share bytes would be read again and again.
    packed_read_ += std::min<std::uint64_t>(m.packed, in_.size() + std::uint64_t{1});
    if (packed_read_ > in_.size()) fail(name, "announces more bytes than the archive has");
    const std::uint64_t most = m.method == 0 ? m.packed : m.packed * most_ratio + ratio_slack;
    if (m.size > most)
        fail(name, "announces " + std::to_string(m.size) + " bytes, more than " +
                       std::to_string(m.packed) + " compressed bytes can hold");
}

/// Between its own header, which has to fit the directory, and the directory. Sizes are not in the
/// header where they are elsewhere, or stand behind the bytes.
std::string_view zip_archive::packed_bytes(std::string_view name, const member& m) const {
    const auto misfit = [&] {
        fail(name, "its header does not match the directory of the archive");
    };
    if (m.at > directory_at_ - ahead_ || directory_at_ - ahead_ - m.at < member_size) misfit();
    const std::uint64_t room = directory_at_ - ahead_ - m.at;
    const char* const header = in_.begin() + ahead_ + m.at;
    const std::uint64_t name_size = field16(header, 26);
    const std::uint64_t before = member_size + name_size + field16(header, 28);
    if (field32(header, 0) != member_mark || room < before || room - before < m.packed) misfit();
    const auto differs = [&](std::uint64_t at, std::uint64_t value) {
        const std::uint32_t here = field32(header, at);
        return here != 0 && here != elsewhere32 && here != value;
    };
    if (package_name({header + member_size, name_size}) != package_name(name) ||
        field16(header, 8) != m.method || differs(14, m.checksum) || differs(18, m.packed) ||
        differs(22, m.size))
        misfit();
    return {header + before, static_cast<std::size_t>(m.packed)};
}

std::string zip_archive::unpacked(std::string_view name, const member& m) const {
    const std::string_view packed = packed_bytes(name, m);
    if (m.method == 0) {
        if (m.size != m.packed) fail(name, "does not have the announced size");
        return std::string(packed);
    }
    std::string bytes;
    // Text of numbers becomes a fifth to a tenth when packed.
    bytes.reserve(static_cast<std::size_t>(std::min(m.size, m.packed * 10)));
    if (!inflater().unpack(packed, m.size, bytes))
        fail(name, "cannot be decompressed to the announced " + std::to_string(m.size) +
                       " bytes: damaged");
    return bytes;
}

std::string zip_archive::read(std::string_view name) {
    const auto found = members_.find(package_name(name));
    if (found == members_.end()) fail(name, "is not in the archive");
    const member& m = found->second;
    check(name, m);
    std::string bytes = unpacked(name, m);
    if (checksum_of(bytes) != m.checksum) fail(name, "wrong checksum: damaged");
    return bytes;
}

void zip_archive::fail(std::string_view name, std::string_view reason) const {
    in_.fail(printable(name) + ": " + std::string(reason));
}

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
