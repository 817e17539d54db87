#include <libmesh/arrange/perturbed_ray.hpp>
#include <libmesh/exact/plane_predicates.hpp>

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace treeform::detail::arrange {
namespace {

constexpr std::array<point3, 3> direction = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// The plane with its normal along the ray.
cutting_plane facing_along(const plane_points& p, int faces) {
    return faces > 0 ? cutting_plane{p.a, p.a, p.b, p.a, p.c}
                     : cutting_plane{p.a, p.a, p.c, p.a, p.b};
}

crossing cross_of(const triangle3& t, int faces) {
    const plane_points plane{t[0], t[1], t[2]};
    return {plane, faces, facing_along(plane, faces)};
}

}  // namespace

perturbed_ray::perturbed_ray(const point3& from, const point3& toward, int along)
    : from_(from),
      toward_(toward),
      implicit_from_(from),
      implicit_toward_(toward),
      along_(along),
      axis_((along + 1) % 3),
      ahead_(treeform::compare(axis_, toward, from)) {
    if (ahead_ != 0) return;
    axis_ = (along + 2) % 3;
    ahead_ = treeform::compare(axis_, toward, from);
    assert(ahead_ != 0);
}

std::optional<crossing> perturbed_ray::meet(const triangle3& t) const {
    const int faces = passes(t[0], t[1], t[2]);
    if (faces == 0) return std::nullopt;
    // The start has moved toward b: where v is in the plane, it is on the same side as b.
    int side = orient3d(t[0], t[1], t[2], from_);
    if (side == 0) side = orient3d(t[0], t[1], t[2], toward_);
    if (side != -faces) return std::nullopt;
    return cross_of(t, faces);
}

double perturbed_ray::distance(const crossing& c) const {
    return cut_parameter(from_, direction[static_cast<std::size_t>(along_)], c.cut);
}

// Of a ray along x: planes are compared along the lines parallel to x through v and, where they are
// equally far there, through b: what differs at b differs by s times as much along the moved ray.
// Where they are equal at both, n x m for their normals n and m is parallel to the plane of both
// lines. The difference of x along the planes has the gradient ((n x m).z, -(n x m).y) / (n.x m.x)
// over (y, z), and (-d.z, d.y) times that is -(d . (n x m)) / (n.x m.x) without the x.
int perturbed_ray::compare(const crossing& c, const crossing& d) const {
    for (const point3& origin : {from_, toward_})
        if (const int sign =
                compare_cuts(origin, direction[static_cast<std::size_t>(along_)], c.cut, d.cut);
            sign != 0)
            return sign;
    return -ahead_ * normal_cross(axis_, c.plane, d.plane) * c.faces * d.faces;
}

perturbed_ray ray_beside(const point3& q, int along) {
    point3 toward = q;
    const auto aside = static_cast<std::size_t>((along + 1) % 3);
    toward[aside] = std::nextafter(q[aside], std::numeric_limits<double>::infinity());
    return {q, toward, along};
}

}  // namespace treeform::detail::arrange
