// LAS and LAZ files: what is read, what is written, what is refused.

#include <libmesh/io/point_rows.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/las_bytes.hpp>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace {

tf::mesh_file read_las(std::string_view bytes, std::string_view name = "scan.las") {
    return tf::read(std::as_bytes(std::span(bytes)), name, {});
}

std::string written_las(const tf::mesh_file& file, const std::string& format = "las") {
    return tf::write_to_memory(file, {.format = format});
}

std::string las_complaint(std::string_view bytes) {
    try {
        (void)read_las(bytes);
    } catch (const tf::io_error& e) {
        return e.what();
    }
    return "read";
}

std::string las_refusal(const tf::mesh_file& file) {
    try {
        (void)written_las(file);
    } catch (const tf::io_error& e) {
        return e.what();
    }
    return "written";
}

bool has_part(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

double value(const tf::mesh_file& file, std::string_view name, std::size_t row) {
    const tf::element* vertices = file.attributes.find("vertex");
    REQUIRE(vertices != nullptr);
    const tf::column* c = vertices->find(name);
    REQUIRE(c != nullptr);
    return c->number(row);
}

test::las_bytes las_of(unsigned format, std::size_t extra = 0) {
    return {.minor = format >= 6   ? 4u
                     : format >= 4 ? 3u
                                   : 2u,
            .format = format,
            .record_size = test::las_sizes[format] + extra};
}

/// One description of extra bytes.
std::string description(unsigned type, std::string_view name, unsigned options = 0) {
    std::string d(192, '\0');
    d[2] = static_cast<char>(type);
    d[3] = static_cast<char>(options);
    name.copy(d.data() + 4, 32);
    return d;
}

}  // namespace

TEST_CASE("LAS: a coordinate is the product, rounded, and then the sum") {
    test::las_bytes las = las_of(0);
    las.scale = 0.001;
    las.offset = 4500000.0;
    std::string points(20, '\0');
    test::put(points, 0, std::int32_t{123456789});
    test::put(points, 4, std::numeric_limits<std::int32_t>::min());
    test::put(points, 8, std::int32_t{-1});
    const tf::mesh_file file = read_las(las.file(points));
    REQUIRE(file.mesh.points.size() == 1);
    const volatile double product = 123456789 * 0.001;
    CHECK(file.mesh.points[0].x == product + 4500000.0);
    const volatile double least = -2147483648.0 * 0.001;
    CHECK(file.mesh.points[0].y == least + 4500000.0);
    CHECK(file.mesh.points[0].z == -0.001 + 4500000.0);
    CHECK(file.format == "las");
    CHECK(file.stored_as == tf::precision::float64);
    CHECK(test::points_of(written_las(file)) == points);
}

TEST_CASE("LAS: values that share a byte") {
    test::las_bytes las = las_of(1);
    std::string points(28, '\0');
    points[14] = static_cast<char>(0b11'101'010);
    points[15] = static_cast<char>(0b101'01001);
    points[16] = static_cast<char>(-17);
    test::put(points, 18, std::uint16_t{777});
    test::put(points, 20, 0.125);
    tf::mesh_file file = read_las(las.file(points));
    CHECK(value(file, "return_number", 0) == 2);
    CHECK(value(file, "number_of_returns", 0) == 5);
    CHECK(value(file, "scan_direction_flag", 0) == 1);
    CHECK(value(file, "edge_of_flight_line", 0) == 1);
    CHECK(value(file, "classification", 0) == 9);
    CHECK(value(file, "synthetic", 0) == 1);
    CHECK(value(file, "key_point", 0) == 0);
    CHECK(value(file, "withheld", 0) == 1);
    CHECK(value(file, "scan_angle_rank", 0) == -17);
    CHECK(value(file, "point_source_id", 0) == 777);
    CHECK(value(file, "gps_time", 0) == 0.125);

    las = las_of(8);
    points.assign(38, '\0');
    points[14] = static_cast<char>(0xe3);
    points[15] = static_cast<char>(0b1'0'10'1001);
    points[16] = static_cast<char>(200);
    test::put(points, 18, std::int16_t{-3000});
    test::put(points, 36, std::uint16_t{65535});
    file = read_las(las.file(points));
    CHECK(value(file, "return_number", 0) == 3);
    CHECK(value(file, "number_of_returns", 0) == 14);
    CHECK(value(file, "overlap", 0) == 1);
    CHECK(value(file, "scanner_channel", 0) == 2);
    CHECK(value(file, "edge_of_flight_line", 0) == 1);
    CHECK(value(file, "classification", 0) == 200);
    CHECK(value(file, "scan_angle", 0) == -3000);
    CHECK(value(file, "nir", 0) == 65535);
}

TEST_CASE("LAS: every format comes back bit for bit, plain and packed") {
    for (unsigned format = 0; format <= 10; ++format)
        for (const auto family : {test::las_family::scan, test::las_family::noise}) {
            CAPTURE(format);
            test::las_bytes las = las_of(format, 5);
            las.scale = 0.25;  // so that no two numbers have one coordinate
            las.add_record("LASF_Projection", 2112, "GEOGCS[...]");
            const std::string points =
                test::las_points(family, format, las.record_size, 500, format);
            const tf::mesh_file file = read_las(las.file(points));
            CHECK(file.warnings.empty());
            const std::string plain = written_las(file);
            CHECK(test::points_of(plain) == points);
            CHECK(plain.substr(las.header_size(), las.records.size()) == las.records);
            const tf::mesh_file unpacked = read_las(written_las(file, "laz"), "scan.laz");
            CHECK(unpacked.format == "laz");
            CHECK(unpacked.mesh.points == file.mesh.points);
            CHECK(unpacked.attributes.elements == file.attributes.elements);
            CHECK(written_las(unpacked) == plain);
        }
}

TEST_CASE("LAS: extended records come back behind the points") {
    test::las_bytes las = las_of(6);
    las.add_extended("someone", 7, "abc");
    las.add_extended("LASF_Spec", 65535, std::string(1000, 'w'));
    const std::string points = test::las_points(test::las_family::scan, 6, 30, 10, 1);
    const std::string bytes = las.file(points);
    for (const char* format : {"las", "laz"}) {
        const std::string out = written_las(read_las(bytes), format);
        CHECK(out.ends_with(las.extended));
        CHECK(test::get<std::uint64_t>(out, 235) == out.size() - las.extended.size());
        CHECK(test::get<std::uint64_t>(out, 227) == out.size() - 1060);  // waveforms
        CHECK(read_las(out, std::string("scan.") + format).las->extended_records.size() == 2);
    }
}

TEST_CASE("LAS: counts and bounds are those of the points written") {
    const test::las_bytes las = las_of(3);
    const std::string points = test::las_points(test::las_family::scan, 3, 34, 100, 1);
    const tf::mesh_file whole = read_las(las.file(points));
    tf::mesh_file half = whole;
    half.mesh.points.resize(50);
    std::vector<std::uint32_t> rows(50);
    for (std::uint32_t i = 0; i < 50; ++i) rows[i] = i;
    half.attributes.elements[0] = whole.attributes.elements[0].gathered(rows);
    const std::string out = written_las(half);
    CHECK(test::points_of(out) == std::string_view(points).substr(0, 50 * 34));
    std::uint32_t by_return[6] = {};
    double low = 1e9;
    double high = -1e9;
    for (std::size_t i = 0; i < 50; ++i) {
        ++by_return[points[i * 34 + 14] & 7];
        low = std::min(low, half.mesh.points[i].x);
        high = std::max(high, half.mesh.points[i].x);
    }
    CHECK(test::get<std::uint32_t>(out, 107) == 50);
    for (std::size_t r = 0; r < 5; ++r)
        CHECK(test::get<std::uint32_t>(out, 111 + 4 * r) == by_return[r + 1]);
    CHECK(test::get<double>(out, 179) == high);
    CHECK(test::get<double>(out, 187) == low);
}

TEST_CASE("LAS: extra bytes have the names and types of their record") {
    test::las_bytes las = las_of(0, 2 + 8 + 3 + 4 + 1);
    las.add_record("LASF_Spec", 4,
                   description(3, "amplitude") + description(10, "a time") +
                       description(0, "flags", 3) + description(12, "pair") +
                       description(4, "too long for what is left"));
    std::string points = test::las_points(test::las_family::noise, 0, las.record_size, 20, 2);
    test::put(points, 20, std::uint16_t{513});
    test::put(points, 22, 2.5);
    tf::mesh_file file = read_las(las.file(points));
    CHECK(value(file, "amplitude", 0) == 513);
    CHECK(value(file, "a_time", 0) == 2.5);
    CHECK(value(file, "flags[2]", 1) == static_cast<unsigned char>(points[las.record_size + 32]));
    CHECK(value(file, "pair[1]", 0) == static_cast<signed char>(points[34]));
    CHECK(value(file, "extra_bytes[0]", 3) >= 0);
    CHECK(test::points_of(written_las(file)) == points);

    // A new column gets a description, one that is gone loses its own.
    auto& columns = file.attributes.elements[0].columns;
    std::erase_if(columns, [](const tf::column& c) { return c.name == "a_time"; });
    const std::vector<std::uint32_t> groups(20, 7);
    columns.push_back(tf::column::of<std::uint32_t>("group", groups));
    const tf::mesh_file again = read_las(written_las(file));
    CHECK(value(again, "group", 19) == 7);
    CHECK(value(again, "amplitude", 0) == 513);
    CHECK(again.attributes.elements[0].find("a_time") == nullptr);
    CHECK(again.las->records.size() == 1);
}

TEST_CASE("LAS: points of other formats get the smallest format that holds them") {
    tf::mesh_file file;
    file.mesh.points = {{1000.125, 2000.25, -3.5}, {1000.5, 2000.75, 4.0}};
    tf::element& vertices = file.attributes.find_or_add("vertex", 2);
    CHECK(written_las(file)[104] == 0);
    const std::vector<std::uint8_t> shades{255, 3};
    for (const char* name : {"red", "green", "blue"})
        vertices.columns.push_back(tf::column::of<std::uint8_t>(name, shades));
    CHECK(written_las(file)[104] == 2);
    const std::vector<double> times{1.5, 2.5};
    vertices.columns.push_back(tf::column::of<double>("gps_time", times));
    const std::string out = written_las(file);
    CHECK(out[104] == 3);
    CHECK(out[25] == 2);
    const tf::mesh_file back = read_las(out);
    CHECK(back.mesh.points == file.mesh.points);
    CHECK(value(back, "red", 0) == 255 * 256);
    CHECK(value(back, "gps_time", 1) == 2.5);
    const std::vector<std::uint8_t> classes{2, 64};
    vertices.columns.push_back(tf::column::of<std::uint8_t>("classification", classes));
    CHECK(written_las(file)[104] == 7);
    CHECK(written_las(file)[25] == 4);
    const std::vector<std::int8_t> degrees{-15, 90};
    vertices.columns.push_back(tf::column::of<std::int8_t>("scan_angle_rank", degrees));
    CHECK(value(read_las(written_las(file)), "classification", 1) == 64);
    CHECK(value(read_las(written_las(file)), "scan_angle", 0) == -2500);
    CHECK(value(read_las(written_las(file)), "scan_angle", 1) == 15000);
}

TEST_CASE("LAS: decimal coordinates keep their decimals; others move by what is told") {
    tf::mesh_file file;
    for (int i = 0; i < 1000; ++i)
        file.mesh.points.push_back({(500000123 + 7 * i) / 1000.0, i / 100.0, -i / 10.0});
    tf::mesh_file back = read_las(written_las(file));
    CHECK(back.las->scale == std::array<double, 3>{0.001, 0.01, 0.1});
    for (std::size_t i = 0; i < 1000; ++i)
        CHECK(std::abs(back.mesh.points[i].x - file.mesh.points[i].x) <= 500000 * 0x1p-52);
    // What was read can be written and read again.
    CHECK(read_las(written_las(back)).mesh == back.mesh);

    file.mesh.points = {{std::sqrt(2.0), 0, 0}, {1e9 / 3, 0, 0}};
    const auto path = std::filesystem::temp_directory_path() / "treeform_io_las_test.las";
    const tf::write_result result = tf::write(path, file);
    CHECK(result.max_displacement > 0.0);
    CHECK(result.max_displacement <= 0.5 * 1.01);
    back = tf::read(path);
    for (std::size_t i = 0; i < 2; ++i)
        CHECK(std::abs(back.mesh.points[i].x - file.mesh.points[i].x) <= result.max_displacement);
    std::filesystem::remove(path);
}

TEST_CASE("LAS: what it does not hold is refused, with the number of the point") {
    const test::las_bytes las = las_of(0);
    tf::mesh_file file = read_las(las.file(test::las_points(test::las_family::scan, 0, 20, 9, 1)));
    file.mesh.points[5].y = std::nan("");
    CHECK(has_part(las_refusal(file), "point 5: a coordinate is not finite"));
    file.mesh.points[5].y = 1e9;
    CHECK(has_part(las_refusal(file), "point 5: a coordinate needs more than 32 bits"));
    file.mesh.points[5].y = 0;
    file.attributes.elements[0].set(
        tf::column::of<double>("intensity", std::vector<double>(9, 0.5)));
    CHECK(has_part(las_refusal(file), "point 0: a value of intensity"));
}

TEST_CASE("LAS: damaged files are refused, odd ones are read with a warning") {
    test::las_bytes las = las_of(1);
    las.add_record("LASF_Projection", 34735, "keys");
    const std::string points = test::las_points(test::las_family::scan, 1, 28, 5, 1);
    const std::string whole = las.file(points);
    const auto changed = [&](std::size_t at, auto by) {
        std::string bytes = whole;
        test::put(bytes, at, by);
        return bytes;
    };
    for (std::size_t size = 4; size < whole.size(); ++size)
        CHECK(las_complaint(std::string_view(whole).substr(0, size)) != "read");
    CHECK(has_part(las_complaint(changed(107, std::uint32_t{6})), "6 announced, 5 found"));
    CHECK(
        has_part(las_complaint(changed(107, ~std::uint32_t{0})), "4294967295 announced, 5 found"));
    CHECK(has_part(las_complaint(changed(25, std::uint8_t{9})), "LAS 1.9 is not supported"));
    CHECK(has_part(las_complaint(changed(104, std::uint8_t{11})), "format 11 is not supported"));
    CHECK(has_part(las_complaint(changed(105, std::uint16_t{27})), "points have 27 bytes"));
    CHECK(has_part(las_complaint(changed(94, std::uint16_t{100})), "the header has 100 bytes"));
    CHECK(has_part(las_complaint(changed(96, std::uint32_t{9999999})), "points begin at byte"));
    CHECK(has_part(las_complaint(changed(131, 0.0)), "scale or offset"));
    CHECK(has_part(las_complaint(changed(163, std::nan(""))), "scale or offset"));
    CHECK(has_part(las_complaint(changed(104, std::uint8_t{0x81})),
                   "compressed points without a LASzip record"));
    const tf::mesh_file odd = read_las(changed(100, std::uint32_t{1000000}));
    CHECK(odd.warnings.at(0).code == "records");
    CHECK(odd.mesh == read_las(whole).mesh);
    CHECK(odd.las->records.size() == 1);
}

TEST_CASE(
    "LAS: points that the header does not count are told of, records behind the points are not") {
    const std::string points = test::las_points(test::las_family::scan, 3, 34, 4, 1);
    std::string bytes = las_of(3).file(points);
    CHECK(read_las(bytes).warnings.empty());
    test::put(bytes, 107, std::uint32_t{3});
    const tf::mesh_file file = read_las(bytes);
    CHECK(file.mesh.points.size() == 3);
    REQUIRE(file.warnings.size() >= 1);
    CHECK(file.warnings[0].text ==
          "the header counts 3 points, and there is room for 4: the rest was not read");
}

TEST_CASE("LAZ: cut anywhere it is refused; a table that lies is found out") {
    const test::las_bytes las = las_of(3);
    const tf::mesh_file file =
        read_las(las.file(test::las_points(test::las_family::scan, 3, 34, 50, 1)));
    const std::string whole = written_las(file, "laz");
    for (std::size_t size = 4; size < whole.size(); ++size)
        CHECK(las_complaint(std::string_view(whole).substr(0, size)) != "read");
    std::string bytes = whole;
    test::put(bytes, 107, std::uint32_t{4000000000u});
    CHECK(has_part(las_complaint(bytes),
                   "the header announces 4000000000 points, but the chunks have"));
}

TEST_CASE("LAS: a stream of blocks is the file") {
    const auto folder = std::filesystem::temp_directory_path() / "treeform_io_las_stream";
    std::filesystem::create_directories(folder);
    const auto bytes_of = [](const std::filesystem::path& path) {
        std::ifstream in(path, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    for (const unsigned format : {1u, 7u}) {
        const test::las_bytes las = las_of(format, 3);
        const std::string whole =
            las.file(test::las_points(test::las_family::scan, format, las.record_size, 120000, 5));
        for (const char* extension : {".las", ".laz"}) {
            const auto in = folder / (std::string("in") + extension);
            const auto out = folder / (std::string("out") + extension);
            (void)tf::write(in, read_las(whole));
            tf::point_reader reader(in);
            REQUIRE(reader.count() == 120000);
            tf::point_writer writer(out, reader.header(), 120000);
            tf::detail::io::point_block block;
            for (std::size_t most = 1; reader.read(block.points, block.properties, most);
                 most = 2 * most + 1)
                writer.write(block.points, block.properties);
            (void)writer.commit();
            CHECK(bytes_of(out) == bytes_of(in));
        }
    }
    std::filesystem::remove_all(folder);
}

TEST_CASE("LAS: parts with a joined head are the file") {
    const auto path = std::filesystem::temp_directory_path() / "treeform_io_las_part.las";
    for (const unsigned format : {1u, 3u, 5u, 7u})
        for (const std::size_t cut : {1u, 700u, 1999u, 2000u}) {
            CAPTURE(format);
            CAPTURE(cut);
            test::las_bytes las = las_of(format, 3);
            if (format == 7) las.add_extended("LASF_Spec", 65535, std::string(1000, 'w'));
            const tf::mesh_file file = read_las(las.file(test::las_points(
                test::las_family::scan, format, las.record_size, 2000, format + cut)));
            std::vector<std::string> heads;
            std::string points;
            for (const auto& [first, last] : {std::pair{std::size_t{0}, cut}, {cut, 2000u}}) {
                tf::detail::io::point_block block;
                std::vector<std::uint32_t> rows;
                for (std::size_t i = first; i < last; ++i) {
                    rows.push_back(static_cast<std::uint32_t>(i));
                    block.points.push_back(file.mesh.points[i]);
                }
                block.properties = file.attributes.elements[0].gathered(rows);
                tf::point_writer writer(path, file, 2000);
                writer.write(block.points, block.properties);
                REQUIRE(writer.has_parts());
                tf::write_result result;
                const tf::detail::io::written_part part = writer.commit_part(result);
                CHECK(part.points == las.record_size * (last - first));
                std::ifstream in(path, std::ios::binary);
                const std::string bytes(std::istreambuf_iterator<char>(in), {});
                if (part.points > 0) heads.push_back(bytes.substr(0, part.head));
                points +=
                    first == cut ? bytes.substr(part.head) : bytes.substr(part.head, part.points);
            }
            CHECK(tf::point_writer::join_heads(heads) + points == written_las(file));
        }
    std::filesystem::remove(path);
}

TEST_CASE("LAZ: parts of whole chunks with a joined head and all chunks are the file") {
    const auto path = std::filesystem::temp_directory_path() / "treeform_io_laz_part.laz";
    constexpr std::size_t count = 110'000;
    for (const unsigned format : {1u, 7u})
        for (const std::vector<std::size_t>& cuts : {std::vector<std::size_t>{0, 50'000, count},
                                                     {0, 0, 50'000, 100'000, count},
                                                     {0, 100'000, 100'000, count}}) {
            CAPTURE(format);
            CAPTURE(cuts.size());
            test::las_bytes las = las_of(format, 3);
            if (format == 7) las.add_extended("LASF_Spec", 65535, std::string(1000, 'w'));
            const tf::mesh_file file = read_las(las.file(
                test::las_points(test::las_family::scan, format, las.record_size, count, format)));
            std::vector<std::string> summaries;
            std::vector<tf::point_writer> writers;
            for (std::size_t r = 0; r + 1 < cuts.size(); ++r) {
                tf::detail::io::point_block block;
                std::vector<std::uint32_t> rows;
                for (std::size_t i = cuts[r]; i < cuts[r + 1]; ++i) {
                    rows.push_back(static_cast<std::uint32_t>(i));
                    block.points.push_back(file.mesh.points[i]);
                }
                block.properties = file.attributes.elements[0].gathered(rows);
                tf::point_writer& writer =
                    writers.emplace_back(std::filesystem::path(path.string() + std::to_string(r)),
                                         file, count, tf::write_options{.format = "laz"});
                REQUIRE(writer.has_parts());
                CHECK(writer.part_granularity() == 50'000);
                writer.write(block.points, block.properties);
                summaries.push_back(writer.part_summary());
            }
            std::vector<std::string> heads;
            std::string points;
            for (std::size_t r = 0; r < writers.size(); ++r) {
                tf::write_result result;
                const tf::detail::io::written_part part = writers[r].commit_part(result, summaries);
                std::ifstream in(path.string() + std::to_string(r), std::ios::binary);
                const std::string bytes(std::istreambuf_iterator<char>(in), {});
                if (part.points > 0) heads.push_back(bytes.substr(0, part.head));
                points += r + 1 == writers.size() ? bytes.substr(part.head)
                                                  : bytes.substr(part.head, part.points);
                std::filesystem::remove(path.string() + std::to_string(r));
            }
            CHECK(tf::point_writer::join_heads(heads) + points ==
                  tf::write_to_memory(file, {.format = "laz"}));
        }
}

TEST_CASE("LAZ: chunks ahead of the first point are not read") {
    const auto path = std::filesystem::temp_directory_path() / "treeform_io_laz_first.laz";
    constexpr std::size_t count = 110'000;
    test::las_bytes las = las_of(1, 3);
    const tf::mesh_file file =
        read_las(las.file(test::las_points(test::las_family::scan, 1, las.record_size, count, 5)));
    std::string bytes = tf::write_to_memory(file, {.format = "laz"});
    for (const bool damaged : {false, true}) {
        if (damaged)  // within the first of three chunks
            std::fill_n(bytes.begin() + std::ptrdiff_t(bytes.size() / 4), 1000, '\x55');
        std::ofstream(path, std::ios::binary) << bytes;
        for (const std::size_t first : {49'999u, 50'000u, 50'001u, 100'000u, 109'999u, 110'000u}) {
            CAPTURE(first);
            std::vector<tf::point3> points;
            const auto read_all = [&] {
                tf::point_reader reader(path, "", first);
                tf::detail::io::point_block block;
                while (reader.read(block.points, block.properties, 30'000))
                    points.insert(points.end(), block.points.begin(), block.points.end());
            };
            if (damaged && first < 50'000) {
                CHECK_THROWS_AS(read_all(), tf::io_error);
                continue;
            }
            read_all();
            const std::vector<tf::point3> expected(file.mesh.points.begin() + std::ptrdiff_t(first),
                                                   file.mesh.points.end());
            CHECK(points == expected);
        }
    }
    std::filesystem::remove(path);
}

TEST_CASE("E57: a message names the program that converts it") {
    CHECK(has_part(las_complaint(std::string_view("ASTM-E57\1\0\0\0", 12)), "pdal translate"));
}
