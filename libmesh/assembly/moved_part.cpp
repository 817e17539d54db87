#include <libmesh/assembly/moved_part.hpp>
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <libmesh/place/relation_of.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

namespace treeform::detail::assembly {
namespace {

aabb<double, 3> widened(const box3& box, double by) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    aabb<double, 3> wide;
    wide.include(box.min);
    wide.include(box.max);
    if (by == 0.0) return wide;
    for (std::size_t k = 0; k < 3; ++k) {
        wide.min[k] = std::nextafter(wide.min[k] - by, -infinity);
        wide.max[k] = std::nextafter(wide.max[k] + by, infinity);
    }
    return wide;
}

/// Bounds how far a moved point, as computed, is from where it is moved to: in each coordinate
/// three products and three sums, each rounded by 2^-53 of what is at most `size`.
double rounding_of(const transform<3>& move, double largest) {
    double size = 0.0;
    for (const auto& row : move.rows)
        size = std::max(size, (std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2])) * largest +
                                  std::abs(row[3]));
    return size * 0x1p-49 + 0x1p-1000;
}

double largest_in(const box3& box) {
    return std::max(base::largest_of(box.min), base::largest_of(box.max));
}

/// Whether the columns are of length 1 and at right angles, to 2^-10: no length changes by more
/// than 2^-8 of itself.
bool is_motion(const transform<3>& move) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            double sum = i == j ? -1.0 : 0.0;
            for (const auto& row : move.rows) sum += row[i] * row[j];
            if (!(std::abs(sum) < 0x1p-10)) return false;
        }
    return true;
}

}  // namespace

std::vector<std::optional<box3>> boxes_of(std::span<const prepared_mesh> parts) {
    std::vector<std::optional<box3>> boxes(parts.size());
    base::for_numbers(parts.size(), 16, [&](std::size_t i) {
        boxes[i] = place::box_of_faces(parts[i].indexed_view());
    });
    return boxes;
}

std::vector<part_pair> near_pairs(const std::vector<std::optional<box3>>& boxes, double distance) {
    std::vector<std::uint32_t> number;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (boxes[i]) number.push_back(i);
    const tree<3> all = build(number, [&](std::uint32_t i) { return widened(*boxes[i], 0.0); });
    constexpr std::size_t grain = 64;
    std::vector<std::vector<part_pair>> found(chunk_count(number.size(), grain));
    for_chunks(number.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t n = begin; n < end; ++n) {
            const std::uint32_t i = number[n];
            search(all, widened(*boxes[i], distance), [&](std::uint32_t other) {
                const std::uint32_t j = number[other];
                if (j > i && place::within(*boxes[i], *boxes[j], distance))
                    found[chunk].push_back({i, j});
            });
        }
    });
    std::vector<part_pair> pairs;
    for (const auto& one : found) pairs.insert(pairs.end(), one.begin(), one.end());
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

std::vector<part_pair> sorted_pairs(const char* function, std::span<const part_pair> pairs,
                                    std::size_t count) {
    std::vector<part_pair> sorted;
    for (const auto& [a, b] : pairs) {
        if (std::max(a, b) >= count)
            throw std::invalid_argument(std::string("treeform::") + function +
                                        ": an ignored pair has part " +
                                        std::to_string(std::max(a, b)) + ", but there are " +
                                        std::to_string(count) + " parts");
        sorted.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    return sorted;
}

resting_part::resting_part(const prepared_mesh& mesh, vertex_identity vertices)
    : shape_(mesh, vertices),
      box_(place::box_of_faces(mesh.indexed_view())),
      solid_(box_ && shape_.closed()) {
    if (!box_) return;
    const mesh_view joined = shape_.joined();
    const auto component = face_components(joined.points.size(), joined.faces);
    for (std::size_t f = 0; f < joined.faces.size(); ++f)
        if (component[f] == corners_.size()) corners_.push_back(joined.points[joined.faces[f][0]]);
}

moved_part::moved_part(const resting_part& part, const transform<3>& move)
    : part_(&part), move_(move) {
    if (!part.box()) return;
    const box3& at = *part.box();
    const double error = rounding_of(move, largest_in(at)) * 4.0;
    box_.emplace();
    for (std::size_t k = 0; k < 3; ++k) {
        double middle = move.rows[k][3], half = error;
        for (std::size_t j = 0; j < 3; ++j) {
            middle += move.rows[k][j] * (0.5 * at.min[j] + 0.5 * at.max[j]);
            half += std::abs(move.rows[k][j]) * (0.5 * at.max[j] - 0.5 * at.min[j]);
        }
        box_->min[k] = middle - half;
        box_->max[k] = middle + half;
    }
}

bool moved_part::near(const moved_part& other, double distance) const {
    if (!box_ || !other.box_) return false;
    // Not finite where coordinates are huge: then the boxes keep nothing apart.
    for (std::size_t k = 0; k < 3; ++k)
        if (box_->min[k] - other.box_->max[k] > distance ||
            other.box_->min[k] - box_->max[k] > distance)
            return false;
    return true;
}

std::vector<point3> moved_part::points() const {
    const points_view at = part_->shape().mesh().points;
    std::vector<point3> moved(at.begin(), at.end());
    for (point3& p : moved) p = move_(p);
    return moved;
}

part_relation moved_part::as_moved(const moved_part& other) const {
    const std::vector<point3> a = points(), b = other.points();
    const place::shape &of_a = part_->shape(), &of_b = other.part_->shape();
    const tree<3> tree_a = build_face_tree(mesh_view{a, of_a.mesh().faces}),
                  tree_b = build_face_tree(mesh_view{b, of_b.mesh().faces});
    const auto how = place::relation_of(
        place::shape(of_a.prepared(), a, tree_a, of_a.vertices(), move_.mirrors()),
        place::shape(of_b.prepared(), b, tree_b, of_b.vertices(), other.move_.mirrors()));
    return {how.relation == mesh_relation::penetrating ? mesh_relation::penetrating
            : how.relation == mesh_relation::touching  ? mesh_relation::touching
                                                       : mesh_relation::disjoint};
}

/// Whether `p` is inside the solid that is moved; none where rounding might have a say.
std::optional<bool> moved_part::holds(const point3& p) const {
    for (std::size_t k = 0; k < 3; ++k)
        if (p[k] < box_->min[k] || p[k] > box_->max[k]) return false;
    if (!is_motion(move_)) return std::nullopt;
    // q is about where p is before the motion: M q + t is within `miss` of p, as found by moving it
    // again. The corners as moved are within `moved` of where M v + t is. So along straight ways p
    // goes to M q + t, and each corner to M v + t, and on no such way the point meets the surface,
    // and the winding number does not change, if M q + t is further than both from the surface
    // moved exactly: if q is further than 1.01 times that from the surface at rest.
    const point3 q = detail::unchecked_inverse(move_)(p);
    if (!base::is_finite(q)) return std::nullopt;
    const point3 again = move_(q);
    const point3 off = base::minus(again, p);
    const double miss = base::largest_of(off) + rounding_of(move_, base::largest_of(q));
    const double moved = rounding_of(move_, largest_in(*part_->box()));
    const double margin = 2.0 * (miss + moved) * 1.7320508075688774;
    if (!std::isfinite(margin)) return std::nullopt;
    const place::shape& solid = part_->shape();
    if (nearness::closest_point_query_of(solid.prepared()).nearest(q, 2.0 * margin))
        return std::nullopt;
    return intersect::point_locator(solid.joined(), solid.faces()).locate(q).where ==
           location::inside;
}

/// Whether a component of `other`, of which no face meets this, is inside this.
std::optional<bool> moved_part::holds_part_of(const moved_part& other) const {
    if (!part_->solid()) return false;
    bool decided = true;
    for (const point3& corner : other.part_->corners()) {
        const auto inside = holds(other.move_(corner));
        if (inside && *inside) return true;
        decided = decided && inside.has_value();
    }
    if (!decided) return std::nullopt;
    return false;
}

part_relation moved_part::relation_to(const moved_part& other, double clearance) const {
    const place::shape &a = part_->shape(), &b = other.part_->shape();
    if (intersects(a.prepared(), b.prepared(), {move_, other.move_})) {
        face_pair_options crossing;
        crossing.transform_a = move_;
        crossing.transform_b = other.move_;
        crossing.first_only = true;
        crossing.kinds = pair_kind::crossing;
        const auto through = mesh_intersections(a.prepared(), b.prepared(), crossing);
        if (!through.pairs.empty()) return {mesh_relation::penetrating};
        return as_moved(other);
    }
    const auto inside = holds_part_of(other), around = other.holds_part_of(*this);
    if ((inside && *inside) || (around && *around)) return {mesh_relation::penetrating};
    if (!inside || !around) {
        const part_relation how = as_moved(other);
        if (how.relation != mesh_relation::disjoint) return how;
    }
    if (clearance == 0.0) return {mesh_relation::disjoint};
    const double apart =
        treeform::distance(a.prepared(), b.prepared(), {move_, other.move_, clearance});
    return apart < clearance ? part_relation{mesh_relation::closer_than_clearance, apart}
                             : part_relation{mesh_relation::clear};
}

}  // namespace treeform::detail::assembly
