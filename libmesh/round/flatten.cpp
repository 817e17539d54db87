#include <libmesh/base/point_math.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/round/flatten.hpp>
#include <libmesh/round/near_edges.hpp>
#include <libmesh/round/region_triangles.hpp>
#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

namespace treeform::detail::round {
namespace {

constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();
constexpr int most_attempts = 20, most_crossings = 100;

using numbers = std::vector<std::uint32_t>;
using side = std::array<std::uint32_t, 2>;  ///< from and to

/// Connected faces near one plane, and what comes in their place.
struct flat_part {
    numbers faces{};  ///< the first is the largest
    bool is_straight = true;
    std::vector<side> rim{};
    std::vector<face> made{};
};

/// What runs along an edge: the parts on its left and right, as seen from the lower end.
struct rim_edge {
    side ends;
    std::uint32_t left, right;  ///< or `nothing`, where it is not the same one part on each side
};

class flattening {
  public:
    flattening(mesh_view surface, std::span<const std::uint32_t> begin_at,
               const flatten_options& options)
        : options_(options),
          given_(surface.faces),
          faces_(surface.faces.begin(), surface.faces.end()),
          begin_at_(begin_at) {
        exact_.given.assign(surface.points.begin(), surface.points.end());
    }

    std::optional<flattened> run() {
        join_points();
        find_edges();
        split_edges();
        grow_parts();
        for (int i = 0; i < most_attempts; ++i) {
            const bool all = make_parts();
            if (getenv("TRACE")) { size_t st=0; for (auto& q:parts_) st+=q.is_straight; fprintf(stderr,"[%zu parts %zu straight %zu loose all %d]",parts_.size(),st,loose_.size(),all); }
            if (all) return collect();
        }
        return std::nullopt;
    }

  private:
    [[nodiscard]] bool is_fixed(std::uint32_t f) const {
        return !options_.fixed.empty() && options_.fixed[f] != 0;
    }
    [[nodiscard]] bool is_there(std::uint32_t f) const {
        return base::has_three_corners(faces_[f]);
    }
    [[nodiscard]] const point3& at(std::uint32_t p) const { return exact_.given[p]; }
    [[nodiscard]] double distance(std::uint32_t p, std::uint32_t q) const {
        const point3 way = base::minus(at(p), at(q));
        return std::sqrt(base::dot(way, way));
    }
    [[nodiscard]] point3 normal(std::uint32_t f) const {
        const auto& [a, b, c] = base::triangle_of(points_view(exact_.given), faces_[f]);
        return base::cross(base::minus(b, a), base::minus(c, a));
    }
    [[nodiscard]] aabb<double, 3> around(std::uint32_t p, std::uint32_t q) const {
        aabb<double, 3> box;
        box.include(at(p));
        box.include(at(q));
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] -= options_.reach;
            box.max[k] += options_.reach;
        }
        return box;
    }

    /// Corners of the faces to begin at that are within reach of each other become one: that of a
    /// face that stays, or the lowest.
    void join_points() {
        is_held_.assign(exact_.given.size(), 0);
        numbers near;
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            if (is_fixed(f))
                for (const std::uint32_t p : faces_[f]) is_held_[p] = 1;
        for (const std::uint32_t f : begin_at_)
            near.insert(near.end(), faces_[f].begin(), faces_[f].end());
        std::ranges::sort(near);
        near.erase(std::unique(near.begin(), near.end()), near.end());
        const dynamic_tree<3> tree(near, [&](std::uint32_t p) {
            aabb<double, 3> box;
            box.include(at(p));
            return box;
        });
        std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> pairs;
        for (const std::uint32_t p : near)
            search(tree, around(p, p), [&](std::uint32_t i) {
                const std::uint32_t q = near[i];
                if (p < q && distance(p, q) <= options_.reach)
                    pairs.emplace_back(distance(p, q), p, q);
            });
        std::ranges::sort(pairs);
        now_ = base::numbers_below(exact_.given.size());
        const auto root = [&](std::uint32_t p) {
            while (now_[p] != p) p = now_[p] = now_[now_[p]];
            return p;
        };
        for (const auto& [length, p, q] : pairs) {
            std::uint32_t a = root(p), b = root(q);
            if (a == b || distance(a, b) > options_.reach ||
                (is_held_[a] != 0 && is_held_[b] != 0))
                continue;
            if (is_held_[b] != 0 || (is_held_[a] == 0 && b < a)) std::swap(a, b);
            now_[b] = a;
        }
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            if (is_fixed(f)) continue;
            for (std::uint32_t& p : faces_[f]) p = root(p);
            if (is_there(f)) loose_.push_back(f);
        }
        std::erase_if(near, [&](std::uint32_t p) { return root(p) != p; });
        near_ = std::move(near);
    }

    [[nodiscard]] static std::uint64_t name(std::uint32_t p, std::uint32_t q) {
        return std::uint64_t{std::min(p, q)} << 32U | std::max(p, q);
    }

    /// Of loose faces: what is across each side, and which edges faces that stay have, too.
    void find_edges() {
        neighbor_.assign(faces_.size(), {nothing, nothing, nothing});
        near_edges(mesh_view{exact_.given, faces_}, loose_)
            .for_each([&](std::span<const near_edges::use> uses) {
                if (uses.size() != 2 || uses[0].way == uses[1].way) return;
                const std::uint32_t f = loose_[uses[0].place], g = loose_[uses[1].place];
                neighbor_[f][side_at(f, uses[0].edge)] = g;
                neighbor_[g][side_at(g, uses[0].edge)] = f;
            });
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            for (std::size_t i = 0; is_fixed(f) && i < 3; ++i)
                held_edges_.insert(name(faces_[f][i], faces_[f][(i + 1) % 3]));
    }

    [[nodiscard]] std::size_t side_at(std::uint32_t f, std::uint64_t edge) const {
        const face& c = faces_[f];
        return name(c[0], c[1]) == edge ? 0 : name(c[1], c[2]) == edge ? 1 : 2;
    }

    /// Each edge gets the points that are within reach of it.
    void split_edges() {
        const dynamic_tree<3> tree(near_, [&](std::uint32_t p) {
            aabb<double, 3> box;
            box.include(at(p));
            return box;
        });
        for (const std::uint32_t f : begin_at_)
            for (std::size_t i = 0; i < 3 && is_there(f) && !is_fixed(f); ++i) {
                const std::uint32_t p = std::min(faces_[f][i], faces_[f][(i + 1) % 3]),
                                    q = std::max(faces_[f][i], faces_[f][(i + 1) % 3]);
                if (held_edges_.contains(name(p, q))) continue;
                const auto [way, is_first] = way_of_.try_emplace(name(p, q));
                if (!is_first) continue;
                const point3 along = base::minus(at(q), at(p));
                std::vector<std::pair<double, std::uint32_t>> on;
                search(tree, around(p, q), [&](std::uint32_t n) {
                    const std::uint32_t r = near_[n];
                    if (r == p || r == q || off(r, p, q) > options_.reach) return;
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
        part_of_.assign(faces_.size(), nothing);
        for (const auto& [square, f] : seeds)
            if (part_of_[f] == nothing && square < 0.0) grow(f, std::sqrt(-square));
        for (const std::uint32_t f : loose_)
            if (part_of_[f] == nothing) add_part(f);
    }

    void add_part(std::uint32_t f) {
        part_of_[f] = static_cast<std::uint32_t>(parts_.size());
        parts_.push_back({.faces = {f}});
    }

    void grow(std::uint32_t seed, double length) {
        const point3 unit = base::scaled(normal(seed), 1.0 / length);
        const point3 origin = at(faces_[seed][0]);
        const auto is_near = [&](std::uint32_t p) {
            return std::abs(base::dot(base::minus(at(p), origin), unit)) <= options_.reach;
        };
        const auto number = static_cast<std::uint32_t>(parts_.size());
        add_part(seed);
        numbers& faces = parts_.back().faces;
        for (std::size_t i = 0; i < faces.size(); ++i)
            for (const std::uint32_t g : neighbor_[faces[i]]) {
                if (g == nothing || part_of_[g] != nothing) continue;
                if (!std::ranges::all_of(faces_[g], is_near)) continue;
                part_of_[g] = number;
                faces.push_back(g);
            }
    }

    [[nodiscard]] double off(std::uint32_t p, std::uint32_t a, std::uint32_t b) const {
        const point3 way = base::minus(at(b), at(a)),
                     to = base::minus(at(p), at(a));
        const double square = base::dot(way, way);
        const double along =
            square > 0.0 ? std::clamp(base::dot(to, way) / square, 0.0, 1.0) : 0.0;
        const point3 rest = base::minus(to, base::scaled(way, along));
        return std::sqrt(base::dot(rest, rest));
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

    /// The sides of all parts, without those that run back and forth.
    void find_rims() {
        for (flat_part& part : parts_) {
            std::vector<side> all;
            for (const std::uint32_t f : part.faces)
                for_sides(f, [&](std::uint32_t p, std::uint32_t q) { all.push_back({p, q}); });
            std::ranges::sort(all);
            part.rim = without_opposites(all);
        }
    }

    [[nodiscard]] static std::vector<side> without_opposites(const std::vector<side>& sorted) {
        std::vector<side> left;
        for (std::size_t i = 0, next = 0; i < sorted.size(); i = next) {
            next = i;
            while (next < sorted.size() && sorted[next] == sorted[i]) ++next;
            const auto [first, last] =
                std::ranges::equal_range(sorted, side{sorted[i][1], sorted[i][0]});
            const auto back = static_cast<std::size_t>(last - first);
            for (std::size_t k = back; k < next - i; ++k) left.push_back(sorted[i]);
        }
        return left;
    }

    /// Points on a straight way between two parts, and nothing else, go.
    void straighten_rims() {
        std::vector<std::pair<side, std::uint32_t>> all;
        for (std::uint32_t p = 0; p < parts_.size(); ++p)
            for (const side& s : parts_[p].rim) all.emplace_back(s, p);
        std::ranges::sort(all);
        const auto parts_at = [&](const side& s) {
            return std::ranges::equal_range(all, s, {}, &std::pair<side, std::uint32_t>::first);
        };
        std::vector<rim_edge> edges;
        std::vector<std::uint8_t> stays(is_held_);
        for (const auto& [ends, part] : all) {
            const auto mine = parts_at(ends), others = parts_at({ends[1], ends[0]});
            if (mine.size() == 1 && others.size() == 1 && parts_[part].is_straight &&
                parts_[others.front().second].is_straight)
                edges.push_back({ends, part, others.front().second});
            else
                stays[ends[0]] = stays[ends[1]] = 1;
        }
        const auto edges_at = [&](std::uint32_t p) {
            return std::ranges::equal_range(edges, p, {},
                                            [](const rim_edge& e) { return e.ends[0]; });
        };
        for (const rim_edge& e : edges) {
            const auto here = edges_at(e.ends[0]);
            if (here.size() != 2 || here[0].left != here[1].right || here[0].right != here[1].left)
                stays[e.ends[0]] = 1;
        }
        for (flat_part& part : parts_)
            std::erase_if(part.rim, [&](const side& s) {
                const auto here = edges_at(s[0]);
                return std::ranges::any_of(here, [&](const rim_edge& e) { return e.ends == s; });
            });
        std::vector<std::uint8_t> seen(edges.size(), 0);
        const auto walk = [&](const rim_edge& start) {
            numbers way{start.ends[0]};
            for (const rim_edge* e = &start;;) {
                const auto i = static_cast<std::size_t>(e - edges.data());
                if (seen[i] != 0) break;
                seen[i] = 1;
                const std::uint32_t to = e->ends[1];
                way.push_back(to);
                const auto here = edges_at(to);
                for (const rim_edge& back : here)
                    if (back.ends[1] == e->ends[0])
                        seen[static_cast<std::size_t>(&back - edges.data())] = 1;
                if (stays[to] != 0) break;
                e = here[0].left == start.left ? &here[0] : &here[1];
            }
            way = simplified(way);
            for (std::size_t k = 0; k + 1 < way.size(); ++k) {
                parts_[start.left].rim.push_back({way[k], way[k + 1]});
                parts_[start.right].rim.push_back({way[k + 1], way[k]});
            }
        };
        for (const rim_edge& e : edges)
            if (seen[static_cast<std::size_t>(&e - edges.data())] == 0 && stays[e.ends[0]] != 0)
                walk(e);
        for (const rim_edge& e : edges)
            if (seen[static_cast<std::size_t>(&e - edges.data())] == 0) walk(e);
        for (flat_part& part : parts_) {
            part.rim = with_crossings(part.rim);
        }
    }

    [[nodiscard]] std::vector<side> with_crossings(const std::vector<side>& rim) const {
        std::vector<side> all, open(rim);
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
        std::ranges::sort(all);
        return without_opposites(all);
    }

    /// Gives both sides a point where they pass each other; false when they are too far apart.
    bool add_crossing(const side& s, const side& t) {
        const point3 a = at(s[0]), c = at(t[0]);
        const point3 u = base::minus(at(s[1]), a), v = base::minus(at(t[1]), c),
                     w = base::minus(c, a);
        const point3 n = base::cross(u, v);
        const double square = base::dot(n, n);
        if (!(square > 0.0)) return false;
        const point3 x = base::plus(a, base::scaled(u, base::dot(base::cross(w, v), n) / square));
        const point3 y = base::plus(c, base::scaled(v, base::dot(base::cross(w, u), n) / square));
        const point3 way = base::minus(x, y);
        if (getenv("TRACE2")) fprintf(stderr,"cross %u-%u %u-%u gap %g sq %g held %d %d lens %g %g\n",s[0],s[1],t[0],t[1],std::sqrt(base::dot(way,way)),square,held_edges_.contains(name(s[0],s[1])),held_edges_.contains(name(t[0],t[1])),distance(s[0],s[1]),distance(t[0],t[1]));
        if (!(base::dot(way, way) <= options_.reach * options_.reach)) return false;
        for (const side& e : {s, t})
            if (held_edges_.contains(name(e[0], e[1]))) return false;
        const auto made = static_cast<std::uint32_t>(exact_.given.size());
        exact_.given.push_back(base::scaled(base::plus(x, y), 0.5));
        for (const side& e : {s, t}) crossing_of_[name(e[0], e[1])] = made;
        return true;
    }

    /// \source Douglas and Peucker, The Canadian Cartographer 10 (1973)
    [[nodiscard]] numbers simplified(const numbers& all) const {
        std::vector<std::uint8_t> keep(all.size(), 0);
        keep.front() = keep.back() = 1;
        std::vector<std::pair<std::size_t, std::size_t>> open{{0, all.size() - 1}};
        while (!open.empty()) {
            const auto [begin, end] = open.back();
            open.pop_back();
            std::size_t furthest = begin;
            double most = options_.reach;
            for (std::size_t i = begin + 1; i < end; ++i)
                if (const double d = off(all[i], all[begin], all[end]); d > most) {
                    most = d;
                    furthest = i;
                }
            if (furthest == begin) continue;
            keep[furthest] = 1;
            open.emplace_back(begin, furthest);
            open.emplace_back(furthest, end);
        }
        numbers kept;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (keep[i] != 0) kept.push_back(all[i]);
        return all.front() == all.back() && kept.size() < 4 ? all : kept;
    }

    /// False where parts could not be made, so that more of their rims, or all of their faces, will
    /// stay.
    bool make_parts() {
        find_rims();
        straighten_rims();
        const std::size_t crossings = crossing_of_.size();
        numbers failed;
        for (std::uint32_t p = 0; p < parts_.size(); ++p)
            if (!make(parts_[p])) failed.push_back(p);
        for (const std::uint32_t p : failed) {
            if (getenv("TRACE2")) { fprintf(stderr,"FAIL part %u faces %zu straight %d rim %zu\n",p,parts_[p].faces.size(),parts_[p].is_straight,parts_[p].rim.size());
              if (parts_[p].rim.size()<40) for (auto& s: parts_[p].rim) fprintf(stderr,"   %u %u  %.17g %.17g %.17g\n",s[0],s[1],at(s[0]).x,at(s[0]).y,at(s[0]).z); }
            if (parts_[p].is_straight) {
                parts_[p].is_straight = false;
                continue;
            }
            const numbers faces = std::move(parts_[p].faces);
            if (faces.size() == 1) {
                for (const side& s : parts_[p].rim) crossing_of_.erase(name(s[0], s[1]));
                for (std::size_t i = 0; i < 3; ++i) {
                    const std::uint64_t edge =
                        name(faces_[faces[0]][i], faces_[faces[0]][(i + 1) % 3]);
                    way_of_.erase(edge);
                    crossing_of_.erase(edge);
                    held_edges_.insert(edge);
                }
                parts_[p].faces = faces;
                continue;
            }
            parts_[p].faces = {faces[0]};
            for (std::size_t i = 1; i < faces.size(); ++i) {
                add_part(faces[i]);
                parts_.back().is_straight = false;
            }
        }
        return failed.empty() && crossing_of_.size() == crossings;
    }

    /// Whether the rim is that of triangles.
    bool make(flat_part& part) {
        part.made.clear();
        if (part.rim.empty()) return true;
        const face& seed = faces_[part.faces[0]];
        if (part.rim.size() == 3 && part.faces.size() == 1 && part.rim[0][0] != part.rim[1][0]) {
            face sorted = seed;
            std::ranges::sort(sorted);
            if (part.rim[0][0] == sorted[0] && part.rim[1][0] == sorted[1] &&
                part.rim[2][0] == sorted[2]) {
                part.made = {seed};
                return true;
            }
        }
        for (int i = 0;; ++i) {
            flat_region region{.first_face = part.faces[0], .plane = seed};
            for (const auto& [from, to] : part.rim) {
                region.points.push_back(from);
                region.points.push_back(to);
                region.rim.push_back({from, to, flat_region::no_line});
            }
            try {
                part.made = triangles_of(exact_, region);
                break;
            } catch (const sides_cross& found) {
                if (i == most_crossings || !add_crossing(part.rim[found.a], part.rim[found.b]))
                    return false;
                part.rim = with_crossings(part.rim);
                if (part.rim.empty()) return true;
            } catch (const std::logic_error& e) {
                if (getenv("TRACE2")) fprintf(stderr,"why: %s\n",e.what());
                return false;
            }
        }
        std::vector<side> sides;
        for (const face& f : part.made)
            for (std::size_t i = 0; i < 3; ++i) sides.push_back({f[i], f[(i + 1) % 3]});
        std::ranges::sort(sides);
        if (getenv("TRACE2") && without_opposites(sides) != part.rim) fprintf(stderr,"why: rim differs\n");
        return without_opposites(sides) == part.rim;
    }

    [[nodiscard]] flattened collect() const {
        flattened result;
        result.points = exact_.given;
        const auto put = [&](const face& corners, std::uint32_t of, bool is_new) {
            result.faces.push_back(corners);
            result.face_of.push_back(of);
            result.is_new.push_back(is_new ? 1 : 0);
        };
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            if (is_fixed(f)) {
                put(faces_[f], f, false);
                continue;
            }
            if (part_of_[f] == nothing) continue;
            const flat_part& part = parts_[part_of_[f]];
            if (f != part.faces.front()) continue;
            ++result.parts;
            for (const face& made : part.made) put(made, f, made != given_[f]);
        }
        return result;
    }

    flatten_options options_;
    std::span<const face> given_;
    std::vector<face> faces_;
    std::span<const std::uint32_t> begin_at_;
    exact_surface exact_{};  ///< the points alone
    numbers now_{};          ///< [V] what each point has become
    numbers near_{};         ///< points that edges may get, ascending
    numbers loose_{};        ///< faces that may change, ascending
    std::vector<std::uint8_t> is_held_{};  ///< [V] by faces that stay
    std::set<std::uint64_t> held_edges_{};
    std::map<std::uint64_t, numbers> way_of_{};  ///< what is on edges, from their lower ends
    std::map<std::uint64_t, std::uint32_t> crossing_of_{};  ///< sides of rims
    std::vector<std::array<std::uint32_t, 3>> neighbor_{};
    std::vector<flat_part> parts_{};
    numbers part_of_{};  ///< of each face, or none
};

}  // namespace

std::optional<flattened> flatten(mesh_view surface, std::span<const std::uint32_t> begin_at,
                                 const flatten_options& options) {
    return flattening(surface, begin_at, options).run();
}

}  // namespace treeform::detail::round
