#include <libmesh/base/point_math.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/round/cancelled_faces.hpp>
#include <libmesh/round/edge_gap.hpp>
#include <libmesh/round/flatten.hpp>
#include <libmesh/round/joined_points.hpp>
#include <libmesh/round/near_edges.hpp>
#include <libmesh/round/region_triangles.hpp>
#include <libmesh/round/straight_rims.hpp>
#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace treeform::detail::round {
namespace {

constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();
constexpr int most_widenings = 4, most_attempts = 40, most_crossings = 100;

using numbers = std::vector<std::uint32_t>;

/// Connected faces near one plane, and what comes in their place.
struct flat_part {
    numbers faces{};  ///< the first is the largest
    bool is_straight = true;
    std::vector<rim_side> rim{};
    std::vector<face> made{};
    std::vector<rim_side> made_of{};  ///< the rim
};

class flattening {
  public:
    /// \param begin_at    faces that meet, or could not be made flat without others at their
    ///        corners
    /// \param falls_apart  what cannot be made does so
    flattening(mesh_view surface, const numbers& begin_at, const flatten_options& options,
               bool falls_apart)
        : options_(options),
          faces_(surface.faces.begin(), surface.faces.end()),
          falls_apart_(falls_apart) {
        exact_.given.assign(surface.points.begin(), surface.points.end());
        exact_.faces = faces_;
        std::vector<std::uint8_t> is_near(surface.points.size(), 0);
        for (const std::uint32_t f : begin_at)
            for (const std::uint32_t p : faces_[f]) is_near[p] = 1;
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            if (std::ranges::any_of(faces_[f], [&](std::uint32_t p) { return is_near[p] != 0; }))
                begin_at_.push_back(f);
    }

    /// Faces to begin at, too, in another attempt; then there is no result.
    [[nodiscard]] const numbers& wanted() const { return wanted_; }

    std::optional<flattened> run() {
        const numbers near = join_points();
        grow_parts();
        split_edges(near);
        for (int i = 0; i < most_attempts; ++i) {
            if (make_parts()) return collect();
            if (!wanted_.empty()) break;
        }
        return std::nullopt;
    }

  private:
    [[nodiscard]] bool is_fixed(std::uint32_t f) const { return fixed_[f] != 0; }
    /// Whether an edge has to stay as it is: a face that stays has it.
    [[nodiscard]] bool is_held(std::uint32_t p, std::uint32_t q) const {
        if (blocked_.contains(name(p, q))) return true;
        if (p >= stars_->size()) return false;
        return std::ranges::any_of((*stars_)[p], [&](std::uint32_t f) {
            return is_fixed(f) && std::ranges::find(faces_[f], q) != faces_[f].end();
        });
    }
    [[nodiscard]] bool is_there(std::uint32_t f) const {
        return base::has_three_corners(faces_[f]);
    }
    [[nodiscard]] const point3& at(std::uint32_t p) const { return exact_.given[p]; }
    [[nodiscard]] point3 normal(std::uint32_t f) const {
        const auto& [a, b, c] = base::triangle_of(points_view(exact_.given), faces_[f]);
        return base::cross(base::minus(b, a), base::minus(c, a));
    }
    [[nodiscard]] aabb<double, 3> around(const point3& p, const point3& q) const {
        aabb<double, 3> box;
        box.include(p);
        box.include(q);
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] -= options_.reach;
            box.max[k] += options_.reach;
        }
        return box;
    }

    /// Corners of the faces to begin at that are within reach of each other become one: that of a
    /// face that stays, or the lowest.
    /// \return those that are left, ascending
    [[nodiscard]] numbers join_points() {
        fixed_.assign(faces_.size(), 1);
        for (const std::uint32_t f : begin_at_) fixed_[f] = 0;
        find_held_points();
        numbers near;
        for (const std::uint32_t f : begin_at_)
            near.insert(near.end(), faces_[f].begin(), faces_[f].end());
        std::ranges::sort(near);
        near.erase(std::unique(near.begin(), near.end()), near.end());
        const numbers now = joined_points(exact_.given, near, is_held_, options_.reach);
        for (const std::uint32_t f : begin_at_)
            for (std::uint32_t& p : faces_[f]) p = now[p];
        stars_.emplace(exact_.given.size(), faces_);
        std::erase_if(near, [&](std::uint32_t p) { return now[p] != p; });
        return near;
    }

    void find_held_points() {
        is_held_.assign(exact_.given.size(), 0);
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            if (is_fixed(f) && is_there(f))
                for (const std::uint32_t p : faces_[f]) is_held_[p] = 1;
    }

    [[nodiscard]] static std::uint64_t name(std::uint32_t p, std::uint32_t q) {
        return std::uint64_t{std::min(p, q)} << 32U | std::max(p, q);
    }

    /// Of faces that may change: what is across each side, if that is one other.
    [[nodiscard]] std::vector<face> neighbors() const {
        numbers all;
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            if (is_there(f) &&
                (!is_fixed(f) || options_.certified.empty() || options_.certified[f] == 0))
                all.push_back(f);
        std::vector<face> across(faces_.size(), {nothing, nothing, nothing});
        near_edges(mesh_view{exact_.given, faces_}, all)
            .for_each([&](std::span<const near_edges::use> uses) {
                if (uses.size() != 2 || uses[0].way == uses[1].way) return;
                const std::uint32_t f = all[uses[0].place], g = all[uses[1].place];
                across[f][side_at(f, uses[0].edge)] = g;
                across[g][side_at(g, uses[0].edge)] = f;
            });
        return across;
    }

    [[nodiscard]] std::size_t side_at(std::uint32_t f, std::uint64_t edge) const {
        const face& c = faces_[f];
        return name(c[0], c[1]) == edge ? 0 : name(c[1], c[2]) == edge ? 1 : 2;
    }

    /// Each edge gets the points that are within reach of it.
    void split_edges(const numbers& near) {
        const dynamic_tree<3> tree(near, [&](std::uint32_t p) {
            aabb<double, 3> box;
            box.include(at(p));
            return box;
        });
        for (const std::uint32_t f : begin_at_)
            for (std::size_t i = 0; i < 3 && is_there(f) && !is_fixed(f); ++i) {
                const std::uint32_t p = std::min(faces_[f][i], faces_[f][(i + 1) % 3]),
                                    q = std::max(faces_[f][i], faces_[f][(i + 1) % 3]);
                if (is_held(p, q)) continue;
                const auto [way, is_first] = way_of_.try_emplace(name(p, q));
                if (!is_first) continue;
                const point3 along = base::minus(at(q), at(p));
                std::vector<std::pair<double, std::uint32_t>> on;
                search(tree, around(at(p), at(q)), [&](std::uint32_t n) {
                    const std::uint32_t r = near[n];
                    if (r == p || r == q || distance_to_edge(at(r), at(p), at(q)) > options_.reach)
                        return;
                    on.emplace_back(base::dot(base::minus(at(r), at(p)), along), r);
                });
                std::ranges::sort(on);
                for (const auto& [place, r] : on) way->second.push_back(r);
                if (on.empty()) way_of_.erase(way);
            }
    }

    /// Largest first, so that planes are well known.
    void grow_parts() {
        std::vector<std::pair<double, std::uint32_t>> seeds;
        for (const std::uint32_t f : begin_at_) {
            if (!is_there(f) || is_fixed(f)) continue;
            const point3 n = normal(f);
            seeds.emplace_back(-base::dot(n, n), f);
        }
        std::ranges::sort(seeds);
        const std::vector<face> across = neighbors();
        part_of_.assign(faces_.size(), nothing);
        for (const auto& [square, f] : seeds)
            if (part_of_[f] == nothing && square < 0.0) grow(f, std::sqrt(-square), across);
        std::vector<std::uint8_t> is_near(exact_.given.size(), 0);
        for (const flat_part& part : parts_)
            for (const std::uint32_t f : part.faces)
                for (const std::uint32_t p : faces_[f]) is_near[p] = 1;
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            if (!is_there(f) || part_of_[f] != nothing) continue;
            const auto& [p, q, r] = faces_[f];
            if ((is_near[p] | is_near[q] | is_near[r]) != 0) add_part(f);
        }
        find_held_points();
    }

    void add_part(std::uint32_t f) {
        part_of_[f] = static_cast<std::uint32_t>(parts_.size());
        fixed_[f] = 0;
        parts_.emplace_back().faces.push_back(f);
    }

    void grow(std::uint32_t seed, double length, const std::vector<face>& across) {
        const point3 unit = base::scaled(normal(seed), 1.0 / length);
        const point3 origin = at(faces_[seed][0]);
        const auto is_near = [&](std::uint32_t p) {
            return std::abs(base::dot(base::minus(at(p), origin), unit)) <= options_.reach;
        };
        const auto number = static_cast<std::uint32_t>(parts_.size());
        add_part(seed);
        numbers& faces = parts_.back().faces;
        for (std::size_t i = 0; i < faces.size(); ++i)
            for (const std::uint32_t g : across[faces[i]]) {
                if (g == nothing || part_of_[g] != nothing) continue;
                if (!std::ranges::all_of(faces_[g], is_near)) continue;
                part_of_[g] = number;
                fixed_[g] = 0;
                faces.push_back(g);
            }
    }

    /// Calls `visit(from, to)` for the pieces of the sides of a face.
    template <class Visit>
    void for_sides(std::uint32_t f, const Visit& visit) const {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t p = faces_[f][i], q = faces_[f][(i + 1) % 3];
            const auto way = way_of_.find(name(p, q));
            if (way == way_of_.end()) {
                visit(p, q);
                continue;
            }
            numbers all = way->second;
            if (q < p) std::ranges::reverse(all);
            all.insert(all.begin(), p);
            all.push_back(q);
            for (std::size_t k = 0; k + 1 < all.size(); ++k) visit(all[k], all[k + 1]);
        }
    }

    /// The sides of all parts, straight where they may be, and with crossings.
    void find_rims() {
        std::vector<std::vector<rim_side>> rims;
        std::vector<std::uint8_t> may;
        for (const flat_part& part : parts_) {
            std::vector<rim_side> all;
            for (const std::uint32_t f : part.faces)
                for_sides(f, [&](std::uint32_t p, std::uint32_t q) { all.push_back({p, q}); });
            rims.push_back(without_opposites(all));
            may.push_back(part.is_straight ? 1 : 0);
        }
        std::vector<std::uint8_t> stays(is_held_);
        stays.resize(exact_.given.size(), 0);
        straighten(rims, exact_.given, std::move(stays), may, options_.reach);
        for (std::size_t p = 0; p < parts_.size(); ++p) parts_[p].rim = with_crossings(rims[p]);
    }

    [[nodiscard]] std::vector<rim_side> with_crossings(const std::vector<rim_side>& rim) const {
        std::vector<rim_side> all, open(rim);
        while (!open.empty()) {
            const auto [p, q] = open.back();
            open.pop_back();
            const auto crossing = crossing_of_.find(name(p, q));
            if (crossing == crossing_of_.end()) {
                all.push_back({p, q});
            } else {
                open.push_back({p, crossing->second});
                open.push_back({crossing->second, q});
            }
        }
        return without_opposites(all);
    }

    /// Whether a side is, or becomes by crossings, one with `of` among its pieces.
    [[nodiscard]] bool leads_to(std::uint32_t p, std::uint32_t q, const rim_side& of) const {
        if (name(p, q) == name(of[0], of[1])) return true;
        const auto crossing = crossing_of_.find(name(p, q));
        return crossing != crossing_of_.end() &&
               (leads_to(p, crossing->second, of) || leads_to(crossing->second, q, of));
    }

    /// Faces that stay, but have this edge, are parts by themselves from now on.
    void loosen(const rim_side& s) {
        if (s[0] >= stars_->size() || !is_held(s[0], s[1])) return;
        for (const std::uint32_t f : (*stars_)[s[0]])
            if (is_fixed(f) && std::ranges::find(faces_[f], s[1]) != faces_[f].end()) {
                add_part(f);
                parts_.back().is_straight = false;
                is_grown_ = true;
            }
    }

    /// Gives both sides a point where they pass each other; false when they are too far apart.
    bool add_crossing(const rim_side& s, const rim_side& t) {
        const std::optional<edge_gap> gap = gap_between({at(s[0]), at(s[1])}, {at(t[0]), at(t[1])});
        if (!gap || gap->length > options_.reach) return false;
        const auto put = [&](const rim_side& e, std::uint32_t p) {
            loosen(e);
            if (is_held(e[0], e[1]) || leads_to(e[0], p, e) || leads_to(p, e[1], e)) return false;
            crossing_of_[name(e[0], e[1])] = p;
            return is_grown_ = true;
        };
        const auto is_at = [&](std::uint32_t p) {
            const point3 to = base::minus(at(p), gap->middle);
            return base::dot(to, to) <= options_.reach * options_.reach;
        };
        for (const std::uint32_t p : s)
            if (is_at(p)) return p != t[0] && p != t[1] && put(t, p);
        for (const std::uint32_t p : t)
            if (is_at(p)) return p != s[0] && p != s[1] && put(s, p);
        loosen(s);
        loosen(t);
        if (is_held(s[0], s[1]) || is_held(t[0], t[1])) return false;
        const auto made = static_cast<std::uint32_t>(exact_.given.size());
        exact_.given.push_back(gap->middle);
        put(s, made);
        put(t, made);
        return true;
    }

    /// False where parts could not be made, or others have to be made once more for them.
    bool make_parts() {
        find_rims();
        is_grown_ = false;
        numbers failed;
        for (std::uint32_t p = 0; p < parts_.size(); ++p)
            if (!make(parts_[p])) failed.push_back(p);
        for (const std::uint32_t p : failed) expect_less(parts_[p]);
        return failed.empty() && !is_grown_;
    }

    /// Of a part that could not be made, the rim will stay; else it falls apart into its faces; a
    /// face keeps its edges as they were.
    void expect_less(flat_part& part) {
        if (part.is_straight) {
            part.is_straight = false;
            return;
        }
        if (part.faces.size() > 1 && !falls_apart_) {
            wanted_.insert(wanted_.end(), part.faces.begin(), part.faces.end());
            return;
        }
        for (std::size_t i = 1; i < part.faces.size(); ++i) {
            add_part(part.faces[i]);
            parts_.back().is_straight = false;
        }
        if (part.faces.size() > 1) {
            part.faces.erase(part.faces.begin() + 1, part.faces.end());
            return;
        }
        for (const rim_side& s : part.rim) crossing_of_.erase(name(s[0], s[1]));
        const face& f = faces_[part.faces[0]];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint64_t edge = name(f[i], f[(i + 1) % 3]);
            way_of_.erase(edge);
            crossing_of_.erase(edge);
            blocked_.insert(edge);
        }
    }

    /// Whether the rim is that of triangles.
    bool make(flat_part& part) {
        if (part.rim == part.made_of) return true;
        part.made_of.clear();
        for (int i = 0; i < most_crossings; ++i) {
            try {
                part.made = triangles(part);
            } catch (const sides_cross& found) {
                if (!add_crossing(part.rim[found.a], part.rim[found.b])) return false;
                part.rim = with_crossings(part.rim);
                continue;
            } catch (const rim_fault&) {
                return false;
            }
            std::vector<rim_side> sides;
            for (const face& f : part.made)
                for (std::size_t k = 0; k < 3; ++k) sides.push_back({f[k], f[(k + 1) % 3]});
            if (without_opposites(sides) != part.rim) return false;
            part.made_of = part.rim;
            return true;
        }
        return false;
    }

    [[nodiscard]] std::vector<face> triangles(const flat_part& part) const {
        if (part.rim.empty()) return {};
        const face& seed = faces_[part.faces[0]];
        if (part.faces.size() == 1 &&
            part.rim ==
                without_opposites({{seed[0], seed[1]}, {seed[1], seed[2]}, {seed[2], seed[0]}}))
            return {seed};
        flat_region region{.first_face = part.faces[0], .plane = seed};
        for (const auto& [from, to] : part.rim) {
            region.points.push_back(from);
            region.points.push_back(to);
            region.rim.push_back({from, to, flat_region::no_line});
        }
        return triangles_of(exact_, region);
    }

    [[nodiscard]] flattened collect() const {
        flattened result;
        result.points = exact_.given;
        std::vector<face> made;
        numbers of;
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            if (is_fixed(f)) {
                result.faces.push_back(faces_[f]);
                result.face_of.push_back(f);
                result.is_new.push_back(0);
                continue;
            }
            if (part_of_[f] == nothing || parts_[part_of_[f]].faces[0] != f) continue;
            const flat_part& part = parts_[part_of_[f]];
            const numbers sources = sources_of(part);
            made.insert(made.end(), part.made.begin(), part.made.end());
            of.insert(of.end(), sources.begin(), sources.end());
        }
        const std::vector<std::uint8_t> gone = cancelled_faces(made, true);
        for (std::size_t i = 0; i < made.size(); ++i) {
            if (gone[i] != 0) continue;
            result.faces.push_back(made[i]);
            result.face_of.push_back(of[i]);
            result.is_new.push_back(made[i] != exact_.faces[of[i]] ? 1 : 0);
        }
        return result;
    }

    /// For each face made, the one of the part that its middle is next to.
    [[nodiscard]] numbers sources_of(const flat_part& part) const {
        numbers sources(part.made.size(), part.faces[0]);
        if (part.faces.size() == 1) return sources;
        const dynamic_tree<3> tree(part.faces, [&](std::uint32_t f) {
            aabb<double, 3> box;
            for (const std::uint32_t p : exact_.faces[f]) box.include(at(p));
            return box;
        });
        for (std::size_t i = 0; i < sources.size(); ++i) {
            const auto& [a, b, c] = base::triangle_of(points_view(exact_.given), part.made[i]);
            const point3 middle = base::scaled(base::plus(a, base::plus(b, c)), 1.0 / 3.0);
            double least = std::numeric_limits<double>::infinity();
            search(tree, around(middle, middle), [&](std::uint32_t n) {
                const double away = closest_point(base::triangle_of(points_view(exact_.given),
                                                                    exact_.faces[part.faces[n]]),
                                                  middle)
                                        .squared_distance;
                if (away > least || (away == least && part.faces[n] > sources[i])) return;
                least = away;
                sources[i] = part.faces[n];
            });
        }
        return sources;
    }

    flatten_options options_;
    std::vector<face> faces_;
    numbers begin_at_{};                 ///< faces at corners of those that meet, ascending
    exact_surface exact_{};              ///< as given, then with points where rims cross
    std::vector<std::uint8_t> fixed_{};  ///< [F] 1 for faces that stay
    std::optional<base::stars> stars_{};
    std::vector<std::uint8_t> is_held_{};        ///< [V] by faces that stay
    std::set<std::uint64_t> blocked_{};          ///< edges that would not split
    std::map<std::uint64_t, numbers> way_of_{};  ///< what is on edges, from their lower ends
    std::map<std::uint64_t, std::uint32_t> crossing_of_{};  ///< sides of rims
    std::deque<flat_part> parts_{};                         ///< stay where they are
    numbers part_of_{};                                     ///< of each face, or none
    bool falls_apart_;
    numbers wanted_{};       ///< faces to begin at, too
    bool is_grown_ = false;  ///< there are crossings, or parts, that rims do not know yet
};

}  // namespace

std::optional<flattened> flatten(mesh_view surface, std::span<const face_pair> meeting,
                                 const flatten_options& options) {
    numbers begin_at;
    for (const face_pair& pair : meeting) begin_at.insert(begin_at.end(), {pair.a, pair.b});
    for (int i = 1;; ++i) {
        flattening attempt(surface, begin_at, options, i == most_widenings);
        std::optional<flattened> result = attempt.run();
        if (attempt.wanted().empty()) return result;
        begin_at.insert(begin_at.end(), attempt.wanted().begin(), attempt.wanted().end());
    }
}

}  // namespace treeform::detail::round
