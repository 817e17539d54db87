#pragma once
/// \file
/// Triangle meshes cut along each other and along themselves, exactly.

#include <libmesh/exact/implicit_point.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform {

/// An input face that covers a face of an arrangement.
struct covering_face {
    std::uint32_t face = 0;  ///< of the input
    /// whether the input face is oriented against the face of the arrangement
    bool opposite = false;
    friend bool operator==(const covering_face&, const covering_face&) = default;
};

/// A conforming complex: any two of its faces share a corner, an edge or nothing. The point set is
/// that of the input without its degenerate faces.
///
/// Points below `given_points.size()` are those of the input; the others are `constructed`. No
/// constructed point equals another point. Where faces of the input overlap, the arrangement has
/// one face for all of them, oriented as the lowest of them.
struct mesh_arrangement {
    std::vector<point3> given_points;         ///< [V] points of the input
    std::vector<implicit_point> constructed;  ///< [K]
    std::vector<face> faces;                  ///< [F'] in the order of their lowest input face
    std::vector<std::size_t> cover_begin;     ///< [F' + 1] begin of the covers of each face
    /// input faces that cover each face, ascending; the first is never opposite
    std::vector<covering_face> covers;
    /// [F'] 1 for unchanged input faces, which no other face cuts or covers. They are not
    /// degenerate, and any two of them share only corners or an edge.
    std::vector<std::uint8_t> whole{};

    [[nodiscard]] std::span<const covering_face> covers_of(std::size_t f) const {
        return {covers.data() + cover_begin[f], cover_begin[f + 1] - cover_begin[f]};
    }
    [[nodiscard]] implicit_point point(std::uint32_t p) const {
        return p < given_points.size() ? implicit_point(given_points[p])
                                       : constructed[p - given_points.size()];
    }
};

struct arrange_faces_options {
    progress_callback progress{};
};

struct arrange_faces_result {
    mesh_arrangement cut;
    std::vector<std::uint32_t> degenerate;  ///< input faces with collinear corners, omitted
    std::uint64_t pairs = 0;      ///< number of pairs of faces that meet beyond shared corners
    std::uint64_t cut_faces = 0;  ///< number of input faces that are not a face of the result
    bool cancelled = false;
};

/// The arrangement of the faces of a mesh, which may overlap and cross.
///
/// Exact on the coordinates as given. Join corners with equal coordinates first
/// (`join_equal_points`), and several meshes to one. Faces that meet no other face are unchanged,
/// and cost nothing beyond the search for pairs.
///
/// \pre    no two corners with different numbers have equal coordinates
/// \throws std::invalid_argument naming a face with a corner out of range, or a point with a
///         coordinate that is not finite or beyond 2^1000
/// \cost   as `self_intersections`, and for the k constructed points of a cluster of overlapping
///         coplanar faces about O(k^1.5)
/// \same   on any number of threads
/// \source identity of points by exact comparison, one common subdivision of coplanar faces:
///         Levy, Exact predicates, exact constructions and combinatorics for mesh CSG, 2024
[[nodiscard]] TREEFORM_API arrange_faces_result
arrange_faces(mesh_view mesh, const arrange_faces_options& options = {});

}  // namespace treeform
