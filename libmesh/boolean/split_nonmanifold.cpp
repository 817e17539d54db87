#include <libmesh/arrange/radial_order.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/split_nonmanifold.hpp>
#include <libmesh/topology/is_manifold.hpp>
#include <libmesh/weld/edge_uses.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {
namespace {

using detail::arrange::face_side;

/// An edge of more than two faces.
struct touching_edge {
    std::uint32_t low;
    std::uint32_t high;
    std::vector<face_side> sides;  ///< counter-clockwise, the first seen from behind where they do
    bool alternates = false;       ///< between inside and outside, as around a solid
    bool by_space = false;         ///< which faces stay together, see `split_nonmanifold`
};

/// The faces at some edges as an arrangement of their own: all that sorting them needs.
class few_faces {
  public:
    few_faces(mesh_view solid, const std::vector<touching_edge>& edges) {
        for (const touching_edge& e : edges)
            for (const face_side side : e.sides) ids_.push_back(detail::arrange::face_of(side));
        std::sort(ids_.begin(), ids_.end());
        ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
        for (const std::uint32_t f : ids_) {
            face few{};
            for (std::size_t i = 0; i < 3; ++i) {
                few[i] = static_cast<std::uint32_t>(mesh_.points.size());
                mesh_.points.push_back(solid.points[solid.faces[f][i]]);
            }
            mesh_.faces.push_back(few);
        }
        cut_.given_points = mesh_.points;
        cut_.faces = mesh_.faces;
        for (std::uint32_t f = 0; f < ids_.size(); ++f) {
            cut_.cover_begin.push_back(f);
            cut_.covers.push_back({f, false});
        }
        cut_.cover_begin.push_back(ids_.size());
    }

    [[nodiscard]] mesh_view mesh() const { return mesh_; }
    [[nodiscard]] const mesh_arrangement& cut() const { return cut_; }
    [[nodiscard]] std::uint32_t number(std::uint32_t f) const {
        return static_cast<std::uint32_t>(std::lower_bound(ids_.begin(), ids_.end(), f) -
                                          ids_.begin());
    }
    [[nodiscard]] std::uint32_t face_of(std::uint32_t few) const { return ids_[few]; }
    [[nodiscard]] std::uint32_t corner(std::uint32_t f, std::uint32_t i) const {
        return cut_.faces[number(f)][i];
    }

  private:
    std::vector<std::uint32_t> ids_;
    treeform::mesh mesh_;
    mesh_arrangement cut_;
};

/// Of a surface of which the faces at all points without a fan are there: others have one fan,
/// which need not be there.
class separator {
  public:
    /// Marks points without a fan as it goes.
    separator(treeform::mesh&& solid, std::vector<std::uint8_t>& lacks_fan)
        : solid_(std::move(solid)),
          is_rough_(lacks_fan),
          edges_(solid_.points.size(), solid_.faces, detail::weld::repeated_corners::left_out) {}

    manifold_surface run() {
        find_touching_edges();
        sort_around_edges();
        detail::base::union_find fans = find_fans();
        std::uint64_t shared = count_shared(fans);
        constexpr int most_rounds = 8;
        for (int round = 0; round < most_rounds && shared > 0; ++round)
            if (!turn_shared(fans, shared)) break;
        return number_points(fans, shared);
    }

  private:
    static constexpr std::uint8_t taken = 2;  ///< a point without one closed fan, by its first fan

    [[nodiscard]] bool runs_up(std::uint32_t f, std::uint32_t low, std::uint32_t high) const {
        const face& c = solid_.faces[f];
        return (c[0] == low && c[1] == high) || (c[1] == low && c[2] == high) ||
               (c[2] == low && c[0] == high);
    }

    void find_touching_edges() {
        std::vector<std::vector<touching_edge>> found(edges_.chunks());
        edges_.for_each([&](const detail::weld::used_edge& edge, std::size_t chunk) {
            if (edge.uses.size() <= 2) return;
            touching_edge e{edge.low, edge.high, {}};
            for (std::size_t i = 0; i < edge.uses.size(); ++i) {
                const std::uint32_t f = edge.face(i);
                e.sides.push_back(runs_up(f, e.low, e.high) ? detail::arrange::front_of(f)
                                                            : detail::arrange::behind(f));
            }
            found[chunk].push_back(std::move(e));
        });
        for (auto& part : found)
            touching_.insert(touching_.end(), std::make_move_iterator(part.begin()),
                             std::make_move_iterator(part.end()));
    }

    void sort_around_edges() {
        const few_faces few(solid_, touching_);
        detail::arrange::radial_order radial(few.mesh(), few.cut());
        for (touching_edge& e : touching_) {
            std::vector<face_side> sides;
            for (const face_side side : e.sides)
                sides.push_back(2 * few.number(detail::arrange::face_of(side)) + (side & 1U));
            const std::uint32_t f = detail::arrange::face_of(e.sides[0]);
            const std::array<std::uint32_t, 2> ends{few.corner(f, i_of(f, e.low)),
                                                    few.corner(f, i_of(f, e.high))};
            if (!radial.sort(ends, sides) || !alternate(sides)) continue;
            // What looks on from a face that is seen from behind is a wedge of the solid.
            if (!detail::arrange::is_behind(sides[0]))
                std::rotate(sides.begin(), sides.begin() + 1, sides.end());
            for (std::size_t i = 0; i < sides.size(); ++i)
                e.sides[i] = 2 * few.face_of(detail::arrange::face_of(sides[i])) + (sides[i] & 1U);
            e.alternates = true;
        }
    }

    static bool alternate(const std::vector<face_side>& sides) {
        for (std::size_t i = 0; i < sides.size(); ++i)
            if (detail::arrange::is_behind(sides[i]) ==
                detail::arrange::is_behind(sides[(i + 1) % sides.size()]))
                return false;
        return true;
    }

    [[nodiscard]] std::uint32_t i_of(std::uint32_t f, std::uint32_t point) const {
        const face& c = solid_.faces[f];
        return c[0] == point ? 0 : c[1] == point ? 1 : 2;
    }
    [[nodiscard]] std::uint32_t corner(std::uint32_t f, std::uint32_t point) const {
        return 3 * f + i_of(f, point);
    }

    /// The pairs of faces that stay together at an edge.
    template <class Visit>
    static void for_each_pair(const touching_edge& e, const Visit& visit) {
        const std::size_t count = e.sides.size();
        for (std::size_t i = e.by_space ? 1 : 0; i < count; i += 2)
            visit(detail::arrange::face_of(e.sides[i]),
                  detail::arrange::face_of(e.sides[(i + 1) % count]));
    }

    /// Sets of the 3 F corners: those that become one point.
    [[nodiscard]] detail::base::union_find find_fans() const {
        detail::base::union_find fans(3 * solid_.faces.size());
        const auto join = [&](std::uint32_t f, std::uint32_t g, std::uint32_t low,
                              std::uint32_t high) {
            fans.join(corner(f, low), corner(g, low));
            fans.join(corner(f, high), corner(g, high));
        };
        edges_.for_each([&](const detail::weld::used_edge& edge, std::size_t) {
            if (edge.uses.size() == 2) join(edge.face(0), edge.face(1), edge.low, edge.high);
        });
        for (const touching_edge& e : touching_) {
            if (e.alternates)
                for_each_pair(e,
                              [&](std::uint32_t f, std::uint32_t g) { join(f, g, e.low, e.high); });
            else
                for (const face_side side : e.sides)
                    join(detail::arrange::face_of(e.sides[0]), detail::arrange::face_of(side),
                         e.low, e.high);
        }
        return fans;
    }

    /// Whether more than two faces have the edge between the same points.
    [[nodiscard]] bool is_shared(const touching_edge& e, detail::base::union_find& fans) const {
        if (!e.alternates) return true;
        std::vector<std::array<std::uint32_t, 2>> ends;
        for_each_pair(e, [&](std::uint32_t f, std::uint32_t) {
            ends.push_back({fans.root(corner(f, e.low)), fans.root(corner(f, e.high))});
        });
        std::sort(ends.begin(), ends.end());
        return std::adjacent_find(ends.begin(), ends.end()) != ends.end();
    }

    [[nodiscard]] std::uint64_t count_shared(detail::base::union_find& fans) const {
        return static_cast<std::uint64_t>(
            std::count_if(touching_.begin(), touching_.end(),
                          [&](const touching_edge& e) { return is_shared(e, fans); }));
    }

    /// Turns what stays together at edges that are shared, at all of them or else at one of the
    /// first; false where none of that leaves fewer of them.
    [[nodiscard]] bool turn_shared(detail::base::union_find& fans, std::uint64_t& shared) {
        constexpr std::size_t most_tried = 16;
        std::vector<std::vector<touching_edge*>> choices(1);
        for (touching_edge& e : touching_) {
            if (!e.alternates || !is_shared(e, fans)) continue;
            choices[0].push_back(&e);
            if (choices.size() <= most_tried) choices.push_back({&e});
        }
        for (const auto& choice : choices) {
            for (touching_edge* const e : choice) e->by_space = !e->by_space;
            detail::base::union_find turned = find_fans();
            if (const std::uint64_t then = count_shared(turned); then < shared) {
                fans = std::move(turned);
                shared = then;
                return true;
            }
            for (touching_edge* const e : choice) e->by_space = !e->by_space;
        }
        return false;
    }

    /// A vertex's first fan keeps its number.
    [[nodiscard]] manifold_surface number_points(detail::base::union_find& fans,
                                                 std::uint64_t shared_edges) {
        manifold_surface result;
        result.shared_edges = shared_edges;
        std::vector<std::uint32_t> point_of_corner(fans.size());
        for (std::uint32_t c = 0; c < fans.size(); ++c) {
            std::uint32_t& point = solid_.faces[c / 3][c % 3];
            if (const std::uint32_t root = fans.root(c); root != c) {
                point = point_of_corner[root];
            } else if (is_rough_[point] != taken) {
                if (is_rough_[point] != 0) is_rough_[point] = taken;
            } else {
                result.vertex_of_added.push_back(point);
                const point3 at = solid_.points[point];
                point = static_cast<std::uint32_t>(solid_.points.size());
                solid_.points.push_back(at);
            }
            point_of_corner[c] = point;
        }
        result.surface = std::move(solid_);
        return result;
    }

    treeform::mesh solid_;
    std::vector<std::uint8_t>& is_rough_;  ///< [V] before points are added
    detail::weld::edge_uses edges_;
    std::vector<touching_edge> touching_{};
};

}  // namespace

manifold_surface split_nonmanifold(mesh&& solid) {
    const std::vector<std::uint32_t> without_fan = topology::points_without_fan(solid);
    if (without_fan.empty()) return {.surface = std::move(solid)};
    std::vector<std::uint8_t> lacks_fan(solid.points.size(), 0);
    for (const std::uint32_t p : without_fan) lacks_fan[p] = 1;
    std::vector<face> all = std::move(solid.faces);
    std::vector<std::uint32_t> at;  // faces at points without a fan
    solid.faces.clear();
    base::compact(
        all.size(),
        [&](std::size_t f) {
            return (lacks_fan[all[f][0]] | lacks_fan[all[f][1]] | lacks_fan[all[f][2]]) != 0;
        },
        [&](std::size_t count) {
            at.resize(count);
            solid.faces.resize(count);
        },
        [&](std::size_t f, std::size_t place) {
            at[place] = static_cast<std::uint32_t>(f);
            solid.faces[place] = all[f];
        });
    manifold_surface result = separator(std::move(solid), lacks_fan).run();
    for (std::size_t i = 0; i < at.size(); ++i) all[at[i]] = result.surface.faces[i];
    result.surface.faces = std::move(all);
    return result;
}

void split_nonmanifold(boolean_result& result) {
    manifold_surface manifold = split_nonmanifold(std::move(result.mesh));
    result.mesh = std::move(manifold.surface);
    result.statistics.split_vertices = manifold.vertex_of_added.size();
    for (auto* sources : {&result.vertex_source, &result.face_of_cut_vertex})
        if (!sources->empty())
            for (const std::uint32_t p : manifold.vertex_of_added)
                sources->push_back((*sources)[p]);
}

}  // namespace treeform::detail::boolean
