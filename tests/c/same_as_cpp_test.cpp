#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/models.hpp>
#include <treeform.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace {

struct handle_deleter {
    void operator()(void* what) const { treeform_free(what); }
};
template <class T>
using handle = std::unique_ptr<T, handle_deleter>;

/// The result of a call that ends with `code`.
template <class T, class Call>
handle<T> result_of(const Call& call, treeform_code code = TREEFORM_OK) {
    T* made = nullptr;
    INFO(treeform_last_error());
    CHECK(call(&made) == code);
    return handle<T>(made);
}

std::string model_path(const char* name) { return (test::data_folder() / name).string(); }

tf::mesh mesh_of(const std::string& path) {
    tf::mesh_file file = tf::read(path);
    return tf::usable_faces(std::move(file.mesh), std::move(file.face_of_triangle)).mesh;
}

handle<treeform_mesh> borrow(const tf::mesh& mesh) {
    return result_of<treeform_mesh>([&](treeform_mesh** out) {
        return treeform_mesh_create(
            reinterpret_cast<const double*>(mesh.points.data()), mesh.points.size(),
            reinterpret_cast<const std::uint32_t*>(mesh.faces.data()), mesh.faces.size(), 0, out);
    });
}

/// Both may be null where there is none.
bool same_bytes(const void* a, const void* b, std::size_t size) {
    return size == 0 || std::memcmp(a, b, size) == 0;
}

bool same(const treeform_arrays& c, const tf::mesh& cpp) {
    return c.point_count == cpp.points.size() && c.face_count == cpp.faces.size() &&
           same_bytes(c.points, cpp.points.data(), c.point_count * sizeof(tf::point3)) &&
           same_bytes(c.faces, cpp.faces.data(), c.face_count * sizeof(tf::face));
}

/// Models that come with the sources, and some real ones where they are.
std::vector<std::string> models() {
    std::vector<std::string> paths;
    for (const char* name : {"two_spheres.stl", "dirty.stl", "cube.stl", "sphere.ply", "fold.obj",
                             "pierce.obj", "duplicate_face.obj", "cubes_on_an_edge.stl"})
        paths.push_back(model_path(name));
    if (test::has_models())
        for (const char* kind : {"selfint", "cad"}) {
            std::size_t taken = 0;
            std::vector<std::string> found;
            for (const auto& entry :
                 std::filesystem::directory_iterator(test::models_folder() / kind))
                if (entry.is_regular_file() && entry.file_size() < 200'000)
                    found.push_back(entry.path().string());
            std::sort(found.begin(), found.end());
            for (const std::string& path : found)
                if (taken < 3 && path.find("SOURCES") == std::string::npos) {
                    paths.push_back(path);
                    ++taken;
                }
        }
    return paths;
}

}  // namespace

TEST_CASE("c: pairs are those of C++, in their order") {
    for (const std::string& path : models()) {
        CAPTURE(path);
        const tf::mesh mesh = mesh_of(path);
        const auto expected = tf::self_intersections(mesh);
        const auto input = borrow(mesh);
        const auto found =
            result_of<treeform_face_pair_result>([&](treeform_face_pair_result** out) {
                return treeform_self_intersections(input.get(), nullptr, out);
            });
        REQUIRE(found->count == expected.pairs.size());
        for (std::size_t i = 0; i < found->count; ++i) {
            CHECK(found->pairs[i].a == expected.pairs[i].a);
            CHECK(found->pairs[i].b == expected.pairs[i].b);
            CHECK(found->pairs[i].kind == static_cast<std::uint8_t>(expected.pairs[i].kind));
        }
    }
}

TEST_CASE("c: what is resolved and repaired is that of C++, bit for bit") {
    for (const std::string& path : models()) {
        CAPTURE(path);
        const tf::mesh mesh = mesh_of(path);
        const auto input = borrow(mesh);
        const auto resolved = tf::resolve_self_intersections(mesh);
        const auto outer = result_of<treeform_repair_result>(
            [&](treeform_repair_result** out) {
                return treeform_resolve_self_intersections(input.get(), TREEFORM_RESOLVE_OUTER,
                                                           nullptr, out);
            },
            resolved.certificate ? TREEFORM_OK : TREEFORM_NOT_CERTIFIED);
        REQUIRE(outer);
        CHECK(same(outer->mesh, resolved.mesh));
        CHECK(outer->certificate->message == resolved.certificate.message());
        const auto expected = tf::repair(mesh);
        const auto repaired = result_of<treeform_repair_result>(
            [&](treeform_repair_result** out) {
                return treeform_repair(input.get(), nullptr, out);
            },
            expected.certificate ? TREEFORM_OK : TREEFORM_NOT_CERTIFIED);
        REQUIRE(repaired);
        CHECK(same(repaired->mesh, expected.mesh));
        CHECK(repaired->statistics->volume_after == expected.statistics.volume_after);
    }
}

TEST_CASE("c: combined, welded and placed meshes are those of C++, bit for bit") {
    const tf::mesh a = mesh_of(model_path("two_spheres.stl"));
    const tf::mesh b = mesh_of(model_path("sphere.ply"));
    const auto first = borrow(a), second = borrow(b);
    const treeform_mesh* const both[] = {first.get(), second.get()};
    const auto made = tf::boolean({a, b}, {"(a-b)+(b-a)", 2});
    const auto combined = result_of<treeform_boolean_result>([&](treeform_boolean_result** out) {
        return treeform_boolean(both, 2, "(a-b)+(b-a)", nullptr, out);
    });
    CHECK(same(combined->mesh, made.mesh));
    CHECK(combined->face_source[0].operand == made.face_source[0].operand);

    treeform_weld_options options;
    treeform_weld_options_init(&options, sizeof options);
    options.tolerance = 0.15;
    const auto thin = tf::weld(b, {.tolerance = 0.15});
    const auto welded = result_of<treeform_weld_result>(
        [&](treeform_weld_result** out) { return treeform_weld(second.get(), &options, out); });
    CHECK(same(welded->mesh, thin.mesh));

    const double direction[3] = {0.25, 0.5, -1.0};
    tf::mesh high = b;
    for (tf::point3& p : high.points) p.z += 7.0;
    const auto third = borrow(high);
    const auto expected = tf::slide(high, a, {0.25, 0.5, -1.0});
    const auto slid = result_of<treeform_placement>(
        [&](treeform_placement** out) {
            return treeform_slide(third.get(), both, 1, direction, nullptr, out);
        },
        expected ? TREEFORM_OK : TREEFORM_NO_PLACE);
    REQUIRE(slid->point_count == expected.points.size());
    CHECK(std::memcmp(slid->points, expected.points.data(),
                      slid->point_count * sizeof(tf::point3)) == 0);
    double distance = 0.0;
    CHECK(treeform_distance(third.get(), first.get(), nullptr, nullptr, &distance) == TREEFORM_OK);
    CHECK(distance == tf::distance(high, a));
}

TEST_CASE("c: files are written as by C++, byte for byte") {
    const tf::mesh_file file = tf::read(model_path("dirty.stl"));
    const auto input = result_of<treeform_file>([&](treeform_file** out) {
        return treeform_read(model_path("dirty.stl").c_str(), nullptr, out);
    });
    treeform_write_options options;
    treeform_write_options_init(&options, sizeof options);
    for (const char* format : {"stl", "ply", "obj", "off", "3mf"}) {
        CAPTURE(format);
        options.format = format;
        const auto bytes = result_of<treeform_bytes>([&](treeform_bytes** out) {
            return treeform_write_memory(input.get(), &options, out);
        });
        const std::string expected = tf::write_to_memory(file, {.format = format});
        REQUIRE(bytes->count == expected.size());
        CHECK(std::memcmp(bytes->bytes, expected.data(), expected.size()) == 0);
    }
}
