/// \file
/// Plates of fifty real parts: the share placed from roomy plates down to small ones, beside the
/// best of many seeds and beside libnest2d, by which slicers arrange; and that no two parts meet,
/// by CGAL, in the coordinates returned. Without TREEFORM_MODELS_DIR nothing is checked.
///
/// TREEFORM_STRESS_COUNT sets the number of seeds (default 2).

#include "nest_outlines.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/tf.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <doctest/doctest.h>
#include <support/models.hpp>
#include <support/random.hpp>
#include <support/settings.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace {

using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr double any_height = std::numeric_limits<double>::infinity();

/// Fifty parts of 12 to 45 in length: models of at most 5,000 faces, several times.
std::vector<tf::mesh> real_parts(const std::filesystem::path& folder) {
    std::vector<tf::mesh> models;
    for (const std::string& file : test::files_with_truth(folder)) {
        const std::string kind = file.substr(0, file.find('/'));
        if (kind != "clean" && kind != "cad" && kind != "robot" && kind != "selfint" &&
            kind != "coplanar")
            continue;
        tf::mesh mesh = tf::as_mesh(tf::read(folder / file)).mesh;
        if (!mesh.faces.empty() && mesh.faces.size() <= 5'000) models.push_back(std::move(mesh));
    }
    REQUIRE(models.size() > 10);
    test::random source(20);
    std::vector<tf::mesh> parts;
    for (std::size_t i = 0; i < 50; ++i) {
        tf::mesh part = models[i % models.size()];
        const tf::box3 box = *tf::bounding_box(part.points);
        double size = 0.0;
        for (std::size_t k = 0; k < 3; ++k) size = std::max(size, box.max[k] - box.min[k]);
        const double by = source.in(12, 45) / size;
        for (tf::point3& p : part.points)
            for (std::size_t k = 0; k < 3; ++k) p[k] = (p[k] - box.min[k]) * by;
        parts.push_back(std::move(part));
    }
    return parts;
}

/// Whether two of the placed parts have a point in common.
bool some_meet(const std::vector<tf::mesh>& parts, const tf::packing& found) {
    struct side {
        std::size_t part;
        kernel::Triangle_3 triangle;
    };
    std::vector<side> sides;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!found.parts[i].placed) continue;
        const auto at = [&](std::uint32_t v) {
            const tf::point3& p = found.parts[i].points[v];
            return kernel::Point_3(p.x, p.y, p.z);
        };
        for (const tf::face& f : parts[i].faces)
            sides.push_back({i, kernel::Triangle_3(at(f[0]), at(f[1]), at(f[2]))});
    }
    using box =
        CGAL::Box_intersection_d::Box_with_handle_d<double, 3, std::vector<side>::const_iterator>;
    std::vector<box> boxes;
    for (auto it = sides.cbegin(); it != sides.cend(); ++it)
        boxes.emplace_back(it->triangle.bbox(), it);
    bool meet = false;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const box& a, const box& b) {
        const side &x = *a.handle(), &y = *b.handle();
        if (meet || x.part == y.part) return;
        if (x.triangle.is_degenerate() || y.triangle.is_degenerate()) return;
        meet = CGAL::do_intersect(x.triangle, y.triangle);
    });
    return meet;
}

std::vector<tf::mesh_view> views(const std::vector<tf::mesh>& parts) {
    return {parts.begin(), parts.end()};
}

std::size_t placed(const tf::packing& found) {
    return found.parts.size() - found.not_placed.size();
}

}  // namespace

TEST_CASE("pack: of fifty real parts as many have a place as by other seeds, or by libnest2d") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    const std::vector<tf::mesh> parts = real_parts(folder);
    const std::size_t seeds = test::setting("TREEFORM_STRESS_COUNT", 2);
    std::vector<test::flat_points> from_above;
    for (const tf::mesh& part : parts) {
        test::flat_points& flat = from_above.emplace_back();
        for (const tf::point3& p : part.points) flat.push_back({p.x, p.y});
    }
    std::string table = "\nside  placed  tries  density  best of seeds  libnest2d\n";
    for (const double side : {220.0, 175.0, 150.0}) {
        CAPTURE(side);
        tf::pack_options options{.size = {side, side, any_height}, .tries = 9};
        const tf::packing found = tf::pack(views(parts), options);
        CHECK_FALSE(some_meet(parts, found));
        std::size_t best = 0;
        for (std::size_t seed = 1; seed <= seeds; ++seed) {
            options.seed = seed;
            options.tries = 4;
            best = std::max(best, placed(tf::pack(views(parts), options)));
        }
        CHECK(placed(found) + 1 >= best);
        const auto nested = test::nest_outlines(from_above, side, options.spacing);
        if (nested) CHECK(placed(found) >= *nested);
        table += std::to_string(static_cast<int>(side)) + "   " + std::to_string(placed(found)) +
                 "      " + std::to_string(found.tries) + "     " + std::to_string(found.density) +
                 "     " + std::to_string(best) + "     " +
                 (nested ? std::to_string(*nested) : "-") + "\n";
    }
    MESSAGE(table);
}

TEST_CASE("pack: stacked in a box, and on plates, no two real parts meet in written coordinates") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    const std::vector<tf::mesh> parts = real_parts(folder);
    for (const auto precision : {tf::precision::float64, tf::precision::float32}) {
        const tf::packing box = tf::pack(views(parts), {.size = {100, 100, 80},
                                                        .spacing = 1,
                                                        .stack = true,
                                                        .tries = 1,
                                                        .precision = precision});
        MESSAGE("in a box of 100 x 100 x 80: ", box.message(), ", density ", box.density);
        CHECK(placed(box) > 25);
        CHECK_FALSE(some_meet(parts, box));
        const tf::packing plates = tf::pack(views(parts), {.size = {90, 90, any_height},
                                                           .plates = 9,
                                                           .plate_step = {100, 0, 0},
                                                           .tries = 4,
                                                           .precision = precision});
        MESSAGE("on plates of 90 x 90: ", plates.message(), ", density ", plates.density);
        CHECK(plates.not_placed.empty());
        CHECK_FALSE(some_meet(parts, plates));
    }
}
