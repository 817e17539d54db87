#include <libmesh/arrange/face_side.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/merged_faces.hpp>
#include <libmesh/boolean/region_triangles.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace treeform::detail::boolean {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// A face's side from one corner to the next, by the edge it is.
struct kept_edge {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t face;
    std::uint32_t from;  ///< the end where the face's side begins
};

/// An edge of which something is to be kept: a region ends at it.
struct crease {
    std::array<std::uint32_t, 2> ends;
    std::size_t begin;  ///< of its uses
    std::size_t end;
};

class merger {
  public:
    merger(const exact_surface& surface, const face_planes& planes)
        : surface_(surface),
          planes_(planes),
          point_count_(surface.given.size() + surface.constructed.size()),
          regions_(surface.faces.size()) {}

    merged_faces run() {
        collect_uses();
        find_regions();
        find_spare_points();
        return rebuild();
    }

  private:
    void collect_uses() {
        uses_.reserve(3 * surface_.faces.size());
        for (std::uint32_t f = 0; f < surface_.faces.size(); ++f)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = surface_.faces[f][i];
                const std::uint32_t b = surface_.faces[f][(i + 1) % 3];
                uses_.push_back({std::min(a, b), std::max(a, b), f, a});
            }
        std::sort(uses_.begin(), uses_.end(), [](const kept_edge& u, const kept_edge& v) {
            if (u.low != v.low) return u.low < v.low;
            return u.high != v.high ? u.high < v.high : u.face < v.face;
        });
    }

    template <class Visit>
    void for_each_edge(const Visit& visit) const {
        for (std::size_t begin = 0, end = 0; begin < uses_.size(); begin = end) {
            const kept_edge& first = uses_[begin];
            while (end < uses_.size() && uses_[end].low == first.low &&
                   uses_[end].high == first.high)
                ++end;
            visit(begin, end);
        }
    }

    [[nodiscard]] std::uint32_t group(std::uint32_t f) const {
        return planes_.group_of.empty() ? 0 : planes_.group_of[planes_.plane_of[f]];
    }

    [[nodiscard]] bool stays(std::uint32_t f) const {
        return !planes_.stays.empty() && planes_.stays[f] != 0;
    }

    [[nodiscard]] bool coplanar(std::uint32_t f, std::uint32_t g) const {
        const std::uint32_t p = planes_.plane_of[f], q = planes_.plane_of[g];
        if (p == q) return true;
        const plane_points plane = detail::arrange::plane_of(planes_.mesh, p);
        return std::ranges::all_of(planes_.mesh.faces[q], [&](std::uint32_t corner) {
            return orient3d(plane.a, plane.b, plane.c, planes_.mesh.points[corner]) == 0;
        });
    }

    /// Two faces that meet here and nowhere bend, so that nothing is lost without the edge.
    [[nodiscard]] bool is_flat(std::size_t begin, std::size_t end) const {
        if (end - begin != 2) return false;
        const kept_edge &u = uses_[begin], &v = uses_[begin + 1];
        if (u.from == v.from || stays(u.face) || stays(v.face)) return false;
        return group(u.face) == group(v.face) && coplanar(u.face, v.face);
    }

    void find_regions() {
        for_each_edge([&](std::size_t begin, std::size_t end) {
            if (is_flat(begin, end))
                regions_.join(uses_[begin].face, uses_[begin + 1].face);
            else
                creases_.push_back({{uses_[begin].low, uses_[begin].high}, begin, end});
        });
    }

    /// The regions at a crease, ascending.
    [[nodiscard]] std::vector<std::uint32_t> regions_at(const crease& c) {
        std::vector<std::uint32_t> regions;
        for (std::size_t u = c.begin; u < c.end; ++u)
            regions.push_back(regions_.root(uses_[u].face));
        std::sort(regions.begin(), regions.end());
        return regions;
    }

    [[nodiscard]] implicit_point point(std::uint32_t p) const {
        return p < surface_.given.size() ? implicit_point(surface_.given[p])
                                         : surface_.constructed[p - surface_.given.size()];
    }

    /// Whether the creases from p, to q and to r, are one line, with the same regions at both:
    /// where two of them are not coplanar, both lie where their planes meet.
    [[nodiscard]] bool continues(std::uint32_t p, const crease& c, const crease& d) {
        if (c.end - c.begin != d.end - d.begin) return false;
        const std::vector<std::uint32_t> regions = regions_at(c);
        if (regions != regions_at(d)) return false;
        for (const std::uint32_t region : regions)
            if (!coplanar(regions.front(), region)) return true;
        const implicit_point at = point(p);
        const implicit_point q = point(other_end(c, p)), r = point(other_end(d, p));
        for (int axis = 0; axis < 3; ++axis) {
            if (orient2d(axis, at, q, r) != 0) return false;
            if (compare(axis, q, at) * compare(axis, r, at) > 0) return false;
        }
        return true;
    }

    [[nodiscard]] static std::uint32_t other_end(const crease& c, std::uint32_t p) {
        return c.ends[0] == p ? c.ends[1] : c.ends[0];
    }

    /// Points in the middle of one region, or of one straight line between the same regions.
    void find_spare_points() {
        std::vector<std::array<std::uint32_t, 2>> first_two(point_count_, {none, none});
        std::vector<std::uint8_t> creases_at(point_count_, 0);
        for (std::uint32_t c = 0; c < creases_.size(); ++c)
            for (const std::uint32_t p : creases_[c].ends)
                if (creases_at[p] < 3 && ++creases_at[p] < 3) first_two[p][creases_at[p] - 1U] = c;
        std::vector<std::uint32_t> region_at(point_count_, none);
        spare_.assign(point_count_, 1);
        for (std::uint32_t f = 0; f < surface_.faces.size(); ++f)
            for (const std::uint32_t p : surface_.faces[f]) {
                const std::uint32_t region = regions_.root(f);
                if (region_at[p] == none) region_at[p] = region;
                if (stays(f) || (creases_at[p] == 0 && region_at[p] != region)) spare_[p] = 0;
            }
        for (std::uint32_t p = 0; p < point_count_; ++p) {
            if (region_at[p] == none || creases_at[p] == 1 || creases_at[p] > 2) spare_[p] = 0;
            if (creases_at[p] == 2)
                spare_[p] = continues(p, creases_[first_two[p][0]], creases_[first_two[p][1]]);
        }
        next_.assign(point_count_, {none, none});
        for (std::uint32_t p = 0; p < point_count_; ++p)
            if (spare_[p] != 0 && creases_at[p] == 2)
                next_[p] = {other_end(creases_[first_two[p][0]], p),
                            other_end(creases_[first_two[p][1]], p)};
    }

    /// Where the straight line that begins at `from` toward `to` ends.
    [[nodiscard]] std::uint32_t end_of_line(std::uint32_t from, std::uint32_t to) const {
        while (spare_[to] != 0) {
            const std::uint32_t beyond = next_[to][0] == from ? next_[to][1] : next_[to][0];
            from = to;
            to = beyond;
        }
        return to;
    }

    /// Faces by region, and which regions lose a point.
    merged_faces rebuild() {
        const auto face_count = static_cast<std::uint32_t>(surface_.faces.size());
        std::vector<std::uint8_t> changes(face_count, 0);  // by root
        for (std::uint32_t f = 0; f < face_count; ++f)
            for (const std::uint32_t p : surface_.faces[f])
                if (spare_[p] != 0) changes[regions_.root(f)] = 1;
        std::vector<std::uint32_t> number(face_count, none);
        std::vector<flat_region> changed;
        for (std::uint32_t f = 0; f < face_count; ++f) {
            const std::uint32_t root = regions_.root(f);
            if (changes[root] == 0) continue;
            if (number[root] == none) {
                number[root] = static_cast<std::uint32_t>(changed.size());
                changed.emplace_back().first_face = root;
            }
            for (const std::uint32_t p : surface_.faces[f])
                if (spare_[p] == 0) changed[number[root]].points.push_back(p);
        }
        add_rims(number, changed);

        constexpr std::size_t grain = 16;
        std::vector<std::vector<face>> made(changed.size());
        for_chunks(changed.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t r = begin; r < end; ++r) {
                flat_region& region = changed[r];
                region.plane = surface_.faces[region.first_face];
                made[r] = triangles_of(surface_, region);
            }
        });
        return joined(changes, number, made);
    }

    /// Each region's rim, with the lines that are straight in one piece.
    void add_rims(const std::vector<std::uint32_t>& number, std::vector<flat_region>& changed) {
        for (const crease& c : creases_) {
            std::vector<std::uint32_t> at;
            for (std::size_t u = c.begin; u < c.end; ++u) {
                const std::uint32_t root = regions_.root(uses_[u].face);
                if (number[root] == none) continue;
                const std::uint32_t from = uses_[u].from;
                if (spare_[from] != 0) continue;  // a line is entered where it begins
                if (at.empty()) at = regions_at(c);
                changed[number[root]].rim.push_back(
                    {from, end_of_line(from, other_end(c, from)), line_name(root, at)});
            }
        }
    }

    /// A region whose plane crosses that of `region` in the line where both meet; or none.
    [[nodiscard]] std::uint32_t line_name(std::uint32_t region,
                                          const std::vector<std::uint32_t>& regions_there) const {
        for (const std::uint32_t other : regions_there)
            if (!coplanar(region, other)) return other;
        return none;
    }

    merged_faces joined(const std::vector<std::uint8_t>& changes,
                        const std::vector<std::uint32_t>& number,
                        const std::vector<std::vector<face>>& made) {
        merged_faces result;
        for (std::uint32_t f = 0; f < surface_.faces.size(); ++f) {
            const std::uint32_t root = regions_.root(f);
            result.merged_into.push_back(changes[root] == 0 ? f : root);
            if (changes[root] == 0) {
                result.faces.push_back(surface_.faces[f]);
                result.face_of.push_back(f);
                result.is_new.push_back(0);
            } else if (root == f) {
                for (const face& triangle : made[number[root]]) {
                    result.faces.push_back(triangle);
                    result.face_of.push_back(f);
                    result.is_new.push_back(1);
                }
            }
        }
        return result;
    }

    const exact_surface& surface_;
    const face_planes& planes_;
    std::size_t point_count_;
    std::vector<kept_edge> uses_;    ///< edge by edge
    std::vector<crease> creases_{};  ///< ascending
    base::union_find regions_;       ///< of faces
    std::vector<std::uint8_t> spare_{};
    std::vector<std::array<std::uint32_t, 2>> next_{};  ///< of spare points of lines, both ways
};

}  // namespace

merged_faces merge_coplanar(const exact_surface& surface, const face_planes& planes) {
    return merger(surface, planes).run();
}

}  // namespace treeform::detail::boolean
