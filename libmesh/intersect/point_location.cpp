#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/geometry/flat_triangle.hpp>
#include <libmesh/geometry/signs.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/ray.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

constexpr std::size_t point_grain = 256;                  // points a chunk
constexpr std::size_t star_grain = std::size_t{1} << 14;  // points of the mesh a chunk

[[noreturn]] void refuse(const std::string& why) {
    throw std::invalid_argument("treeform::" + why);
}

bool is_finite(const point2& p) { return std::isfinite(p.x) && std::isfinite(p.y); }
using detail::base::is_finite;

/// What has been found along the ray so far.
struct tally {
    static constexpr auto nothing = std::numeric_limits<std::uint32_t>::max();
    std::int32_t winding = 0;
    std::uint32_t on = nothing;  ///< lowest face or edge that holds the point

    void touch(std::uint32_t id) { on = std::min(on, id); }
    [[nodiscard]] point_location result() const {
        if (on != nothing) return {location::boundary, 0, on};
        return {winding != 0 ? location::inside : location::outside, winding, 0};
    }
};

/// Sign of a - b; also where a processor flushes denormals to zero.
int order(double a, double b) {
    const point3 p{a, 0, 0};
    const point3 q{b, 0, 0};
    return detail::geometry::lexicographically_less(q, p) -
           detail::geometry::lexicographically_less(p, q);
}

// Faces, seen along x: a face is passed through when the point, moved to y + eps, z + eps^2, lies
// strictly inside its projection. About a directed edge p -> r, the sign of
//     (r.y - p.y) (z - p.z) - (r.z - p.z) (y - p.y),
// where it is 0, becomes that of -(r.z - p.z) eps + (r.y - p.y) eps^2. The two faces at an edge see
// opposite signs, so the moved ray crosses a closed surface properly, and the winding number about
// the moved point is that about the point itself unless the point is on the surface. A face
// that is seen edge on is never passed through: its three moved signs are not all equal.

int moved_sign(int sign, const point3& p, const point3& r) {
    if (sign != 0) return sign;
    const int up = order(r.z, p.z);
    return up != 0 ? -up : order(r.y, p.y);
}

/// Counts one face, with corners a, b, c, for point q.
void count_face(const triangle3& t, const point3& q, std::uint32_t id, tally& found) {
    const auto& [a, b, c] = t;
    const std::array<int, 3> about{orient2d(0, a, b, q), orient2d(0, b, c, q),
                                   orient2d(0, c, a, q)};
    const auto [least, most] = std::minmax({about[0], about[1], about[2]});
    if (least < 0 && most > 0) return;
    if (least == 0 && most == 0) {  // seen edge on, or without area
        if (intersect(t, {q, q, q}).count != 0) found.touch(id);
        return;
    }
    const int side = orient3d(a, b, c, q);
    if (side == 0) return found.touch(id);
    const int faces = most + least > 0 ? 1 : -1;  // along x: away from the point, or toward it
    if (side == faces) return;                    // behind the point
    if (moved_sign(about[0], a, b) == faces && moved_sign(about[1], b, c) == faces &&
        moved_sign(about[2], c, a) == faces)
        found.winding += faces;
}

/// Counts one edge, from p to r, for point q: half-open in y.
void count_edge(const point2& p, const point2& r, const point2& q, std::uint32_t id, tally& found) {
    const int from = order(p.y, q.y);
    const int to = order(r.y, q.y);
    if (from * to > 0) return;
    const int side = orient2d(p, r, q);
    if (side == 0) {
        if (order(p.x, q.x) * order(r.x, q.x) <= 0) found.touch(id);
        return;
    }
    if (from <= 0 && to > 0 && side > 0) ++found.winding;
    if (from > 0 && to <= 0 && side < 0) --found.winding;
}

/// Walks the net of edges a -> b at point a, b > a: each must be passed as often as b -> a.
class edge_balance {
  public:
    explicit edge_balance(std::span<const face> faces) : faces_(faces) {}

    /// The lowest b that is not balanced, or none.
    [[nodiscard]] std::optional<std::uint32_t> unbalanced(std::uint32_t a,
                                                          std::span<const std::uint32_t> star) {
        ends_.clear();
        for (const std::uint32_t id : star) {
            const face& f = faces_[id];
            const std::size_t i = f[0] == a ? 0 : f[1] == a ? 1 : 2;
            add(a, f[(i + 1) % 3], 1);
            add(a, f[(i + 2) % 3], -1);
        }
        std::sort(ends_.begin(), ends_.end());
        for (std::size_t i = 0; i < ends_.size();) {
            std::int64_t net = 0;
            const std::uint32_t b = ends_[i].first;
            for (; i < ends_.size() && ends_[i].first == b; ++i) net += ends_[i].second;
            if (net != 0) return b;
        }
        return std::nullopt;
    }

  private:
    void add(std::uint32_t a, std::uint32_t b, int direction) {
        if (b > a) ends_.emplace_back(b, direction);
    }

    std::span<const face> faces_;
    std::vector<std::pair<std::uint32_t, int>> ends_;
};

template <class Locator, class Point>
std::vector<point_location> locate_all(const Locator& locator, std::span<const Point> points,
                                       const char* name) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!is_finite(points[i]))
            refuse(std::string(name) + ": point " + std::to_string(i) + " is not finite");
    std::vector<point_location> found(points.size());
    for_chunks(points.size(), point_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) found[i] = locator.locate(points[i]);
    });
    return found;
}

void check_edges(const char* function, std::size_t points, std::span<const curve_edge> edges) {
    if (edges.size() > tree<2>::max_size) refuse(std::string(function) + ": too many edges");
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (std::max(edges[i][0], edges[i][1]) >= points)
            refuse(std::string(function) + ": edge " + std::to_string(i) +
                   " has an end out of range");
}

}  // namespace

std::optional<std::array<std::uint32_t, 2>> find_open_edge(mesh_view mesh) {
    detail::base::check_faces("find_open_edge", mesh.points.size(), mesh.faces);
    const std::size_t count = detail::base::nameable_points(mesh.points.size());
    const detail::base::stars stars(count, mesh.faces);
    using edge = std::array<std::uint32_t, 2>;
    std::vector<std::optional<edge>> first(chunk_count(stars.size(), star_grain));
    for_chunks(stars.size(), star_grain,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   edge_balance balance(mesh.faces);
                   for (std::size_t v = begin; v < end && !first[chunk]; ++v) {
                       const auto a = static_cast<std::uint32_t>(v);
                       if (const auto b = balance.unbalanced(a, stars[v])) first[chunk] = {a, *b};
                   }
               });
    for (const auto& found : first)
        if (found) return found;
    return std::nullopt;
}

void detail::intersect::check_closed(const char* function, mesh_view mesh) {
    if (const auto open = find_open_edge(mesh))
        refuse(std::string(function) + ": the mesh is open at the edge between points " +
               std::to_string((*open)[0]) + " and " + std::to_string((*open)[1]));
}

bool detail::intersect::is_closed(const prepared_mesh& mesh) {
    constexpr base::slot<bool> slot{base::slot_name::closed};
    if (mesh.is_cloud()) return false;
    return base::prepared_slots::get(mesh, slot, [&] {
        return !find_open_edge(weld::join_faces(mesh).of(mesh.indexed_view()));
    });
}

namespace {

template <class Counts>
point_location located(mesh_view mesh, const tree<3>& faces, const point3& point,
                       const Counts& counts) {
    if (!is_finite(point)) refuse("locate: the point is not finite");
    constexpr double infinite = std::numeric_limits<double>::infinity();
    tally found;
    visit_ray(faces, ray<double, 3>{{point.x, point.y, point.z}, {1, 0, 0}}, [&](std::uint32_t id) {
        const face& f = mesh.faces[id];
        if (counts(id))
            count_face({mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]}, point, id, found);
        return infinite;
    });
    return found.result();
}

}  // namespace

point_location detail::intersect::point_locator::locate(const point3& point) const {
    return located(mesh_, *tree_, point, [](std::uint32_t) { return true; });
}

std::optional<std::int32_t> detail::intersect::point_locator::winding_of(
    const point3& point, function_ref<bool(std::uint32_t)> counts) const {
    const point_location found = located(mesh_, *tree_, point, counts);
    if (found.where == location::boundary) return std::nullopt;
    return found.winding;
}

std::vector<point_location> detail::intersect::point_locator::locate(
    std::span<const point3> points) const {
    return locate_all(*this, points, "locate");
}

namespace {

/// Finds the points `asked`, one or a span, after the mesh was checked.
template <class Asked>
auto locate_in(const prepared_mesh& mesh, const Asked& asked) {
    const tree<3>& faces = build_face_tree(mesh, "locate");
    if (!detail::intersect::is_closed(mesh))
        detail::intersect::check_closed("locate",
                                        detail::weld::join_faces(mesh).of(mesh.indexed_view()));
    return detail::intersect::point_locator(mesh.indexed_view(), faces).locate(asked);
}

bool is_in(const point_location& found) { return found.where != location::outside; }

}  // namespace

point_location locate(const mesh_ref& given_mesh, const point3& point) {
    const detail::base::prepared_ref mesh(given_mesh);
    return locate_in(mesh, point);
}
std::vector<point_location> locate(const mesh_ref& given_mesh, std::span<const point3> points) {
    const detail::base::prepared_ref mesh(given_mesh);
    return locate_in(mesh, points);
}

bool contains(const mesh_ref& mesh, const point3& point) { return is_in(locate(mesh, point)); }

int winding_number(const mesh_ref& mesh, const point3& point) {
    return locate(mesh, point).winding;
}

curve_locator::curve_locator(std::span<const point2> points, std::span<const curve_edge> edges)
    : points_(points), edges_(edges) {
    check_edges("curve_locator", points.size(), edges);
    tree_ = build(edges, [points](const curve_edge& e) {
        aabb<double, 2> box;
        box.include(points[e[0]]);
        box.include(points[e[1]]);
        if (!is_finite(points[e[0]]) || !is_finite(points[e[1]])) box.min[0] = NAN;
        return box;
    });
    std::vector<std::int64_t> net(points.size());
    for (const auto& [from, to] : edges) ++net[to], --net[from];
    for (std::size_t i = 0; i < net.size(); ++i)
        if (net[i] != 0) refuse("curve_locator: the curve is open at point " + std::to_string(i));
}

point_location curve_locator::locate(const point2& point) const {
    if (!is_finite(point)) refuse("curve_locator: the point is not finite");
    constexpr double infinite = std::numeric_limits<double>::infinity();
    tally found;
    visit_ray(tree_, ray<double, 2>{{point.x, point.y}, {1, 0}}, [&](std::uint32_t id) {
        const auto& [from, to] = edges_[id];
        count_edge(points_[from], points_[to], point, id, found);
        return infinite;
    });
    return found.result();
}

std::vector<point_location> curve_locator::locate(std::span<const point2> points) const {
    return locate_all(*this, points, "curve_locator");
}

}  // namespace treeform
