/// \file
/// Placements of real meshes: what has been placed penetrates nothing, and could not have been
/// placed much further. Without TREEFORM_MODELS_DIR nothing is checked.

#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/nearness/closest_pair.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/models.hpp>
#include <support/truth.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

tf::mesh read(const std::filesystem::path& path) {
    return tf::join_equal_points(tf::read(path).mesh);
}

double largest_of(const tf::mesh& mesh) {
    double largest = 0.0;
    for (const tf::point3& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(p[k]));
    return largest;
}

/// `a` with its box centered above that of `b`, beyond it by the height of `b`.
tf::mesh above(tf::mesh a, const tf::mesh& b) {
    const tf::box3 from = tf::bounding_box(a.points).value();
    const tf::box3 to = tf::bounding_box(b.points).value();
    const double x = 0.5 * (to.min.x + to.max.x) - 0.5 * (from.min.x + from.max.x);
    const double y = 0.5 * (to.min.y + to.max.y) - 0.5 * (from.min.y + from.max.y);
    const double z = to.max.z + (to.max.z - to.min.z) - from.min.z;
    for (tf::point3& p : a.points) p = {p.x + x, p.y + y, p.z + z};
    return a;
}

tf::mesh dropped(tf::mesh a, double way, bool to_single) {
    for (tf::point3& p : a.points) {
        p.z -= way;
        if (to_single)
            p = {tf::detail::base::nearest_float(p.x), tf::detail::base::nearest_float(p.y),
                 tf::detail::base::nearest_float(p.z)};
    }
    return a;
}

}  // namespace

TEST_CASE("models: what is dropped on another stops outside of it, and not an ulp before") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    std::set<std::array<std::string, 2>> seen;
    int placed = 0, touching = 0;
    for (const test::truth_row& row : test::read_truth(folder / "TRUTH_PAIRS.csv")) {
        const std::array files{row.text("file_a"), row.text("file_b")};
        if (!seen.insert(files).second) continue;
        CAPTURE(row.text("pair"));
        const tf::mesh b = read(folder / files[1]);
        const tf::mesh a = above(read(folder / files[0]), b);
        const auto moving = tf::prepared_mesh::borrow(a), fixed = tf::prepared_mesh::borrow(b);
        const tf::point3 down{0.0, 0.0, -1.0};
        for (const bool to_single : {false, true}) {
            CAPTURE(to_single);
            const auto found = tf::slide(
                moving, fixed, down,
                {.precision = to_single ? tf::precision::float32 : tf::precision::float64});
            if (found.outcome == tf::placement_outcome::nothing_met) continue;
            REQUIRE(found.outcome == tf::placement_outcome::contact);
            const tf::mesh there{found.points, a.faces};
            CHECK(there.points == dropped(a, found.travel, to_single).points);
            const auto now = tf::relation(tf::prepared_mesh::borrow(there), fixed).relation;
            CHECK((now == tf::mesh_relation::touching) ==
                  (found.relation == tf::mesh_relation::touching));
            CHECK(now != tf::mesh_relation::penetrating);
            ++placed;
            touching += now == tf::mesh_relation::touching;
            if (now == tf::mesh_relation::touching) continue;
            // An ulp of the largest coordinate further it meets.
            double height = 0.0;
            for (const tf::point3& p : there.points) height = std::max(height, std::abs(p.z));
            const double largest = std::max({largest_of(a), height, found.travel});
            const double ulp = to_single ? std::ldexp(1.0, std::ilogb(height) - 23)
                                         : std::ldexp(1.0, std::ilogb(largest) - 52);
            const tf::mesh further = dropped(a, found.travel + ulp, to_single);
            CHECK(tf::relation(tf::prepared_mesh::borrow(further), fixed).relation !=
                  tf::mesh_relation::disjoint);
        }
    }
    CHECK(placed > 0);
    MESSAGE(placed << " placements checked, " << touching << " of them touch exactly");
}

TEST_CASE("models: fifty parts on a plate keep their distance, and those left out are named") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    // Fifty parts of moderate size, some of them twice, at sizes from 32 to 64.
    std::set<std::string> files;
    for (const test::truth_row& row : test::read_truth(folder / "TRUTH_PAIRS.csv"))
        files.insert({row.text("file_a"), row.text("file_b")});
    std::vector<tf::mesh> parts;
    for (int copy = 0; parts.size() < 50; ++copy) {
        REQUIRE(copy < 50);
        for (const std::string& file : files) {
            if (parts.size() == 50) break;
            tf::mesh part = read(folder / file);
            if (part.faces.size() > 30000) continue;
            const tf::box3 box = tf::bounding_box(part.points).value();
            const double size =
                std::max({box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z});
            const double factor = std::ldexp(1.0, 5 - std::ilogb(size));
            for (tf::point3& p : part.points) p = {factor * p.x, factor * p.y, factor * p.z};
            parts.push_back(std::move(part));
        }
    }
    const std::vector<tf::mesh_view> views(parts.begin(), parts.end());
    for (const double side : {600.0, 200.0}) {
        CAPTURE(side);
        const tf::pack_options options{.size = {side, side, infinity}, .spacing = 2.0};
        const auto result = tf::pack(views, options);
        std::vector<std::uint32_t> left_out;
        std::vector<tf::mesh> placed;
        for (std::uint32_t i = 0; i < parts.size(); ++i) {
            if (!result.parts[i].placed) {
                left_out.push_back(i);
                continue;
            }
            placed.push_back({result.parts[i].points, parts[i].faces});
            const tf::box3 box = tf::bounding_box(placed.back().points).value();
            CHECK(box.min.z == 0.0);
            CHECK(std::min(box.min.x, box.min.y) >= 0.0);
            CHECK(std::max(box.max.x, box.max.y) <= side);
        }
        CHECK(result.not_placed == left_out);
        CHECK(left_out.empty() == (side == 600.0));
        CHECK(placed.size() >= 5);
        std::vector<tf::tree<3>> trees;
        for (const tf::mesh& part : placed) trees.push_back(tf::build_face_tree(part));
        for (std::size_t i = 0; i < placed.size(); ++i)
            for (std::size_t j = i + 1; j < placed.size(); ++j) {
                const auto gap = tf::detail::nearness::closest_pair(placed[i], trees[i], placed[j],
                                                                    trees[j], 2.5);
                if (gap) CHECK(gap->distance >= 2.0);
            }
        MESSAGE(placed.size() << " of 50 parts on a plate of " << side);
    }
}
