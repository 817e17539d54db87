#include <libmesh/round/coarse_grid.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using box3 = tf::aabb<double, 3>;
using tf::detail::round::coarse_grid;

box3 box_of(const tf::mesh& mesh, const tf::face& f) {
    box3 box;
    for (const std::uint32_t corner : f) box.include(mesh.points[corner]);
    return box;
}

/// How many of `asked` the grid of `added` lets pass; all that it has to are among them.
std::size_t count_passed(const tf::mesh& added, const tf::mesh& asked) {
    box3 reach;
    std::vector<box3> boxes;
    for (const tf::face& f : added.faces) {
        boxes.push_back(box_of(added, f));
        reach.include(boxes.back());
    }
    coarse_grid grid(reach);
    const auto cells_of = [&](const tf::mesh& mesh, const tf::face& f) {
        return std::array{grid.cell_of(mesh.points[f[0]]), grid.cell_of(mesh.points[f[1]]),
                          grid.cell_of(mesh.points[f[2]])};
    };
    for (const tf::face& f : added.faces) {
        const auto [a, b, c] = cells_of(added, f);
        grid.add(a, b, c);
    }
    grid.finish();
    std::size_t passed = 0;
    bool all_that_meet = true;
    for (const tf::face& f : asked.faces) {
        const auto [a, b, c] = cells_of(asked, f);
        const bool pass = grid.may_meet(a, b, c);
        const box3 box = box_of(asked, f);
        const bool meets = std::any_of(boxes.begin(), boxes.end(),
                                       [&](const box3& other) { return overlaps(box, other); });
        all_that_meet = all_that_meet && (pass || !meets);
        passed += pass ? 1 : 0;
    }
    CHECK(all_that_meet);
    return passed;
}

}  // namespace

TEST_CASE("coarse_grid: every face whose box meets one that was added passes, whatever the sizes") {
    test::random source(7);
    for (const double size : {1e-4, 0.003, 0.01, 0.02, 0.05, 0.3})
        for (const double other : {1e-4, 0.01, 0.04, 0.3}) {
            CAPTURE(size);
            CAPTURE(other);
            count_passed(test::random_soup(source, 60, size),
                         test::random_soup(source, 3000, other));
        }
}

TEST_CASE("coarse_grid: faces in the cells of others, beyond the box and in flat boxes pass") {
    test::random source(11);
    const tf::mesh soup = test::random_soup(source, 100, 0.02);
    CHECK(count_passed(soup, soup) == soup.faces.size());
    const tf::mesh sheet = test::grid(20);  // z = 0 throughout
    CHECK(count_passed(sheet, sheet) == sheet.faces.size());
    count_passed(soup, sheet);
    const tf::mesh point{{{2, 3, 4}}, {{0, 0, 0}}};
    CHECK(count_passed(point, point) == 1);
}

TEST_CASE("coarse_grid: no face is missed where boxes are as large or as small as doubles can be") {
    test::random source(12);
    const tf::mesh added = test::moved(test::random_soup(source, 60, 0.02), {-0.5, -0.5, -0.5});
    const tf::mesh asked = test::moved(test::random_soup(source, 1000, 0.05), {-0.5, -0.5, -0.5});
    for (const double size :
         {0x1p1023, 1e300, 0.9e290, 1.1e290, 0.9e-290, 1.1e-290, 1e-310, 1e-322}) {
        CAPTURE(size);
        count_passed(test::scaled(added, size), test::scaled(asked, size));
        count_passed(added, test::scaled(asked, size));
        count_passed(test::scaled(added, size), asked);
    }
}

TEST_CASE("coarse_grid: few faces pass that are far from all that were added") {
    test::random source(13);
    tf::mesh ends = test::random_soup(source, 2, 1e-3);
    for (std::size_t k = 0; k < 3; ++k) {
        ends.points[k] = {0.0, 0.0, 0.001 * static_cast<double>(k)};
        ends.points[k + 3] = {1.0, 1.0, 1.0 - 0.001 * static_cast<double>(k)};
    }
    CHECK(count_passed(ends, test::random_soup(source, 10000, 0.01)) < 100);
}
