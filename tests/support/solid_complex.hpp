#pragma once
/// \file
/// Solids made of tetrahedra that fit together, and surfaces that wind around them as asked: what
/// cells and windings of a surface are to be is known by construction.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace test {

/// Faces of several operands.
struct operands {
    tf::mesh mesh;
    std::vector<std::uint32_t> of_face;
    std::size_t count = 0;
};

inline std::array<std::uint32_t, 3> sorted(tf::face f) {
    std::sort(f.begin(), f.end());
    return f;
}

inline bool same_way(const tf::face& f, const tf::face& g) {
    for (std::size_t i = 0; i < 3; ++i)
        if (f == tf::face{g[i], g[(i + 1) % 3], g[(i + 2) % 3]}) return true;
    return false;
}

/// Tetrahedra that meet in corners, edges or faces, or not at all; d is on the positive side of
/// a, b, c.
struct complex {
    std::vector<tf::point3> points;
    std::vector<std::array<std::uint32_t, 4>> solids;

    void turn_right_way() {
        for (auto& s : solids) {
            const int side = tf::orient3d(points[s[0]], points[s[1]], points[s[2]], points[s[3]]);
            if (side == 0) throw std::logic_error("test::complex: a flat tetrahedron");
            if (side < 0) std::swap(s[0], s[1]);
        }
    }
    /// Outward.
    [[nodiscard]] std::array<tf::face, 4> faces(std::size_t i) const {
        const auto& [a, b, c, d] = solids[i];
        return {{{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}}};
    }
};

/// Cubes of a lattice, each cut in six along its diagonal.
inline complex lattice(std::uint32_t side) {
    complex result;
    const std::uint32_t n = side + 1;
    for (std::uint32_t i = 0; i < n * n * n; ++i)
        result.points.push_back({static_cast<double>(i % n), static_cast<double>(i / n % n),
                                 static_cast<double>(i / (n * n))});
    const std::array<std::uint32_t, 3> step{1, n, n * n};
    for (std::uint32_t z = 0; z < side; ++z)
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                const std::uint32_t at = x + n * y + n * n * z;
                std::array<std::size_t, 3> way{0, 1, 2};
                do {
                    const std::uint32_t b = at + step[way[0]];
                    const std::uint32_t c = b + step[way[1]];
                    result.solids.push_back({at, b, c, c + step[way[2]]});
                } while (std::next_permutation(way.begin(), way.end()));
            }
    return result;
}

/// What the places of the lattice's points become, the tetrahedra still fitting together.
enum class shape { straight, sheared, uneven, tiny, huge };

inline complex placed(random& source, complex c, shape how) {
    if (how == shape::sheared) {
        std::array<std::array<double, 3>, 3> m{};
        double det = 0;
        while (det == 0) {
            for (auto& row : m)
                for (double& x : row) x = static_cast<double>(source.below(9)) - 4;
            det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                  m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                  m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
        }
        for (tf::point3& p : c.points)
            p = {m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z,
                 m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z,
                 m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z};
    }
    if (how == shape::uneven)
        for (tf::point3& p : c.points)
            p = {p.x + source.in(-0.1, 0.1), p.y + source.in(-0.1, 0.1),
                 p.z + source.in(-0.1, 0.1)};
    const double scale = how == shape::tiny ? 0x1p-1074 : how == shape::huge ? 0x1p+800 : 1.0;
    for (tf::point3& p : c.points) p = {p.x * scale, p.y * scale, p.z * scale};

    std::vector<std::uint32_t> number(c.points.size());
    std::iota(number.begin(), number.end(), 0U);
    source.shuffle(number);
    complex result = c;
    for (std::size_t i = 0; i < number.size(); ++i) result.points[number[i]] = c.points[i];
    for (auto& solid : result.solids)
        for (std::uint32_t& corner : solid) corner = number[corner];
    result.turn_right_way();
    return result;
}

/// [operand][solid] how often each operand is to wind around each solid.
using field = std::vector<std::vector<int>>;

/// Faces between solids, each with the solid in front of it and the one behind; `outside` is one
/// past the last solid.
struct wall {
    tf::face face;
    std::size_t front;
    std::size_t behind;
};
inline std::vector<wall> walls_of(const complex& c) {
    std::map<std::array<std::uint32_t, 3>, wall> found;
    for (std::size_t i = 0; i < c.solids.size(); ++i)
        for (const tf::face& f : c.faces(i)) {
            const auto [at, added] = found.try_emplace(sorted(f), wall{f, c.solids.size(), i});
            if (!added) at->second.front = i;
        }
    std::vector<wall> walls;
    for (const auto& [key, w] : found) walls.push_back(w);
    return walls;
}

inline int winding(const field& w, std::size_t operand, std::size_t solid) {
    return solid < w[operand].size() ? w[operand][solid] : 0;
}

struct shuffled_operands : operands {
    explicit shuffled_operands(std::size_t number) { count = number; }
    void add(const tf::face& f, std::size_t operand, int times) {
        for (int i = 0; i < std::abs(times); ++i) {
            mesh.faces.push_back(times > 0 ? f : tf::face{f[0], f[2], f[1]});
            of_face.push_back(static_cast<std::uint32_t>(operand));
        }
    }
    void shuffle(random& source) {
        std::vector<std::uint32_t> order(mesh.faces.size());
        std::iota(order.begin(), order.end(), 0U);
        source.shuffle(order);
        const operands before = *this;
        for (std::size_t i = 0; i < order.size(); ++i) {
            const tf::face& f = before.mesh.faces[order[i]];
            const std::size_t turn = source.below(3);
            for (std::size_t k = 0; k < 3; ++k) mesh.faces[i][k] = f[(k + turn) % 3];
            of_face[i] = before.of_face[order[i]];
        }
    }
};

/// Faces that wind as `w` says: just those needed, or every solid's own, which cancel or pile up.
/// Some more that bound nothing.
inline operands surfaces(random& source, const complex& c, const std::vector<wall>& walls,
                         const field& w, bool just_needed) {
    shuffled_operands result(w.size());
    result.mesh.points = c.points;
    for (std::size_t k = 0; k < w.size(); ++k) {
        if (just_needed)
            for (const wall& s : walls)
                result.add(s.face, k, winding(w, k, s.behind) - winding(w, k, s.front));
        else
            for (std::size_t i = 0; i < c.solids.size(); ++i)
                for (const tf::face& f : c.faces(i)) result.add(f, k, w[k][i]);
    }
    for (std::size_t i = source.below(3) == 0 ? source.below(20) : 0; i > 0; --i) {
        const tf::face& f = walls[source.below(walls.size())].face;
        const std::size_t k = source.below(w.size());
        result.add(f, k, 1);
        result.add(f, k, -1);
    }
    result.shuffle(source);
    return result;
}

}  // namespace test
