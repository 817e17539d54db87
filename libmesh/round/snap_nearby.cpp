#include <libmesh/base/point_math.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/round/cancelled_faces.hpp>
#include <libmesh/round/face_pieces.hpp>
#include <libmesh/round/flat_patches.hpp>
#include <libmesh/round/joint_geometry.hpp>
#include <libmesh/round/snap_nearby.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace treeform::detail::round {
namespace {

using base::dot;
using base::minus;

constexpr std::size_t snap_grain = std::size_t{1} << 10;
constexpr int most_rounds = 8, most_rounds_of_operands = 3;

/// A place on an edge, from 0 at its lower end to 1, and how far away it is.
struct place {
    double along = 0.0;
    double distance = 0.0;
};

/// A point to be put into an edge.
struct edge_point {
    edge_name edge{};
    double along = 0.0;
    std::uint32_t point = 0;
    double distance = 0.0;
};

/// Two edges that pass each other.
struct passing_edges {
    edge_name a{}, b{};
    place on_a{}, on_b{};
    point3 between{};
    friend bool operator<(const passing_edges& x, const passing_edges& y) {
        return std::tie(x.a, x.b) < std::tie(y.a, y.b);
    }
};

/// `find(i, part)` for 0 <= i < count, in parallel; the parts in order. Of more than `most`, some
/// that are more than that.
template <class T, class Find>
std::vector<T> gather(std::size_t count, std::size_t most, const Find& find) {
    std::vector<std::vector<T>> parts(chunk_count(count, snap_grain));
    std::atomic<std::size_t> total{0};
    for_chunks(count, snap_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end && total <= most; ++i) {
            const std::size_t before = parts[c].size();
            find(i, parts[c]);
            total += parts[c].size() - before;
        }
    });
    std::vector<T> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// Three passes, each on what the one before it has left: corners, edges, faces.
class joining {
  public:
    joining(mesh_view mesh, std::span<const std::uint8_t> offending, const joint& how)
        : reach_(how.reach),
          solid_(how.solid),
          source_(how.source),
          operand_(how.operand),
          bad_(offending.begin(), offending.end()) {
        surface().points.assign(mesh.points.begin(), mesh.points.end());
        surface().faces.assign(mesh.faces.begin(), mesh.faces.end());
        result_.face_of.resize(mesh.faces.size());
        std::iota(result_.face_of.begin(), result_.face_of.end(), 0U);
        most_faces_ = (of_operands() ? 6 : 3) * mesh.faces.size() + 4000;
    }

    joined_near run() {
        const int rounds = of_operands() ? most_rounds_of_operands : most_rounds;
        for (int round = 0; round < rounds; ++round) {
            const joined_near before = result_;
            const std::vector<std::uint8_t> bad_before = bad_;
            const bool corners = join_corners();
            const bool edges = split_edges();
            const bool faces = split_faces();
            if (!grows_) flip();
            // Common points ought to make faces the same, so that they go; else this leads nowhere.
            const std::size_t was = before.surface.faces.size();
            if (grows_ || (!of_operands() && surface().faces.size() > was + was / 4 + 200)) {
                result_ = before;
                bad_ = bad_before;
                break;
            }
            if (!corners && !edges && !faces) break;
        }
        join_corners();  // no two points that are used are equal
        return std::move(result_);
    }

  private:
    mesh& surface() { return result_.surface; }
    [[nodiscard]] const mesh& surface() const { return result_.surface; }
    [[nodiscard]] const point3& at(std::uint32_t p) const { return surface().points[p]; }

    /// How many points more in edges and faces do not make too many faces.
    [[nodiscard]] std::size_t room() const {
        const std::size_t faces = surface().faces.size();
        return faces < most_faces_ ? (most_faces_ - faces) / 2 : 0;
    }
    bool too_many(std::size_t points) {
        grows_ = grows_ || points > room();
        return grows_;
    }

    [[nodiscard]] bool of_operands() const { return !operand_.empty(); }

    /// What moves in one pass may move again in the next.
    void note(double distance) { pass_ = std::max(pass_, distance); }
    void end_pass() {
        result_.moved += pass_;
        pass_ = 0.0;
    }

    /// The points that faces use, offending ones or all.
    [[nodiscard]] std::vector<std::uint32_t> used_points(bool offending_only) const {
        const std::size_t points = surface().points.size();
        if (!offending_only) return detail::base::used_points(points, surface().faces);
        std::vector<face> faces;
        for (std::size_t f = 0; f < surface().faces.size(); ++f)
            if (bad_[f] != 0) faces.push_back(surface().faces[f]);
        return detail::base::used_points(points, faces);
    }

    [[nodiscard]] std::vector<edge_name> offending_edges() const {
        std::vector<edge_name> edges;
        for (std::size_t f = 0; f < surface().faces.size(); ++f)
            if (bad_[f] != 0)
                for (const edge_name& e : edges_of(surface().faces[f])) edges.push_back(e);
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        return edges;
    }

    [[nodiscard]] tree<3> tree_of_points(const std::vector<std::uint32_t>& points) const {
        return build(points, [&](std::uint32_t p) { return box_around(at(p), at(p), 0.0); });
    }

    /// Calls `visit(q)` for the points within reach of p.
    template <class Visit>
    void visit_near(std::uint32_t p, const tree<3>& around,
                    const std::vector<std::uint32_t>& points, const Visit& visit) const {
        search(around, box_around(at(p), at(p), reach_), [&](std::uint32_t id) {
            if (length(minus(at(p), at(points[id]))) <= reach_) visit(points[id]);
        });
    }

    /// Corners within reach, one of them of an offending face, become the lower one of the two. No
    /// chains: what others have joined stays. So each goes to the lowest that stays, and whether
    /// those before it stay is known when its turn comes. Of points of offending faces those that
    /// stay are out of reach of each other: what they visit is not much more than there is, however
    /// dense it is.
    bool join_corners() {
        const std::vector<std::uint32_t> loose = used_points(true);
        std::vector<std::uint32_t> fixed = used_points(false);
        std::erase_if(fixed, [&](std::uint32_t p) {
            return std::binary_search(loose.begin(), loose.end(), p);
        });
        const tree<3> around_loose = tree_of_points(loose), around_fixed = tree_of_points(fixed);
        std::vector<std::uint32_t> now(surface().points.size());
        std::iota(now.begin(), now.end(), 0U);
        for (const std::uint32_t p : loose) {
            visit_near(p, around_fixed, fixed, [&](std::uint32_t q) {
                if (q < now[p] && now[q] == q) now[p] = q;
            });
            if (now[p] != p) continue;
            const auto join = [&](std::uint32_t q) {
                if (q > p && now[q] == q) now[q] = p;
            };
            visit_near(p, around_loose, loose, join);
            visit_near(p, around_fixed, fixed, join);
        }
        bool any = false;
        for (std::uint32_t p = 0; p < now.size(); ++p) {
            if (now[p] == p) continue;
            any = true;
            note(length(minus(at(p), at(now[p]))));
        }
        if (!any) return false;
        replace_faces([&](std::uint32_t, const face& f, std::vector<face>& pieces) {
            pieces.push_back({now[f[0]], now[f[1]], now[f[2]]});
        });
        return true;
    }

    [[nodiscard]] place nearest_on(std::uint32_t p, const edge_name& e) const {
        const point3 &a = at(e[0]), &q = at(p);
        const point3 way = minus(at(e[1]), a);
        const double square = dot(way, way);
        const double along =
            square > 0.0 ? std::clamp(dot(minus(q, a), way) / square, 0.0, 1.0) : 0.0;
        const point3 there{a.x + along * way.x, a.y + along * way.y, a.z + along * way.z};
        return {along, length(minus(q, there))};
    }

    /// Corners next to offending edges.
    [[nodiscard]] std::vector<edge_point> corners_near(const std::vector<edge_name>& edges) const {
        const std::vector<std::uint32_t> all = used_points(false);
        const tree<3> around = tree_of_points(all);
        return gather<edge_point>(
            edges.size(), room(), [&](std::size_t i, std::vector<edge_point>& found) {
                const edge_name& e = edges[i];
                search(around, box_around(at(e[0]), at(e[1]), near()), [&](std::uint32_t id) {
                    const std::uint32_t p = all[id];
                    if (p == e[0] || p == e[1]) return;
                    const place on = nearest_on(p, e);
                    if (on.distance <= near()) found.push_back({e, on.along, p, on.distance});
                });
            });
    }

    /// Where the lines through two edges are nearest, if that is inside of both.
    [[nodiscard]] bool pass(passing_edges& e) const {
        const point3 &p = at(e.a[0]), &q = at(e.b[0]);
        const point3 u = minus(at(e.a[1]), p), v = minus(at(e.b[1]), q), w = minus(q, p);
        const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
        const double turn = uu * vv - uv * uv;
        if (!(turn > 0x1p-40 * uu * vv)) return false;  // along each other: their ends are near
        const double s = (uw * vv - vw * uv) / turn, t = (uw * uv - vw * uu) / turn;
        if (!(s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0)) return false;
        const point3 on_a{p.x + s * u.x, p.y + s * u.y, p.z + s * u.z};
        const point3 on_b{q.x + t * v.x, q.y + t * v.y, q.z + t * v.z};
        const double distance = length(minus(on_a, on_b));
        if (!(distance <= near())) return false;
        e.on_a = {s, distance};
        e.on_b = {t, distance};
        e.between = {(on_a.x + on_b.x) / 2, (on_a.y + on_b.y) / 2, (on_a.z + on_b.z) / 2};
        return true;
    }

    [[nodiscard]] std::vector<passing_edges> edges_passing(
        const std::vector<edge_name>& edges) const {
        const tree<3> around =
            build(edges, [&](const edge_name& e) { return box_around(at(e[0]), at(e[1]), 0.0); });
        auto all = gather<passing_edges>(
            edges.size(), room(), [&](std::size_t i, std::vector<passing_edges>& found) {
                const edge_name& a = edges[i];
                search(around, box_around(at(a[0]), at(a[1]), near()), [&](std::uint32_t id) {
                    const edge_name& b = edges[id];
                    if (!(a < b) || a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1])
                        return;
                    passing_edges both{.a = a, .b = b};
                    if (pass(both)) found.push_back(both);
                });
            });
        std::sort(all.begin(), all.end());
        return all;
    }

    /// A corner or new point where edges pass each other: an end of theirs within reach, or one
    /// made for other edges there, or a new one.
    std::uint32_t point_for(const passing_edges& e, std::size_t first_made) {
        for (const std::uint32_t end : {e.a[0], e.a[1], e.b[0], e.b[1]})
            if (length(minus(at(end), e.between)) <= reach_) return end;
        const auto made = static_cast<std::uint32_t>(surface().points.size());
        for (std::uint32_t p = made; p-- > first_made && made - p < 64;)
            if (length(minus(at(p), e.between)) <= reach_) return p;
        surface().points.push_back(e.between);
        return made;
    }

    /// Offending edges, with all faces at them, get the corners next to them, and common points
    /// where they pass each other.
    bool split_edges() {
        const std::vector<edge_name> edges = offending_edges();
        std::vector<edge_point> in_edges = corners_near(edges);
        const std::size_t first_made = surface().points.size();
        const auto passing = of_operands() ? std::vector<passing_edges>{} : edges_passing(edges);
        if (too_many(std::max(in_edges.size(), passing.size()))) return false;
        for (const passing_edges& e : passing) {
            const std::uint32_t p = point_for(e, first_made);
            if (p != e.a[0] && p != e.a[1])
                in_edges.push_back({e.a, e.on_a.along, p, e.on_a.distance});
            if (p != e.b[0] && p != e.b[1])
                in_edges.push_back({e.b, e.on_b.along, p, e.on_b.distance});
        }
        if (in_edges.empty() || too_many(in_edges.size())) return false;
        const auto by_point = [](const edge_point& e) {
            return std::tuple(e.edge, e.point, e.along);
        };
        std::sort(in_edges.begin(), in_edges.end(),
                  [&](const auto& e, const auto& f) { return by_point(e) < by_point(f); });
        const auto last = std::unique(
            in_edges.begin(), in_edges.end(),
            [](const auto& e, const auto& f) { return e.edge == f.edge && e.point == f.point; });
        in_edges.erase(last, in_edges.end());
        const auto by_place = [](const edge_point& e) {
            return std::tuple(e.edge, e.along, e.point);
        };
        std::sort(in_edges.begin(), in_edges.end(),
                  [&](const auto& e, const auto& f) { return by_place(e) < by_place(f); });
        for (const edge_point& e : in_edges) note(e.distance);
        put_into_edges(in_edges);
        return true;
    }

    void put_into_edges(const std::vector<edge_point>& in_edges) {
        std::vector<std::uint8_t> split(surface().points.size(), 0);
        for (const edge_point& e : in_edges) split[e.edge[0]] = split[e.edge[1]] = 1;
        const auto points_of = [&](std::uint32_t a, std::uint32_t b) {
            std::vector<std::uint32_t> points;
            const edge_name name = edge_between(a, b);
            auto next = std::lower_bound(
                in_edges.begin(), in_edges.end(), name,
                [](const edge_point& e, const edge_name& edge) { return e.edge < edge; });
            for (; next != in_edges.end() && next->edge == name; ++next)
                points.push_back(next->point);
            if (a > b) std::reverse(points.begin(), points.end());
            return points;
        };
        replace_faces([&](std::uint32_t, const face& f, std::vector<face>& pieces) {
            std::array<std::vector<std::uint32_t>, 3> inner;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = f[k], b = f[(k + 1) % 3];
                if (split[a] != 0 && split[b] != 0) inner[k] = points_of(a, b);
            }
            if (inner[0].empty() && inner[1].empty() && inner[2].empty()) {
                pieces.push_back(f);
                return;
            }
            face_pieces cut(f, surface().points);
            for (std::size_t k = 0; k < 3; ++k) cut.split_edge(f[k], f[(k + 1) % 3], inner[k]);
            pieces = cut.all();
        });
    }

    [[nodiscard]] bool is_near_edge(std::uint32_t p, const face& f) const {
        const auto edges = edges_of(f);
        return std::any_of(edges.begin(), edges.end(),
                           [&](const edge_name& e) { return nearest_on(p, e).distance <= near(); });
    }

    /// Offending faces get the corners next to them. What is next to one of their edges waits for
    /// the edge to be split: here it would turn a piece over.
    bool split_faces() {
        std::vector<std::uint32_t> faces;
        for (std::uint32_t f = 0; f < bad_.size(); ++f)
            if (bad_[f] != 0) faces.push_back(f);
        const std::vector<std::uint32_t> all = used_points(false);
        const tree<3> around = tree_of_points(all);
        using in_face = std::tuple<std::uint32_t, std::uint32_t, double>;
        const auto found =
            gather<in_face>(faces.size(), room(), [&](std::size_t i, std::vector<in_face>& part) {
                const face& f = surface().faces[faces[i]];
                const triangle3 t{at(f[0]), at(f[1]), at(f[2])};
                aabb<double, 3> box = box_around(t[0], t[1], near());
                box.include(box_around(t[2], t[2], near()));
                const std::size_t first = part.size();
                search(around, box, [&](std::uint32_t id) {
                    const std::uint32_t p = all[id];
                    if (holds(f, p) || is_near_edge(p, f)) return;
                    const double distance = std::sqrt(closest_point(t, at(p)).squared_distance);
                    if (distance <= near()) part.emplace_back(faces[i], p, distance);
                });
                std::sort(part.begin() + static_cast<std::ptrdiff_t>(first), part.end());
            });
        if (found.empty() || too_many(found.size())) return false;
        for (const in_face& one : found) note(std::get<2>(one));
        auto next = found.begin();
        replace_faces([&](std::uint32_t number, const face& f, std::vector<face>& pieces) {
            if (next == found.end() || std::get<0>(*next) != number) {
                pieces.push_back(f);
                return;
            }
            face_pieces cut(f, surface().points);
            for (; next != found.end() && std::get<0>(*next) == number; ++next)
                cut.split_inside(std::get<1>(*next));
            pieces = cut.all();
        });
        return true;
    }

    /// Flat patches of offending faces get the triangles of Delaunay, so that patches that lie on
    /// each other are cut in the same way. A piece is of the face that its middle lies in.
    void flip() {
        const auto [by_patch, borders] = find_flat_patches({.surface = surface(),
                                                            .offending = bad_,
                                                            .face_of = result_.face_of,
                                                            .source = source_,
                                                            .operand = operand_,
                                                            .near = near()});
        const std::vector<std::uint32_t> face_of = result_.face_of;
        for (std::size_t begin = 0, end = 0; begin < by_patch.size(); begin = end) {
            std::vector<face> faces;
            for (; end < by_patch.size() && by_patch[end][0] == by_patch[begin][0]; ++end)
                faces.push_back(surface().faces[by_patch[end][1]]);
            face_pieces pieces(faces, surface().points);
            note(pieces.flip(borders, reach_));
            const std::vector<std::size_t> lies_in = pieces.lying_in(faces);
            for (std::size_t i = begin; i < end; ++i) {
                surface().faces[by_patch[i][1]] = pieces.all()[i - begin];
                result_.face_of[by_patch[i][1]] = face_of[by_patch[begin + lies_in[i - begin]][1]];
            }
        }
        end_pass();
        cancel();
    }

    /// Ends a pass: puts the pieces that `cut(number, face, pieces)` adds in the place of each
    /// face.
    template <class Cut>
    void replace_faces(const Cut& cut) {
        end_pass();
        std::vector<face> faces, pieces;
        std::vector<std::uint32_t> face_of;
        std::vector<std::uint8_t> bad;
        for (std::uint32_t f = 0; f < surface().faces.size(); ++f) {
            pieces.clear();
            cut(f, surface().faces[f], pieces);
            for (const face& piece : pieces) {
                if (!base::has_three_corners(piece)) continue;
                faces.push_back(piece);
                face_of.push_back(result_.face_of[f]);
                bad.push_back(bad_[f]);
            }
        }
        surface().faces = std::move(faces);
        result_.face_of = std::move(face_of);
        bad_ = std::move(bad);
        cancel();
    }

    /// Of faces that cover each other, what bounds nothing goes.
    void cancel() {
        if (of_operands()) return;
        const std::vector<std::uint8_t> gone = cancelled_faces(surface().faces, solid_);
        std::size_t kept = 0;
        for (std::size_t f = 0; f < gone.size(); ++f) {
            if (gone[f] != 0) continue;
            surface().faces[kept] = surface().faces[f];
            result_.face_of[kept] = result_.face_of[f];
            bad_[kept++] = bad_[f];
        }
        surface().faces.resize(kept);
        result_.face_of.resize(kept);
        bad_.resize(kept);
    }

    /// Edges and faces take corners from nearer than corners join: edges do not get short by it.
    [[nodiscard]] double near() const { return reach_ / 2; }

    double reach_;
    bool solid_;
    std::span<const std::uint32_t> source_;
    std::span<const std::uint32_t> operand_;
    double pass_ = 0.0;  ///< the largest distance closed since the last pass
    std::size_t most_faces_ = 0;
    bool grows_ = false;
    std::vector<std::uint8_t> bad_;  ///< by face
    joined_near result_{};
};

}  // namespace

joined_near snap_nearby(mesh_view mesh, std::span<const std::uint8_t> offending, const joint& how) {
    return joining(mesh, offending, how).run();
}

}  // namespace treeform::detail::round
