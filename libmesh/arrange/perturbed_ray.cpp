#include <libmesh/arrange/perturbed_ray.hpp>

#include <cassert>

namespace treeform::detail::arrange {
namespace {

constexpr point3 along_x{1, 0, 0};

/// The plane with its normal along +x.
cutting_plane facing_x(const plane_points& p, int faces) {
    return faces > 0 ? cutting_plane{p.a, p.a, p.b, p.a, p.c}
                     : cutting_plane{p.a, p.a, p.c, p.a, p.b};
}

}  // namespace

perturbed_ray::perturbed_ray(const point3& from, const point3& toward)
    : from_(from),
      toward_(toward),
      implicit_from_(from),
      implicit_toward_(toward),
      axis_(1),
      ahead_(treeform::compare(1, toward, from)) {
    if (ahead_ != 0) return;
    axis_ = 2;
    ahead_ = treeform::compare(2, toward, from);
    assert(ahead_ != 0);
}

std::optional<crossing> perturbed_ray::meet(const triangle3& t) const {
    const int faces = passes(t[0], t[1], t[2]);
    if (faces == 0) return std::nullopt;
    // The start has moved toward b: where v is in the plane, it is on the same side as b.
    int side = orient3d(t[0], t[1], t[2], from_);
    if (side == 0) side = orient3d(t[0], t[1], t[2], toward_);
    if (side != -faces) return std::nullopt;
    const plane_points plane{t[0], t[1], t[2]};
    return crossing{plane, faces, facing_x(plane, faces)};
}

double perturbed_ray::distance(const crossing& c) const {
    return cut_parameter(from_, along_x, c.cut);
}

// Planes are compared along the lines parallel to x through v and, where they are equally far
// there, through b: what differs at b differs by s times as much along the moved ray. Where they
// are equal at both, n x m for their normals n and m is parallel to the plane of both lines. The
// difference of x along the planes has the gradient ((n x m).z, -(n x m).y) / (n.x m.x) over
// (y, z), and (-d.z, d.y) times that is -(d . (n x m)) / (n.x m.x) without the x.
int perturbed_ray::compare(const crossing& c, const crossing& d) const {
    for (const point3& origin : {from_, toward_})
        if (const int sign = compare_cuts(origin, along_x, c.cut, d.cut); sign != 0) return sign;
    return -ahead_ * normal_cross(axis_, c.plane, d.plane) * c.faces * d.faces;
}

}  // namespace treeform::detail::arrange
