#include <libmesh/cut/layer_loops.hpp>
#include <libmesh/cut/slabs.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/round/region_triangles.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace treeform::detail::cut {
namespace {

/// A corner of what faces are cut into: a point of the mesh, or where an edge meets a plane.
struct slab_corner {
    static constexpr std::uint32_t no_plane = std::numeric_limits<std::uint32_t>::max();

    crossing at{};
    std::uint32_t plane = no_plane;

    [[nodiscard]] bool is_given() const { return plane == no_plane; }
    friend auto operator<=>(const slab_corner& a, const slab_corner& b) {
        return std::array{a.is_given() ? 0U : 1U, a.at.low, a.at.high, a.plane} <=>
               std::array{b.is_given() ? 0U : 1U, b.at.low, b.at.high, b.plane};
    }
    friend bool operator==(const slab_corner& a, const slab_corner& b) = default;
};

struct slab_face {
    std::array<slab_corner, 3> corners;
    std::uint32_t face;
};

class slab_cutter {
  public:
    slab_cutter(mesh_view mesh, const plane_levels& levels)
        : mesh_(mesh), levels_(levels), whole_(levels.planes.size() + 1), cut_(whole_.size()) {
        for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) add(f);
    }

    std::vector<slab> run(bool caps) {
        std::vector<slab> slabs(whole_.size());
        std::vector<std::vector<slab_face>> lids(levels_.planes.size());
        for_chunks(caps ? lids.size() : 0, 1, [&](std::size_t k, std::size_t, std::size_t) {
            lids[k] = cap_of(static_cast<std::uint32_t>(k));
        });
        for_chunks(slabs.size(), 1, [&](std::size_t s, std::size_t, std::size_t) {
            if (s < lids.size()) cut_[s].insert(cut_[s].end(), lids[s].begin(), lids[s].end());
            if (s > 0)
                for (slab_face lid : lids[s - 1]) {
                    std::swap(lid.corners[1], lid.corners[2]);
                    cut_[s].push_back(lid);
                }
            slabs[s] = numbered(whole_[s], cut_[s]);
        });
        return slabs;
    }

  private:
    [[nodiscard]] std::uint32_t level(std::uint32_t v) const { return levels_.level[v]; }
    /// The lowest slab that the point is in or at; `level` is the highest.
    [[nodiscard]] std::uint32_t lowest(std::uint32_t v) const {
        return levels_.level[v] - levels_.on[v];
    }

    void add(std::uint32_t f) {
        const auto [a, b, c] = mesh_.faces[f];
        const std::uint32_t first = std::min({level(a), level(b), level(c)});
        const std::uint32_t last = std::max({lowest(a), lowest(b), lowest(c)});
        if (first > last)  // in a plane: what is solid is behind it
            whole_[faces_up(f) ? last : first].push_back(f);
        else if (first == last)
            whole_[first].push_back(f);
        else
            for (std::uint32_t s = first; s <= last; ++s) add_part(f, s);
    }

    [[nodiscard]] bool faces_up(std::uint32_t f) const {
        const auto [a, b, c] = mesh_.faces[f];
        return direction_side(mesh_.points[a], mesh_.points[b], mesh_.points[c], levels_.normal) >
               0;
    }

    /// The part of a face in slab s, a strictly convex polygon, as triangles about its first
    /// corner.
    void add_part(std::uint32_t f, std::uint32_t s) {
        std::array<slab_corner, 6> corners;
        std::size_t count = 0;
        const face& g = mesh_.faces[f];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t u = g[i], v = g[i == 2 ? 0 : i + 1];
            if (lowest(u) <= s && s <= level(u)) corners[count++].at = {u, u};
            const bool up = level(u) < level(v) || (level(u) == level(v) && lowest(u) < lowest(v));
            const crossing edge = up ? crossing{u, v} : crossing{v, u};
            const auto cross = [&](std::uint32_t k) {  // strictly
                if (level(edge.low) <= k && lowest(edge.high) > k) corners[count++] = {edge, k};
            };
            const bool bottom = s > 0, top = s < levels_.planes.size();
            if (up && bottom) cross(s - 1);
            if (top) cross(s);
            if (!up && bottom) cross(s - 1);
        }
        for (std::size_t i = 2; i < count; ++i)
            cut_[s].push_back({{corners[0], corners[i - 1], corners[i]}, f});
    }

    [[nodiscard]] bool is_in(const slab_corner& c, std::uint32_t k) const {
        return c.is_given() ? levels_.is_on(c.at.low, k) : c.plane == k;
    }

    [[nodiscard]] implicit_point point(const slab_corner& c) const {
        return exact_point(mesh_, levels_, c.is_given() ? 0 : c.plane, c.at);
    }

    /// The cap of what is below plane k: where edges that lie in the plane have no other face, it
    /// has.
    [[nodiscard]] std::vector<slab_face> cap_of(std::uint32_t k) const {
        std::vector<std::array<slab_corner, 2>>
            sides;  // of the cap, the other way than those of faces
        const auto visit = [&](const std::array<slab_corner, 3>& c) {
            for (std::size_t i = 0; i < 3; ++i)
                if (const slab_corner& p = c[i], &q = c[i == 2 ? 0 : i + 1];
                    is_in(p, k) && is_in(q, k))
                    sides.push_back({q, p});
        };
        for (const std::uint32_t f : whole_[k]) visit(corners_of(f));
        for (const slab_face& f : cut_[k]) visit(f.corners);
        std::ranges::sort(sides);
        std::vector<std::array<slab_corner, 2>> rim;
        for (auto at = sides.begin(); at != sides.end();) {
            const auto end = std::upper_bound(at, sides.end(), *at);
            const std::array reverse{(*at)[1], (*at)[0]};
            const auto [first, last] = std::equal_range(sides.begin(), sides.end(), reverse);
            if (end - at > last - first) rim.push_back(*at);
            at = end;
        }
        return lid_over(rim, k);
    }

    [[nodiscard]] std::vector<slab_face> lid_over(
        const std::vector<std::array<slab_corner, 2>>& rim, std::uint32_t k) const {
        if (rim.empty()) return {};
        std::vector<slab_corner> corners;
        for (const auto& side : rim) corners.push_back(side[0]);
        for (const auto& side : rim) corners.push_back(side[1]);
        std::ranges::sort(corners);
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        const auto number = [&](const slab_corner& c) {
            return static_cast<std::uint32_t>(std::ranges::lower_bound(corners, c) -
                                              corners.begin());
        };
        exact_surface flat;
        for (const slab_corner& c : corners) flat.constructed.push_back(point(c));
        round::flat_region region;
        region.axis = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (std::abs(levels_.normal[static_cast<std::size_t>(axis)]) >
                std::abs(levels_.normal[static_cast<std::size_t>(region.axis)]))
                region.axis = axis;
        region.orientation = levels_.normal[static_cast<std::size_t>(region.axis)] > 0.0 ? 1 : -1;
        for (const auto& [from, to] : rim) {
            region.rim.push_back({number(from), number(to), round::flat_region::no_line});
            region.points.push_back(region.rim.back().from);
            region.points.push_back(region.rim.back().to);
        }
        std::vector<slab_face> lid;
        const auto cap = static_cast<std::uint32_t>(mesh_.faces.size() + k);
        for (const auto& [a, b, c] : round::triangles_of(flat, region))
            lid.push_back({{corners[a], corners[b], corners[c]}, cap});
        return lid;
    }

    [[nodiscard]] std::array<slab_corner, 3> corners_of(std::uint32_t f) const {
        const auto [a, b, c] = mesh_.faces[f];
        return {slab_corner{{a, a}}, slab_corner{{b, b}}, slab_corner{{c, c}}};
    }

    /// The faces of a slab over its own points, whole ones first.
    [[nodiscard]] slab numbered(const std::vector<std::uint32_t>& whole,
                                const std::vector<slab_face>& cut) const {
        slab made;
        std::vector<slab_corner> made_corners;
        for (const std::uint32_t f : whole)
            for (const std::uint32_t v : mesh_.faces[f]) made.point_of.push_back(v);
        for (const slab_face& f : cut)
            for (const slab_corner& c : f.corners)
                if (c.is_given())
                    made.point_of.push_back(c.at.low);
                else
                    made_corners.push_back(c);
        const auto sort_unique = [](auto& values) {
            std::ranges::sort(values);
            values.erase(std::unique(values.begin(), values.end()), values.end());
        };
        sort_unique(made.point_of);
        sort_unique(made_corners);
        for (const std::uint32_t v : made.point_of) made.surface.given.push_back(mesh_.points[v]);
        for (const slab_corner& c : made_corners) made.surface.constructed.push_back(point(c));
        const auto number = [&](const slab_corner& c) {
            return static_cast<std::uint32_t>(
                c.is_given()
                    ? std::ranges::lower_bound(made.point_of, c.at.low) - made.point_of.begin()
                    : std::ranges::lower_bound(made_corners, c) - made_corners.begin() +
                          std::ssize(made.point_of));
        };
        const auto put = [&](const std::array<slab_corner, 3>& c, std::uint32_t face,
                             std::uint8_t certified) {
            made.surface.faces.push_back({number(c[0]), number(c[1]), number(c[2])});
            made.surface.certified.push_back(certified);
            made.face_of.push_back(face);
        };
        for (const std::uint32_t f : whole) put(corners_of(f), f, 1);
        for (const slab_face& f : cut) put(f.corners, f.face, 0);
        return made;
    }

    mesh_view mesh_;
    const plane_levels& levels_;
    std::vector<std::vector<std::uint32_t>> whole_;  ///< [slabs] faces in one slab
    std::vector<std::vector<slab_face>> cut_;        ///< [slabs] parts of others
};

}  // namespace

std::vector<slab> slabs_of(mesh_view mesh, const plane_levels& levels, bool caps) {
    return slab_cutter(mesh, levels).run(caps);
}

}  // namespace treeform::detail::cut
