#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <libmesh/place/point_sides.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/morton_order.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform::detail::place {
namespace {

constexpr std::size_t points_per_chunk = 1024;
/// Faces that are counted between two points; where there are more, a ray is no dearer.
constexpr std::size_t most_faces_between = 96;

/// A point off the surface, and how often the surface winds around it.
struct known_point {
    point3 at{};
    double distance = 0.0;
    std::int32_t winding = 0;
};

/// How the winding number changes on the way from `p` to `q` at the face a, b, c; none where that
/// cannot be told from the signs of these points alone: the way meets the face's border, or ends on
/// its plane.
std::optional<std::int32_t> change_at(const std::array<point3, 3>& t, const point3& p,
                                      const point3& q) {
    const auto& [a, b, c] = t;
    const int from = orient3d(a, b, c, p), to = orient3d(a, b, c, q);
    if (from == to && from != 0) return 0;
    const std::array<int, 3> about{orient3d(p, q, a, b), orient3d(p, q, b, c),
                                   orient3d(p, q, c, a)};
    const auto [least, most] = std::minmax({about[0], about[1], about[2]});
    if (least < 0 && most > 0) return 0;  // the line passes the triangle by
    if (least == 0 || most == 0 || from == 0 || to == 0) return std::nullopt;
    // From outside to inside it goes up, for a face is counter-clockwise seen from outside.
    return from > 0 ? 1 : -1;
}

class side_finder {
  public:
    side_finder(mesh_view mesh, const tree<3>& tree, double error)
        : mesh_(mesh), tree_(tree), locator_(mesh, tree), error_(error) {}

    std::int8_t side_of(const point3& q, double distance) {
        if (known_) {
            const auto winding = shared(q, distance);
            if (winding) {
                known_ = {q, distance, *winding};
                return side(*winding);
            }
        }
        const point_location found = locator_.locate(q);
        ++counted_;
        if (found.where == location::boundary) return 0;
        known_ = {q, distance, found.winding};
        return side(found.winding);
    }

    [[nodiscard]] std::uint64_t counted() const { return counted_; }

  private:
    static std::int8_t side(std::int32_t winding) {
        return static_cast<std::int8_t>(winding != 0 ? -1 : 1);
    }

    /// The winding number around `q`, from that of the known point.
    std::optional<std::int32_t> shared(const point3& q, double distance) {
        const point3 way = base::minus(q, known_->at);
        const double length = std::sqrt(base::dot(way, way));
        // No face comes into the open balls around the two points, less the error of the distances.
        // Where the balls meet, nothing is between the points. The length is rounded by less than
        // 2^-50 of itself and 2^-1000, the sum by less than 2^-52.
        const double reach = distance + known_->distance;
        if (length * (1.0 + 0x1p-48) + 0x1p-1000 < reach - 2.0 * error_) return known_->winding;
        return counted_between(q);
    }

    std::optional<std::int32_t> counted_between(const point3& q) {
        const point3& p = known_->at;
        aabb<double, 3> between;
        between.include(p);
        between.include(q);
        std::int32_t winding = known_->winding;
        std::size_t faces = 0;
        bool decided = true;
        search(tree_, between, [&](std::uint32_t f) {
            const auto change = ++faces > most_faces_between
                                    ? std::nullopt
                                    : change_at(base::triangle_of(mesh_, f), p, q);
            decided = change.has_value();
            if (decided) winding += *change;
            return !decided;
        });
        if (!decided) return std::nullopt;
        return winding;
    }

    mesh_view mesh_;
    const tree<3>& tree_;
    intersect::point_locator locator_;
    double error_;
    std::optional<known_point> known_{};
    std::uint64_t counted_ = 0;
};

}  // namespace

point_sides sides_in_order(mesh_view mesh, const tree<3>& tree, std::span<const point3> queries,
                           std::span<const double> distance, double error) {
    point_sides result;
    result.side.resize(queries.size());
    std::vector<std::uint64_t> counted(chunk_count(queries.size(), points_per_chunk));
    for_chunks(queries.size(), points_per_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   side_finder find(mesh, tree, error);
                   for (std::size_t i = begin; i < end; ++i)
                       result.side[i] = find.side_of(queries[i], distance[i]);
                   counted[chunk] = find.counted();
               });
    result.winding_numbers = std::accumulate(counted.begin(), counted.end(), std::uint64_t{0});
    return result;
}

std::vector<std::int8_t> sides_of(mesh_view mesh, const tree<3>& tree,
                                  std::span<const point3> queries) {
    const auto order = morton_order<3>(queries.size(), [&](std::size_t i) {
        return std::array<double, 3>{queries[i].x, queries[i].y, queries[i].z};
    });
    std::vector<point3> in_order;
    in_order.reserve(queries.size());
    for (const std::uint32_t i : order) in_order.push_back(queries[i]);
    // Distances would cost more than the few faces that they save from being counted.
    const std::vector<double> unknown(queries.size());
    const point_sides found = sides_in_order(mesh, tree, in_order, unknown, 0.0);
    std::vector<std::int8_t> side(queries.size());
    for (std::size_t i = 0; i < order.size(); ++i) side[order[i]] = found.side[i];
    return side;
}

}  // namespace treeform::detail::place

namespace treeform {
namespace {

/// Numbers of the points in the closed box.
std::vector<std::uint32_t> points_in(const box3& box, points_view points) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        bool within = true;
        for (std::size_t k = 0; k < 3; ++k)
            within = within && box.min[k] <= points[i][k] && points[i][k] <= box.max[k];
        if (within) numbers.push_back(i);
    }
    return numbers;
}

void lower_sides(const prepared_mesh& solid, points_view points, std::vector<std::int8_t>& side) {
    const mesh_view mesh = solid.indexed_view();
    const auto box = bounding_box(mesh.points);
    if (mesh.faces.empty() || solid.is_cloud() || !box) return;
    const auto numbers = points_in(*box, points);
    if (numbers.empty() || !detail::intersect::is_closed(solid)) return;
    std::vector<point3> within;
    within.reserve(numbers.size());
    for (const std::uint32_t i : numbers) within.push_back(points[i]);
    const auto found = detail::place::sides_of(mesh, build_face_tree(solid, "count_sides"), within);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        side[numbers[i]] = std::min(side[numbers[i]], found[i]);
}

}  // namespace

std::array<std::uint64_t, 3> count_sides(points_view points, const mesh_refs& given_solids) {
    const detail::base::prepared_refs all_solids(given_solids);
    const std::span<const prepared_mesh> solids = all_solids;
    detail::place::check_finite("count_sides", points);
    std::vector<std::int8_t> side(points.size(), 1);
    for (const prepared_mesh& solid : solids) lower_sides(solid, points, side);
    std::array<std::uint64_t, 3> counts{};
    for (const std::int8_t one : side) ++counts[static_cast<std::size_t>(one + 1)];
    return counts;
}

}  // namespace treeform
