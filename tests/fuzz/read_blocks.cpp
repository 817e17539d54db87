/// \file
/// Points and rows that are read in blocks: from any on, in parts, and by what is known of their
/// records, they are those that are read from the front.

#include <libmesh/io/point_rows.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>

namespace {

namespace io = tf::detail::io;
using opener = std::function<io::point_rows(std::uint64_t first, const io::record_index* known)>;

void add(std::string& bytes, const void* data, std::size_t size) {
    if (size > 0) bytes.append(static_cast<const char*>(data), size);
}

std::string points_of(io::point_rows& rows) {
    std::string bytes;
    const tf::element* const declared = rows.head.attributes.find("vertex");
    tf::element some;
    std::vector<tf::point3> points;
    do {
        points.clear();
        io::restart(some, declared == nullptr ? tf::element{.name = "vertex"} : *declared);
        rows.append(points, some, 3, rows.head.warnings);
        add(bytes, points.data(), points.size() * sizeof(tf::point3));
    } while (!points.empty());
    return bytes;
}

/// Of each row the element, and of faces the corners.
std::string rows_of(io::point_rows& rows, std::uint64_t count) {
    std::string bytes;
    tf::row_block block;
    const auto next = [&] {
        const auto most = static_cast<std::size_t>(std::min<std::uint64_t>(count, 3));
        return count > 0 && rows.behind(block, most, rows.head.warnings);
    };
    while (next()) {
        count -= block.rows.rows;
        for (std::size_t r = 0; r < block.rows.rows; ++r) {
            bytes += block.rows.name + '\n';
            if (block.first_corner.empty()) continue;
            const std::uint64_t first = block.first_corner[r];
            add(bytes, block.corners.data() + first,
                (block.first_corner[r + 1] - first) * sizeof(std::uint32_t));
        }
    }
    return bytes;
}

void check(bool holds) {
    if (!holds) std::abort();
}

/// `whole` are points that have been read from the front.
void check_points(const opener& open, const std::string& whole, const io::record_index* known) {
    const std::uint64_t count = whole.size() / sizeof(tf::point3);
    for (const std::uint64_t first : {std::uint64_t{1}, count / 2, count}) {
        if (first > count) continue;
        io::point_rows rows = open(first, known);
        check(rows.left_out <= first);
        check(points_of(rows) == whole.substr(rows.left_out * sizeof(tf::point3)));
    }
}

std::optional<io::record_index> look_in_turn(const io::source& in) {
    io::record_index all;
    io::row_place next;
    for (std::uint64_t part = 0; part < 3; ++part) {
        const std::uint64_t end =
            part == 2 ? std::numeric_limits<std::uint64_t>::max() : in.size() * (part + 1) / 3;
        io::listed_points seen = io::scan_listed_points(in, next, end, 4);
        check(seen.found.marks.size() <= 5);
        all.add(seen.found);
        next = seen.next;
    }
    return all;
}

void read_ply(const io::source& in, io::row_use use) {
    const opener open = [&](std::uint64_t first, const io::record_index* known) {
        return io::open_ply_points(in, first, use, known);
    };
    io::point_rows front = open(0, nullptr);
    const std::string points = points_of(front);
    constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
    const std::string rows = rows_of(front, all);
    check_points(open, points, nullptr);
    const auto known = io::has_listed_points(in) ? look_in_turn(in) : io::scan_ply(in, {}, 4);
    const io::record_index* const index = known ? &*known : nullptr;
    if (index != nullptr && io::has_listed_points(in)) check_points(open, points, index);
    io::point_rows parted = open(0, index);
    const auto parts = parted.row_parts(3);
    if (parts.empty()) return;
    check(parts.size() == 4);
    std::string joined;
    try {
        for (std::size_t p = 0; p < 3; ++p) {
            parted.go_to(parts[p]);
            joined += rows_of(parted, parts[p + 1].row - parts[p].row);
        }
    } catch (const tf::io_error&) {
        return;  // faces that are not alike, or lines that are not rows
    }
    check(joined == rows);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const io::source in(std::as_bytes(std::span(data, size)), "fuzz");
    int result = -1;
    const auto refused = [&](const auto& read) {
        try {
            read();
            result = 0;
        } catch (const tf::io_error&) {
        }
    };
    for (const io::row_use use : {io::row_use::none, io::row_use::copied, io::row_use::read})
        refused([&] { read_ply(in, use); });
    refused([&] {
        const opener open = [&](std::uint64_t first, const io::record_index* known) {
            return io::open_pcd_points(in, first, known);
        };
        io::point_rows front = open(0, nullptr);
        check_points(open, points_of(front), nullptr);
    });
    return result;
}
