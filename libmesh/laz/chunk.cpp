#include <libmesh/laz/chunk.hpp>
#include <libmesh/laz/entropy.hpp>
#include <libmesh/laz/first_items.hpp>
#include <libmesh/laz/integer_code.hpp>
#include <libmesh/laz/items.hpp>
#include <libmesh/laz/layered_items.hpp>
#include <libmesh/laz/layered_point.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <variant>

namespace treeform::detail::laz {

namespace {

using any_item = std::variant<point_item, gps_time_item, color_item, wave_packet_item, bytes_item,
                              first_point_item, first_gps_time_item, first_color_item>;

[[nodiscard]] any_item start_item(const item& i, const std::uint8_t* first) {
    const bool is_first = i.version == 1;
    switch (i.type) {
        case item_type::point10:
            if (is_first) return first_point_item(first);
            return point_item(first);
        case item_type::gps_time11:
            if (is_first) return first_gps_time_item(first);
            return gps_time_item(first);
        case item_type::color12:
            if (is_first) return first_color_item(first);
            return color_item(first);
        case item_type::wave_packet13:
            return wave_packet_item(first);
        default:
            return bytes_item(first, i.size);
    }
}

/// The states of all items, and where each stands in a record.
class pointwise {
  public:
    pointwise(std::span<const item> items, const std::uint8_t* first) {
        std::size_t at = 0;
        for (const item& i : items) {
            items_.emplace_back(start_item(i, first + at), at);
            at += i.size;
        }
    }

    template <class Coder>
    void code(Coder& c, std::uint8_t* record) {
        for (auto& [state, at] : items_)
            std::visit([&, from = record + at](auto& s) { s.code(c, from); }, state);
    }

  private:
    std::vector<std::pair<any_item, std::size_t>> items_{};
};

using any_layered = std::variant<layered<color_item>, layered<infrared_item>,
                                 layered<wave_packet_item>, layered<byte_item>>;

/// The states of items in layers: the point, then one or more layers for each other item.
class layerwise {
  public:
    layerwise(std::span<const item> items, const std::uint8_t* first) : point_(first) {
        const unsigned channel = first[15] >> 4 & 3u;
        std::size_t at = layered_point::size;
        const auto add = [&]<class Item>(std::in_place_type_t<Item>) {
            rest_.emplace_back(layered<Item>(first + at, channel), at);
            at += Item::size;
        };
        for (const item& i : items.subspan(1)) {
            if (i.type == item_type::color14 || i.type == item_type::color_infrared14)
                add(std::in_place_type<color_item>);
            if (i.type == item_type::color_infrared14) add(std::in_place_type<infrared_item>);
            if (i.type == item_type::wave_packet14) add(std::in_place_type<wave_packet_item>);
            if (i.type == item_type::bytes14)
                for (std::size_t b = 0; b < i.size; ++b) add(std::in_place_type<byte_item>);
        }
    }

    [[nodiscard]] std::size_t other_layers() const { return rest_.size(); }

    template <class Layer>
    void code(std::array<Layer, layered_point::layers>& point, std::vector<Layer>& rest,
              std::uint8_t* record) {
        const unsigned channel = point_.code(point, record);
        for (std::size_t i = 0; i < rest_.size(); ++i) {
            auto& [state, at] = rest_[i];
            std::visit([&, from = record + at](auto& s) { s.code(rest[i], from, channel); }, state);
        }
    }

  private:
    layered_point point_;
    std::vector<std::pair<any_layered, std::size_t>> rest_{};
};

/// The next `size` bytes of `packed`, which it loses.
[[nodiscard]] std::span<const std::uint8_t> take(std::span<const std::uint8_t>& packed,
                                                 std::size_t size) {
    if (packed.size() < size) throw damaged("compressed data end too early");
    const auto taken = packed.first(size);
    packed = packed.subspan(size);
    return taken;
}

void unpack_layers(std::span<const item> items, std::span<const std::uint8_t> packed,
                   std::uint32_t count, std::uint8_t* records) {
    const std::size_t size = record_size(items);
    layerwise state(items, records);
    const auto stated = static_cast<std::uint32_t>(get32(take(packed, 4).data()));
    if (stated != count)
        throw damaged("a chunk announces " + std::to_string(count) + " points, and then " +
                      std::to_string(stated));
    const std::size_t layers = layered_point::layers + state.other_layers();
    std::span<const std::uint8_t> sizes = take(packed, 4 * layers);
    const auto next = [&] {
        const auto bytes = static_cast<std::uint32_t>(get32(take(sizes, 4).data()));
        return layer_reader(take(packed, bytes));
    };
    const auto next_nine = [&]<std::size_t... I>(std::index_sequence<I...>) {
        return std::array<layer_reader, sizeof...(I)>{((void)I, next())...};
    };
    auto point = next_nine(std::make_index_sequence<layered_point::layers>{});
    std::vector<layer_reader> rest;
    rest.reserve(state.other_layers());
    for (std::size_t i = 0; i < state.other_layers(); ++i) rest.push_back(next());
    if (count > 1 && !point[0].is_there()) throw damaged("a chunk has no coordinates");
    for (std::uint32_t i = 1; i < count; ++i)
        state.code(point, rest, records + std::size_t{i} * size);
}

void append(std::vector<std::uint8_t>& to, std::span<const std::uint8_t> bytes) {
    to.insert(to.end(), bytes.begin(), bytes.end());
}

void append_word(std::vector<std::uint8_t>& to, std::size_t word) {
    std::array<std::uint8_t, 4> bytes{};
    put32(bytes.data(), static_cast<std::int32_t>(static_cast<std::uint32_t>(word)));
    append(to, bytes);
}

void pack_layers(std::vector<std::uint8_t>& to, std::span<const item> items, std::uint32_t count,
                 const std::uint8_t* records) {
    const std::size_t size = record_size(items);
    layerwise state(items, records);
    std::array<layer_writer, layered_point::layers> point;
    std::vector<layer_writer> rest(state.other_layers());
    point[0].says(true);  // there even when no point follows the first
    point[1].says(true);
    std::vector<std::uint8_t> record(size);
    for (std::uint32_t i = 1; i < count; ++i) {
        std::copy_n(records + std::size_t{i} * size, size, record.data());
        state.code(point, rest, record.data());
    }
    append_word(to, count);
    std::vector<std::vector<std::uint8_t>> layers;
    for (layer_writer& l : point) layers.push_back(l.finish());
    for (layer_writer& l : rest) layers.push_back(l.finish());
    for (const auto& l : layers) append_word(to, l.size());
    for (const auto& l : layers) append(to, l);
}

template <class Coder>
void code_table(Coder& c, std::span<chunk> chunks, bool sizes_vary) {
    integer_code numbers(32, 2);
    chunk last;
    const auto number = [&](std::uint32_t was, std::uint32_t is, unsigned context) {
        return static_cast<std::uint32_t>(numbers.code(c, static_cast<std::int32_t>(was),
                                                       static_cast<std::int32_t>(is), context));
    };
    for (chunk& k : chunks) {
        if (sizes_vary) k.points = number(last.points, k.points, 0);
        k.bytes = number(last.bytes, k.bytes, 1);
        last = k;
    }
}

}  // namespace

std::vector<item> items_of(unsigned format, std::size_t size) {
    std::vector<item> items;
    const auto add = [&](item_type type, std::uint16_t bytes, std::uint16_t version) {
        items.push_back({type, bytes, version});
    };
    if (format >= 6) {
        add(item_type::point14, 30, 3);
        if (format == 7) add(item_type::color14, 6, 3);
        if (format == 8 || format == 10) add(item_type::color_infrared14, 8, 3);
        if (format >= 9) add(item_type::wave_packet14, 29, 3);
    } else {
        add(item_type::point10, 20, 2);
        if (format == 1 || format >= 3) add(item_type::gps_time11, 8, 2);
        if (format == 2 || format == 3 || format == 5) add(item_type::color12, 6, 2);
        if (format >= 4) add(item_type::wave_packet13, 29, 1);
    }
    if (const std::size_t known = record_size(items); size > known)
        add(format >= 6 ? item_type::bytes14 : item_type::bytes,
            static_cast<std::uint16_t>(size - known), format >= 6 ? 3 : 2);
    return items;
}

bool is_layered(std::span<const item> items) {
    return !items.empty() && items[0].type == item_type::point14;
}

bool is_supported(std::span<const item> items) {
    const std::size_t size = record_size(items);
    const auto is_read = [](const item& is, const item& written) {
        const bool first = is.version == 1 && is.type != item_type::bytes;
        return is.type == written.type && is.size == written.size &&
               (is.version == written.version || (first && written.version == 2));
    };
    for (unsigned format = 0; format <= 10; ++format) {
        const auto known = items_of(format, size);
        if (std::equal(items.begin(), items.end(), known.begin(), known.end(), is_read))
            return true;
    }
    return false;
}

std::size_t record_size(std::span<const item> items) {
    return std::accumulate(items.begin(), items.end(), std::size_t{0},
                           [](std::size_t sum, const item& i) { return sum + i.size; });
}

void unpack_chunk(std::span<const item> items, std::span<const std::uint8_t> packed,
                  std::uint32_t count, std::uint8_t* records) {
    const std::size_t size = record_size(items);
    const auto first = take(packed, size);
    std::copy(first.begin(), first.end(), records);
    if (is_layered(items)) return unpack_layers(items, packed, count, records);
    if (count == 1) return;
    pointwise state(items, records);
    decoder c(packed);
    for (std::uint32_t i = 1; i < count; ++i) state.code(c, records + std::size_t{i} * size);
}

std::vector<std::uint8_t> pack_chunk(std::span<const item> items, std::uint32_t count,
                                     const std::uint8_t* records) {
    const std::size_t size = record_size(items);
    std::vector<std::uint8_t> packed(records, records + size);
    if (is_layered(items)) {
        pack_layers(packed, items, count, records);
        return packed;
    }
    pointwise state(items, records);
    encoder c;
    std::vector<std::uint8_t> record(size);
    for (std::uint32_t i = 1; i < count; ++i) {
        std::copy_n(records + std::size_t{i} * size, size, record.data());
        state.code(c, record.data());
    }
    append(packed, c.finish());
    return packed;
}

std::vector<chunk> read_chunk_table(std::span<const std::uint8_t> packed, bool sizes_vary,
                                    std::size_t most) {
    if (packed.size() < 8) throw damaged("the chunk table ends too early");
    const auto version = static_cast<std::uint32_t>(get32(packed.data()));
    const auto count = static_cast<std::uint32_t>(get32(packed.data() + 4));
    if (version != 0)
        throw damaged("the chunk table has the unknown version " + std::to_string(version));
    if (count > most)
        throw damaged("the chunk table announces " + std::to_string(count) +
                      " chunks, more than the file can hold");
    std::vector<chunk> chunks(count);
    if (count == 0) return chunks;
    decoder c(packed.subspan(8));
    code_table(c, chunks, sizes_vary);
    return chunks;
}

std::vector<std::uint8_t> write_chunk_table(std::span<const chunk> chunks, bool sizes_vary) {
    std::vector<std::uint8_t> bytes(8);
    put32(bytes.data() + 4, static_cast<std::int32_t>(static_cast<std::uint32_t>(chunks.size())));
    if (chunks.empty()) return bytes;
    std::vector<chunk> copy(chunks.begin(), chunks.end());
    encoder c;
    code_table(c, copy, sizes_vary);
    const std::vector<std::uint8_t> packed = c.finish();
    bytes.insert(bytes.end(), packed.begin(), packed.end());
    return bytes;
}

}  // namespace treeform::detail::laz
