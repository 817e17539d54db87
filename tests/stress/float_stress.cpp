/// \file
/// Whether large hard solids can be written in floats: gears of long thin triangles, gantries of
/// overlapping shells, layers of noise, and a model that others fail on.
///
/// TREEFORM_STRESS_COUNT sets the cases of each kind (default 1), TREEFORM_STRESS_SEED the seed.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/float_output.hpp>
#include <support/machine_parts.hpp>
#include <support/models.hpp>
#include <support/random.hpp>
#include <support/settings.hpp>
#include <support/solid_families.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr tf::precision to_float = tf::precision::float32;

std::vector<std::uint64_t> seeds() {
    std::vector<std::uint64_t> all;
    for (std::uint64_t i = 0; i < test::stress_count(1); ++i)
        all.push_back(test::stress_seed() + i);
    return all;
}

/// Mending in floats is bounded, and what it leaves is no larger than three times the exact result.
template <class Result>
void check_floats(const Result& doubles, const Result& floats) {
    test::check_floats(doubles, floats);
    CHECK(floats.mesh.faces.size() <= 3 * floats.statistics.exact_faces + 1000);
    if constexpr (requires { floats.statistics.rounding_rounds; })
        CHECK(floats.statistics.rounding_rounds <= 15);
}

void check_formula(const std::vector<tf::mesh>& operands, const tf::boolean_expression& formula) {
    const std::vector<tf::mesh_view> views(operands.begin(), operands.end());
    check_floats(tf::boolean(views, formula), tf::boolean(views, formula, {.precision = to_float}));
}

void check_repair(const tf::mesh& mesh) {
    check_floats(
        tf::resolve_self_intersections(mesh),
        tf::resolve_self_intersections(mesh, tf::resolve_mode::outer, {.precision = to_float}));
}

}  // namespace

TEST_CASE("two gears of 20,000 long thin triangles each, less one another, can be written") {
    for (const std::uint64_t seed : seeds()) {
        CAPTURE(seed);
        test::random source(seed);
        check_formula(test::gears(source, 20'000), {"a-b", 2});
    }
}

TEST_CASE("a gantry of 60,000 faces in 80 overlapping shells can be written") {
    for (const std::uint64_t seed : seeds()) {
        CAPTURE(seed);
        test::random source(seed);
        check_repair(test::gantry(source, 80, 60'000));
    }
}

TEST_CASE("layers of noise can be written") {
    for (const test::solid_family& family : test::solid_families()) {
        if (family.name != "noise") continue;
        for (std::size_t number = 0; number < 20 * seeds().size(); ++number) {
            CAPTURE(number);
            test::random source(1'000'003 * test::stress_seed() + number);
            const test::solid_case made = family.make(number, source);
            const std::vector<tf::mesh_view> views(made.operands.begin(), made.operands.end());
            for (const tf::boolean_expression& asked : made.asked) {
                const auto floats = tf::boolean(views, asked, {.precision = to_float});
                if (floats.certificate.status != tf::status::vanished)
                    check_floats(tf::boolean(views, asked), floats);
            }
        }
    }
}

TEST_CASE("models that others fail on are repaired within a thousandth of their size") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    for (const std::string_view name : {"openscad_crash_1k.obj", "ht90_actuator_4k.stl"}) {
        CAPTURE(name);
        const tf::mesh mesh =
            tf::join_equal_points(tf::read(folder / "selfint" / std::string(name)).mesh);
        const double most = 1e-3 * tf::bounding_box(mesh.points)->diagonal();
        const tf::repair_result doubles = tf::repair(mesh);
        const tf::repair_result floats =
            tf::repair(mesh, {.precision = to_float, .max_displacement = most});
        test::check_floats(doubles, floats);
        CHECK(floats.certificate.max_displacement <= most);
        const double volume = tf::signed_volume(doubles.mesh);
        CHECK(std::abs(tf::signed_volume(floats.mesh) - volume) < 1e-3 * volume);
        // Needles that meet in their tips, as deep as they have to be moved apart.
        if (name == "ht90_actuator_4k.stl") CHECK(floats.statistics.touching == 0);
    }
}

TEST_CASE("a model of OpenSCAD's crash reports, repaired and cut, can be written") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    const tf::mesh mesh =
        tf::join_equal_points(tf::read(folder / "selfint/openscad_crash_1k.obj").mesh);
    check_repair(mesh);
    const auto box = *tf::bounding_box(mesh.points);
    const tf::point3 middle{(box.min[0] + box.max[0]) / 2, (box.min[1] + box.max[1]) / 2,
                            (box.min[2] + box.max[2]) / 2};
    const tf::point3 back{-middle.x, -middle.y, -middle.z};
    const double size =
        std::hypot(box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]);
    check_formula({mesh, test::moved(test::scaled(test::ball(4, 1.0), 0.25 * size), middle)},
                  {"a-b", 2});
    check_formula({mesh, test::moved(mesh, {0.01 * size, 0.017 * size, 0.007 * size})}, {"a-b", 2});
    check_formula(
        {mesh, test::moved(test::turned(test::moved(mesh, back), {1, 2, 3}, 0.3), middle)},
        {"a-b", 2});
}
