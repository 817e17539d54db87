#pragma once
/// \file
/// The first contact of two triangles in motion by its definition, in rationals: the least t with
/// t d in the convex hull of the differences of corners, found by trying every set of up to three
/// of these nine points. Slow, and shares nothing with the library but the types of the question.

#include <treeform/mesh/predicates.hpp>

#include <gmpxx.h>
#include <support/known_points.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace treeform::test {

using rational_point = rational_vector;

/// Row operations on [columns | right]; the unique solution, or none.
inline std::optional<std::vector<mpq_class>> solved(std::vector<std::vector<mpq_class>> rows) {
    const std::size_t unknowns = rows[0].size() - 1;
    std::size_t rank = 0;
    for (std::size_t column = 0; column < unknowns; ++column) {
        std::size_t pivot = rank;
        while (pivot < rows.size() && rows[pivot][column] == 0) ++pivot;
        if (pivot == rows.size()) return std::nullopt;
        std::swap(rows[rank], rows[pivot]);
        for (std::size_t r = 0; r < rows.size(); ++r) {
            if (r == rank || rows[r][column] == 0) continue;
            const mpq_class factor = rows[r][column] / rows[rank][column];
            for (std::size_t c = column; c <= unknowns; ++c) rows[r][c] -= factor * rows[rank][c];
        }
        ++rank;
    }
    for (std::size_t r = rank; r < rows.size(); ++r)
        if (rows[r][unknowns] != 0) return std::nullopt;
    std::vector<mpq_class> solution(unknowns);
    for (std::size_t c = 0; c < unknowns; ++c) solution[c] = rows[c][unknowns] / rows[c][c];
    return solution;
}

/// t and weights, all >= 0, with t d = sum of weights * corners, weights adding up to 1. A linear
/// program takes its least value where the columns in use are independent, and there are four rows.
inline std::optional<mpq_class> first_time(const triangle3& a, const triangle3& b,
                                           const point3& d) {
    std::vector<rational_point> hull;
    for (const point3& x : a)
        for (const point3& y : b) {
            const rational_point p = rational(x), q = rational(y);
            hull.push_back({q[0] - p[0], q[1] - p[1], q[2] - p[2]});
        }
    const rational_point direction = rational(d);
    std::optional<mpq_class> best;
    const auto offer = [&](const std::vector<std::size_t>& chosen) {
        std::vector<std::vector<mpq_class>> rows(4);
        for (std::size_t k = 0; k < 3; ++k) {
            for (const std::size_t i : chosen) rows[k].push_back(hull[i][k]);
            rows[k].push_back(-direction[k]);
            rows[k].emplace_back(0);
        }
        for (std::size_t i = 0; i < chosen.size(); ++i) rows[3].emplace_back(1);
        rows[3].emplace_back(0);
        rows[3].emplace_back(1);
        const auto solution = solved(std::move(rows));
        if (!solution) return;
        for (const mpq_class& x : *solution)
            if (x < 0) return;
        if (!best || solution->back() < *best) best = solution->back();
    };
    for (std::size_t i = 0; i < hull.size(); ++i) {
        offer({i});
        for (std::size_t j = i + 1; j < hull.size(); ++j) {
            offer({i, j});
            for (std::size_t k = j + 1; k < hull.size(); ++k) offer({i, j, k});
        }
    }
    return best;
}

}  // namespace treeform::test
