#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>

#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <vector>

TEST_CASE("for_chunks: every element is in one chunk, and chunks are counted in order") {
    for (const std::size_t count : {0UL, 1UL, 9UL, 10UL, 11UL, 1000UL}) {
        std::vector<std::size_t> chunk_of(count, 0);
        std::atomic<std::size_t> calls{0};
        tf::for_chunks(count, 10, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
            ++calls;
            for (std::size_t i = begin; i < end; ++i) chunk_of[i] += chunk + 1;
        });
        CHECK(calls == tf::chunk_count(count, 10));
        for (std::size_t i = 0; i < count; ++i) REQUIRE(chunk_of[i] == i / 10 + 1);
    }
}

TEST_CASE("for_chunks: an exception reaches the caller") {
    CHECK_THROWS_AS(tf::for_chunks(100, 1,
                                   [](std::size_t i, std::size_t, std::size_t) {
                                       if (i == 57) throw std::runtime_error("57");
                                   }),
                    std::runtime_error);
}

TEST_CASE("for_chunks: a nested loop that returns has run all its chunks, whoever else throws") {
    std::atomic<int> short_loops{0};
    for (int round = 0; round < 200; ++round)
        CHECK_THROWS_AS(
            tf::for_chunks(8, 1,
                           [&](std::size_t i, std::size_t, std::size_t) {
                               if (i == 5) throw std::runtime_error("5");
                               std::atomic<std::size_t> ran{0};
                               tf::for_chunks(
                                   2000, 1, [&](std::size_t, std::size_t, std::size_t) { ++ran; });
                               if (ran != 2000) ++short_loops;
                           }),
            std::runtime_error);
    CHECK(short_loops == 0);
}

TEST_CASE("thread_scope: lowers the number of threads while it lives") {
    const unsigned before = tf::thread_count();
    {
        const tf::thread_scope one(1);
        CHECK(tf::thread_count() == 1);
    }
    CHECK(tf::thread_count() == before);
}
