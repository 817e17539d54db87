#pragma once
/// \file
/// The regions of space that an arrangement of faces bounds, and how often each operand's surface
/// winds around them.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform {

/// An edge of an arrangement along which an operand's faces run more often one way than the other:
/// there its surface ends.
struct open_arrangement_edge {
    std::uint32_t operand = 0;
    std::array<std::uint32_t, 2> points{};  ///< of the arrangement, ascending
    std::uint32_t face = 0;                 ///< the operand's lowest input face at that edge
    friend bool operator==(const open_arrangement_edge&, const open_arrangement_edge&) = default;
};

/// Cells are the connected parts of space without the surface, except for faces that bound nothing
/// as what covers them cancels out: cells that only such faces separate are one. Cell 0 is the
/// unbounded one; the others are in the order of the lowest faces next to them.
struct arrangement_cells {
    /// The number of operands, k.
    std::size_t operands = 0;
    /// [F'][2] the cell in front of each face (to which its normal points) and the one behind it.
    std::vector<std::array<std::uint32_t, 2>> cell_of_side;
    /// [C][k] winding number of each operand's surface around each cell. Two cells next to each
    /// other differ in a row, two others may not.
    std::vector<std::int32_t> winding;
    /// The first open edges, in the order of their points, then operands, at most 100: then the
    /// operands bound nothing, and all above is empty.
    std::vector<open_arrangement_edge> open;
    std::uint64_t open_count = 0;

    [[nodiscard]] std::span<const std::int32_t> winding_of(std::uint32_t cell) const {
        return {winding.data() + cell * operands, operands};
    }
};

/// The cells of `cut`, the arrangement of `mesh`.
///
/// Exact. Faces around an edge are sorted by the planes of the input faces they lie in. A part of
/// the surface that shares no edge with the rest, points perhaps, is placed in it by one ray
/// from the part's greatest point, which is always a point of the input; the ray is moved by less
/// than any number, so that it grazes nothing.
///
/// Without faces, the one cell is the unbounded one.
///
/// \param  operand_of_face  [F] of the input: which operand each face belongs to
/// \pre    `cut` is `arrange_faces(mesh).cut`
/// \throws std::invalid_argument naming the lowest face whose operand is not less than
///         `operand_count`, or when `cut` has not as many points as `mesh`, or numbers that are no
///         points or faces; std::logic_error naming an edge, point or face where `cut` is no
///         arrangement and contradicts itself
/// \cost   O(V' + F' log d) time for at most d faces at an edge or point, some 40 bytes a face; and
///         one ray for each part, with a tree of the faces that such rays may meet when there are
///         several parts, one beside another in direction x; C k windings
/// \same   on any number of threads
/// \source Zhou, Grinspun, Zorin and Jacobson, Mesh Arrangements for Solid Geometry, SIGGRAPH 2016,
///         for cells, winding vectors and which inputs have them; here without constructed normals
[[nodiscard]] TREEFORM_API arrangement_cells
find_cells(mesh_view mesh, const mesh_arrangement& cut,
           std::span<const std::uint32_t> operand_of_face, std::size_t operand_count);

}  // namespace treeform
