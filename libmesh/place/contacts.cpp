#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/place/contacts.hpp>
#include <libmesh/place/facing.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search_pair.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform::detail::place {
namespace {

using base::cross;
using base::dot;
using base::minus;
using base::triangle_of;

/// Along an edge; 0 where the feature is none.
point3 edge_of(const triangle3& t, triangle_feature on) {
    switch (on) {
        case triangle_feature::e0:
            return minus(t[1], t[0]);
        case triangle_feature::e1:
            return minus(t[2], t[1]);
        case triangle_feature::e2:
            return minus(t[0], t[2]);
        default:
            return {};
    }
}

/// Of the plane in which the features meet; on the side that the motion comes from.
point3 contact_normal(const triangle3& moving, const triangle3& fixed, feature_pair at,
                      const point3& motion) {
    point3 normal = unit_of(cross(edge_of(moving, at.on_a), edge_of(fixed, at.on_b)));
    if (normal == point3{} && at.on_a == triangle_feature::interior) normal = normal_of(moving);
    if (normal == point3{}) normal = normal_of(fixed);
    if (normal == point3{}) normal = normal_of(moving);
    if (dot(normal, motion) > 0.0) normal = {-normal.x, -normal.y, -normal.z};
    for (std::size_t k = 0; k < 3; ++k) normal[k] += 0.0;  // no -0
    return normal;
}

}  // namespace

std::vector<placement_contact> contacts_of(const shape& moving, const chosen_parts& parts,
                                           const sweep_result& met, const point3& motion) {
    std::vector<placement_contact> rows;
    for (const sweep_meeting& c : met.contacts) {
        const point3 normal = contact_normal(
            triangle_of(moving.mesh(), c.where.face_a),
            triangle_of(parts.parts[c.part].mesh(), c.where.face_b), c.where.at, motion);
        rows.push_back(
            {c.where.point, normal, c.where.face_a, c.where.face_b, parts.number[c.part]});
    }
    return rows;
}

std::vector<placement_contact> contacts_at(const shape& there, const surroundings& among,
                                           std::size_t limit, std::uint64_t& count) {
    std::vector<placement_contact> rows;
    const auto box = bounding_box(there.mesh().points);
    for (std::size_t number = 0; number < among.all().size(); ++number) {
        const auto& other = among.box_of(number);
        if (!box || !other || !within(*box, *other, 0.0)) continue;
        const shape part = among.shape_of(number);
        const auto found = intersect::mesh_intersections(there.mesh(), there.faces(), part.mesh(),
                                                         part.faces(), {.limit = limit});
        for (const std::uint64_t of_kind : found.counts) count += of_kind;
        for (const face_pair& pair : found.pairs) {
            const triangle3 a = triangle_of(there.mesh(), pair.a);
            const triangle3 b = triangle_of(part.mesh(), pair.b);
            const point3 n = normal_of(b);
            const bool turned = looks_inward(part, pair.b);
            rows.push_back({closest_pair(a, b).on_b,
                            turned ? point3{0.0 - n.x, 0.0 - n.y, 0.0 - n.z} : n, pair.a, pair.b,
                            number});
        }
    }
    return rows;
}

std::optional<placement_contact> contact_with_bed(mesh_view mesh) {
    std::optional<placement_contact> lowest;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (const std::uint32_t corner : mesh.faces[f]) {
            const point3& p = mesh.points[corner];
            if (lowest && !(p.z < lowest->point.z)) continue;
            lowest = placement_contact{p, {0.0, 0.0, 1.0}, f, std::nullopt, 0};
        }
    return lowest;
}

}  // namespace treeform::detail::place

namespace treeform {
namespace {

using detail::base::triangle_of;

using detail::place::shape;
using relations = std::vector<mesh_relation>;

int gravity(mesh_relation how) {
    constexpr std::array<int, 5> of{0, 2, 3, 1, 0};
    return of[static_cast<std::size_t>(how)];
}

/// The gravest relation stays.
void mark(mesh_relation& present, mesh_relation one) {
    if (gravity(one) > gravity(present)) present = one;
}

void mark_meeting(const shape& placed, const shape& part, relations& a, relations& b) {
    const auto found = detail::intersect::mesh_intersections(placed.mesh(), placed.faces(),
                                                             part.mesh(), part.faces());
    for (const face_pair& pair : found.pairs) {
        const mesh_relation one =
            pair.kind == pair_kind::crossing ? mesh_relation::penetrating : mesh_relation::touching;
        mark(a[pair.a], one);
        mark(b[pair.b], one);
    }
}

void mark_near(const shape& placed, const shape& part, double clearance, relations& a,
               relations& b) {
    const mesh_view mesh = placed.mesh();
    const auto wide = build(mesh.faces, [&](const face& f) {
        aabb<double, 3> box;
        for (const std::uint32_t corner : f) box.include(mesh.points[corner]);
        constexpr double infinity = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] = std::nextafter(box.min[k] - clearance, -infinity);
            box.max[k] = std::nextafter(box.max[k] + clearance, infinity);
        }
        return box;
    });
    using pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
    const auto chunks =
        search<pairs>(wide, part.faces(), [&](pairs& mine, std::uint32_t i, std::uint32_t j) {
            const auto near = closest_pair(triangle_of(mesh, i), triangle_of(part.mesh(), j));
            if (std::sqrt(near.squared_distance) < clearance) mine.emplace_back(i, j);
            return false;
        });
    for (const pairs& chunk : chunks)
        for (const auto& [i, j] : chunk) {
            mark(a[i], mesh_relation::closer_than_clearance);
            mark(b[j], mesh_relation::closer_than_clearance);
        }
}

/// A clearance that was given is kept: what stopped at it is not closer, and shown all the same.
void mark_contacts(mesh_view placed, std::span<const prepared_mesh> fixed, const placement& at,
                   std::vector<relations>& found) {
    const mesh_relation one =
        at.clearance > 0.0 ? mesh_relation::closer_than_clearance : mesh_relation::touching;
    for (const placement_contact& c : at.contacts) {
        mark(found[0][c.moving], one);
        if (!c.fixed_face) continue;
        found[1 + c.fixed].resize(fixed[c.fixed].indexed_view().faces.size());
        mark(found[1 + c.fixed][*c.fixed_face], one);
    }
    if (at.outcome != placement_outcome::bed || !at.bed) return;
    for (std::uint32_t f = 0; f < placed.faces.size(); ++f)
        for (const std::uint32_t corner : placed.faces[f])
            if (placed.points[corner].z <= *at.bed) mark(found[0][f], one);
}

}  // namespace

const mesh& placed_mesh::value() const& {
    if (!certificate) throw not_certified_error(certificate, reason);
    return mesh;
}

mesh placed_mesh::value() && {
    if (!certificate) throw not_certified_error(std::move(certificate), reason);
    return std::move(mesh);
}

placed_mesh placement::moved(const mesh_ref& placed) const {
    placed_mesh made{.certificate = certificate, .reason = message()};
    if (!certificate) return made;
    if (placed.view().points.size() != points.size())
        throw std::invalid_argument(
            "treeform::placement::moved: " + std::to_string(placed.view().points.size()) +
            " points, not " + std::to_string(points.size()));
    made.mesh = {points, {placed.view().faces.begin(), placed.view().faces.end()}};
    return made;
}

std::vector<relations> placement::face_relations(const mesh_ref& given_moving,
                                                 const mesh_refs& given_fixed) const {
    const placement& at = *this;
    const detail::base::prepared_ref moving(given_moving);
    const detail::base::prepared_refs all_fixed(given_fixed);
    const std::span<const prepared_mesh> fixed = all_fixed;
    const mesh_view here = moving.view();
    const mesh_view there{at.points, here.faces};
    std::optional<tree<3>> own;
    if (!std::equal(here.points.begin(), here.points.end(), at.points.begin(), at.points.end()))
        own = build_face_tree(there);
    const shape placed = own ? shape(moving, at.points, *own) : shape(moving);
    const auto box = detail::place::box_of_faces(there);
    std::vector<relations> found(1 + fixed.size());
    found[0].resize(here.faces.size());
    for (std::size_t i = 0; i < fixed.size(); ++i) {
        const auto other = bounding_box(fixed[i].indexed_view().points);
        if (!box || !other || !detail::place::within(*box, *other, at.clearance)) continue;
        const shape part(fixed[i]);
        found[1 + i].resize(part.mesh().faces.size());
        if (at.clearance > 0.0) mark_near(placed, part, at.clearance, found[0], found[1 + i]);
        mark_meeting(placed, part, found[0], found[1 + i]);
    }
    mark_contacts(there, fixed, at, found);
    return found;
}

}  // namespace treeform
