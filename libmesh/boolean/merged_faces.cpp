#include <libmesh/arrange/face_side.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/fill_stars.hpp>
#include <libmesh/base/flattened.hpp>
#include <libmesh/base/parallel_invoke.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/base/running_sums.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/merged_faces.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/round/region_triangles.hpp>
#include <libmesh/weld/edge_uses.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <utility>

namespace treeform::detail::boolean {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t face_grain = std::size_t{1} << 10;
constexpr std::size_t point_grain = std::size_t{1} << 8;

/// An edge of which something is to be kept: a region ends at it.
using crease = weld::used_edge;

class merger {
  public:
    merger(const exact_surface& surface, const face_planes& planes)
        : surface_(surface),
          planes_(planes),
          point_count_(surface.given.size() + surface.constructed.size()),
          edges_(point_count_, surface.faces, weld::repeated_corners::left_out) {}

    merged_faces run() {
        find_regions();
        find_spare_points();
        return rebuild();
    }

  private:
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

    /// The end of an edge where the side of its face `f` begins.
    [[nodiscard]] std::uint32_t from(const crease& c, std::uint32_t f) const {
        const auto& [p, q, r] = surface_.faces[f];
        const std::uint32_t next = p == c.low ? q : q == c.low ? r : p;
        return next == c.high ? c.low : c.high;
    }

    /// Two faces that meet here and nowhere bend, so that nothing is lost without the edge.
    [[nodiscard]] bool is_flat(const crease& c) const {
        if (c.uses.size() != 2) return false;
        const std::uint32_t f = c.face(0), g = c.face(1);
        if (from(c, f) == from(c, g) || stays(f) || stays(g)) return false;
        return group(f) == group(g) && coplanar(f, g);
    }

    void find_regions() {
        base::union_find regions(surface_.faces.size());
        std::vector<std::vector<crease>> found(edges_.chunks());
        edges_.for_each([&](const crease& c, std::size_t chunk) {
            if (is_flat(c))
                regions.join(c.face(0), c.face(1));
            else
                found[chunk].push_back(c);
        });
        creases_ = base::flattened(std::move(found));
        region_ = regions.take_roots();
    }

    /// The regions at a crease, ascending.
    [[nodiscard]] std::vector<std::uint32_t> regions_at(const crease& c) const {
        std::vector<std::uint32_t> regions;
        for (std::size_t u = 0; u < c.uses.size(); ++u) regions.push_back(region_[c.face(u)]);
        std::sort(regions.begin(), regions.end());
        return regions;
    }

    [[nodiscard]] implicit_point point(std::uint32_t p) const {
        return p < surface_.given.size() ? implicit_point(surface_.given[p])
                                         : surface_.constructed[p - surface_.given.size()];
    }

    /// Whether the creases from p, to q and to r, are one line, with the same regions at both:
    /// where two of them are not coplanar, both lie where their planes meet.
    [[nodiscard]] bool continues(std::uint32_t p, const crease& c, const crease& d) const {
        if (c.uses.size() != d.uses.size()) return false;
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
        return c.low == p ? c.high : c.low;
    }

    /// Points in the middle of one region, or of one straight line between the same regions.
    void find_spare_points() {
        const auto creases_at = base::fill_stars<std::uint64_t>(
            point_count_, creases_.size(), [&](std::size_t c, const auto& visit) {
                visit(creases_[c].low);
                visit(creases_[c].high);
            });
        std::vector<std::uint32_t> region_at(point_count_, none);  // one of them
        spare_.assign(point_count_, 1);
        for_chunks(surface_.faces.size(), face_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t f = begin; f < end; ++f)
                           for (const std::uint32_t p : surface_.faces[f]) {
                               const std::uint32_t region = region_[f];
                               std::uint32_t other = none;
                               std::atomic_ref(region_at[p])
                                   .compare_exchange_strong(other, region,
                                                            std::memory_order_relaxed);
                               const bool differs = other != none && other != region;
                               if (stays(static_cast<std::uint32_t>(f)) ||
                                   (differs && creases_at[p].empty()))
                                   std::atomic_ref(spare_[p]).store(0, std::memory_order_relaxed);
                           }
                   });
        next_.assign(point_count_, {none, none});
        for_chunks(point_count_, point_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto p = static_cast<std::uint32_t>(i);
                const auto at = creases_at[p];
                if (region_at[p] == none || at.size() == 1 || at.size() > 2) spare_[p] = 0;
                if (at.size() != 2) continue;
                const crease &c = creases_[at[0]], &d = creases_[at[1]];
                spare_[p] = continues(p, c, d);
                if (spare_[p] != 0) next_[p] = {other_end(c, p), other_end(d, p)};
            }
        });
    }

    /// Where the straight line that begins at `before` toward `to` ends.
    [[nodiscard]] std::uint32_t end_of_line(std::uint32_t before, std::uint32_t to) const {
        while (spare_[to] != 0) {
            const std::uint32_t beyond = next_[to][0] == before ? next_[to][1] : next_[to][0];
            before = to;
            to = beyond;
        }
        return to;
    }

    /// Triangles for the regions that lose a point.
    merged_faces rebuild() const {
        const std::size_t face_count = surface_.faces.size();
        std::vector<std::uint8_t> changes(face_count, 0);  // by region
        for_chunks(face_count, face_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t f = begin; f < end; ++f)
                for (const std::uint32_t p : surface_.faces[f])
                    if (spare_[p] != 0)
                        std::atomic_ref(changes[region_[f]]).store(1, std::memory_order_relaxed);
        });
        std::vector<std::uint32_t> number(face_count, none), changed;  // by region, and back
        base::compact(
            face_count, [&](std::size_t f) { return region_[f] == f && changes[f] != 0; },
            [&](std::size_t count) { changed.resize(count); },
            [&](std::size_t f, std::size_t place) {
                number[f] = static_cast<std::uint32_t>(place);
                changed[place] = static_cast<std::uint32_t>(f);
            });
        const auto visit_number = [&](std::size_t f, const auto& visit) {
            if (const std::uint32_t n = number[region_[f]]; n != none) visit(n);
        };
        const auto faces_of =
            base::fill_stars<std::uint64_t>(changed.size(), face_count, visit_number);
        const auto creases_of = base::fill_stars<std::uint64_t>(
            changed.size(), creases_.size(), [&](std::size_t c, const auto& visit) {
                for (std::size_t u = 0; u < creases_[c].uses.size(); ++u)
                    visit_number(creases_[c].face(u), visit);
            });
        constexpr std::size_t grain = 4;
        std::vector<std::vector<face>> made(changed.size());
        for_chunks(changed.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t r = begin; r < end; ++r) {
                round::flat_region region{.first_face = changed[r],
                                          .plane = surface_.faces[changed[r]]};
                for (const std::uint32_t f : faces_of[r])
                    for (const std::uint32_t p : surface_.faces[f])
                        if (spare_[p] == 0) region.points.push_back(p);
                const auto at = creases_of[r];
                for (std::size_t i = 0; i < at.size(); ++i)
                    if (i == 0 || at[i] != at[i - 1]) add_rim(creases_[at[i]], region);
                made[r] = round::triangles_of(surface_, region);
            }
        });
        return joined(number, made);
    }

    /// The sides of a crease that a region has, with the lines that are straight in one piece.
    void add_rim(const crease& c, round::flat_region& region) const {
        std::vector<std::uint32_t> at;
        for (std::size_t u = 0; u < c.uses.size(); ++u) {
            if (region_[c.face(u)] != region.first_face) continue;
            const std::uint32_t begin = from(c, c.face(u));
            if (spare_[begin] != 0) continue;  // a line is entered where it begins
            if (at.empty()) at = regions_at(c);
            region.rim.push_back(
                {begin, end_of_line(begin, other_end(c, begin)), line_name(region.first_face, at)});
        }
    }

    /// A region whose plane crosses that of `region` in the line where both meet; or none.
    [[nodiscard]] std::uint32_t line_name(std::uint32_t region,
                                          const std::vector<std::uint32_t>& regions_there) const {
        for (const std::uint32_t other : regions_there)
            if (!coplanar(region, other)) return other;
        return none;
    }

    [[nodiscard]] merged_faces joined(const std::vector<std::uint32_t>& number,
                                      const std::vector<std::vector<face>>& made) const {
        const std::size_t face_count = surface_.faces.size();
        const std::vector<std::size_t> first = base::running_sums(face_count, [&](std::size_t f) {
            if (number[region_[f]] == none) return std::size_t{1};
            return region_[f] == f ? made[number[f]].size() : 0;
        });
        merged_faces result;
        base::parallel_invoke(
            [&] { base::resize_all(face_count, result.merged_into); },
            [&] { base::resize_all(first.back(), result.faces, result.face_of, result.is_new); });
        for_chunks(face_count, face_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto f = static_cast<std::uint32_t>(i);
                const bool stays_as_it_is = number[region_[f]] == none;
                result.merged_into[f] = stays_as_it_is ? f : region_[f];
                for (std::size_t k = first[f]; k < first[f + 1]; ++k) {
                    result.faces[k] =
                        stays_as_it_is ? surface_.faces[f] : made[number[f]][k - first[f]];
                    result.face_of[k] = f;
                    result.is_new[k] = stays_as_it_is ? 0 : 1;
                }
            }
        });
        return result;
    }

    const exact_surface& surface_;
    const face_planes& planes_;
    std::size_t point_count_;
    weld::edge_uses edges_;
    std::vector<crease> creases_{};   ///< ascending
    buffer<std::uint32_t> region_{};  ///< of each face: its lowest
    std::vector<std::uint8_t> spare_{};
    std::vector<std::array<std::uint32_t, 2>> next_{};  ///< of spare points of lines, both ways
};

}  // namespace

merged_faces merge_coplanar(const exact_surface& surface, const face_planes& planes) {
    return merger(surface, planes).run();
}

}  // namespace treeform::detail::boolean
