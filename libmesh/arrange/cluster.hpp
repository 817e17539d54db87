#pragma once
/// \file
/// The common subdivision of coplanar input faces that overlap.

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

/// A triangle of the subdivision, counter-clockwise about the normal of its first cover. Point
/// numbers: first points of the input, then named points, then those `made` by this cluster.
struct cluster_face {
    std::array<std::uint32_t, 3> corners{};
    std::size_t covers = 0;  ///< begin of its covers
};

struct cut_cluster {
    std::vector<implicit_point> made;   ///< crossings of lines that have no name from two faces
    std::vector<cluster_face> faces;    ///< ascending by first cover
    std::vector<covering_face> covers;  ///< the covers of all faces, face by face
    /// Pairs of point numbers that are equal points.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> same;
};

/// The numbers of the meetings of each face, ascending.
using meetings_by_face = base::faces_by_point<std::uint64_t>;

/// The input of a cluster.
struct cluster_input {
    mesh_view mesh;
    const intersect::mesh_meetings* met;
    std::span<const std::uint32_t> members;  ///< faces that overlap in one plane, ascending
    const meetings_by_face* by_face;
    std::pmr::memory_resource* memory;  ///< for temporary data
};

[[nodiscard]] cut_cluster cut(const cluster_input& input);

}  // namespace treeform::detail::arrange
