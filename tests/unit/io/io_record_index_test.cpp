/// \file
/// Texts of points that many look at, each at the lines that begin in its part, and that are then
/// read from any point on.

#include <libmesh/io/point_rows.hpp>
#include <libmesh/io/record_index.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace io = treeform::detail::io;

io::source source_of(const std::string& text) { return {std::as_bytes(std::span(text)), "text"}; }

struct text_kind {
    std::string name;
    std::string head;
    std::function<io::record_index(const io::source&, const io::file_part&, std::size_t)> scan;
    std::function<io::point_rows(const io::source&, std::uint64_t, const io::record_index*)> open;
};

/// With a head for so many points.
std::vector<text_kind> text_kinds(std::size_t points) {
    const std::string count = std::to_string(points);
    std::vector<text_kind> all;
    for (const auto& [format, head] : std::vector<std::pair<std::string, std::string>>{
             {"xyz", "# by hand\n"}, {"csv", "x,y,z,t\n"}, {"pts", count + "\n"}}) {
        const std::string name = format;
        all.push_back({name, head,
                       [name](const auto& in, const auto& part, std::size_t most) {
                           return io::scan_xyz(in, name, part, most);
                       },
                       [name](const auto& in, std::uint64_t first, const auto* known) {
                           return io::open_xyz_points(in, name, first, known);
                       }});
    }
    std::string head = "ply\nformat ascii 1.0\nelement vertex " + count + "\n";
    for (const char* axis : {"x", "y", "z", "t"})
        head += "property double " + std::string(axis) + "\n";
    all.push_back({"ply", head + "end_header\n",
                   [](const auto& in, const auto& part, std::size_t most) {
                       return io::scan_ply(in, part, most).value();
                   },
                   [](const auto& in, std::uint64_t first, const auto* known) {
                       return io::open_ply_points(in, first, io::row_use::none, known);
                   }});
    all.push_back({"pcd",
                   "VERSION .7\nFIELDS x y z t\nSIZE 8 8 8 8\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH " +
                       count + "\nHEIGHT 1\nPOINTS " + count + "\nDATA ascii\n",
                   [](const auto& in, const auto& part, std::size_t most) {
                       return io::scan_pcd(in, part, most).value();
                   },
                   [](const auto& in, std::uint64_t first, const auto* known) {
                       return io::open_pcd_points(in, first, known);
                   }});
    return all;
}

io::record_index scan_in_parts(const text_kind& k, const io::source& in, std::uint64_t parts,
                               std::size_t most) {
    io::record_index all;
    for (std::uint64_t rank = 0; rank < parts; ++rank) all.add(k.scan(in, {rank, parts}, most));
    return all;
}

struct row_values {
    std::vector<tf::point3> points{};
    std::vector<std::byte> more{};
    std::vector<std::string> warnings{};
    bool operator==(const row_values&) const = default;
};

/// What is read from a point on, in blocks.
row_values read_from(const text_kind& k, const io::source& in, std::uint64_t first,
                     const io::record_index* known) {
    io::point_rows rows = k.open(in, first, known);
    row_values all;
    tf::element vertices{.name = "vertex"};
    if (!rows.head.attributes.elements.empty()) vertices = rows.head.attributes.elements[0];
    CHECK(rows.left_out <= first);
    while (rows.append(all.points, vertices, 100, rows.head.warnings) > 0) continue;
    const auto passed = static_cast<std::ptrdiff_t>(first - rows.left_out);
    all.points.erase(all.points.begin(), all.points.begin() + passed);
    for (const tf::column& c : vertices.columns)
        if (!c.values.empty())
            all.more.insert(all.more.end(),
                            c.values.begin() + passed * std::ptrdiff_t(tf::size_of(c.type)),
                            c.values.end());
    for (const tf::io_warning& w : rows.head.warnings) all.warnings.push_back(w.code + w.text);
    return all;
}

/// Lines as people have them. Only XYZ has comments, and uneven lines.
std::string lines(const std::string& name, std::size_t count, test::random& random, bool uneven) {
    const bool xyz = name != "ply" && name != "pcd";
    const std::string separator = name == "csv" ? "," : " ";
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
        while (random.below(6) == 0) text += std::array{"\n", " \t \n", "\r\n"}[random.below(3)];
        if (xyz && random.below(8) == 0) text += "  # 1 2 3 4\n// 5 6\n";
        text += std::string(random.below(8) == 0 ? random.below(40) : 0, ' ');
        for (std::size_t k = 0; k < 4; ++k) {
            if (k == 3 && xyz && uneven && random.below(30) == 0) break;
            if (k > 0) text += separator;
            text += std::to_string(random.below(1000)) + (random.below(9) == 0 ? ".25" : "");
        }
        if (i + 1 < count || random.below(2) == 0)
            text += std::array{"\n", "\r\n", "\r", " \n"}[random.below(4)];
    }
    return text;
}

}  // namespace

TEST_CASE("record index: any number of parts find the records that one finds") {
    test::random random(1);
    for (std::size_t round = 0; round < 60; ++round) {
        const std::size_t points = 1 + random.below(round % 3 == 0 ? 4 : 300);
        for (const text_kind& k : text_kinds(points)) {
            const std::string text = k.head + lines(k.name, points, random, round % 5 == 0);
            CAPTURE(k.name);
            CAPTURE(text);
            const io::source in = source_of(text);
            const io::record_index one = k.scan(in, {}, 1 << 20);
            REQUIRE(one.records == points);
            REQUIRE(one.marks.size() == points);
            for (const std::uint64_t parts : {1U, 2U, 3U, 7U, 50U}) {
                const io::record_index all = scan_in_parts(k, in, parts, 2 + random.below(20));
                CHECK(all.records == points);
                CHECK(all.even == one.even);
                CHECK(all.hexadecimal == one.hexadecimal);
                REQUIRE_FALSE(all.marks.empty());
                CHECK(all.marks.front().record == 0);
                for (const auto& m : all.marks) CHECK(m.byte == one.marks.at(m.record).byte);
                for (const std::uint64_t first :
                     {std::uint64_t{0}, random.below(points), std::uint64_t{points}})
                    CHECK(read_from(k, in, first, &all) == read_from(k, in, first, nullptr));
            }
        }
    }
}

TEST_CASE("record index: marks are spread evenly, however many records there are") {
    for (const std::size_t count : {1U, 2U, 15U, 16U, 17U, 1000U, 4095U}) {
        std::string text;
        for (std::size_t i = 0; i < count; ++i) text += "1 2 3\n";
        const io::record_index all = io::scan_xyz(source_of(text), "xyz", {}, 16);
        CHECK(all.records == count);
        CHECK(all.marks.size() <= 16);
        for (std::size_t i = 0; i < all.marks.size(); ++i) {
            CHECK(all.marks[i].byte == 6 * all.marks[i].record);
            CHECK(all.before(all.marks[i].record).record == all.marks[i].record);
            CHECK(all.marks[i].record <= (i + 1) * (count / 8 + 1));
        }
        CHECK(all.before(count).record == all.marks.back().record);
    }
}

TEST_CASE("record index: marks of every some-th record are as few as others") {
    for (const std::size_t most : {2U, 5U, 8U})
        for (const std::uint64_t each : {1U, 3U, 16U, 1000U}) {
            CAPTURE(each);
            io::spread_marks marks(most);
            for (std::uint64_t record = 0; record < 100'000 * each; record += each)
                marks.add(record, 7 * record);
            const auto all = std::move(marks).all();
            CHECK(all.size() <= most);
            CHECK(all.size() >= (most + 1) / 2 - 1);
            CHECK(all.front().record == 0);
            for (const auto& m : all) CHECK(m.byte == 7 * m.record);
        }
}

TEST_CASE("record index: what is unusual anywhere is known wherever the text is read") {
    const std::string plain = "1 2 3 4\n1 2 3 4\n1 2 3 4\n";
    for (const text_kind& k : text_kinds(9)) {
        if (k.name == "csv") continue;
        const std::string text = k.head + plain + "1 2 0x1p1 4\n" + plain + "5 6 7 8\n9 9 9 9\n";
        CAPTURE(k.name);
        const io::source in = source_of(text);
        const io::record_index all = scan_in_parts(k, in, 4, 4);
        CHECK(all.hexadecimal);
        CHECK(read_from(k, in, 8, &all) == read_from(k, in, 8, nullptr));
        CHECK(read_from(k, in, 8, &all).warnings.size() == 1);
    }
    for (const char* odd : {"1 2 3\n", "1 2 3 4 5\n", "1 2 3 a tree\n"}) {
        const text_kind k = text_kinds(9).front();
        const std::string text = plain + plain + odd + plain;
        const io::source in = source_of(text);
        const io::record_index all = scan_in_parts(k, in, 5, 4);
        CHECK_FALSE(all.even);
        const row_values rest = read_from(k, in, 1, &all);
        CHECK(rest == read_from(k, in, 1, nullptr));
        CHECK(rest.more.empty());
        CHECK(rest.points.size() == 9);
    }
}

TEST_CASE("record index: a part is looked at, and read, without a look at the others") {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    constexpr std::size_t points = 20'000;
    constexpr std::uint64_t parts = 4;
    for (const text_kind& k : text_kinds(points)) {
        CAPTURE(k.name);
        const std::string line = k.name == "csv" ? "10,11,12,100013\n" : "10 11 12 100013\n";
        const std::size_t body = k.head.size();
        const std::size_t size = body + points * line.size();
        void* const map =
            ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        REQUIRE(map != MAP_FAILED);
        auto* const bytes = static_cast<char*>(map);
        std::ranges::copy(k.head, bytes);
        for (std::size_t i = 0; i < points; ++i)
            std::ranges::copy(line, bytes + body + i * line.size());
        const io::source in({reinterpret_cast<const std::byte*>(bytes), size}, "text");
        // What is looked at beside the head and these bytes ends the test.
        const auto show = [&](std::size_t first, std::size_t last) {
            ::mprotect(map, size, PROT_NONE);
            ::mprotect(map, page, PROT_READ);
            first = first / page * page;
            ::mprotect(bytes + first, std::min(last, size) - first, PROT_READ);
        };
        io::record_index all;
        for (std::uint64_t rank = 0; rank < parts; ++rank) {
            const io::file_part part{rank, parts};
            show(body + part.first(size - body) - 1, body + part.last(size - body) + line.size());
            all.add(k.scan(in, part, 256));
        }
        CHECK(all.records == points);
        for (std::uint64_t rank = 0; rank < parts; ++rank) {
            const io::file_part part{rank, parts};
            show(body + all.before(part.first(points)).record * line.size(),
                 body + part.last(points) * line.size());
            io::point_rows rows = k.open(in, part.first(points), &all);
            CHECK(part.first(points) - rows.left_out < points / 500);
            std::vector<tf::point3> some;
            tf::element vertices = rows.head.attributes.elements.at(0);
            const std::size_t count = part.last(points) - rows.left_out;
            CHECK(rows.append(some, vertices, count, rows.head.warnings) == count);
        }
        ::munmap(map, size);
    }
}
