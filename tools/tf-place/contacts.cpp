#include "tools/tf-place/contacts.hpp"

#include <libmesh/geometry/triangle_distance.hpp>
#include <treeform/mesh/mesh_intersections.hpp>
#include <treeform/tf.hpp>

#include <cmath>

namespace tools {
namespace {

double dot(const tf::point3& a, const tf::point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

tf::point3 cross(const tf::point3& a, const tf::point3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

tf::point3 minus(const tf::point3& a, const tf::point3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// Of length 1; 0 where there is no direction.
tf::point3 unit(const tf::point3& v) {
    const double size = length(v);
    if (!(size > 0.0) || !std::isfinite(size)) return {};
    return {v.x / size, v.y / size, v.z / size};
}

tf::triangle3 triangle_of(tf::mesh_view mesh, std::uint32_t f) {
    const tf::face& corners = mesh.faces[f];
    return {mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]};
}

tf::point3 normal_of(const tf::triangle3& t) {
    return unit(cross(minus(t[1], t[0]), minus(t[2], t[0])));
}

/// Along an edge; 0 where the feature is none.
tf::point3 edge_of(const tf::triangle3& t, tf::feature on) {
    switch (on) {
        case tf::feature::e0:
            return minus(t[1], t[0]);
        case tf::feature::e1:
            return minus(t[2], t[1]);
        case tf::feature::e2:
            return minus(t[0], t[2]);
        default:
            return {};
    }
}

/// Of the plane in which the features meet; on the side that the motion comes from.
tf::point3 contact_normal(const tf::triangle3& moving, const tf::triangle3& fixed, tf::contact at,
                          const tf::point3& motion) {
    tf::point3 normal = unit(cross(edge_of(moving, at.on_a), edge_of(fixed, at.on_b)));
    if (normal == tf::point3{} && at.on_a == tf::feature::interior) normal = normal_of(moving);
    if (normal == tf::point3{}) normal = normal_of(fixed);
    if (normal == tf::point3{}) normal = normal_of(moving);
    if (dot(normal, motion) > 0.0) normal = {-normal.x, -normal.y, -normal.z};
    for (std::size_t k = 0; k < 3; ++k) normal[k] += 0.0;  // no -0
    return normal;
}

}  // namespace

std::vector<contact_row> contacts_of(const body& moving, const std::vector<body>& fixed,
                                     const chosen_parts& parts, const tf::slide_result& slid,
                                     const tf::point3& motion) {
    std::vector<contact_row> rows;
    for (const tf::slide_contact& c : slid.contacts) {
        const std::size_t part = parts.number[c.part];
        const body& other = fixed[part];
        const tf::point3 normal =
            contact_normal(triangle_of(moving.mesh, c.where.face_a),
                           triangle_of(other.mesh, c.where.face_b), c.where.at, motion);
        rows.push_back({c.where.point, normal, c.where.face_a, c.where.face_b, part});
    }
    return rows;
}

std::vector<contact_row> contacts_at(tf::mesh_view mesh, const tf::tree<3>& faces,
                                     std::vector<body>& fixed, std::size_t limit,
                                     std::uint64_t& count) {
    std::vector<contact_row> rows;
    const auto box = tf::bounding_box(mesh.points);
    for (std::size_t part = 0; part < fixed.size(); ++part) {
        body& other = fixed[part];
        bool apart = !box;
        for (std::size_t k = 0; k < 3 && !apart; ++k)
            apart = box->max[k] < other.box->min[k] || other.box->max[k] < box->min[k];
        if (apart) continue;
        const tf::still_part still = other.still();
        const auto found =
            tf::mesh_intersections(mesh, faces, still.mesh, *still.faces, {.limit = limit});
        for (const std::uint64_t of_kind : found.counts) count += of_kind;
        for (const tf::face_pair& pair : found.pairs) {
            const tf::triangle3 a = triangle_of(mesh, pair.a);
            const tf::triangle3 b = triangle_of(other.mesh, pair.b);
            rows.push_back({tf::closest_points(a, b).on_b, normal_of(b), pair.a, pair.b, part});
        }
    }
    return rows;
}

std::optional<contact_row> contact_with_bed(tf::mesh_view mesh) {
    std::optional<contact_row> lowest;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (const std::uint32_t corner : mesh.faces[f]) {
            const tf::point3& p = mesh.points[corner];
            if (lowest && !(p.z < lowest->point.z)) continue;
            lowest = contact_row{p, {0.0, 0.0, 1.0}, f, std::nullopt, 0};
        }
    return lowest;
}

}  // namespace tools
