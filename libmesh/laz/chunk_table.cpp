#include <libmesh/laz/bytes.hpp>
#include <libmesh/laz/chunk_table.hpp>
#include <libmesh/laz/entropy.hpp>
#include <libmesh/laz/integer_code.hpp>

#include <string>

namespace treeform::detail::laz {

namespace {

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
