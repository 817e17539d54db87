#include "tools/picture/sheet.hpp"
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <string_view>

namespace tools {
namespace {

constexpr std::size_t rows_a_chunk = 128;

void put_number(std::string& to, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) to += static_cast<char>(value >> shift & 255U);
}

std::uint32_t checksum(std::string_view bytes) {
    return static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

void put_chunk(std::string& to, const std::string& name_and_data) {
    put_number(to, static_cast<std::uint32_t>(name_and_data.size() - 4));
    to += name_and_data;
    put_number(to, checksum(name_and_data));
}

/// Rows as they are: even colors pack better than differences, as which PNG can store rows, too.
std::string bytes_of_rows(const picture& drawn, std::size_t begin, std::size_t end) {
    std::string bytes;
    bytes.reserve((end - begin) * (3 * drawn.width + 1));
    for (std::size_t y = begin; y < end; ++y) {
        bytes += '\0';  // no differences
        for (std::size_t x = 0; x < drawn.width; ++x)
            for (const std::uint8_t c : drawn.at(x, y)) bytes += static_cast<char>(c);
    }
    return bytes;
}

/// A piece of a deflate stream that others can follow, the last one its end.
std::string deflated(const std::string& bytes, bool last) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())) + 64, '\0');
    // zlib does not change what it reads, though its type does not say so.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, last ? Z_FINISH : Z_FULL_FLUSH);
    packed.resize(packed.size() - stream.avail_out);
    deflateEnd(&stream);
    return packed;
}

struct piece {
    std::string packed{};
    uLong sum = 0;
    std::size_t size = 0;
};

}  // namespace

std::string png(const picture& drawn) {
    std::string file("\x89PNG\r\n\x1a\n");
    std::string header("IHDR");
    put_number(header, static_cast<std::uint32_t>(drawn.width));
    put_number(header, static_cast<std::uint32_t>(drawn.height));
    header += std::string("\x08\x02\0\0\0", 5);  // 8 bits, red, green and blue
    put_chunk(file, header);

    std::vector<piece> pieces(tf::chunk_count(drawn.height, rows_a_chunk));
    tf::for_chunks(drawn.height, rows_a_chunk,
                   [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                       const std::string bytes = bytes_of_rows(drawn, begin, end);
                       pieces[chunk] = {deflated(bytes, chunk + 1 == pieces.size()),
                                        adler32(1, reinterpret_cast<const Bytef*>(bytes.data()),
                                                static_cast<uInt>(bytes.size())),
                                        bytes.size()};
                   });
    std::string data("IDAT\x78\x9c");
    uLong sum = 1;
    for (const piece& p : pieces) {
        data += p.packed;
        sum = adler32_combine(sum, p.sum, static_cast<z_off_t>(p.size));
    }
    put_number(data, static_cast<std::uint32_t>(sum));
    put_chunk(file, data);
    put_chunk(file, "IEND");
    return file;
}

}  // namespace tools
