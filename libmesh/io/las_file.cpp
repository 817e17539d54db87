#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/las_dimensions.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace treeform::detail::io {

namespace {

constexpr std::size_t record_head = 54;
constexpr std::size_t extended_head = 60;

template <class T>
[[nodiscard]] T get(const char* at) {
    return base::load<T, std::endian::little>(at);
}

[[nodiscard]] std::vector<std::byte> bytes_between(const char* begin, const char* end) {
    const auto* const first = reinterpret_cast<const std::byte*>(begin);
    return {first, first + (end - begin)};
}

/// Trailing zeros are not part of a name; what stands behind a zero is kept with it.
[[nodiscard]] std::string name_at(const char* at, std::size_t size) {
    std::string name(at, size);
    name.erase(name.find_last_not_of('\0') + 1);
    return name;
}

/// A record, plain or extended; none where it would go beyond `end`. Moves `at` behind it.
[[nodiscard]] std::optional<las_record> take_record(const char*& at, const char* end,
                                                    bool extended) {
    const std::size_t head = extended ? extended_head : record_head;
    if (static_cast<std::size_t>(end - at) < head) return std::nullopt;
    const std::uint64_t size = extended ? get<std::uint64_t>(at + 20) : get<std::uint16_t>(at + 20);
    if (size > static_cast<std::size_t>(end - at) - head) return std::nullopt;
    las_record r;
    r.reserved = get<std::uint16_t>(at);
    r.user_id = name_at(at + 2, 16);
    r.record_id = get<std::uint16_t>(at + 18);
    r.description = name_at(at + (extended ? 28 : 22), 32);
    r.data = bytes_between(at + head, at + head + size);
    at += head + size;
    return r;
}

[[nodiscard]] const las_record* find_record(std::span<const las_record> records,
                                            std::string_view user_id, std::uint16_t id) {
    for (const las_record& r : records)
        if (r.record_id == id && r.user_id.c_str() == user_id) return &r;
    return nullptr;
}

class las_opener {
  public:
    las_opener(const source& in, std::vector<io_warning>& warnings)
        : in_(in), warnings_(warnings) {}

    las_file open() {
        read_block();
        read_records();
        read_extended();
        read_packing();
        check_points();
        const std::size_t known = las_record_size(file_.header.point_format);
        file_.dimensions = las_dimensions(file_.header.point_format);
        const las_record* const extra = find_record(file_.header.records, "LASF_Spec", 4);
        const auto more =
            extra_dimensions(extra == nullptr ? std::span<const std::byte>{} : extra->data, known,
                             file_.record_size - known);
        file_.dimensions.insert(file_.dimensions.end(), more.begin(), more.end());
        return std::move(file_);
    }

  private:
    [[nodiscard]] const char* at(std::uint64_t byte) const { return in_.begin() + byte; }

    void read_block() {
        if (in_.size() < 227) in_.fail_byte(in_.begin(), "the file ends within the header");
        las_header& h = file_.header;
        h.version_minor = get<std::uint8_t>(at(25));
        if (get<std::uint8_t>(at(24)) != 1 || h.version_minor > 4)
            in_.fail_byte(at(24), "LAS " + std::to_string(get<std::uint8_t>(at(24))) + '.' +
                                      std::to_string(h.version_minor) +
                                      " is not supported, only 1.0 to 1.4");
        const std::size_t size = get<std::uint16_t>(at(94));
        const std::size_t least = h.version_minor == 4 ? 375 : h.version_minor == 3 ? 235 : 227;
        if (size < least || size > in_.size())
            in_.fail_byte(at(94), "the header has " + std::to_string(size) +
                                      " bytes; that of LAS 1." + std::to_string(h.version_minor) +
                                      " has " + std::to_string(least));
        h.block = bytes_between(in_.begin(), at(size));
        file_.first_point = get<std::uint32_t>(at(96));
        if (file_.first_point < size || file_.first_point > in_.size())
            in_.fail_byte(at(96), "points begin at byte " + std::to_string(file_.first_point) +
                                      " of " + std::to_string(in_.size()));
        read_format();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            h.scale[axis] = get<double>(at(131 + 8 * axis));
            h.offset[axis] = get<double>(at(155 + 8 * axis));
            if (!std::isfinite(h.scale[axis]) || h.scale[axis] == 0.0 ||
                !std::isfinite(h.offset[axis]))
                in_.fail_byte(at(131 + 8 * axis), "scale or offset is zero or not a number");
        }
        file_.count = get<std::uint32_t>(at(107));
        if (h.version_minor == 4 && (file_.count == 0 || h.point_format >= 6))
            file_.count = get<std::uint64_t>(at(247));
    }

    /// Bits 6 and 7 of the format say that points are packed.
    void read_format() {
        const auto stored = get<std::uint8_t>(at(104));
        file_.header.point_format = stored & 0x3f;
        packed_ = (stored & 0xc0) != 0;
        file_.record_size = get<std::uint16_t>(at(105));
        if (file_.header.point_format > 10)
            in_.fail_byte(at(104), "point data format " + std::to_string(stored) +
                                       " is not supported, only 0 to 10");
        const std::size_t least = las_record_size(file_.header.point_format);
        if (file_.record_size < least)
            in_.fail_byte(at(105), "points have " + std::to_string(file_.record_size) +
                                       " bytes; those of format " +
                                       std::to_string(file_.header.point_format) + " have " +
                                       std::to_string(least));
    }

    /// Reads `stated` records; says so where fewer are there.
    void take_records(std::vector<las_record>& to, const char*& next, const char* end,
                      std::uint32_t stated, bool extended) {
        while (to.size() < stated) {
            auto r = take_record(next, end, extended);
            if (!r) break;
            to.push_back(*std::move(r));
        }
        if (to.size() < stated)
            warnings_.push_back({"records", "the header announces " + std::to_string(stated) +
                                                (extended ? " extended" : "") +
                                                " records, but the file has " +
                                                std::to_string(to.size())});
    }

    void read_records() {
        las_header& h = file_.header;
        const char* next = at(h.block.size());
        const char* const end = at(file_.first_point);
        take_records(h.records, next, end, get<std::uint32_t>(at(100)), false);
        h.behind_records = bytes_between(next, end);
    }

    void read_extended() {
        las_header& h = file_.header;
        if (h.version_minor == 3) read_waveforms();
        if (h.version_minor < 4) return;
        const auto first = get<std::uint64_t>(at(235));
        const bool is_there = first >= file_.first_point && first <= in_.size();
        const char* next = is_there ? at(first) : in_.end();
        take_records(h.extended_records, next, in_.end(), get<std::uint32_t>(at(243)), true);
    }

    /// LAS 1.3 has one extended record, of waveforms, if they are not in a file of their own.
    void read_waveforms() {
        const auto first = get<std::uint64_t>(at(227));
        if (first < file_.first_point || first >= in_.size()) return;
        const char* next = at(first);
        if (auto r = take_record(next, in_.end(), true))
            file_.header.extended_records.push_back(*std::move(r));
    }

    void read_packing() {
        const las_record* const r = find_record(file_.header.records, "laszip encoded", 22204);
        if (!packed_) return;
        if (r == nullptr || r->data.size() < 34)
            in_.fail(
                "compressed points without a LASzip record; convert the file with LASzip or PDAL");
        const char* const d = reinterpret_cast<const char*>(r->data.data());
        las_packing packing;
        const auto compressor = get<std::uint16_t>(d);
        packing.chunked = compressor != 1;
        packing.chunk_size = get<std::uint32_t>(d + 12);
        const std::size_t items = get<std::uint16_t>(d + 32);
        for (std::size_t i = 0; i < items && 34 + 6 * (i + 1) <= r->data.size(); ++i) {
            const char* const at_item = d + 34 + 6 * i;
            packing.items.push_back({static_cast<laz::item_type>(get<std::uint16_t>(at_item)),
                                     get<std::uint16_t>(at_item + 2),
                                     get<std::uint16_t>(at_item + 4)});
        }
        const std::uint16_t usual = laz::is_layered(packing.items) ? 3 : 2;
        if (packing.items.size() != items || !laz::is_supported(packing.items) ||
            compressor != (packing.chunked ? usual : 1) ||
            (packing.chunked && packing.chunk_size == 0) || get<std::uint16_t>(d + 2) != 0)
            in_.fail(
                "this compression of points is not supported; convert the file with LASzip or "
                "PDAL: pdal translate in.laz out.las");
        if (laz::record_size(packing.items) != file_.record_size)
            in_.fail_byte(at(105), "compressed points have " +
                                       std::to_string(laz::record_size(packing.items)) +
                                       " bytes, but the header says " +
                                       std::to_string(file_.record_size));
        file_.packing = std::move(packing);
    }

    void check_points() {
        const std::uint64_t there = in_.size() - file_.first_point;
        if (!file_.packing && file_.count > there / file_.record_size)
            in_.fail_byte(at(file_.first_point),
                          "the file ends within the points: " + std::to_string(file_.count) +
                              " announced, " + std::to_string(there / file_.record_size) +
                              " found");
        const std::uint64_t room = (end_of_points() - file_.first_point) / file_.record_size;
        if (!file_.packing && file_.count < room)
            warnings_.push_back({"count", "the header counts " + std::to_string(file_.count) +
                                              " points, and there is room for " +
                                              std::to_string(room) + ": the rest was not read"});
    }

    /// Where what the header names begins behind the points, else the end of the file.
    [[nodiscard]] std::uint64_t end_of_points() const {
        const int minor = get<std::uint8_t>(at(25));
        std::uint64_t end = in_.size();
        const auto ends_at = [&](std::uint64_t place) {
            if (place >= file_.first_point) end = std::min(end, place);
        };
        if (minor >= 3) ends_at(get<std::uint64_t>(at(227)));  // waveforms
        if (minor >= 4 && get<std::uint32_t>(at(243)) > 0) ends_at(get<std::uint64_t>(at(235)));
        return end;
    }

    const source& in_;
    std::vector<io_warning>& warnings_;
    las_file file_{};
    bool packed_ = false;
};

}  // namespace

las_file open_las(const source& in, std::vector<io_warning>& warnings) {
    return las_opener(in, warnings).open();
}

}  // namespace treeform::detail::io
