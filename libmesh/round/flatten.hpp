#pragma once
/// \file
/// Parts of a surface that all but lie in one plane get as few corners as their rims need.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::round {

struct flatten_options {
    double reach = 0.0;  ///< how far corners may be from a plane, a straight rim, and each other
    bool solid = true;   ///< the faces bound a solid: what covers each other back to back goes
    std::span<const std::uint8_t> fixed{};  ///< [F] 1 for faces that are to stay; or empty
};

struct flattened {
    std::vector<point3> points;  ///< those given, then where rims cross
    std::vector<face> faces;
    std::vector<std::uint32_t>
        face_of;                       ///< [F] face that the middle of each one lies in, or next to
    std::vector<std::uint8_t> is_new;  ///< [F] 0 for faces that are as they were
    std::uint64_t parts = 0;           ///< with other faces than before
};

/// Where faces that were meant to lie in one plane do so but for rounding, as of a CAD part that
/// was turned, cutting them along each other makes many pieces, as far apart as rounding moves
/// them. Each flat part, as it grows over edges from the largest face listed that is not in one
/// yet, becomes triangles between the corners of its rim. Before that, short edges go; rims between
/// two parts become straight where they are within reach of that. A part whose rim crosses itself
/// then keeps all of its rim, or stays as it is.
///
/// Points stay where they are. A closed surface stays closed. Whether less meets afterwards is for
/// the caller to see.
///
/// \param  begin_at  faces, ascending
/// \cost   O(F log F), and O(n^1.5) for the n corners of a rim
/// \same   on any number of threads
[[nodiscard]] std::optional<flattened> flatten(mesh_view surface,
                                               std::span<const std::uint32_t> begin_at,
                                               const flatten_options& options);

}  // namespace treeform::detail::round
