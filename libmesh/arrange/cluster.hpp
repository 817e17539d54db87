#pragma once
/// \file
/// The common subdivision of input faces that overlap in one plane.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/base/fill_stars.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/intersect/meetings.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::arrange {

/// A part of the plane: its corners turn left about the normal of the first cover.
/// Points are of the input, then named, then `made` by this cluster, in that order of numbers.
struct cluster_face {
    std::array<std::uint32_t, 3> corners{};
    std::size_t covers = 0;  ///< where its covers begin
};

struct cut_cluster {
    std::vector<implicit_point> made;   ///< points where lines cross that no two faces name
    std::vector<cluster_face> faces;    ///< ascending by first cover
    std::vector<covering_face> covers;  ///< face by face
    /// Numbers of points that turned out to be one point.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> same;
};

/// The numbers of the meetings of each face, ascending.
using meetings_by_face = base::faces_by_point<std::uint64_t>;

/// What a cluster needs to know of the mesh.
struct cluster_input {
    mesh_view mesh;
    const intersect::mesh_meetings* met;
    std::span<const std::uint32_t> members;  ///< faces that overlap in one plane, ascending
    const meetings_by_face* by_face;
    std::pmr::memory_resource* memory;  ///< of all that is not in the result
};

[[nodiscard]] cut_cluster cut(const cluster_input& input);

}  // namespace treeform::detail::arrange
