#pragma once
/// \file
/// Set operations before any rounding, and their volumes in rational numbers.

#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <gmpxx.h>
#include <support/rational_points.hpp>
#include <support/soups.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace test {

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

inline rational_point rational(const tf::implicit_point& p) {
    using origin = tf::implicit_point::origin;
    const auto at = [&](std::size_t i) { return rational(p.definition()[i]); };
    const auto plane_at = [&](std::size_t i) {
        return rational_plane(at(i), at(i + 1), at(i + 2));
    };
    switch (p.kind()) {
        case origin::given:
            return rational(p.center());
        case origin::line_plane:
            return meeting(at(0), at(1), plane_at(2));
        case origin::line_normal: {
            const rational_point n = at(3), from = minus(at(2), at(0)), way = minus(at(1), at(0));
            const mpq_class t = dot(n, from) / dot(n, way);
            const rational_point a = at(0);
            return {a[0] + t * way[0], a[1] + t * way[1], a[2] + t * way[2]};
        }
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

/// Operands cut along each other, before any rounding.
class exact_arrangement {
  public:
    explicit exact_arrangement(std::span<const tf::mesh> operands,
                               tf::fill_rule rule = tf::fill_rule::nonzero)
        : count_(operands.size()), rule_(rule), in_(std::make_unique<bool[]>(operands.size())) {
        tf::mesh all;
        std::vector<std::uint32_t> operand;
        for (const tf::mesh& mesh : operands) {
            all = together(std::move(all), mesh);
            operand.resize(all.faces.size(), static_cast<std::uint32_t>(&mesh - operands.data()));
        }
        all = tf::join_equal_points(all);
        cut_ = tf::arrange_faces(all).cut;
        cells_ = tf::find_cells(all, cut_, operand, count_);
    }

    /// Whether each operand bounds a solid; else nothing below has a meaning.
    [[nodiscard]] bool closed() const { return cells_.open.empty(); }
    [[nodiscard]] const tf::mesh_arrangement& cut() const { return cut_; }

    /// Whether face f bounds what the expression makes: 1 with the inside behind it, -1 with the
    /// inside in front of it, else 0.
    [[nodiscard]] int sign(std::size_t f, const tf::boolean_expression& expression) const {
        return int{inside(cells_.cell_of_side[f][1], expression)} -
               int{inside(cells_.cell_of_side[f][0], expression)};
    }
    /// Six times the signed volume under face f.
    [[nodiscard]] mpq_class under_face(std::size_t f) const {
        const auto& [a, b, c] = cut_.faces[f];
        return under(rational(cut_.point(a)), rational(cut_.point(b)), rational(cut_.point(c)));
    }

  private:
    [[nodiscard]] bool inside(std::uint32_t cell, const tf::boolean_expression& expression) const {
        const auto windings = cells_.winding_of(cell);
        for (std::size_t k = 0; k < count_; ++k)
            in_[k] = rule_ == tf::fill_rule::even_odd   ? windings[k] % 2 != 0
                     : rule_ == tf::fill_rule::positive ? windings[k] > 0
                                                        : windings[k] != 0;
        return expression({in_.get(), count_});
    }

    std::size_t count_;
    tf::fill_rule rule_;
    std::unique_ptr<bool[]> in_;  ///< [count_]
    tf::mesh_arrangement cut_;
    tf::arrangement_cells cells_;
};

/// The volumes of several set operations on the same operands: exact face by face, added up in 1024
/// bits, since the denominators of a sum grow without end.
/// \pre arranged.closed()
inline std::vector<mpf_class> exact_volumes(const exact_arrangement& arranged,
                                            std::span<const tf::boolean_expression> expressions) {
    constexpr mp_bitcnt_t bits = 1024;
    std::vector<mpf_class> sums(expressions.size(), mpf_class(0, bits));
    for (std::size_t f = 0; f < arranged.cut().faces.size(); ++f) {
        std::optional<mpf_class> part;
        for (std::size_t e = 0; e < expressions.size(); ++e) {
            const int sign = arranged.sign(f, expressions[e]);
            if (sign == 0) continue;
            if (!part) part = mpf_class(mpq_class(arranged.under_face(f) / 6), bits);
            sums[e] += sign * *part;
        }
    }
    return sums;
}

}  // namespace test
