#include <libmesh/base/byte_order.hpp>
#include <libmesh/carry/carried.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace treeform::detail::carry {
namespace {

constexpr std::size_t least_block = 227;
constexpr std::size_t description_size = 192;

template <class T>
T las_number(std::span<const std::byte> bytes, std::size_t at) {
    return base::load<T, std::endian::little>(reinterpret_cast<const char*>(bytes.data()) + at);
}

/// The data of a record, or nothing.
std::span<const std::byte> record_data(const las_header& h, std::string_view user,
                                       std::uint16_t id) {
    for (const auto* records : {&h.records, &h.extended_records})
        for (const las_record& r : *records)
            if (r.record_id == id && r.user_id.c_str() == user) return r.data;
    return {};
}

std::string text_in(std::span<const std::byte> bytes) {
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
    return text;
}

/// A reference system as a header describes it.
struct las_system {
    std::string text{};  ///< of WKT, or the bytes of keys
    std::string name{};  ///< for people
    std::string code{};  ///< of EPSG, if it has one
};

/// The last code in WKT is that of the whole.
std::string code_in_wkt(const std::string& wkt) {
    std::string code;
    for (std::size_t at = wkt.find("\"EPSG\""); at != std::string::npos;
         at = wkt.find("\"EPSG\"", at + 1)) {
        const std::size_t first = wkt.find_first_of("0123456789", at);
        if (first == std::string::npos) break;
        code = wkt.substr(first, wkt.find_first_not_of("0123456789", first) - first);
    }
    return code;
}

las_system system_of(const las_header& h) {
    constexpr std::string_view user = "LASF_Projection";
    las_system s{.text = text_in(record_data(h, user, 2112))};
    if (!s.text.empty()) {
        const std::size_t first = s.text.find('"');
        const std::size_t last = s.text.find('"', first + 1);
        s.name = first == std::string::npos || last == std::string::npos
                     ? "WKT"
                     : s.text.substr(first + 1, last - first - 1);
        s.code = code_in_wkt(s.text);
        return s;
    }
    const auto keys = record_data(h, user, 34735);
    if (keys.size() < 8) return {.name = "none"};
    for (const std::uint16_t id :
         {std::uint16_t{34735}, std::uint16_t{34736}, std::uint16_t{34737}})
        s.text += text_in(record_data(h, user, id)) + '|';
    s.name = "GeoTIFF keys";
    for (const std::uint16_t wanted : {std::uint16_t{3072}, std::uint16_t{2048}})
        for (std::size_t at = 8; at + 8 <= keys.size() && s.code.empty(); at += 8)
            if (las_number<std::uint16_t>(keys, at) == wanted &&
                las_number<std::uint16_t>(keys, at + 6) != 32767)
                s.code = std::to_string(las_number<std::uint16_t>(keys, at + 6));
    if (!s.code.empty()) s.name = "EPSG " + s.code;
    return s;
}

bool are_same(const las_system& a, const las_system& b) {
    return a.text == b.text || (!a.code.empty() && a.code == b.code);
}

bool has_time(const las_header& h) { return h.point_format == 1 || h.point_format >= 3; }

/// Adjusted standard GPS time, or else seconds of a week.
bool counts_from_epoch(const las_header& h) {
    return h.block.size() >= least_block && (std::to_integer<unsigned>(h.block[6]) & 1) != 0;
}

void refuse_mixed(const las_header& a, const std::string& name_of_a, const las_header& b,
                  const std::string& name_of_b) {
    const las_system x = system_of(a);
    const las_system y = system_of(b);
    const std::string both = name_of_a + " and " + name_of_b;
    if (!are_same(x, y))
        throw std::invalid_argument("treeform::concatenate_files: " + both +
                                    " have different reference systems: " + x.name + ", " + y.name);
    if (has_time(a) && has_time(b) && counts_from_epoch(a) != counts_from_epoch(b))
        throw std::invalid_argument("treeform::concatenate_files: " + both +
                                    " have different GPS times: " +
                                    (counts_from_epoch(a) ? "since the epoch, within a week"
                                                          : "within a week, since the epoch"));
}

struct las_bounds {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
};

/// Of all points on an axis, by the headers; none where one does not say.
std::optional<las_bounds> bounds_of(std::span<const las_header* const> all, std::size_t axis) {
    las_bounds b;
    for (const las_header* h : all) {
        if (h->block.size() < least_block) return std::nullopt;
        const bool counted = las_number<std::uint32_t>(h->block, 107) > 0 ||
                             (h->block.size() >= 255 && h->version_minor >= 4 &&
                              las_number<std::uint64_t>(h->block, 247) > 0);
        if (!counted) continue;
        b.low = std::min(b.low, las_number<double>(h->block, 187 + 16 * axis));
        b.high = std::max(b.high, las_number<double>(h->block, 179 + 16 * axis));
    }
    if (!std::isfinite(b.low) || !std::isfinite(b.high) || b.low > b.high) return std::nullopt;
    return b;
}

/// The finest scale that holds them, with the offset of the first or from the middle.
void choose_grid(las_header& to, std::span<const las_header* const> all, std::size_t axis) {
    const auto is_same = [&](const las_header* h) {
        return h->scale[axis] == to.scale[axis] && h->offset[axis] == to.offset[axis];
    };
    const auto bounds = bounds_of(all, axis);
    if (std::ranges::all_of(all, is_same) || !bounds) return;
    std::vector<double> scales;
    for (const las_header* h : all) scales.push_back(std::abs(h->scale[axis]));
    std::ranges::sort(scales);
    constexpr double reach = std::numeric_limits<std::int32_t>::max();
    const double half = 0.5 * bounds->high - 0.5 * bounds->low;
    const double middle = std::nearbyint(bounds->low + half);
    for (const double scale : scales)
        for (const double offset : {to.offset[axis], middle})
            if (std::max(std::abs(bounds->high - offset), std::abs(bounds->low - offset)) / scale <
                reach) {
                to.scale[axis] = scale;
                to.offset[axis] = offset;
                return;
            }
    to.scale[axis] = std::max(half / (reach - 1000.0), scales.front());
    to.offset[axis] = bounds->low + half;
}

/// Descriptions of extra bytes that are not there yet.
void add_descriptions(las_header& to, const las_header& from) {
    const auto data = record_data(from, "LASF_Spec", 4);
    auto at = std::ranges::find_if(to.records, [](const las_record& r) {
        return r.record_id == 4 && r.user_id.c_str() == std::string_view("LASF_Spec");
    });
    if (at == to.records.end() && data.size() >= description_size)
        at = to.records.insert(
            at, {.user_id = "LASF_Spec", .record_id = 4, .description = "Extra Bytes"});
    const auto name_at = [](std::span<const std::byte> all, std::size_t first) {
        return all.subspan(first + 4, 32);
    };
    for (std::size_t i = 0; i + description_size <= data.size(); i += description_size) {
        bool is_there = false;
        for (std::size_t k = 0; k + description_size <= at->data.size(); k += description_size)
            is_there = is_there || std::ranges::equal(name_at(at->data, k), name_at(data, i));
        const auto one = data.subspan(i, description_size);
        if (!is_there) at->data.insert(at->data.end(), one.begin(), one.end());
    }
}

}  // namespace

std::optional<las_header> join_las(std::span<const mesh_file> files,
                                   std::span<const std::string> names, bool mixed) {
    if (!files.front().las) return std::nullopt;
    las_header joined = *files.front().las;
    std::vector<const las_header*> all;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (!files[i].las) continue;
        const las_header& one = *files[i].las;
        all.push_back(&one);
        if (i == 0) continue;
        if (!mixed) refuse_mixed(joined, names[0], one, names[i]);
        add_descriptions(joined, one);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) choose_grid(joined, all, axis);
    return joined;
}

}  // namespace treeform::detail::carry
