#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/round/turned_faces.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace treeform::detail::round {
namespace {

using base::cross;
using base::dot;
using base::minus;

using box3 = aabb<double, 3>;
using uses = std::span<const near_edges::use>;

box3 box_of(mesh_view surface, std::uint32_t f) {
    box3 box;
    for (const std::uint32_t corner : surface.faces[f]) box.include(surface.points[corner]);
    return box;
}

/// The parts of a surface near faces that have moved, as far as they are near; faces by their
/// places among those near.
class near_parts {
  public:
    near_parts(mesh_view surface, std::span<const std::uint8_t> sound, const near_edges& near)
        : surface_(surface), sound_(sound), edges_(near), near_(near.faces()), sets_(near_.size()) {
        edges_.for_each([&](uses at) {
            if (at.size() == 2) sets_.join(at[0].place, at[1].place);
        });
    }

    /// Those without a face that holds them, in the order of their lowest faces.
    ///
    /// All that are not near hold. Where an edge is one of theirs, no box of a face that has moved
    /// meets it, and what is near and has the edge is held there, too: so are both faces at an edge
    /// of which others have been left out.
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> loose() {
        std::vector<std::uint8_t> held(near_.size(), 0);
        edges_.for_each([&](uses at) {
            if (at.size() == 1)
                std::atomic_ref(held[sets_.root(at[0].place)]).store(1, std::memory_order_relaxed);
        });
        std::vector<std::array<std::uint32_t, 2>> left;
        for (std::uint32_t i = 0; i < near_.size(); ++i)
            if (const std::uint32_t part = sets_.root(i); held[part] == 0)
                left.push_back({part, i});
        std::sort(left.begin(), left.end());
        std::vector<std::vector<std::uint32_t>> result;
        for (std::size_t i = 0; i < left.size(); ++i) {
            if (i == 0 || left[i][0] != left[i - 1][0]) result.emplace_back();
            result.back().push_back(left[i][1]);
        }
        return result;
    }

    /// Whether loose parts are as they were, for all that `moved` tells.
    ///
    /// The winding number of the surface next to a corner of a part is that of the part there and
    /// that of the rest. The latter is as it was if the corner has met nothing of the rest on its
    /// way: if it is in no box of the rest's faces (see above; faces far from all that has moved
    /// have not moved, nor do they hold a corner that has). The former is one number w on all of
    /// the part's front and w + 1 behind it, as neither changes along the part. If the part is
    /// closed, all of space has one of these numbers, and 0 far away: w is 0 or -1, as the part's
    /// volume is positive or negative. So it is as it was if the volume has the sign it had.
    [[nodiscard]] bool are_as_before(std::span<const std::vector<std::uint32_t>> loose,
                                     double moved) {
        const std::vector<std::uint8_t> open = open_parts();
        std::vector<face> faces;
        for (const std::uint32_t f : near_) faces.push_back(surface_.faces[f]);
        const tree<3> tree = build_face_tree({surface_.points, faces});
        return std::all_of(loose.begin(), loose.end(), [&](const auto& part) {
            const bool still = std::all_of(part.begin(), part.end(),
                                           [&](std::uint32_t i) { return sound_[near_[i]] != 0; });
            return (still || (open[part[0]] == 0 && keeps_sign(part, moved))) &&
                   is_apart_somewhere(part, tree);
        });
    }

  private:
    /// By the lowest face: 1 for parts that run along some edge more often one way.
    [[nodiscard]] std::vector<std::uint8_t> open_parts() {
        std::vector<std::uint8_t> open(near_.size(), 0);
        edges_.for_each([&](uses at) {
            for (const near_edges::use& use : at) {
                const std::uint32_t part = sets_.root(use.place);
                int sum = 0;
                for (const near_edges::use& other : at)
                    if (sets_.root(other.place) == part) sum += other.way;
                if (sum != 0) std::atomic_ref(open[part]).store(1, std::memory_order_relaxed);
            }
        });
        return open;
    }

    /// Whether a closed part's volume V has the sign that it had when its points were up to `moved`
    /// away, in each coordinate.
    ///
    /// 6 V is the sum over the faces of (a - o) . n, n = (b - a) x (c - a), for any o. A face with
    /// a box of extents x, y, z has |n.x| <= y z, as that is twice an area within a rectangle, and
    /// so on: |n.x| + |n.y| + |n.z| <= P = x y + y z + z x.
    /// (1) When one point moves by d, 6 V changes by the sum of d . n over the faces at it: what n
    /// lacks of a x b + b x c + c x a there adds up to nothing, as the part is closed. One
    /// point after the other, by at most m in each coordinate, is 3 m times the sum of all P, of
    /// boxes that are m larger each way, as some of their corners may have moved.
    /// (2) With o a corner, |a - o| <= D in each coordinate, D the part's largest extent. To
    /// compute n takes 4 roundings and (a - o) . n another 4, of terms no larger than 2 D P
    /// together: the error is below 18 e D P, e = 2^-53; to add up F of them, below (F + 1) e D
    /// times the sum of all P. The bound is doubled, for its own roundings. What underflows is
    /// below 2^-1022 each time, and multiplied by no more than 2^301 then.
    [[nodiscard]] bool keeps_sign(const std::vector<std::uint32_t>& part, double moved) const {
        const auto count = static_cast<double>(part.size());
        box3 all;
        for (const std::uint32_t i : part) all.include(box_of(surface_, near_[i]));
        double extent = 0.0;
        for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, all.max[k] - all.min[k]);
        if (!(extent < 0x1p150) || !(moved < 0x1p150)) return false;
        const point3 origin = surface_.points[surface_.faces[near_[part[0]]][0]];
        double volume = 0.0, areas = 0.0;
        for (const std::uint32_t i : part) {
            const auto& [a, b, c] = surface_.faces[near_[i]];
            const auto& points = surface_.points;
            volume += dot(minus(points[a], origin),
                          cross(minus(points[b], points[a]), minus(points[c], points[a])));
            const box3 box = box_of(surface_, near_[i]);
            const double x = box.max[0] - box.min[0] + 2.0 * moved;
            const double y = box.max[1] - box.min[1] + 2.0 * moved;
            const double z = box.max[2] - box.min[2] + 2.0 * moved;
            areas += x * y + y * z + z * x;
        }
        const double bound = (3.0 * moved + (count + 32.0) * 0x1p-53 * extent) * areas;
        return std::abs(volume) > 2.0 * bound + count * 0x1p-700;
    }

    /// Whether a corner of the part is in no box of a face of another part.
    [[nodiscard]] bool is_apart_somewhere(const std::vector<std::uint32_t>& part,
                                          const tree<3>& tree) {
        return std::any_of(part.begin(), part.end(), [&](std::uint32_t i) {
            const face& corners = surface_.faces[near_[i]];
            return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t p) {
                box3 at;
                at.include(surface_.points[p]);
                return !search_any(tree, at, [&](std::uint32_t other) {
                    return sets_.root(other) != part[0] &&
                           overlaps(at, box_of(surface_, near_[other]));
                });
            });
        });
    }

    mesh_view surface_;
    std::span<const std::uint8_t> sound_;
    const near_edges& edges_;
    std::span<const std::uint32_t> near_;
    base::union_find sets_;
};

/// The surface as the arrangement that it is.
mesh_arrangement as_arrangement(mesh_view surface) {
    mesh_arrangement cut;
    cut.given_points.assign(surface.points.begin(), surface.points.end());
    cut.faces.assign(surface.faces.begin(), surface.faces.end());
    cut.cover_begin.resize(cut.faces.size() + 1);
    std::iota(cut.cover_begin.begin(), cut.cover_begin.end(), std::size_t{0});
    cut.covers.resize(cut.faces.size());
    for (std::uint32_t f = 0; f < cut.faces.size(); ++f) cut.covers[f] = {f, false};
    return cut;
}

}  // namespace

bool may_be_turned(mesh_view surface, std::span<const std::uint8_t> sound, const near_edges& near,
                   double moved) {
    if (std::none_of(sound.begin(), sound.end(), [](std::uint8_t s) { return s != 0; }))
        return true;
    near_parts parts(surface, sound, near);
    const auto loose = parts.loose();
    return !loose.empty() &&
           !(moved < std::numeric_limits<double>::infinity() && parts.are_as_before(loose, moved));
}

turned_faces find_turned_faces(mesh_view surface) {
    turned_faces result;
    const std::vector<std::uint32_t> one_operand(surface.faces.size(), 0);
    const arrangement_cells cells = find_cells(surface, as_arrangement(surface), one_operand, 1);
    result.open = cells.open_count > 0;
    if (result.open) return result;
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
        const auto [front, behind] = cells.cell_of_side[f];
        if (cells.winding[front] != 0 || cells.winding[behind] != 1) result.faces.push_back(f);
    }
    return result;
}

}  // namespace treeform::detail::round
