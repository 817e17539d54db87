#include <libmesh/arrange/cluster.hpp>
#include <libmesh/arrange/planar_box.hpp>
#include <libmesh/arrange/planar_triangulation.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/geometry/features.hpp>

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <stdexcept>

namespace treeform::detail::arrange {
namespace {

constexpr std::uint32_t none = planar_triangulation::none;

/// A line of the plane: along an edge of a member, or where the plane of another face meets it.
struct line_name {
    bool is_face = false;
    intersect::edge_name of{};  ///< an edge, or a face and 0
    friend auto operator<=>(const line_name&, const line_name&) = default;
};

template <class T>
using vector = std::pmr::vector<T>;

template <class Vector>
void sort_unique(Vector& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

template <class Vector>
std::uint32_t place_in(const Vector& sorted, const typename Vector::value_type& value) {
    return static_cast<std::uint32_t>(std::lower_bound(sorted.begin(), sorted.end(), value) -
                                      sorted.begin());
}

class cutter {
  public:
    explicit cutter(const cluster_input& input)
        : in_(input),
          points_(in_.memory),
          lines_(in_.memory),
          lines_of_(in_.memory),
          segments_(in_.memory),
          vertex_of_(in_.memory),
          chains_(in_.memory),
          covers_(in_.memory),
          id_(in_.memory) {
        collect();
        project();
    }

    cut_cluster run() {
        if (points_.size() == 3) return copies();
        planar_triangulation plane = start();
        insert_points(plane);
        force_lines(plane);
        number_points(plane);
        if (is_single()) {
            write_single(plane);
        } else {
            cover(plane);
            write(plane);
        }
        return std::move(result_);
    }

  private:
    [[nodiscard]] const face& corners(std::uint32_t f) const { return in_.mesh.faces[f]; }
    [[nodiscard]] plane_points plane_of(std::uint32_t f) const {
        const face& c = corners(f);
        return {in_.mesh.points[c[0]], in_.mesh.points[c[1]], in_.mesh.points[c[2]]};
    }
    /// By far the most are: then all of the triangulation is the face.
    [[nodiscard]] bool is_single() const { return in_.members.size() == 1; }
    [[nodiscard]] implicit_point point(std::uint32_t id) const {
        return id < in_.mesh.points.size() ? implicit_point(in_.mesh.points[id])
                                           : in_.met->points[id - in_.mesh.points.size()];
    }
    template <class Visit>
    void for_meetings(std::uint32_t member, const Visit& visit) const {
        for (const std::uint32_t i : (*in_.by_face)[member]) visit(in_.met->meetings[i]);
    }

    /// A segment across the plane, by points and line.
    struct segment {
        std::uint32_t from, to, line;
    };
    /// A point and a line it lies on.
    struct incidence {
        std::uint32_t point;
        line_name line;
    };

    void collect() {
        vector<incidence> on(in_.memory);
        on.reserve(16);
        vector<std::array<std::uint32_t, 3>> crossings(in_.memory);  // from, to, face
        for (const std::uint32_t f : in_.members) {
            for (std::size_t i = 0; i < 3; ++i) {
                const intersect::edge_name e = intersect::edge_of(corners(f), i);
                on.push_back({e[0], {false, e}});
                on.push_back({e[1], {false, e}});
            }
            for_meetings(f, [&](const intersect::meeting& m) {
                const bool first = m.a == f;
                const std::uint32_t other = first ? m.b : m.a;
                for (std::size_t k = 0; k < m.count; ++k) {
                    const intersect::meeting_end& end = m.ends[k];
                    const triangle_feature here = first ? end.on_a : end.on_b;
                    if (geometry::is_edge(here))
                        on.push_back({end.point,
                                      {false, intersect::edge_of(corners(f),
                                                                 static_cast<std::size_t>(
                                                                     geometry::index_of(here)))}});
                    else if (!geometry::is_corner(here))
                        points_.push_back(end.point);
                    if (!m.coplanar) on.push_back({end.point, {true, {other, 0}}});
                }
                if (!m.coplanar && m.count == 2)
                    crossings.push_back({m.ends[0].point, m.ends[1].point, other});
            });
        }
        for (const incidence& i : on) {
            points_.push_back(i.point);
            lines_.push_back(i.line);
        }
        sort_unique(points_);
        sort_unique(lines_);
        lines_of_.resize(points_.size());
        for (const incidence& i : on) lines_of_[local(i.point)].push_back(place_in(lines_, i.line));
        for (auto& lines : lines_of_) sort_unique(lines);
        for (const auto& [from, to, other] : crossings)
            segments_.push_back(
                {local(from), local(to), place_in(lines_, line_name{true, {other, 0}})});
    }

    [[nodiscard]] std::uint32_t local(std::uint32_t id) const { return place_in(points_, id); }

    /// An axis along which the plane's projection has an area, the largest as far as doubles tell.
    void project() {
        const plane_points p = plane_of(in_.members[0]);
        const auto minus = [](const point3& a, const point3& b) {
            return point3{a.x - b.x, a.y - b.y, a.z - b.z};
        };
        const point3 u = minus(p.b, p.a);
        const point3 v = minus(p.c, p.a);
        const std::array<double, 3> n = {std::abs(u.y * v.z - u.z * v.y),
                                         std::abs(u.z * v.x - u.x * v.z),
                                         std::abs(u.x * v.y - u.y * v.x)};
        std::array<int, 3> axes = {0, 1, 2};
        std::stable_sort(axes.begin(), axes.end(), [&](int i, int j) {
            return n[static_cast<std::size_t>(i)] > n[static_cast<std::size_t>(j)];
        });
        for (const int axis : axes) {
            axis_ = axis;
            orientation_ = treeform::orient2d(axis, p.a, p.b, p.c);
            if (orientation_ != 0) return;
        }
        throw std::logic_error("treeform::arrange_faces: a face without area");
    }

    /// Members with the same three corners, and nothing else there.
    [[nodiscard]] cut_cluster copies() const {
        const face& first = corners(in_.members[0]);
        cut_cluster result;
        result.faces.push_back({first, 0});
        for (const std::uint32_t f : in_.members) {
            const face& c = corners(f);
            const std::size_t turn = c[0] == first[0] ? 0 : c[1] == first[0] ? 1 : 2;
            result.covers.push_back({f, c[(turn + 1) % 3] != first[1]});
        }
        return result;
    }

    planar_triangulation start() {
        // Local numbers in the triangulation: three corners that hold everything, then the points
        // (a corner of a single member being one of those three).
        vector<implicit_point> points(in_.memory);
        vector<vector<std::uint32_t>> lines(in_.memory);
        vertex_of_.assign(points_.size(), none);
        points.reserve(points_.size() + 3);
        lines.reserve(points_.size() + 3);
        if (is_single()) {
            for (const std::uint32_t c : corners(in_.members[0])) {
                vertex_of_[local(c)] = static_cast<std::uint32_t>(points.size());
                points.push_back(point(c));
                lines.push_back(std::move(lines_of_[local(c)]));
            }
        } else {
            for (const point3& p : frame()) {
                points.emplace_back(p);
                lines.emplace_back();
            }
        }
        for (std::uint32_t i = 0; i < points_.size(); ++i) {
            if (vertex_of_[i] != none) continue;
            vertex_of_[i] = static_cast<std::uint32_t>(points.size());
            points.push_back(point(points_[i]));
            lines.push_back(std::move(lines_of_[i]));
        }
        return {std::move(points), std::move(lines), axis_, orientation_,
                [this](std::uint32_t line, std::uint32_t other) { return cross(line, other); }};
    }

    /// A triangle that strictly holds all members in projection.
    [[nodiscard]] std::array<point3, 3> frame() const {
        planar_box box(axis_);
        for (const std::uint32_t f : in_.members)
            for (const std::uint32_t c : corners(f)) box.include(in_.mesh.points[c]);
        return box.triangle_around(orientation_);
    }

    [[nodiscard]] implicit_point cross(std::uint32_t i, std::uint32_t j) const {
        const line_name& p = lines_[std::min(i, j)];  // edges come before faces
        const line_name& q = lines_[std::max(i, j)];
        const auto& points = in_.mesh.points;
        if (p.is_face)
            return implicit_point::where_planes_meet(plane_of(in_.members[0]), plane_of(p.of[0]),
                                                     plane_of(q.of[0]));
        if (q.is_face)
            return implicit_point::where_line_meets(points[p.of[0]], points[p.of[1]],
                                                    plane_of(q.of[0]));
        return implicit_point::where_lines_cross(points[p.of[0]], points[p.of[1]], points[q.of[0]],
                                                 points[q.of[1]]);
    }

    void insert_points(planar_triangulation& plane) {
        for (std::uint32_t i = 0; i < points_.size(); ++i) {
            const std::uint32_t vertex = plane.insert(vertex_of_[i]);
            if (vertex == vertex_of_[i]) continue;
            result_.same.emplace_back(points_[i], id_of_vertex(vertex));
            vertex_of_[i] = vertex;
        }
    }

    /// \pre vertex is a point of before
    [[nodiscard]] std::uint32_t id_of_vertex(std::uint32_t vertex) const {
        return points_[static_cast<std::size_t>(
            std::find(vertex_of_.begin(), vertex_of_.end(), vertex) - vertex_of_.begin())];
    }

    void force_lines(planar_triangulation& plane) {
        chains_.resize(lines_.size());
        const std::size_t named = plane.points().size();
        force_edges(plane);
        for (const segment& s : segments_)
            if (vertex_of_[s.from] != vertex_of_[s.to])
                plane.constrain(vertex_of_[s.from], vertex_of_[s.to], s.line);
        // Where not all pairs that meet are known, edges may be crossed at points without a name,
        // which are on the way along them now.
        if (!is_single() && plane.points().size() > named) force_edges(plane);
    }

    void force_edges(planar_triangulation& plane) {
        for (std::uint32_t line = 0; line < lines_.size() && !lines_[line].is_face; ++line) {
            const auto [u, v] = lines_[line].of;
            chains_[line] = plane.constrain(vertex_of_[local(u)], vertex_of_[local(v)], line);
        }
    }

    /// Spreads each member from one of its sides over the triangles within its boundary.
    void cover(const planar_triangulation& plane) {
        covers_.resize(plane.triangle_count());
        vector<std::uint32_t> seen(plane.triangle_count(), none, in_.memory);
        for (const std::uint32_t f : in_.members) {
            const plane_points p = plane_of(f);
            const bool opposite = treeform::orient2d(axis_, p.a, p.b, p.c) != orientation_;
            vector<intersect::edge_name> rim(in_.memory);
            for (std::size_t i = 0; i < 3; ++i) {
                const auto& way =
                    chains_[place_in(lines_, line_name{false, intersect::edge_of(corners(f), i)})];
                for (std::size_t k = 0; k + 1 < way.size(); ++k)
                    rim.push_back(intersect::edge_between(way[k], way[k + 1]));
            }
            std::sort(rim.begin(), rim.end());
            const auto& way =
                chains_[place_in(lines_, line_name{false, intersect::edge_of(corners(f), 0)})];
            // The chain runs from the lower to the higher point.
            const bool forward = (corners(f)[0] < corners(f)[1]) != opposite;
            vector<std::uint32_t> stack(
                1, forward ? plane.left_of(way[0], way[1]) : plane.left_of(way[1], way[0]),
                in_.memory);
            seen[stack.back()] = f;
            while (!stack.empty()) {
                const std::uint32_t t = stack.back();
                stack.pop_back();
                covers_[t].push_back({f, opposite});
                const auto c = plane.corners(t);
                for (std::size_t i = 0; i < 3; ++i) {
                    if (std::binary_search(rim.begin(), rim.end(),
                                           intersect::edge_between(c[i], c[(i + 1) % 3])))
                        continue;
                    const std::uint32_t beyond = plane.across(t, i);
                    if (beyond == none)
                        throw std::logic_error("treeform::arrange_faces: face " +
                                               std::to_string(f) + " has no boundary in its plane");
                    if (seen[beyond] == f) continue;
                    seen[beyond] = f;
                    stack.push_back(beyond);
                }
            }
        }
    }

    /// What the vertices of the triangulation are called outside.
    void number_points(const planar_triangulation& plane) {
        const auto given = static_cast<std::uint32_t>(in_.mesh.points.size());
        const auto named = static_cast<std::uint32_t>(in_.met->points.size());
        const std::size_t inserted = points_.size() + (is_single() ? 0 : 3);
        id_.assign(plane.points().size(), none);
        for (std::uint32_t i = static_cast<std::uint32_t>(points_.size()); i-- > 0;)
            id_[vertex_of_[i]] = points_[i];
        for (std::size_t v = inserted; v < plane.points().size(); ++v) {
            id_[v] = given + named + static_cast<std::uint32_t>(result_.made.size());
            result_.made.push_back(plane.points()[v]);
        }
    }

    void write_single(const planar_triangulation& plane) {
        const std::size_t count = plane.triangle_count();
        result_.covers.assign(count, {in_.members[0], false});
        result_.faces.reserve(count);
        for (std::size_t t = 0; t < count; ++t) {
            const auto c = plane.corners(t);
            result_.faces.push_back({{id_[c[0]], id_[c[1]], id_[c[2]]}, t});
        }
    }

    void write(const planar_triangulation& plane) {
        vector<std::uint32_t> order(in_.memory);
        for (std::uint32_t t = 0; t < plane.triangle_count(); ++t)
            if (!covers_[t].empty()) order.push_back(t);
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t s, std::uint32_t t) {
            return covers_[s][0].face < covers_[t][0].face;
        });
        for (const std::uint32_t t : order) {
            auto c = plane.corners(t);
            const bool turned = covers_[t][0].opposite;
            if (turned) std::swap(c[1], c[2]);
            result_.faces.push_back({{id_[c[0]], id_[c[1]], id_[c[2]]}, result_.covers.size()});
            for (const covering_face& cover : covers_[t])
                result_.covers.push_back({cover.face, cover.opposite != turned});
        }
    }

    const cluster_input& in_;
    vector<std::uint32_t> points_;            ///< of the input or named, ascending
    vector<line_name> lines_;                 ///< ascending, edges first
    vector<vector<std::uint32_t>> lines_of_;  ///< of each point
    vector<segment> segments_;
    vector<std::uint32_t> vertex_of_;       ///< of each point, in the triangulation
    vector<vector<std::uint32_t>> chains_;  ///< vertices along each edge
    vector<vector<covering_face>> covers_;  ///< of each triangle
    vector<std::uint32_t> id_;              ///< of each vertex, outside
    int axis_ = 2;
    int orientation_ = 1;
    cut_cluster result_;
};

}  // namespace

cut_cluster cut(const cluster_input& input) { return cutter(input).run(); }

}  // namespace treeform::detail::arrange
