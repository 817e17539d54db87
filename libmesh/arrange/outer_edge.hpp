#pragma once
/// \file
/// Finds an edge of a part of a surface next to the outside of that part.

#include <libmesh/arrange/face_side.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/arrange/numbered_sets.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/arrange/radial_order.hpp>
#include <treeform/tree/aabb.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::arrange {

/// The extent of a part of a surface. A part is a set of faces linked by edges; it consists of
/// whole input faces, so its extreme points are points of the input.
struct part_extent {
    std::uint32_t top = 0;  ///< its lexicographically greatest point, by x, then y, then z
    aabb<double, 3> box;    ///< its box, if there are several parts
    std::vector<std::uint32_t> faces_at_top{};  ///< ascending
};

/// [parts] \param parts the part of each patch
/// \same  on any number of threads
[[nodiscard]] std::vector<part_extent> find_extents(const mesh_arrangement& cut,
                                                    const surface_patches& patches,
                                                    const numbered_sets& parts);

/// The edge from a part's greatest point toward another corner of an input face. At its beginning,
/// face side `side` of the part is next to the unbounded region (ignoring other parts).
struct outer_edge {
    point3 from;
    point3 toward;  ///< y, or else z, differs from that of `from`
    face_side side;
};

/// \throws std::logic_error naming the point if faces of the part overlap
/// \cost   linear in the faces at the point
[[nodiscard]] outer_edge find_outer_edge(mesh_view mesh, const mesh_arrangement& cut,
                                         const part_extent& part, radial_order& radial);

}  // namespace treeform::detail::arrange
