/// \file
/// Packed bytes by blocks, and unpacked by several one after the other. What one packs and unpacks
/// is tested with the files that are packed so.

#include <libmesh/io/lzf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace io = treeform::detail::io;

std::string packed(std::string_view bytes) {
    std::string to(io::lzf_most_packed(bytes.size()), '\0');
    to.resize(io::lzf_pack(bytes, to.data()));
    return to;
}

/// By several, each up to one of the ends; none where they are refused, or end elsewhere.
std::optional<std::string> unpacked_by(const std::vector<std::size_t>& ends,
                                       const std::string& bytes, std::size_t size) {
    std::string all;
    io::lzf_place at;
    for (const std::size_t end : ends) {
        const auto put = [&](std::string_view some) {
            CHECK(at.unpacked == all.size());
            CHECK(all.size() + some.size() <= size);
            all += some;
        };
        if (!io::lzf_unpack_on(bytes, at, end, size, put)) return std::nullopt;
        CHECK(at.unpacked == all.size());
        CHECK((at.packed + at.unpacked >= end || at.packed == bytes.size()));
        CHECK(at.packed + at.unpacked < end + 300);
        CHECK(at.last == all.substr(all.size() - std::min<std::size_t>(all.size(), 8192)));
    }
    if (at.packed != bytes.size() || at.unpacked != size) return std::nullopt;
    return all;
}

enum class letters { one, few, all, repeated };

std::string made(std::size_t size, letters kind, test::random& random) {
    std::string bytes(size, 'a');
    if (kind == letters::few)
        for (char& c : bytes) c = static_cast<char>('a' + random.below(3));
    if (kind == letters::all)
        for (char& c : bytes) c = static_cast<char>(random.bits());
    if (kind == letters::repeated)  // from exactly as far back as a copy can reach
        for (std::size_t i = 0; i < size; ++i)
            bytes[i] = i < 8192 ? static_cast<char>(random.bits()) : bytes[i - 8192];
    return bytes;
}

constexpr letters letter_kinds[] = {letters::one, letters::few, letters::all, letters::repeated};

}  // namespace

TEST_CASE("lzf: blocks packed alone, one after the other, are what all of them are packed to") {
    test::random random(1);
    constexpr std::size_t block = io::lzf_block;
    for (const std::size_t size :
         {block - 1, block, block + 1, block + 2, 2 * block, 3 * block - 2, 3 * block + 31})
        for (const letters kind : letter_kinds) {
            CAPTURE(size);
            CAPTURE(kind);
            const std::string bytes = made(size, kind, random);
            const std::string whole = packed(bytes);
            std::string joined;
            for (std::size_t at = 0; at < size; at += block)
                joined += packed(std::string_view(bytes).substr(at, block));
            CHECK(whole == joined);
            CHECK(whole.size() <= io::lzf_most_packed(size));
            if (kind == letters::one || kind == letters::repeated) CHECK(whole.size() < size / 20);
            std::string back(size, '\0');
            REQUIRE(io::lzf_unpack(whole, back.data(), size));
            CHECK(back == bytes);
        }
    // No byte repeats: nothing but literals, and a byte more for every 32 and for the last ones.
    const std::string noise = made(block + 1, letters::all, random);
    CHECK(packed(noise).size() > noise.size() + noise.size() / 33);
}

TEST_CASE("lzf: one goes on where the one before has ended, wherever that is") {
    test::random random(2);
    for (const std::size_t size :
         std::vector<std::size_t>{0, 1, 40, 8191, 8193, 100'000, 4'500'000})
        for (const letters kind : letter_kinds) {
            CAPTURE(size);
            CAPTURE(kind);
            const std::string bytes = made(size, kind, random);
            const std::string whole = packed(bytes);
            for (const std::size_t parts : {1U, 2U, 4U, 7U}) {
                std::vector<std::size_t> ends(parts, whole.size() + size);
                for (std::size_t i = 0; i + 1 < parts; ++i)
                    ends[i] = random.below(whole.size() + size + 1);
                std::ranges::sort(ends);
                if (parts == 7) ends[1] = ends[0];  // one has nothing
                CHECK(unpacked_by(ends, whole, size) == bytes);
            }
            if (size > 9000) continue;
            std::vector<std::size_t> each(whole.size() + size);  // each has a token or nothing
            for (std::size_t i = 0; i < each.size(); ++i) each[i] = i + 1;
            CHECK(unpacked_by(each, whole, size) == bytes);
        }
}

TEST_CASE("lzf: damaged bytes are refused by several where one refuses them") {
    test::random random(3);
    std::size_t refused = 0;
    for (int round = 0; round < 400; ++round) {
        const std::string bytes = made(3000, letters::few, random);
        std::string whole = packed(bytes);
        for (std::size_t i = 0; i <= random.below(3); ++i)
            whole[random.below(whole.size())] = static_cast<char>(random.bits());
        if (round % 5 == 0) whole.resize(random.below(whole.size()));
        std::string back(3000, '\0');
        const bool good = io::lzf_unpack(whole, back.data(), back.size());
        const std::size_t cut = random.below(whole.size() + back.size() + 1);
        const auto several = unpacked_by({cut, whole.size() + back.size()}, whole, back.size());
        CHECK(several.has_value() == good);
        if (good) CHECK(*several == back);
        refused += good ? 0 : 1;
    }
    CHECK(refused > 100);
    // A place that is not one of the stream.
    io::lzf_place wrong{.packed = 5, .unpacked = 4, .last = "ab"};
    CHECK_FALSE(io::lzf_unpack_on("123456", wrong, 6, 100, [](std::string_view) {}));
    io::lzf_place behind{.packed = 7, .unpacked = 2, .last = "ab"};
    CHECK_FALSE(io::lzf_unpack_on("123456", behind, 6, 100, [](std::string_view) {}));
}
