#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search_pair.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace treeform {
namespace {

using detail::base::triangle_of;

using detail::place::shape;
using classes = std::vector<contact_class>;

/// The gravest class stays.
void mark(contact_class& present, contact_class one) {
    if (present == contact_class::none || one < present) present = one;
}

void mark_meeting(const shape& placed, const shape& part, classes& a, classes& b) {
    const auto found = detail::intersect::mesh_intersections(placed.mesh(), placed.faces(),
                                                             part.mesh(), part.faces());
    for (const face_pair& pair : found.pairs) {
        const contact_class one =
            pair.kind == pair_kind::crossing ? contact_class::penetrating : contact_class::touching;
        mark(a[pair.a], one);
        mark(b[pair.b], one);
    }
}

void mark_near(const shape& placed, const shape& part, double clearance, classes& a, classes& b) {
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
            const auto near = closest_points(triangle_of(mesh, i), triangle_of(part.mesh(), j));
            if (std::sqrt(near.squared_distance) < clearance) mine.emplace_back(i, j);
            return false;
        });
    for (const pairs& chunk : chunks)
        for (const auto& [i, j] : chunk) {
            mark(a[i], contact_class::near);
            mark(b[j], contact_class::near);
        }
}

/// A clearance that was given is kept: what stopped at it is not closer, and shown all the same.
void mark_contacts(mesh_view placed, std::span<const prepared_mesh> fixed, const placement& at,
                   contact_classes& found) {
    const contact_class one = at.clearance > 0.0 ? contact_class::near : contact_class::touching;
    for (const placement_contact& c : at.contacts) {
        mark(found.moving[c.moving], one);
        if (!c.fixed_face) continue;
        found.fixed[c.fixed].resize(fixed[c.fixed].view().faces.size());
        mark(found.fixed[c.fixed][*c.fixed_face], one);
    }
    if (!at.on_bed || !at.bed) return;
    for (std::uint32_t f = 0; f < placed.faces.size(); ++f)
        for (const std::uint32_t corner : placed.faces[f])
            if (placed.points[corner].z <= *at.bed) mark(found.moving[f], one);
}

}  // namespace

contact_classes contact_classes::of(const mesh_ref& given_moving, const mesh_refs& given_fixed,
                                    const placement& at) {
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
    contact_classes found{classes(here.faces.size()), std::vector<classes>(fixed.size())};
    for (std::size_t i = 0; i < fixed.size(); ++i) {
        const auto other = bounding_box(fixed[i].view().points);
        if (!box || !other || !detail::place::within(*box, *other, at.clearance)) continue;
        const shape part(fixed[i]);
        found.fixed[i].resize(part.mesh().faces.size());
        if (at.clearance > 0.0) mark_near(placed, part, at.clearance, found.moving, found.fixed[i]);
        mark_meeting(placed, part, found.moving, found.fixed[i]);
    }
    mark_contacts(there, fixed, at, found);
    return found;
}

}  // namespace treeform
