#pragma once
/// \file
/// A dynamic tree and what should be in it.

#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/detail/node_bounds.hpp>
#include <treeform/tree/dynamic_tree.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace test {

using ids = std::vector<std::uint32_t>;

template <std::size_t D>
using box = tf::aabb<double, D>;

/// What should be in the tree: a map.
template <std::size_t D>
using model = std::map<std::uint32_t, box<D>>;

/// A dynamic tree and what should be in it, changed together.
template <std::size_t D>
struct twin {
    tf::dynamic_tree<D> tree;
    model<D> all;

    ids insert(const boxes<D>& of) {
        const ids given = tree.insert(of, itself);
        REQUIRE(given.size() == of.size());
        for (std::size_t i = 0; i < of.size(); ++i) REQUIRE(all.emplace(given[i], of[i]).second);
        return given;
    }
    void remove(const ids& which) {
        tree.remove(which);
        for (const std::uint32_t id : which) REQUIRE(all.erase(id) == 1);
    }
    void move(const ids& which, const boxes<D>& to) {
        tree.move(which, to);
        for (std::size_t i = 0; i < which.size(); ++i) all[which[i]] = to[i];
    }
    /// `count` different ids of those there, at most all.
    [[nodiscard]] ids some(std::size_t count, test::random& random) const {
        ids result;
        for (const auto& [id, of] : all) result.push_back(id);
        random.shuffle(result);
        result.resize(std::min(count, result.size()));
        return result;
    }
    [[nodiscard]] boxes<D> shifted(const ids& which, double by, test::random& random) const {
        boxes<D> result;
        for (const std::uint32_t id : which) {
            box<D> moved = all.at(id);
            for (std::size_t k = 0; k < D; ++k) {
                const double step = by * (random.unit() - 0.5);
                moved.min[k] += step;
                moved.max[k] += step;
            }
            result.push_back(moved);
        }
        return result;
    }

    /// One random update.
    void step(test::random& random, const boxes<D>& source) {
        const auto size = std::size_t{1} << random.below(9);
        boxes<D> fresh;
        for (std::size_t i = 0; i < size; ++i) fresh.push_back(source[random.below(source.size())]);
        const ids which = some(size, random);
        fresh.resize(size);
        switch (random.below(4)) {
            case 0:
                (void)insert(fresh);
                break;
            case 1:
                remove(which);
                break;
            case 2:
                move(which, shifted(which, 0.02, random));
                break;
            default:
                fresh.resize(which.size());
                move(which, fresh);
        }
    }
};

/// The invariants that the documentation states.
template <std::size_t D>
void check_shape(const twin<D>& both) {
    REQUIRE(both.tree.size() == both.all.size());
    std::vector<std::size_t> sizes;
    ids found;
    for (const std::uint32_t part : both.tree.top().ids()) {
        const tf::tree<D>* const one = &both.tree.part(part);
        std::size_t live = 0;
        for (std::size_t place = 0; place < one->size(); ++place) {
            const std::uint32_t id = one->ids()[place];
            const tf::wide_node<D>& leaf = one->level(one->levels() - 1)[place / 8];
            const bool is_empty = leaf.min[0][place % 8] > leaf.max[0][place % 8];
            REQUIRE(is_empty == (id == 0xFFFFFFFF));
            if (is_empty) continue;
            REQUIRE(tf::detail::slot_holds(leaf, place % 8, both.all.at(id), one->frame()));
            found.push_back(id);
            ++live;
        }
        for (unsigned level = 0; level + 1 < one->levels(); ++level)
            for (std::size_t child = 0; child < one->nodes_in_level(level + 1); ++child) {
                const tf::detail::node_bounds<D> bounds(one->level(level + 1)[child]);
                const tf::wide_node<D>& parent = one->level(level)[child / 8];
                for (std::size_t k = 0; k < D; ++k) {
                    REQUIRE(parent.min[k][child % 8] == bounds.min[k]);
                    REQUIRE(parent.max[k][child % 8] == bounds.max[k]);
                }
            }
        REQUIRE(2 * live >= one->size());
        sizes.push_back(one->size());
    }
    std::sort(found.begin(), found.end());
    REQUIRE(std::ranges::equal(found, both.all, {}, {}, [](const auto& p) { return p.first; }));
    for (const auto& [id, of] : both.all) {
        REQUIRE(both.tree.contains(id));
        REQUIRE(both.tree.box(id) == of);
    }
    std::sort(sizes.begin(), sizes.end());
    for (std::size_t i = 1; i < sizes.size(); ++i) REQUIRE(sizes[i] >= 4 * sizes[i - 1]);
    const double size = std::max(static_cast<double>(both.all.size()), 1.0);
    REQUIRE(static_cast<double>(sizes.size()) <= 2.0 + std::max(0.0, std::log2(size / 32.0) / 2.0));
}

}  // namespace test
