#pragma once
/// \file
/// Boxes that trees find hard in different ways, and what brute force says about them.

#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace test {

template <std::size_t D>
using boxes = std::vector<tf::aabb<double, D>>;
using id_pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

inline constexpr auto itself = [](const auto& box) { return box; };

template <std::size_t D>
double squared_between(const tf::aabb<double, D>& a, const tf::aabb<double, D>& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < D; ++k) {
        const double gap = std::max({0.0, a.min[k] - b.max[k], b.min[k] - a.max[k]});
        sum += gap * gap;
    }
    return sum;
}

template <std::size_t D>
tf::aabb<double, D> box_at(const std::array<double, D>& corner, double size) {
    tf::aabb<double, D> box;
    box.include(corner);
    auto other = corner;
    for (double& x : other) x += size;
    box.include(other);
    return box;
}

inline const std::vector<std::string> box_families{
    "random", "grid", "equal", "line", "far", "tiny", "huge", "mixed", "extreme", "stray", "comb"};

template <std::size_t D>
boxes<D> box_family(const std::string& name, std::size_t count, std::uint64_t seed) {
    random source(seed);
    boxes<D> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::array<double, D> corner{};
        double size = 0.05;
        for (double& x : corner) x = source.unit();
        if (name == "grid")
            for (double& x : corner) x = std::floor(x * 8.0) / 8.0, size = 0.125;
        if (name == "equal") corner.fill(0.25);
        if (name == "line") std::fill(corner.begin() + 1, corner.end(), 0.5);
        if (name == "far") corner[0] += 1e6;
        if (name == "tiny")
            for (double& x : corner) x *= 1e-300, size = 5e-302;
        if (name == "huge")
            for (double& x : corner) x = (x - 0.5) * 1.6e308, size = 2e307;
        if (name == "mixed")
            for (double& x : corner) x *= std::ldexp(1.0, static_cast<int>(i % 80) - 40);
        if (name == "extreme")  // differences that overflow
            for (double& x : corner)
                x = (x < 0.6 ? -1.0 : 1.0) * (1.7e308 - 1e307 * x), size = 9e306;
        if (name == "comb" && i % 8 != 0)  // a sample at equal distances sees none of these
            for (double& x : corner) x = 5.0 - x;
        result[i] = box_at<D>(corner, size);
    }
    if (name == "stray" && count > 0) result[0] = box_at<D>({1e30}, 1.0);
    return result;
}

/// The pairs (i, j) of boxes of `a` and `b` that overlap, ascending.
template <std::size_t D>
id_pairs overlapping(const boxes<D>& a, const boxes<D>& b) {
    id_pairs result;
    for (std::uint32_t i = 0; i < a.size(); ++i)
        for (std::uint32_t j = 0; j < b.size(); ++j)
            if (overlaps(a[i], b[j])) result.emplace_back(i, j);
    return result;
}

/// The same among the boxes of one list, i < j.
template <std::size_t D>
id_pairs overlapping(const boxes<D>& of) {
    id_pairs result;
    for (std::uint32_t i = 0; i < of.size(); ++i)
        for (std::uint32_t j = i + 1; j < of.size(); ++j)
            if (overlaps(of[i], of[j])) result.emplace_back(i, j);
    return result;
}

}  // namespace test
