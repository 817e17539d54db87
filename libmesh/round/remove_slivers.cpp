#include <libmesh/base/point_math.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/intersect/classify_pair.hpp>
#include <libmesh/round/cancelled_faces.hpp>
#include <libmesh/round/edge_gap.hpp>
#include <libmesh/round/remove_slivers.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace treeform::detail::round {
namespace {

using ids = std::vector<std::uint32_t>;

constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();

/// Changes that help nothing but those that follow. Few are enough: what they do not open is cut.
constexpr int most_sideways = 100;

/// `point` becomes the corner `at`; or the edge, or the face, between these gets it; or the edge is
/// turned, to the one from `point` to `across`.
struct sliver_change {
    double size = 0.0;  ///< of what goes
    std::uint32_t point = 0;
    std::array<std::uint32_t, 3> at{no_point, no_point, no_point};  ///< ascending
    std::uint32_t across = no_point;

    friend bool operator<(const sliver_change& a, const sliver_change& b) {
        return std::tie(a.size, a.point, a.at, a.across) <
               std::tie(b.size, b.point, b.at, b.across);
    }
};

/// What a change makes of a face.
struct face_piece {
    face corners;
    std::uint32_t of;
    ids meets{};  ///< faces that the change leaves alone
};

class sliver_removal {
  public:
    sliver_removal(mesh_view surface, std::span<const face_pair> meeting,
                   const sliver_limits& limits)
        : points_(surface.points),
          limits_(limits),
          faces_(surface.faces.begin(), surface.faces.end()),
          source_(faces_.size()),
          is_new_(faces_.size(), 0),
          given_stars_(points_.size(), surface.faces),
          tree_(faces_, [&](const face& f) { return box_of(f); }) {
        std::iota(source_.begin(), source_.end(), 0U);
        ids bad;
        for (const face_pair& pair : meeting) {
            bad.insert(bad.end(), {pair.a, pair.b});
            if (pair.a == pair.b) continue;
            meets_[pair.a].push_back(pair.b);
            meets_[pair.b].push_back(pair.a);
        }
        std::ranges::sort(bad);
        bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
        for (const std::uint32_t f : bad) line_up(f);
    }

    slivers_removed run() {
        while (!next_.empty() && visits_ < limits_.visits) {
            const auto [size, f] = next_.top();
            next_.pop();
            if (!tree_.contains(f) || !is_bad(f)) continue;
            const std::vector<sliver_change> changes = changes_of(f);
            const auto helps = [&](const sliver_change& c) { return try_change(c, false); };
            if (std::ranges::any_of(changes, helps) || sideways_ == 0 || !meets_.contains(f))
                continue;
            const auto is_no_worse = [&](const sliver_change& c) {
                return c.at[1] != no_point && c.across == no_point && try_change(c, true);
            };
            if (std::ranges::any_of(changes, is_no_worse)) --sideways_;
        }
        slivers_removed result;
        result.changes = changes_;
        result.moved = moved_;
        result.visits = visits_;
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            if (!tree_.contains(f)) continue;
            result.faces.push_back(faces_[f]);
            result.face_of.push_back(source_[f]);
            result.is_new.push_back(is_new_[f]);
        }
        return result;
    }

  private:
    [[nodiscard]] const point3& at(std::uint32_t p) const { return points_[p]; }

    [[nodiscard]] aabb<double, 3> box_of(const face& f) const {
        aabb<double, 3> box;
        for (const std::uint32_t p : f) box.include(at(p));
        return box;
    }

    [[nodiscard]] double distance(std::uint32_t p, std::uint32_t q) const {
        const point3 way = base::minus(at(p), at(q));
        return std::sqrt(base::dot(way, way));
    }

    /// How far `p` is above the edge from `a` to `b`; infinite where it is not above it.
    [[nodiscard]] double height(std::uint32_t p, std::uint32_t a, std::uint32_t b) const {
        const point3 way = base::minus(at(b), at(a)), to = base::minus(at(p), at(a));
        const double square = base::dot(way, way), along = base::dot(to, way);
        if (!(along > 0.0 && along < square)) return std::numeric_limits<double>::infinity();
        const point3 off = base::minus(to, base::scaled(way, along / square));
        return std::sqrt(base::dot(off, off));
    }

    /// The same above a face.
    [[nodiscard]] double height(std::uint32_t p, const face& f) const {
        const point3 u = base::minus(at(f[1]), at(f[0])), v = base::minus(at(f[2]), at(f[0])),
                     to = base::minus(at(p), at(f[0]));
        const point3 normal = base::cross(u, v);
        const double square = base::dot(normal, normal);
        const double along_u = base::dot(base::cross(to, v), normal),
                     along_v = base::dot(base::cross(u, to), normal);
        if (!(along_u > 0.0 && along_v > 0.0 && along_u + along_v < square))
            return std::numeric_limits<double>::infinity();
        return std::abs(base::dot(to, normal)) / std::sqrt(square);
    }

    [[nodiscard]] bool is_thin(const face& f) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (distance(f[i], f[(i + 1) % 3]) < limits_.thin ||
                height(f[i], f[(i + 1) % 3], f[(i + 2) % 3]) < limits_.thin)
                return true;
        return collinear(at(f[0]), at(f[1]), at(f[2]));
    }

    [[nodiscard]] bool is_fixed(std::uint32_t f) const {
        return f < limits_.fixed.size() && limits_.fixed[f] != 0;
    }

    [[nodiscard]] bool is_bad(std::uint32_t f) const {
        return meets_.contains(f) || is_thin(faces_[f]);
    }

    /// Those that bring the corners of a face to what it is near: to each other and its edges, and
    /// to faces that it meets; and the corners of these to the face.
    [[nodiscard]] std::vector<sliver_change> changes_of(std::uint32_t f) {
        std::vector<sliver_change> changes;
        add_changes(f, f, changes);
        add_turns(f, changes);
        const auto met = meets_.find(f);
        if (met != meets_.end()) {
            visits_ += met->second.size();
            for (const std::uint32_t g : met->second) {
                add_changes(f, g, changes);
                add_changes(g, f, changes);
            }
        }
        std::sort(changes.begin(), changes.end());
        return changes;
    }

    /// Edges of two faces that all but lie in one plane.
    void add_turns(std::uint32_t f, std::vector<sliver_change>& changes) const {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t p = faces_[f][i], q = faces_[f][(i + 1) % 3],
                                r = faces_[f][(i + 2) % 3];
            const ids both = faces_between(p, q);
            if (both.size() != 2) continue;
            const face& g = faces_[both[0] == f ? both[1] : both[0]];
            const std::uint32_t s = opposite(g, p, q);
            const double gap = distance_of_diagonals(p, q, r, s);
            if (s != r && gap <= limits_.reach)
                changes.push_back({gap,
                                   std::min(r, s),
                                   {std::min(p, q), std::max(p, q), no_point},
                                   std::max(r, s)});
        }
    }

    [[nodiscard]] static std::uint32_t opposite(const face& f, std::uint32_t p, std::uint32_t q) {
        return *std::ranges::find_if(f, [&](std::uint32_t c) { return c != p && c != q; });
    }

    [[nodiscard]] ids faces_between(std::uint32_t p, std::uint32_t q) const {
        ids faces;
        std::ranges::set_intersection(star(p), star(q), std::back_inserter(faces));
        return faces;
    }

    /// Between the edges from p to q and from r to s where these pass each other; else infinite.
    [[nodiscard]] double distance_of_diagonals(std::uint32_t p, std::uint32_t q, std::uint32_t r,
                                               std::uint32_t s) const {
        const std::optional<edge_gap> gap = gap_between({at(p), at(q)}, {at(r), at(s)});
        return gap ? gap->length : std::numeric_limits<double>::infinity();
    }

    void add_changes(std::uint32_t from, std::uint32_t to,
                     std::vector<sliver_change>& changes) const {
        const face& f = faces_[to];
        for (const std::uint32_t p : faces_[from]) {
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t q = f[i], r = f[(i + 1) % 3];
                if (p == q) continue;
                const double edge = distance(p, q);
                if (edge <= limits_.reach) {
                    changes.push_back({edge, p, {q, no_point, no_point}});
                    changes.push_back({edge, q, {p, no_point, no_point}});
                }
                if (p == r) continue;
                const double rise = height(p, q, r);
                if (rise <= limits_.reach)
                    changes.push_back({rise, p, {std::min(q, r), std::max(q, r), no_point}});
            }
            if (has_corner(to, p)) continue;
            const double rise = height(p, f);
            if (!(rise <= limits_.reach)) continue;
            changes.push_back({rise, p, {f[0], f[1], f[2]}});
            std::ranges::sort(changes.back().at);
        }
    }

    void line_up(std::uint32_t f) {
        const auto changes = changes_of(f);
        if (!changes.empty()) next_.emplace(changes.front().size, f);
    }

    [[nodiscard]] bool has_corner(std::uint32_t f, std::uint32_t p) const {
        return std::ranges::find(faces_[f], p) != faces_[f].end();
    }

    [[nodiscard]] std::span<const std::uint32_t> star(std::uint32_t p) const {
        const auto changed = stars_.find(p);
        return changed == stars_.end() ? given_stars_[p] : std::span(changed->second);
    }

    /// The faces that a change is about, ascending.
    [[nodiscard]] ids faces_at(const sliver_change& change) const {
        const auto& [p, q, r] = change.at;
        ids faces;
        if (q == no_point)
            std::ranges::set_union(star(change.point), star(p), std::back_inserter(faces));
        else
            faces = faces_between(p, q);
        if (r != no_point)
            std::erase_if(faces, [&](std::uint32_t f) { return !has_corner(f, change.at[2]); });
        return faces;
    }

    [[nodiscard]] std::vector<face_piece> pieces_of(const sliver_change& change,
                                                    const ids& faces) const {
        std::vector<face_piece> pieces;
        const auto put = [&](std::uint32_t f, std::uint32_t corner, std::uint32_t to) {
            face corners = faces_[f];
            std::ranges::replace(corners, corner, to);
            if (base::has_three_corners(corners)) pieces.push_back({corners, f});
        };
        for (const std::uint32_t f : faces) {
            if (change.at[1] == no_point) {
                put(f, change.point, change.at[0]);
                continue;
            }
            if (change.across != no_point) {
                put(f, change.at[has_corner(f, change.point) ? 0 : 1],
                    has_corner(f, change.point) ? change.across : change.point);
                continue;
            }
            if (has_corner(f, change.point)) continue;
            for (const std::uint32_t corner : change.at)
                if (corner != no_point) put(f, corner, change.point);
        }
        std::vector<face> corners;
        for (const face_piece& piece : pieces) corners.push_back(piece.corners);
        const std::vector<std::uint8_t> gone = cancelled_faces(corners, limits_.solid);
        std::size_t i = 0;
        std::erase_if(pieces, [&](const face_piece&) { return gone[i++] != 0; });
        return pieces;
    }

    /// Pairs that meet, and thin faces, among and at faces that are there.
    [[nodiscard]] std::size_t count_bad(const ids& faces) const {
        std::size_t count = 0;
        for (const std::uint32_t f : faces) {
            count += is_thin(faces_[f]) ? 1 : 0;
            const auto met = meets_.find(f);
            if (met == meets_.end()) continue;
            for (const std::uint32_t g : met->second)
                count += f < g || !std::ranges::binary_search(faces, g) ? 1 : 0;
        }
        return count;
    }

    /// The same of pieces in their place, if that is less than `most`; else `most` or more.
    std::size_t find_bad(std::vector<face_piece>& pieces, const ids& replaced, std::size_t most) {
        std::size_t count = static_cast<std::size_t>(std::ranges::count_if(
            pieces, [&](const face_piece& piece) { return is_thin(piece.corners); }));
        for (std::size_t i = 0; i < pieces.size() && count < most; ++i) {
            const face& f = pieces[i].corners;
            for (std::size_t j = 0; j < i; ++j) count += meet(f, pieces[j].corners) ? 1 : 0;
            search(tree_, box_of(f), [&](std::uint32_t g) {
                if (count >= most || std::ranges::binary_search(replaced, g)) return;
                if (!meet(f, faces_[g])) return;
                ++count;
                pieces[i].meets.push_back(g);
            });
        }
        return count;
    }

    [[nodiscard]] bool meet(const face& f, const face& g) {
        ++visits_;
        return intersect::classify_pair(points_, f, g, counters_).has_value();
    }

    /// Makes the change if less is bad after it, or as much at most.
    bool try_change(const sliver_change& change, bool or_as_much) {
        ids faces = faces_at(change);
        std::vector<face_piece> pieces = pieces_of(change, faces);
        std::erase_if(pieces, [&](const face_piece& piece) {
            if (piece.corners != faces_[piece.of]) return false;
            faces.erase(std::ranges::lower_bound(faces, piece.of));  // nothing changes there
            return true;
        });
        if (std::ranges::any_of(faces, [&](std::uint32_t f) { return is_fixed(f); })) return false;
        const std::size_t before = count_bad(faces);
        const std::size_t most = before + (or_as_much ? 1 : 0);
        if (find_bad(pieces, faces, most) >= most) return false;
        ids around = take_out(faces);
        const ids put = put_in(pieces, faces);
        around.insert(around.end(), put.begin(), put.end());
        for (const std::uint32_t f : around)
            if (is_bad(f)) line_up(f);
        ++changes_;
        moved_ = std::max(moved_, change.size);
        return true;
    }

    /// Forgets what is known of faces. Those that one of them met.
    ids take_out(const ids& faces) {
        ids partners;
        for (const std::uint32_t f : faces) {
            for (const std::uint32_t p : faces_[f]) std::erase(own_star(p), f);
            const auto met = meets_.find(f);
            if (met == meets_.end()) continue;
            for (const std::uint32_t g : met->second) {
                const auto other = meets_.find(g);
                if (other == meets_.end()) continue;
                std::erase(other->second, f);
                if (other->second.empty()) meets_.erase(other);
                if (!std::ranges::binary_search(faces, g)) partners.push_back(g);
            }
            meets_.erase(f);
        }
        return partners;
    }

    ids& own_star(std::uint32_t p) {
        const auto [place, is_first] = stars_.try_emplace(p);
        if (is_first) place->second.assign(given_stars_[p].begin(), given_stars_[p].end());
        return place->second;
    }

    /// Pieces in the place of faces. Their numbers.
    ids put_in(const std::vector<face_piece>& pieces, const ids& faces) {
        const std::size_t same = std::min(pieces.size(), faces.size());
        ids numbers(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(same));
        std::vector<aabb<double, 3>> boxes;
        for (const face_piece& piece : pieces) boxes.push_back(box_of(piece.corners));
        const std::span all = boxes;
        const ids sources = sources_of(pieces, faces);
        tree_.move(numbers, all.first(same));
        tree_.remove(std::span(faces).subspan(same));
        for (const std::uint32_t f : tree_.insert(all.subspan(same))) numbers.push_back(f);
        faces_.resize(tree_.id_end());
        source_.resize(tree_.id_end());
        is_new_.resize(tree_.id_end());
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const std::uint32_t f = numbers[i];
            faces_[f] = pieces[i].corners;
            source_[f] = sources[i];
            is_new_[f] = 1;
            for (const std::uint32_t p : faces_[f]) {
                ids& star = own_star(p);
                star.insert(std::ranges::lower_bound(star, f), f);
            }
        }
        for (std::size_t i = 0; i < pieces.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (meet(pieces[i].corners, pieces[j].corners)) note(numbers[i], numbers[j]);
        for (std::size_t i = 0; i < pieces.size(); ++i)
            for (const std::uint32_t g : pieces[i].meets) note(numbers[i], g);
        return numbers;
    }

    /// That of the face in which the middle of each lies, or next to it.
    [[nodiscard]] ids sources_of(const std::vector<face_piece>& pieces, const ids& faces) const {
        ids sources;
        for (const face_piece& piece : pieces) {
            const auto& [a, b, c] = base::triangle_of(points_, piece.corners);
            const point3 middle = base::scaled(base::plus(a, base::plus(b, c)), 1.0 / 3.0);
            const auto away = [&](std::uint32_t f) {
                return closest_point(base::triangle_of(points_, faces_[f]), middle)
                    .squared_distance;
            };
            std::uint32_t nearest = piece.of;
            for (const std::uint32_t f : faces)
                if (away(f) < away(nearest)) nearest = f;
            sources.push_back(source_[nearest]);
        }
        return sources;
    }

    void note(std::uint32_t f, std::uint32_t g) {
        meets_[f].push_back(g);
        meets_[g].push_back(f);
    }

    points_view points_;
    sliver_limits limits_;
    std::vector<face> faces_;  ///< by number in the tree, which knows which are there
    ids source_;
    std::vector<std::uint8_t> is_new_;
    base::stars given_stars_;
    std::unordered_map<std::uint32_t, ids> stars_{};  ///< where they have changed
    std::unordered_map<std::uint32_t, ids> meets_{};
    dynamic_tree<3> tree_;
    using place_in_line = std::pair<double, std::uint32_t>;
    std::priority_queue<place_in_line, std::vector<place_in_line>, std::greater<>> next_{};
    predicate_counters counters_{};
    int sideways_ = most_sideways;  ///< left
    std::uint64_t visits_ = 0;
    std::uint64_t changes_ = 0;
    double moved_ = 0.0;
};

}  // namespace

slivers_removed remove_slivers(mesh_view surface, std::span<const face_pair> meeting,
                               const sliver_limits& limits) {
    return sliver_removal(surface, meeting, limits).run();
}

}  // namespace treeform::detail::round
