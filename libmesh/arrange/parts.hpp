#pragma once
/// \file
/// Parts of a surface that share no edge: which region each one lies in.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/arrange/patches.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::arrange {

/// The outermost side of a part, and what is beyond it.
struct part_place {
    face_side outer = 0;                ///< of one of the part's faces
    std::optional<face_side> beyond{};  ///< a side of another part's face that looks into the same
                                        ///< region; none where that reaches infinity
};

/// [parts] \param parts the part of each patch
///
/// Together with what edges tell, this tells the regions of space without the surface: parts
/// have no more than points in common, so each lies in one region of any other, and following
/// `beyond` leads outwards until the surrounding part is met from inside.
///
/// \throws std::logic_error naming a point or face where the faces are no arrangement
/// \same   on any number of threads
[[nodiscard]] std::vector<part_place> place_parts(mesh_view mesh, const mesh_arrangement& cut,
                                                  const surface_patches& patches,
                                                  const numbered_sets& parts);

}  // namespace treeform::detail::arrange
