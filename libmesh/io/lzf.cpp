#include <libmesh/io/lzf.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace treeform::detail::io {

namespace {

constexpr std::size_t most_literals = 32;
constexpr std::size_t most_back = 8192;
constexpr std::size_t most_copied = 264;
constexpr std::size_t progress_step = std::size_t{16} << 20;

[[nodiscard]] std::size_t byte_at(const char* at) { return static_cast<unsigned char>(*at); }

/// Copies what may overlap its own result: a run repeats the bytes between.
void copy_back(char* to, std::size_t back, std::size_t count) {
    if (back >= count) {
        std::memcpy(to, to - back, count);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) to[i] = to[static_cast<std::ptrdiff_t>(i - back)];
}

/// A block at a time.
class packer {
  public:
    /// Returns where the packed bytes end.
    char* pack(std::string_view block, char* to) {
        base_ += bytes_.size() + most_back + 1;  // what was seen before is out of reach
        bytes_ = block;
        to_ = to;
        at_ = literals_ = 0;
        while (at_ + 2 < bytes_.size()) {
            const std::size_t back = base_ + at_ - std::exchange(last_[hash()], base_ + at_);
            const std::size_t count = back > most_back ? 0 : match(back);
            if (count < 3) {
                ++at_;
                continue;
            }
            put_literals();
            put_copy(back, count);
            remember(count);
        }
        at_ = bytes_.size();
        put_literals();
        return to_;
    }

  private:
    static constexpr unsigned hash_bits = 16;

    [[nodiscard]] std::size_t hash() const {
        const char* const at = bytes_.data() + at_;
        const std::uint32_t three =
            static_cast<std::uint32_t>(byte_at(at) | byte_at(at + 1) << 8 | byte_at(at + 2) << 16);
        return (three * 2654435761U) >> (32 - hash_bits);
    }

    /// How many bytes from here on stand so far ahead, too.
    [[nodiscard]] std::size_t match(std::size_t back) const {
        const std::size_t most = std::min(bytes_.size() - at_, most_copied);
        std::size_t count = 0;
        while (count < most && bytes_[at_ - back + count] == bytes_[at_ + count]) ++count;
        return count;
    }

    void put(std::size_t byte) { *to_++ = static_cast<char>(byte); }

    /// The bytes since the last copy.
    void put_literals() {
        while (literals_ < at_) {
            const std::size_t some = std::min(at_ - literals_, most_literals);
            put(some - 1);
            std::memcpy(to_, bytes_.data() + literals_, some);
            to_ += some;
            literals_ += some;
        }
    }

    void put_copy(std::size_t back, std::size_t count) {
        const std::size_t length = count - 2;
        put(std::min<std::size_t>(length, 7) << 5 | (back - 1) >> 8);
        if (length >= 7) put(length - 7);
        put((back - 1) & 255);
    }

    /// Goes on behind the copy; its last bytes can start another one.
    void remember(std::size_t count) {
        const std::size_t stop = at_ + count;
        for (at_ = stop - 2; at_ < stop && at_ + 2 < bytes_.size(); ++at_)
            last_[hash()] = base_ + at_;
        at_ = stop;
        literals_ = stop;
    }

    std::string_view bytes_{};
    char* to_ = nullptr;
    std::size_t base_ = 0;  ///< what positions in the block are counted from
    std::size_t at_ = 0;
    std::size_t literals_ = 0;  ///< first byte that is in no copy and not yet written
    /// Where three bytes of that hash stood last.
    std::vector<std::size_t> last_ = std::vector<std::size_t>(std::size_t{1} << hash_bits);
};

/// Unpacks until `most` bytes have been read and made, or a few more: to bytes of which there are
/// `done`. False when they would be more than `size`, or are damaged.
[[nodiscard]] bool unpack_some(const char*& at, const char* end, char* to, std::size_t& done,
                               std::size_t most, std::size_t size) {
    const char* const from = at;
    const std::size_t known = done;
    while (at < end && static_cast<std::size_t>(at - from) + (done - known) < most) {
        const std::size_t control = byte_at(at++);
        const auto left = static_cast<std::size_t>(end - at);
        if (control < most_literals) {
            const std::size_t count = control + 1;
            if (count > left || count > size - done) return false;
            std::memcpy(to + done, at, count);
            at += count;
            done += count;
        } else {
            std::size_t count = (control >> 5) + 2;
            const bool is_long = count == 9;
            if (left < (is_long ? 2U : 1U)) return false;
            if (is_long) count += byte_at(at++);
            const std::size_t back = ((control & 31) << 8 | byte_at(at++)) + 1;
            if (back > done || count > size - done) return false;
            copy_back(to + done, back, count);
            done += count;
        }
    }
    return true;
}

}  // namespace

bool lzf_unpack(std::string_view packed, char* to, std::size_t size, const lzf_progress& progress) {
    const char* const begin = packed.data();
    const char* const end = begin + packed.size();
    std::size_t done = 0;
    for (const char* at = begin; at < end;) {
        if (!unpack_some(at, end, to, done, progress_step, size)) return false;
        if (progress) progress(static_cast<std::size_t>(at - begin), done);
    }
    return done == size;
}

bool lzf_unpack_on(std::string_view packed, lzf_place& place, std::size_t end, std::size_t size,
                   const std::function<void(std::string_view bytes)>& put) {
    constexpr std::size_t at_once = std::size_t{4} << 20;
    if (place.packed > packed.size() || place.unpacked > size ||
        place.last.size() != std::min(place.unpacked, most_back))
        return false;
    const char* at = packed.data() + place.packed;
    std::string held = std::move(place.last);
    while (place.packed < packed.size() && place.packed + place.unpacked < end) {
        const std::size_t known = held.size();
        held.resize(known + at_once + most_copied);
        std::size_t done = known;
        const std::size_t most = std::min(at_once, end - place.packed - place.unpacked);
        if (!unpack_some(at, packed.data() + packed.size(), held.data(), done, most,
                         known + (size - place.unpacked)))
            return false;
        held.resize(done);
        place.packed = static_cast<std::size_t>(at - packed.data());
        put(std::string_view(held).substr(known));
        place.unpacked += done - known;
        held.erase(0, done - std::min(done, most_back));
    }
    place.last = std::move(held);
    return true;
}

std::size_t lzf_pack(std::string_view bytes, char* to, const lzf_progress& progress) {
    packer blocks;
    char* end = to;
    std::size_t next_report = progress_step;
    for (std::size_t done = 0; done < bytes.size();) {
        const std::string_view block = bytes.substr(done, lzf_block);
        end = blocks.pack(block, end);
        done += block.size();
        if (!progress || done < next_report) continue;
        progress(static_cast<std::size_t>(end - to), done);
        next_report = done + progress_step;
    }
    return static_cast<std::size_t>(end - to);
}

}  // namespace treeform::detail::io
