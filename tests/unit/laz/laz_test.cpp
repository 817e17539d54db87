// Chunks of LAZ: what is packed comes back, and what is damaged is said to be.

#include <libmesh/laz/chunk.hpp>
#include <libmesh/laz/entropy.hpp>
#include <libmesh/laz/integer_code.hpp>
#include <libmesh/laz/items.hpp>

#include <doctest/doctest.h>
#include <support/las_bytes.hpp>
#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace laz = treeform::detail::laz;

namespace {

const std::uint8_t* bytes_of(const std::string& text) {
    return reinterpret_cast<const std::uint8_t*>(text.data());
}

std::string unpacked(const std::vector<laz::item>& items, std::span<const std::uint8_t> packed,
                     std::size_t count) {
    std::string records(count * laz::record_size(items), '\0');
    laz::unpack_chunk(items, packed, static_cast<std::uint32_t>(count),
                      reinterpret_cast<std::uint8_t*>(records.data()));
    return records;
}

std::vector<std::uint8_t> packed(const std::vector<laz::item>& items, const std::string& records) {
    const std::size_t count = records.size() / laz::record_size(items);
    return laz::pack_chunk(items, static_cast<std::uint32_t>(count), bytes_of(records));
}

}  // namespace

TEST_CASE("entropy: symbols, bits and raw numbers come back, in the order they were put") {
    test::random numbers(1);
    struct entry {
        int kind;
        std::uint32_t value;
        unsigned bits;
    };
    std::vector<entry> entries;
    for (int i = 0; i < 100000; ++i) {
        const int kind = static_cast<int>(numbers.below(5));
        const unsigned bits = 1 + static_cast<unsigned>(numbers.below(32));
        // Most symbols are rare, as in real data; carries come from long runs of them.
        std::uint32_t value = 0;
        if (kind == 0) value = numbers.below(50) == 0 ? 1 : 0;
        if (kind == 1) value = static_cast<std::uint32_t>(numbers.below(3) * numbers.below(5));
        if (kind == 2) value = numbers.below(100) == 0 ? 255 : 7;
        if (kind == 3) value = static_cast<std::uint32_t>(numbers.below(516));
        if (kind == 4) value = static_cast<std::uint32_t>(numbers.bits() >> (64 - bits));
        entries.push_back({kind, value, bits});
    }
    const auto run = [&](auto& coder) {
        laz::bit_model bit;
        laz::symbol_model few(16);
        laz::symbol_model bytes(256);
        laz::symbol_model many(516);
        std::vector<std::uint32_t> values;
        for (const entry& e : entries) {
            if (e.kind == 0) values.push_back(coder.bit(bit, e.value));
            if (e.kind == 1) values.push_back(coder.symbol(few, e.value));
            if (e.kind == 2) values.push_back(coder.symbol(bytes, e.value));
            if (e.kind == 3) values.push_back(coder.symbol(many, e.value));
            if (e.kind == 4) values.push_back(coder.bits(e.bits, e.value));
        }
        return values;
    };
    laz::encoder encoder;
    const auto put = run(encoder);
    const std::vector<std::uint8_t> bytes = encoder.finish();
    laz::decoder decoder(bytes);
    CHECK(run(decoder) == put);
}

TEST_CASE("integers: every difference comes back, the ends of the range included") {
    constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
    constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
    const std::array<std::int32_t, 14> hard{0,    1,   -1,  2,    -2,   127,   128,
                                            -128, 255, 256, -257, most, least, 1 << 30};
    const auto run = [&](auto& coder, unsigned bits) {
        laz::integer_code code(bits, 2);
        std::vector<std::int32_t> values;
        for (const std::int32_t was : hard)
            for (const std::int32_t is : hard) {
                const std::int32_t real = bits == 32 ? is : is & 0xffff;
                values.push_back(
                    code.code(coder, bits == 32 ? was : was & 0xffff, real, is % 2 == 0 ? 0 : 1));
                CHECK((!std::decay_t<decltype(coder)>::writes || values.back() == real));
            }
        return values;
    };
    for (const unsigned bits : {16u, 32u}) {
        laz::encoder encoder;
        const auto put = run(encoder, bits);
        const std::vector<std::uint8_t> bytes = encoder.finish();
        laz::decoder decoder(bytes);
        CHECK(run(decoder, bits) == put);
    }
}

TEST_CASE("median: of five equal steps it is that step") {
    laz::median5 median;
    for (int i = 0; i < 5; ++i) median.add(7);
    CHECK(median.get() == 7);
    median.add(1000);
    CHECK(median.get() == 7);
}

TEST_CASE("chunks: every format comes back, with and without extra bytes") {
    for (unsigned format = 0; format <= 10; ++format) {
        for (const std::size_t extra : {0u, 1u, 7u}) {
            const std::size_t size = test::las_sizes[format] + extra;
            const auto items = laz::items_of(format, size);
            CHECK(laz::is_supported(items));
            REQUIRE(laz::record_size(items) == size);
            CHECK(laz::is_layered(items) == (format >= 6));
            for (const auto family :
                 {test::las_family::scan, test::las_family::equal, test::las_family::noise})
                for (const std::size_t count : {1u, 2u, 3u, 1000u}) {
                    CAPTURE(format);
                    CAPTURE(extra);
                    CAPTURE(count);
                    const std::string records =
                        test::las_points(family, format, size, count, format + 10 * count);
                    const auto bytes = packed(items, records);
                    CHECK(unpacked(items, bytes, count) == records);
                    if (family == test::las_family::equal && count == 1000)
                        CHECK(bytes.size() * 10 < records.size());
                }
        }
    }
}

TEST_CASE("chunks: damaged bytes end with an error or with other points") {
    for (const unsigned format : {3u, 5u, 8u, 10u}) {
        const std::size_t size = test::las_sizes[format] + 2;
        const auto items = laz::items_of(format, size);
        const std::string records =
            test::las_points(test::las_family::scan, format, size, 300, format);
        const auto whole = packed(items, records);
        test::random numbers(format);
        std::size_t refused = 0;
        for (int i = 0; i < 500; ++i) {
            auto bytes = whole;
            if (i % 2 == 0) {
                bytes.resize(numbers.below(whole.size()));
            } else {
                for (int k = 0; k < 4; ++k)
                    bytes[numbers.below(bytes.size())] =
                        static_cast<std::uint8_t>(numbers.below(256));
            }
            try {
                (void)unpacked(items, bytes, 300);
            } catch (const laz::damaged&) {
                ++refused;
            }
        }
        CHECK(refused >= 200);  // hardly a file that is cut can be read to its end
    }
}

TEST_CASE("chunks: the first versions of items come back, too") {
    auto items = laz::items_of(3, 34);
    for (laz::item& i : items) i.version = 1;
    CHECK(laz::is_supported(items));
    for (const auto family :
         {test::las_family::scan, test::las_family::equal, test::las_family::noise}) {
        const std::string records = test::las_points(family, 3, 34, 1000, 4);
        CHECK(unpacked(items, packed(items, records), 1000) == records);
    }
}

TEST_CASE("chunks: items that are not known are not taken for others") {
    auto items = laz::items_of(3, 34);
    items[0].version = 3;
    CHECK_FALSE(laz::is_supported(items));
    CHECK_FALSE(laz::is_supported({}));
    items = laz::items_of(7, 40);
    std::swap(items[1], items[2]);
    CHECK_FALSE(laz::is_supported(items));
}

TEST_CASE("table of chunks: comes back; one that says more than there can be is refused") {
    test::random numbers(3);
    std::vector<laz::chunk> chunks;
    for (int i = 0; i < 1000; ++i)
        chunks.push_back({static_cast<std::uint32_t>(numbers.below(50000)),
                          static_cast<std::uint32_t>(numbers.below(400000))});
    for (const bool vary : {false, true}) {
        const auto bytes = laz::write_chunk_table(chunks, vary);
        const auto back = laz::read_chunk_table(bytes, vary, 1000);
        REQUIRE(back.size() == chunks.size());
        for (std::size_t i = 0; i < back.size(); ++i) {
            CHECK(back[i].bytes == chunks[i].bytes);
            CHECK(back[i].points == (vary ? chunks[i].points : 0));
        }
        CHECK_THROWS_AS((void)laz::read_chunk_table(bytes, vary, 999), laz::damaged);
        CHECK_THROWS_AS((void)laz::read_chunk_table(std::span(bytes).first(7), vary, 1000),
                        laz::damaged);
    }
    CHECK(laz::read_chunk_table(laz::write_chunk_table({}, true), true, 0).empty());
}
