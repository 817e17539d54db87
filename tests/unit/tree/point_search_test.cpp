#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/point_search.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

template <std::size_t D>
using cloud = std::vector<std::array<double, D>>;
using near_points = std::vector<tf::near_point>;

/// The lower corners of a family of boxes.
template <std::size_t D>
cloud<D> points_of(const std::string& family, std::size_t count, std::uint64_t seed) {
    cloud<D> points;
    for (const auto& box : test::box_family<D>(family, count, seed)) points.push_back(box.min);
    return points;
}

/// Everything by distance, then by number; `unit` keeps the squares in the range of double.
template <std::size_t D>
near_points points_by_brute_force(const cloud<D>& points, const std::array<double, D>& query,
                                  double unit) {
    near_points all;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        double squared = 0.0;
        for (std::size_t k = 0; k < D; ++k) {
            const double gap = points[i][k] * unit - query[k] * unit;
            squared += gap * gap;
        }
        all.push_back({i, squared});
    }
    std::sort(all.begin(), all.end(), [](const tf::near_point& a, const tf::near_point& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.id < b.id;
    });
    for (tf::near_point& one : all) one.distance = std::sqrt(one.distance) / unit;
    return all;
}

double unit_of(const std::string& family) {
    if (family == "tiny") return 0x1p1000;
    return family == "huge" || family == "extreme" ? 0x1p-1000 : 1.0;
}

near_points first_points(near_points all, std::size_t k) {
    all.resize(std::min(k, all.size()));
    return all;
}

near_points inside(near_points all, double radius) {
    std::erase_if(all, [&](const tf::near_point& one) { return one.distance > radius; });
    return all;
}

template <std::size_t D>
void compare_points(const std::string& family, std::size_t count) {
    const cloud<D> points = points_of<D>(family, count, 7);
    const tf::point_search<D> search(points);
    cloud<D> queries = points_of<D>(family, 290, 8);
    queries.insert(queries.end(), points.begin(),
                   points.begin() + std::min<long>(10, static_cast<long>(count)));
    queries.push_back({});
    for (const std::size_t k : {std::size_t{1}, std::size_t{6}, std::size_t{50}}) {
        const auto batch = search.k_nearest(queries, k);
        REQUIRE(batch.size() == queries.size());
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const near_points expected =
                first_points(points_by_brute_force(points, queries[i], unit_of(family)), k);
            REQUIRE(std::ranges::equal(batch[i], expected));
            if (i % 16 == 0) REQUIRE(search.k_nearest(queries[i], k) == expected);
        }
    }
    const near_points all = points_by_brute_force(points, queries[0], unit_of(family));
    const double radius = all[all.size() / 2].distance * (1.0 + 0x1p-30);
    const auto batch = search.all_within(queries, radius);
    for (std::size_t i = 0; i < queries.size(); ++i)
        REQUIRE(std::ranges::equal(
            batch[i], inside(points_by_brute_force(points, queries[i], unit_of(family)), radius)));
    REQUIRE(search.all_within(queries[0], radius) == inside(all, radius));
    REQUIRE(search.nearest(queries[0]) == all[0]);
}

}  // namespace

TEST_CASE("point search: nothing is near where there are no points") {
    const tf::point_search<3> none;
    CHECK(!none.nearest({1, 2, 3}));
    CHECK(none.k_nearest({1, 2, 3}, 4).empty());
    CHECK(none.all_within({1, 2, 3}, 1e300).empty());
    const cloud<3> queries(3);
    CHECK(none.k_nearest(queries, 2).size() == 3);
    CHECK(none.k_nearest(queries, 2).answers.empty());
    const tf::point_search<3> also_none(cloud<3>{});
    CHECK(also_none.k_nearest({1, 2, 3}, 4).empty());
}

TEST_CASE("point search: the radius is inclusive, and zero finds equal points") {
    const cloud<2> points{{3, 4}, {0, 0}, {6, 8}, {0, 0}};
    const tf::point_search<2> search(points);
    CHECK(search.all_within({0, 0}, 0.0) == near_points{{1, 0.0}, {3, 0.0}});
    CHECK(search.all_within({0, 0}, 5.0) == near_points{{1, 0.0}, {3, 0.0}, {0, 5.0}});
    CHECK(search.all_within({0, 0}, std::nextafter(5.0, 0.0)).size() == 2);
    CHECK(search.k_nearest({6, 0}, 2, 5.0) == near_points{{0, 5.0}});
    CHECK(!search.nearest({6, 0}, 4.0));
    CHECK(search.k_nearest({6, 0}, 0).empty());
}

TEST_CASE("point search: a float cloud is searched as the doubles it stands for") {
    const std::vector<std::array<float, 3>> points{{0.1F, 0.2F, 0.3F}, {1.0F, 1.0F, 1.0F}};
    const tf::point_search<3> search(points);
    const std::array<double, 3> same{0.1F, 0.2F, 0.3F};
    CHECK(search.nearest(same) == tf::near_point{0, 0.0});
    CHECK(search.nearest({0.1, 0.2, 0.3})->distance > 0.0);
}

TEST_CASE("point search: queries far off the cloud find its nearest point") {
    const cloud<2> points{{0, 0}, {1, 0}, {2, 0}};
    const tf::point_search<2> search(points);
    CHECK(search.nearest({1e9, 0})->id == 2);
    CHECK(search.nearest({-1e15, 0})->id == 0);
    CHECK(search.nearest({1e300, 0})->distance == 1e300);
    CHECK(search.nearest({0, -1e-300})->id == 0);
}

TEST_CASE("point search: what cannot be meant is refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const tf::point_search<2> search(cloud<2>{{0, 0}});
    CHECK_THROWS_AS((void)search.nearest({nan, 0}), std::invalid_argument);
    CHECK_THROWS_AS((void)search.nearest({0, 0}, -1.0), std::invalid_argument);
    CHECK_THROWS_AS((void)search.all_within({0, 0}, nan), std::invalid_argument);
    const cloud<2> queries{{0, 0}, {0, nan}};
    CHECK_THROWS_WITH_AS((void)search.k_nearest(queries, 1),
                         "treeform::point_search: query 1 is not finite", std::invalid_argument);
    CHECK_THROWS_AS(tf::point_search<2>(cloud<2>{{0, nan}}), std::invalid_argument);
}

TEST_CASE("point search: answers are those of brute force, to the last bit and tie") {
    for (const std::string& family : test::box_families) {
        CAPTURE(family);
        for (const std::size_t count : {1U, 9U, 600U}) {
            CAPTURE(count);
            compare_points<2>(family, count);
            compare_points<3>(family, count);
        }
    }
}

TEST_CASE("point search: pairs are those of brute force, whatever the scale") {
    for (const double scale : {1e-200, 1.0, 1e200}) {
        cloud<3> points = points_of<3>("mixed", 400, 3);
        double extent = 0.0;
        for (auto& p : points)
            for (double& x : p) extent = std::max(extent, std::abs(x));
        for (auto& p : points)
            for (double& x : p) x = x / extent * scale;
        const tf::point_search<3> search(points);
        std::vector<tf::id_pair> expected;
        for (std::uint32_t a = 0; a < points.size(); ++a)
            for (std::uint32_t b = a + 1; b < points.size(); ++b)
                if (std::hypot(points[a][0] - points[b][0], points[a][1] - points[b][1],
                               points[a][2] - points[b][2]) <= 0.1 * scale)
                    expected.emplace_back(a, b);
        CHECK(search.pairs_within(0.1 * scale) == expected);
        CHECK(expected.size() > 10);
        CHECK(search.pairs_within(0.1 * scale, [](double) { return false; }).empty());
        const tf::thread_scope one(1);
        int looks = 0;
        CHECK(search.pairs_within(2.0 * scale, [&](double) { return ++looks == 1; }).empty());
        CHECK(looks == 2);
        CHECK(search.pairs_within(4.0 * scale).size() == 400 * 399 / 2);
        CHECK(search.pairs_within(0.0).size() < 400);
    }
    CHECK(tf::point_search<2>().pairs_within(1.0).empty());
    CHECK_THROWS_AS((void)tf::point_search<2>().pairs_within(-1.0), std::invalid_argument);
}

TEST_CASE("point search: answers are the same on any number of threads") {
    const tf::point_search<3> search(points_of<3>("mixed", 2000, 1));
    const cloud<3> queries = points_of<3>("mixed", 3000, 2);
    const auto expected = search.k_nearest(queries, 5);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(search.k_nearest(queries, 5).answers == expected.answers);
    }
}

TEST_CASE("point search: a projection says where an element is") {
    struct star {
        int name;
        std::array<float, 3> at;
    };
    const std::vector<star> stars{{7, {0, 0, 0}}, {8, {1, 0, 0}}, {9, {4, 0, 0}}};
    const tf::point_search<3> by_member(stars, &star::at);
    const tf::point_search<3> by_function(stars, [](const star& s) {
        return std::array<double, 3>{-s.at[0], 0, 0};
    });
    CHECK(by_member.nearest({3, 0, 0}) == tf::near_point{2, 1.0});
    CHECK(by_function.nearest({-1.5, 0, 0}) == tf::near_point{1, 0.5});
    CHECK(by_member.k_nearest({0, 0, 0}, 2).back() == tf::near_point{1, 1.0});
}

namespace {

struct place {
    float x, y;
};
struct place_in_space {
    float x, y, z;
};
template <std::size_t D, class Query>
concept is_query = requires(const tf::point_search<D>& search, const Query& query) {
    search.nearest(query);
};

}  // namespace

TEST_CASE("point_search: points and queries may be of any type with x, y, z or with []") {
    const std::vector<tf::point3> points{{0, 0, 0}, {1, 0, 0}, {4, 4, 4}};
    const tf::point_search<3> search(points);
    CHECK(search.nearest(tf::point3{3, 3, 3})->id == 2);
    CHECK(search.nearest({3, 3, 3})->id == 2);
    CHECK(search.nearest(std::array{0.9F, 0.0F, 0.0F})->id == 1);
    CHECK(search.nearest(place_in_space{3, 3, 3}, 1.0) == std::nullopt);
    CHECK(search.k_nearest(points[1], 2) == search.k_nearest({1, 0, 0}, 2));
    CHECK(search.all_within(points[1], 1.0) == search.all_within({1, 0, 0}, 1.0));
    const std::vector<std::array<double, 3>> arrays{{0, 0, 0}, {1, 0, 0}, {4, 4, 4}};
    CHECK(search.k_nearest(points, 2).answers == search.k_nearest(arrays, 2).answers);
    CHECK(search.all_within(points, 1.5).begin == search.all_within(arrays, 1.5).begin);
    const std::vector<place> plane{{0, 0}, {5, 1}};
    const tf::point_search<2> flat(plane);
    CHECK(flat.nearest(tf::point2{4, 4})->id == 1);
    CHECK(flat.nearest(plane[1])->distance == 0.0);
    static_assert(is_query<3, tf::point3> && is_query<2, tf::point2>);
    static_assert(!is_query<3, tf::point2> && !is_query<2, tf::point3>);
    static_assert(!is_query<3, std::array<float, 2>> && !is_query<3, place>);
}
