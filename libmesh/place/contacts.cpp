#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/place/contacts.hpp>
#include <libmesh/place/facing.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cmath>

namespace treeform::detail::place {
namespace {

using base::cross;
using base::dot;
using base::minus;
using base::triangle_of;

/// Of length 1; 0 where there is no direction.
point3 unit(const point3& v) {
    const double size = std::hypot(v.x, v.y, v.z);
    if (!(size > 0.0) || !std::isfinite(size)) return {};
    return {v.x / size, v.y / size, v.z / size};
}

point3 normal_of(const triangle3& t) { return unit(cross(minus(t[1], t[0]), minus(t[2], t[0]))); }

/// Along an edge; 0 where the feature is none.
point3 edge_of(const triangle3& t, feature on) {
    switch (on) {
        case feature::e0:
            return minus(t[1], t[0]);
        case feature::e1:
            return minus(t[2], t[1]);
        case feature::e2:
            return minus(t[0], t[2]);
        default:
            return {};
    }
}

/// Of the plane in which the features meet; on the side that the motion comes from.
point3 contact_normal(const triangle3& moving, const triangle3& fixed, contact at,
                      const point3& motion) {
    point3 normal = unit(cross(edge_of(moving, at.on_a), edge_of(fixed, at.on_b)));
    if (normal == point3{} && at.on_a == feature::interior) normal = normal_of(moving);
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
            rows.push_back({closest_points(a, b).on_b,
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
