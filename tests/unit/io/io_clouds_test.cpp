// Real LAS and LAZ files: read, written, and read again.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/las_bytes.hpp>
#include <support/models.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string written(const tf::mesh_file& file, const std::string& format) {
    return tf::write_to_memory(file, {.format = format});
}

std::vector<tf::point3> sorted_places(const tf::mesh_file& file) {
    std::vector<tf::point3> points = file.mesh.points;
    std::sort(points.begin(), points.end(), [](const tf::point3& a, const tf::point3& b) {
        return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    });
    return points;
}

}  // namespace

TEST_CASE("clouds: what is whole comes back bit for bit, as LAS and through LAZ") {
    const auto folder = test::clouds_folder();
    if (folder.empty()) return;
    std::size_t read = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".las") continue;
        CAPTURE(entry.path().filename().string());
        const std::string original = bytes_of(entry.path());
        tf::mesh_file file;
        try {
            file = tf::read(entry.path());
        } catch (const tf::io_error& e) {
            MESSAGE(e.what());
            continue;
        }
        ++read;
        const std::string plain = written(file, "las");
        CHECK(test::points_of(plain) == test::points_of(original));
        const auto first = test::get<std::uint16_t>(original, 94);
        if (file.warnings.empty()) {
            CHECK(test::get<std::uint32_t>(plain, 96) == test::get<std::uint32_t>(original, 96));
            const auto records = test::get<std::uint32_t>(original, 96) - first;
            CHECK(plain.substr(first, records) == original.substr(first, records));
        }
        CHECK(written(tf::read(std::as_bytes(std::span(written(file, "laz"))), "a.laz", {}),
                      "las") == plain);
    }
    CHECK(read >= 20);
}

TEST_CASE("clouds: LAZ equals its twin") {
    const auto folder = test::clouds_folder();
    if (folder.empty()) return;
    const tf::mesh_file las = tf::read(folder / "apps/simple.las");
    for (const char* name : {"apps/simple.laz", "apps/simple-laszip-compressor-version-1.2r0.laz",
                             "laszip/laszip-generated.laz", "laszip/liblas-generated.laz",
                             "laszip/laszip-generated_with2bytespadding.laz"}) {
        CAPTURE(name);
        const tf::mesh_file laz = tf::read(folder / name);
        CHECK(laz.mesh == las.mesh);
        CHECK(laz.attributes.elements == las.attributes.elements);
    }
    const tf::mesh_file star = tf::read(folder / "ept/lone-star.laz");
    const tf::mesh_file copc = tf::read(folder / "copc/lone-star.copc.laz");
    REQUIRE(star.mesh.points.size() == 518862);
    CHECK(sorted_places(star) == sorted_places(copc));
    CHECK(sorted_places(tf::read(folder / "las/1.2-with-color.las")) ==
          sorted_places(tf::read(folder / "copc/1.2-with-color.copc.laz")));
    // Written anew it is a plain LAZ.
    const tf::mesh_file again =
        tf::read(std::as_bytes(std::span(written(copc, "laz"))), "again.laz", {});
    CHECK(again.attributes.elements == copc.attributes.elements);
    for (const tf::las_record& r : again.attributes.las->records)
        CHECK(std::string_view(r.user_id) != "copc");
}
