#include <libmesh/arrange/outer_edge.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/geometry/flat_triangle.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform::detail::arrange {
namespace {

constexpr auto no_point = std::numeric_limits<std::uint32_t>::max();

/// Raises `top` to `p` if that is greater.
void raise(const mesh_arrangement& cut, std::uint32_t& top, std::uint32_t p) {
    if (p == top || p == no_point) return;
    if (top != no_point && cut.given_points[p].x < cut.given_points[top].x) return;  // nearly all
    if (top == no_point ||
        geometry::lexicographically_less(cut.given_points[top], cut.given_points[p]))
        top = p;
}

std::uint32_t greatest_given_point(const mesh_arrangement& cut) {
    const std::vector<point3>& points = cut.given_points;
    std::vector<std::uint32_t> tops(chunk_count(points.size(), light_grain), no_point);
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        std::uint32_t top = no_point;
        for (std::size_t p = begin; p < end; ++p)
            if ((top == no_point || points[p].x >= points[top].x) &&
                detail::base::is_finite(points[p]))
                raise(cut, top, static_cast<std::uint32_t>(p));
        tops[c] = top;
    });
    std::uint32_t top = no_point;
    for (const std::uint32_t p : tops) raise(cut, top, p);
    return top;
}

/// The extent of all faces as one part; none where their greatest point is not that of all points.
std::optional<part_extent> extent_of_all(const mesh_arrangement& cut) {
    const std::uint32_t top = greatest_given_point(cut);
    std::vector<std::vector<std::uint32_t>> at_top(chunk_count(cut.faces.size(), light_grain));
    for_chunks(cut.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t c) {
                   for (std::size_t f = begin; f < end; ++f) {
                       const auto& [p, q, r] = cut.faces[f];
                       if (p == top || q == top || r == top)
                           at_top[c].push_back(static_cast<std::uint32_t>(f));
                   }
               });
    part_extent all{top, {}};
    for (const auto& chunk : at_top)
        all.faces_at_top.insert(all.faces_at_top.end(), chunk.begin(), chunk.end());
    if (all.faces_at_top.empty()) return std::nullopt;
    return all;
}

/// Whether the direction of the edge at `v` that leads to `p` is that from v to b. No two edges at
/// a greatest point run opposite ways.
bool same_direction(const point3& v, const point3& b, const implicit_point& p) {
    for (const int axis : {0, 1, 2})
        if (orient2d(axis, v, b, p) != 0) return false;
    return true;
}

/// Finds an edge of `part` at its greatest point v such that, near v, the part is on one side of
/// the vertical plane through the edge or in that plane, and the direction +x is on the other side.
/// All edges at v lead to lesser x, or to the same x and lesser y, or straight down. Seen from
/// above, the first one in counter-clockwise order will do if it leads to greater y, and the
/// last one if it leads to lesser y.
class edge_finder {
  public:
    edge_finder(mesh_view mesh, const mesh_arrangement& cut, const part_extent& part)
        : mesh_(mesh), cut_(cut), part_(part), v_(mesh.points[part.top]) {}

    /// An input point on the edge; none when the part near v is in the plane y = v.y.
    [[nodiscard]] std::optional<std::uint32_t> find() {
        for_ends([&](std::uint32_t b, std::uint32_t) { widen(b); });
        if (first_ == no_point) return std::nullopt;
        if (compare(1, mesh_.points[first_], v_) > 0) return first_;
        if (compare(1, mesh_.points[last_], v_) < 0) return last_;
        return std::nullopt;
    }

    /// Calls `visit(b, f)` for the other corners b of the input faces that cover a face f at v.
    template <class Visit>
    void for_ends(const Visit& visit) const {
        for (const std::uint32_t f : part_.faces_at_top)
            for (const covering_face& cover : cut_.covers_of(f))
                for (const std::uint32_t b : mesh_.faces[cover.face])
                    if (b != part_.top) visit(b, f);
    }

    /// The faces at the edge from v toward b.
    [[nodiscard]] std::vector<face_side> sides_toward(std::uint32_t b) const {
        const std::uint32_t end = first_point_toward(b);
        std::vector<face_side> sides;
        for (const std::uint32_t f : part_.faces_at_top) {
            const auto [next, last] = neighbors(f);
            if (next == end) sides.push_back(front_of(f));
            if (last == end) sides.push_back(behind(f));
        }
        return sides;
    }

  private:
    void widen(std::uint32_t b) {
        const point3& p = mesh_.points[b];
        if (compare(0, p, v_) == 0 && compare(1, p, v_) == 0) return;  // straight down
        if (first_ == no_point || orient2d(2, v_, mesh_.points[first_], p) < 0) first_ = b;
        if (last_ == no_point || orient2d(2, v_, mesh_.points[last_], p) > 0) last_ = b;
    }

    /// The corners of a face after v and before it.
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> neighbors(std::uint32_t id) const {
        const face& f = cut_.faces[id];
        const std::size_t i = f[0] == part_.top ? 0 : f[1] == part_.top ? 1 : 2;
        return {f[(i + 1) % 3], f[(i + 2) % 3]};
    }

    /// The point at which the edge from v toward b ends: b, or where it is cut first.
    [[nodiscard]] std::uint32_t first_point_toward(std::uint32_t b) const {
        for (const std::uint32_t f : part_.faces_at_top) {
            const auto [next, last] = neighbors(f);
            if (next == b || last == b) return b;
        }
        for (const std::uint32_t f : part_.faces_at_top) {
            const auto [next, last] = neighbors(f);
            if (same_direction(v_, mesh_.points[b], cut_.point(next))) return next;
            if (same_direction(v_, mesh_.points[b], cut_.point(last))) return last;
        }
        return no_point;
    }

    mesh_view mesh_;
    const mesh_arrangement& cut_;
    const part_extent& part_;
    point3 v_;
    std::uint32_t first_ = no_point;
    std::uint32_t last_ = no_point;
};

[[noreturn]] void refuse(std::uint32_t point) {
    throw std::logic_error("treeform::find_cells: not an arrangement at point " +
                           std::to_string(point));
}

}  // namespace

std::vector<part_extent> find_extents(const mesh_arrangement& cut, const surface_patches& patches,
                                      const numbered_sets& parts) {
    if (parts.count() == 1)
        if (auto all = extent_of_all(cut)) return {*all};
    struct extent {
        std::uint32_t part = 0;
        std::size_t begin = 0;  ///< its first face
        std::uint32_t top = no_point;
        aabb<double, 3> box;
    };
    const std::size_t given = cut.given_points.size();
    std::vector<std::vector<extent>> runs(chunk_count(cut.faces.size(), light_grain));
    for_chunks(cut.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t c) {
                   extent run{parts[patches.patch[begin]], begin, no_point, {}};
                   for (std::size_t f = begin; f < end; ++f) {
                       const std::uint32_t part = parts[patches.patch[f]];
                       if (run.part != part) {
                           runs[c].push_back(run);
                           run = {part, f, no_point, {}};
                       }
                       for (const std::uint32_t p : cut.faces[f]) {
                           if (p >= given) continue;
                           raise(cut, run.top, p);
                           run.box.include(cut.given_points[p]);
                       }
                   }
                   runs[c].push_back(run);
               });
    std::vector<part_extent> result(parts.count(), part_extent{no_point, {}});
    for (const auto& chunk : runs)
        for (const extent& run : chunk) {
            raise(cut, result[run.part].top, run.top);
            result[run.part].box.include(run.box);
        }

    std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> at_top(runs.size());
    for_chunks(cut.faces.size(), light_grain, [&](std::size_t, std::size_t end, std::size_t c) {
        for (std::size_t i = 0; i < runs[c].size(); ++i) {
            const auto& [part, first, top, box] = runs[c][i];
            if (top != result[part].top) continue;  // nearly all
            const std::size_t last = i + 1 < runs[c].size() ? runs[c][i + 1].begin : end;
            for (std::size_t f = first; f < last; ++f)
                if (std::ranges::find(cut.faces[f], top) != cut.faces[f].end())
                    at_top[c].emplace_back(part, static_cast<std::uint32_t>(f));
        }
    });
    for (const auto& chunk : at_top)
        for (const auto& [part, id] : chunk) result[part].faces_at_top.push_back(id);
    return result;
}

outer_edge find_outer_edge(mesh_view mesh, const mesh_arrangement& cut, const part_extent& part,
                           radial_order& radial) {
    if (part.faces_at_top.empty()) refuse(part.top);
    edge_finder finder(mesh, cut, part);
    const point3& v = mesh.points[part.top];
    if (const auto b = finder.find()) {
        const auto sides = finder.sides_toward(*b);
        if (sides.empty()) refuse(part.top);
        const auto last = radial.last_before_x(v, mesh.points[*b], sides);
        if (!last) refuse(part.top);
        return {v, mesh.points[*b], *last};
    }
    // All faces at v are in one plane; being extreme there they bound nothing, and the same region
    // is on both sides of all of them.
    std::optional<outer_edge> edge;
    finder.for_ends([&](std::uint32_t b, std::uint32_t f) {
        if (!edge && compare(2, mesh.points[b], v) != 0) edge = {v, mesh.points[b], front_of(f)};
    });
    if (!edge) refuse(part.top);
    return *edge;
}

}  // namespace treeform::detail::arrange
