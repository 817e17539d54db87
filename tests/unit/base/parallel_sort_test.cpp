#include <libmesh/base/fill_stars.hpp>
#include <libmesh/base/flattened.hpp>
#include <libmesh/base/parallel_sort.hpp>
#include <libmesh/base/running_sums.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace {

namespace base = treeform::detail::base;

/// Around the sizes of blocks, and of merges that have no partner.
constexpr std::array<std::size_t, 10> sizes{0, 1, 2, 2047, 2048, 2049, 4097, 5000, 12'345, 100'000};

std::vector<std::uint32_t> random_numbers(std::size_t count, std::size_t below) {
    test::random random(count + below);
    std::vector<std::uint32_t> numbers(count);
    for (std::uint32_t& n : numbers) n = static_cast<std::uint32_t>(random.below(below));
    return numbers;
}

}  // namespace

TEST_CASE("parallel_sort: as std::sort, of few different numbers and of many, on any threads") {
    for (const std::size_t size : sizes)
        for (const std::size_t below : {std::size_t{1}, std::size_t{7}, std::size_t{1} << 30}) {
            std::vector<std::uint32_t> expected = random_numbers(size, below);
            const std::vector<std::uint32_t> given = expected;
            std::sort(expected.begin(), expected.end());
            for (const unsigned threads : {1U, 2U, 8U}) {
                const treeform::thread_scope scope(threads);
                std::vector<std::uint32_t> sorted = given;
                base::parallel_sort(sorted);
                CHECK(sorted == expected);
            }
        }
}

TEST_CASE("parallel_sort: what is equal ends up the same on any number of threads") {
    using pair = std::array<std::uint32_t, 2>;
    std::vector<pair> given;
    for (const std::uint32_t n : random_numbers(50'000, 5))
        given.push_back({n, static_cast<std::uint32_t>(given.size())});
    std::vector<pair> first;
    for (const unsigned threads : {1U, 2U, 8U}) {
        const treeform::thread_scope scope(threads);
        std::vector<pair> sorted = given;
        base::parallel_sort(sorted, [](const pair& a, const pair& b) { return a[0] < b[0]; });
        if (first.empty()) first = sorted;
        CHECK(sorted == first);
        CHECK(std::is_sorted(sorted.begin(), sorted.end(),
                             [](const pair& a, const pair& b) { return a[0] < b[0]; }));
        std::sort(sorted.begin(), sorted.end());
        std::vector<pair> all = given;
        std::sort(all.begin(), all.end());
        CHECK(sorted == all);
    }
}

TEST_CASE("running_sums, flattened: each part begins where those before it end") {
    for (const std::size_t size : sizes) {
        const std::vector<std::uint32_t> lengths = random_numbers(size, 3);
        std::vector<std::vector<std::size_t>> parts(size);
        std::vector<std::size_t> expected, sums{0};
        for (std::size_t i = 0; i < size; ++i) {
            parts[i].assign(lengths[i], i);
            expected.insert(expected.end(), lengths[i], i);
            sums.push_back(expected.size());
        }
        CHECK(base::running_sums(size, [&](std::size_t i) { return lengths[i]; }) == sums);
        CHECK(base::flattened(std::move(parts)) == expected);
    }
}

TEST_CASE(
    "fill_lists: what is at a point, in the order of its numbers, several times where given so") {
    constexpr std::size_t points = 3000;
    for (const std::size_t size : sizes) {
        const std::vector<std::uint32_t> a = random_numbers(size, points),
                                         b = random_numbers(size, points / 2);
        std::vector<std::vector<std::uint32_t>> expected(points);
        for (std::uint32_t i = 0; i < size; ++i)
            for (const std::uint32_t p : {a[i], b[i]}) expected[p].push_back(i);
        for (const unsigned threads : {1U, 8U}) {
            const treeform::thread_scope scope(threads);
            const auto found =
                base::fill_stars<std::size_t>(points, size, [&](std::size_t i, const auto& visit) {
                    visit(a[i]);
                    visit(b[i]);
                });
            bool same = true;
            for (std::size_t p = 0; p < points; ++p)
                same = same && std::ranges::equal(found[p], expected[p]);
            CHECK(same);
        }
    }
}
