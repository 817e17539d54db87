#pragma once
/// \file
/// The regions of space that an arrangement of faces bounds, with the winding number of each
/// operand.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform {

/// An open edge of an arrangement: the signed face count of an operand is not zero.
struct open_arrangement_edge {
    std::uint32_t operand = 0;
    std::array<std::uint32_t, 2> points{};  ///< of the arrangement, ascending
    std::uint32_t face = 0;                 ///< the operand's lowest input face at that edge
    friend bool operator==(const open_arrangement_edge&, const open_arrangement_edge&) = default;
};

/// Cells are the connected components of space without the surface. Faces whose covers cancel out
/// do not separate cells. Cell 0 is the unbounded one; the others are in the order of the lowest
/// faces next to them.
struct arrangement_cells {
    /// The number of operands, k.
    std::size_t operands = 0;
    /// [F'][2] the cell in front of each face (to which its normal points) and the one behind it.
    std::vector<std::array<std::uint32_t, 2>> cell_of_side;
    /// [C][k] winding number of each operand's surface around each cell. The rows of adjacent cells
    /// differ; those of other cells may be equal.
    std::vector<std::int32_t> winding;
    /// The first 100 open edges, in the order of their points, then operands. If there are any, the
    /// operands bound nothing, and the members above are empty.
    std::vector<open_arrangement_edge> open;
    std::uint64_t open_count = 0;

    [[nodiscard]] std::span<const std::int32_t> winding_of(std::uint32_t cell) const {
        return {winding.data() + cell * operands, operands};
    }
};

/// The cells of `cut`, the arrangement of `mesh`.
///
/// Exact. Faces around an edge are sorted by the planes of the input faces that contain them. A
/// part of the surface that shares no edge with the rest (perhaps points) is located in it by one
/// ray from the part's greatest point, which is always a point of the input; the ray is perturbed
/// symbolically, so that it grazes nothing.
///
/// Without faces, the unbounded cell is the only one.
///
/// \param  operand_of_face  [F of the input] the operand of each face
/// \pre    `cut` is `arrange_faces(mesh).cut`
/// \throws std::invalid_argument naming the lowest face whose operand is not less than
///         `operand_count`, if `cut` and `mesh` differ in the number of points, or for point or
///         face numbers out of range; std::logic_error naming an edge, point or face at which `cut`
///         is not a valid arrangement
/// \cost   O(V' + F' log d) time for at most d faces at an edge or point, about 40 bytes a face;
///         one ray for each part, and a tree over the faces that such rays may meet if several
///         parts overlap in direction x; C k winding numbers
/// \same   on any number of threads
/// \source Zhou, Grinspun, Zorin and Jacobson, Mesh Arrangements for Solid Geometry, SIGGRAPH 2016,
///         for cells, winding vectors and the inputs for which they exist; here without constructed
///         normals
[[nodiscard]] TREEFORM_API arrangement_cells
find_cells(mesh_view mesh, const mesh_arrangement& cut,
           std::span<const std::uint32_t> operand_of_face, std::size_t operand_count);

}  // namespace treeform
