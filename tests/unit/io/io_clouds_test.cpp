// Real LAS and LAZ files: read, written, and read again.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/las_bytes.hpp>
#include <support/models.hpp>
#include <support/own_folder.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

using test::bytes_of;

std::string written_cloud(const tf::mesh_file& file, const std::string& format) {
    return tf::write_to_memory(file, {.format = format});
}

tf::mesh_file read_back(std::string_view bytes) {
    return tf::read(std::as_bytes(std::span(bytes)), "written.laz", {});
}

/// The places in units of `unit`, which both files of a pair have; their offsets differ.
std::vector<std::array<double, 3>> sorted_places(const tf::mesh_file& file, double unit) {
    std::vector<std::array<double, 3>> places;
    for (const tf::point3& p : file.mesh.points)
        places.push_back({std::round(p.x / unit), std::round(p.y / unit), std::round(p.z / unit)});
    std::sort(places.begin(), places.end());
    return places;
}

}  // namespace

TEST_CASE("clouds: what is whole comes back bit for bit, as LAS and through LAZ") {
    NEEDS_CLOUDS();
    const auto folder = test::clouds_folder();
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
        const std::string plain = written_cloud(file, "las");
        CHECK(test::points_of(plain) == test::points_of(original));
        const auto first = test::get<std::uint16_t>(original, 94);
        if (file.warnings.empty()) {
            CHECK(test::get<std::uint32_t>(plain, 96) == test::get<std::uint32_t>(original, 96));
            const auto records = test::get<std::uint32_t>(original, 96) - first;
            CHECK(plain.substr(first, records) == original.substr(first, records));
        }
        CHECK(written_cloud(read_back(written_cloud(file, "laz")), "las") == plain);
    }
    CHECK(read >= 20);
}

TEST_CASE("clouds: LAZ equals its twin") {
    NEEDS_CLOUDS();
    const auto folder = test::clouds_folder();
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
    CHECK(sorted_places(star, 0.00025) == sorted_places(copc, 0.00025));
    const tf::mesh_file colors = tf::read(folder / "copc/1.2-with-color.copc.laz");
    CHECK(sorted_places(tf::read(folder / "las/1.2-with-color.las"), 0.01) ==
          sorted_places(colors, 0.01));
    // Written anew it is a plain LAZ.
    const tf::mesh_file again = read_back(written_cloud(copc, "laz"));
    CHECK(again.attributes.elements == copc.attributes.elements);
    for (const tf::las_record& r : again.las->records) CHECK(std::string_view(r.user_id) != "copc");
}
