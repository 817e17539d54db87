// Every STL, OBJ, PLY, OFF and XYZ file of TREEFORM_MODELS_DIR against its row of TRUTH.csv.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/models.hpp>
#include <support/truth.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace {

/// One row a file: what a reader of doubles sees.
std::vector<test::truth_row> truth(const std::filesystem::path& folder) {
    std::vector<test::truth_row> rows = test::read_truth(folder / "TRUTH.csv");
    std::erase_if(rows, [](const auto& row) { return row.text("precision") == "f32"; });
    return rows;
}

/// Malformed, but all that is there is whole triangles: read with a warning.
bool is_whole(const test::truth_row& r) {
    const std::string file = r.text("file");
    return file == "hostile/h_stl_count_max.stl" || file == "hostile/truncated.stl" ||
           file == "hostile/halfdonut_trailing_byte.stl" ||
           file == "hostile/invalid_triangle_count.stl";
}

bool same_bits_or_nan(const std::vector<tf::point3>& a, const std::vector<tf::point3>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t v = 0; v < a.size(); ++v)
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (std::bit_cast<std::uint64_t>(a[v][axis]) !=
                    std::bit_cast<std::uint64_t>(b[v][axis]) &&
                !(a[v][axis] != a[v][axis] && b[v][axis] != b[v][axis]))
                return false;
    return true;
}

tf::mesh_file reread(const std::string& bytes, const char* name) {
    return tf::read(std::as_bytes(std::span(bytes)), name, {});
}

}  // namespace

TEST_CASE("models: counts are those of the truth, and malformed files are refused with a reason") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    for (const test::truth_row& r : truth(folder)) {
        const auto path = folder / r.text("file");
        CAPTURE(path.string());
        if (is_whole(r)) {
            const tf::mesh_file file = tf::read(path);
            CHECK(file.stored_faces == static_cast<std::size_t>(r.number("faces_stored")));
            CHECK(file.warnings.size() == 1);
            continue;
        }
        if (r.text("status") == "malformed") {
            try {
                (void)tf::read(path);
                FAIL("read without complaint; wrong is: " << r.text("note"));
            } catch (const tf::io_error& e) {
                const std::string what = e.what();
                CHECK(what.starts_with(path.string() + ":"));
                CHECK(what.size() > path.string().size() + 8);
            }
            continue;
        }
        const tf::mesh_file file = tf::read(path);
        CHECK(file.format == r.text("format"));
        CHECK(file.mesh.points.size() == static_cast<std::size_t>(r.number("vertices_stored")));
        CHECK(file.stored_faces == static_cast<std::size_t>(r.number("faces_stored")));
        CHECK(file.mesh.faces.size() == static_cast<std::size_t>(r.number("triangles")));
        CHECK((file.stored_as == tf::precision::float32) == (r.text("precision") == "exact"));
        CHECK(file.indexed == !file.format.starts_with("stl"));
        std::size_t nonfinite = 0;
        for (const auto& p : file.mesh.points)
            nonfinite += std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) ? 0U : 1U;
        CHECK(nonfinite == static_cast<std::size_t>(r.number("nonfinite_vertices")));
    }
}

TEST_CASE("models: what was read comes back bit for bit from every format that can hold it") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    for (const test::truth_row& r : truth(folder)) {
        if (r.text("status") == "malformed") continue;
        const auto path = folder / r.text("file");
        const tf::mesh_file file = tf::read(path);
        for (const char* const format : {"ply", "off", "obj"}) {
            for (const bool ascii : {false, true}) {
                CAPTURE(path.string());
                CAPTURE(format);
                CAPTURE(ascii);
                const auto again =
                    reread(tf::write_to_memory(file, {.format = format, .ascii = ascii}), format);
                CHECK(same_bits_or_nan(again.mesh.points, file.mesh.points));
                CHECK(again.mesh.faces == file.mesh.faces);
                CHECK(again.face_of_triangle == file.face_of_triangle);
                CHECK(again.stored_as == file.stored_as);
                if (file.format.starts_with("ply") && std::string(format) == "ply")
                    CHECK(again.attributes.comments == file.attributes.comments);
            }
        }
        if (file.stored_as == tf::precision::float32 && !file.mesh.faces.empty()) {
            const auto stl = reread(tf::write_to_memory(file, {.format = "stl"}), "a.stl");
            REQUIRE(stl.mesh.faces.size() == file.mesh.faces.size());
            std::vector<tf::point3> corners;
            for (const tf::face& f : file.mesh.faces)
                for (const std::uint32_t corner : f) corners.push_back(file.mesh.points[corner]);
            CHECK(same_bits_or_nan(stl.mesh.points, corners));
        }
    }
}

TEST_CASE("models: scenes come with a part for each node that shows triangles") {
    NEEDS_MODELS();
    const auto folder = test::models_folder() / "scene";
    if (!std::filesystem::exists(folder / "nested.glb")) SKIP_CASE("the models have no scenes");
    CHECK(tf::read(folder / "cube_gears.3mf").attributes.parts.size() == 17);
    const tf::mesh_file menger = tf::read(folder / "mengerSponge3.glb");
    CHECK(menger.mesh.faces.size() == 21598);
    CHECK(menger.attributes.parts.size() == 1);
    const tf::mesh_file nested = tf::read(folder / "nested.glb");
    CHECK(nested.mesh.faces.size() == 12 * nested.attributes.parts.size());
    CHECK(nested.stored_as == tf::precision::float32);
}
