#pragma once
/// \file
/// Locates the parts of a surface that share no edge in the regions of the other parts.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/arrange/patches.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::arrange {

/// The outermost side of a part, and the side of another part next to the same region.
struct part_place {
    face_side outer = 0;  ///< a side of one of the part's faces
    /// a side of another part's face next to the same region; none if that is unbounded
    std::optional<face_side> beyond{};
};

/// [parts] \param parts the part of each patch
///
/// Together with the order of faces around edges, this determines the regions of space without the
/// surface: parts share only points, so each lies in one region of any other, and following
/// `beyond` leads outward until the inside of the surrounding part is reached.
///
/// \throws std::logic_error naming a point or face at which the faces are not a valid arrangement
/// \same   on any number of threads
[[nodiscard]] std::vector<part_place> place_parts(mesh_view mesh, const mesh_arrangement& cut,
                                                  const surface_patches& patches,
                                                  const numbered_sets& parts);

}  // namespace treeform::detail::arrange
