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
    bool opposite = false;   ///< the input face is oriented against the face of the arrangement
    friend bool operator==(const covering_face&, const covering_face&) = default;
};

/// A conforming complex: two of its faces have a common corner, a common edge, or nothing in
/// common. As a point set it is the input's, degenerate faces apart.
///
/// Points below `given_points.size()` are the input's, with its numbers; the others are
/// `constructed`, each different from all others. Where faces of the input overlap, the arrangement
/// has one face for all of them, oriented as the lowest of them.
struct mesh_arrangement {
    std::vector<point3> given_points;         ///< [V] the input's
    std::vector<implicit_point> constructed;  ///< [K]
    std::vector<face> faces;                  ///< [F'] in the order of their lowest input face
    std::vector<std::size_t> cover_begin;     ///< [F' + 1] where a face's covers begin
    std::vector<covering_face> covers;        ///< face by face, ascending by face; the first is the
                                              ///< lowest and never opposite
    /// [F'] 1 for input faces as they are, that no other cuts or covers. In the coordinates of the
    /// input, they have an area, and two of them meet in common corners or a common edge only.
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
    std::vector<std::uint32_t> degenerate;  ///< input faces with collinear corners, left out
    std::uint64_t pairs = 0;                ///< of faces that meet beyond their shared corners
    std::uint64_t cut_faces = 0;            ///< input faces that are not a face of the result
    bool cancelled = false;
};

/// The arrangement of a mesh's faces, overlapping and crossing as they may.
///
/// Exact on the coordinates as given. Corners with equal coordinates are to be one point
/// (`join_equal_points`); several meshes are given as one. No face that meets nothing is looked at
/// twice: it comes out as it went in.
///
/// \pre    points that are corners differ from each other
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
