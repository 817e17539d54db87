#pragma once
/// \file
/// Volumes of solids in rational numbers, of rounded results and of what they ought to be.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/expression.hpp>
#include <libmesh/exact/constructed_point.hpp>
#include <libmesh/mesh.hpp>
#include <libmesh/weld/equal_points.hpp>

#include <gmpxx.h>
#include <support/soups.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace test {

using rational_point = std::array<mpq_class, 3>;

inline rational_point rational(const tf::point3& p) { return {p.x, p.y, p.z}; }

inline rational_point minus(const rational_point& p, const rational_point& q) {
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
inline rational_point cross(const rational_point& p, const rational_point& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
inline mpq_class dot(const rational_point& p, const rational_point& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
inline rational_point along(const rational_point& p, const rational_point& q, const mpq_class& t) {
    const rational_point d = minus(q, p);
    return {p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]};
}

struct rational_plane {
    rational_point at, normal;
    rational_plane(const rational_point& a, const rational_point& b, const rational_point& c)
        : at(a), normal(cross(minus(b, a), minus(c, a))) {}
    [[nodiscard]] mpq_class side(const rational_point& p) const {
        return dot(normal, minus(p, at));
    }
};

/// Where the line through p and q meets the plane.
inline rational_point meeting(const rational_point& p, const rational_point& q,
                              const rational_plane& of) {
    const mpq_class from = of.side(p), to = of.side(q);
    return along(p, q, from / (from - to));
}

inline rational_point rational(const tf::constructed_point& p) {
    using origin = tf::constructed_point::origin;
    const auto at = [&](std::size_t i) { return rational(p.definition()[i]); };
    const auto plane_at = [&](std::size_t i) {
        return rational_plane(at(i), at(i + 1), at(i + 2));
    };
    switch (p.kind()) {
        case origin::given:
            return rational(p.centre());
        case origin::line_plane:
            return meeting(at(0), at(1), plane_at(2));
        case origin::lines: {
            // The second line in a plane across both: through its ends along their normal.
            const rational_point n = cross(minus(at(1), at(0)), minus(at(3), at(2)));
            const rational_point third{at(2)[0] + n[0], at(2)[1] + n[1], at(2)[2] + n[2]};
            return meeting(at(0), at(1), rational_plane(at(2), at(3), third));
        }
        case origin::planes:
            break;
    }
    const rational_plane a = plane_at(0), b = plane_at(3), c = plane_at(6);
    const rational_point bc = cross(b.normal, c.normal), ca = cross(c.normal, a.normal),
                         ab = cross(a.normal, b.normal);
    const mpq_class det = dot(a.normal, bc), da = dot(a.normal, a.at), db = dot(b.normal, b.at),
                    dc = dot(c.normal, c.at);
    rational_point result;
    for (std::size_t k = 0; k < 3; ++k) result[k] = (da * bc[k] + db * ca[k] + dc * ab[k]) / det;
    return result;
}

/// Six times the signed volume under a triangle.
inline mpq_class under(const rational_point& a, const rational_point& b, const rational_point& c) {
    return dot(a, cross(b, c));
}

inline mpq_class volume_of(const tf::mesh& mesh) {
    mpq_class sum = 0;
    for (const tf::face& f : mesh.faces)
        sum += under(rational(mesh.points[f[0]]), rational(mesh.points[f[1]]),
                     rational(mesh.points[f[2]]));
    return sum / 6;
}

/// The volumes of several set operations on the same operands, before any rounding: exact face by
/// face, added up in 1024 bits, since the denominators of a sum grow without end. Nothing where an
/// operand is open.
inline std::optional<std::vector<mpf_class>> exact_volumes(
    std::span<const tf::mesh> operands, std::span<const tf::boolean_expression> expressions) {
    constexpr mp_bitcnt_t bits = 1024;
    tf::mesh all;
    std::vector<std::uint32_t> operand;
    for (const tf::mesh& mesh : operands) {
        all = together(std::move(all), mesh);
        operand.resize(all.faces.size(), static_cast<std::uint32_t>(&mesh - operands.data()));
    }
    all = tf::join_equal_points(all);
    const auto cut = tf::arrange_faces(all).cut;
    const auto cells = tf::find_cells(all, cut, operand, operands.size());
    if (!cells.open.empty()) return std::nullopt;
    const auto in = std::make_unique<bool[]>(operands.size());
    std::vector<mpf_class> sums(expressions.size(), mpf_class(0, bits));
    for (std::size_t f = 0; f < cut.faces.size(); ++f) {
        const auto inside = [&](std::size_t side, const tf::boolean_expression& expression) {
            const auto windings = cells.winding_of(cells.cell_of_side[f][side]);
            for (std::size_t k = 0; k < operands.size(); ++k) in[k] = windings[k] != 0;
            return int{expression({in.get(), operands.size()})};
        };
        std::optional<mpf_class> part;
        for (std::size_t e = 0; e < expressions.size(); ++e) {
            const int sign = inside(1, expressions[e]) - inside(0, expressions[e]);
            if (sign == 0) continue;
            const auto& [a, b, c] = cut.faces[f];
            if (!part)
                part = mpf_class(mpq_class(under(rational(cut.point(a)), rational(cut.point(b)),
                                                 rational(cut.point(c))) /
                                           6),
                                 bits);
            sums[e] += sign * *part;
        }
    }
    return sums;
}

}  // namespace test
