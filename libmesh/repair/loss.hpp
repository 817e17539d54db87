#pragma once
/// \file
/// How much of a mesh an operation has lost.

#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::repair {

/// Volume where both are solids, else area.
struct loss {
    double before = 0.0;
    double after = 0.0;
    bool is_volume = false;

    [[nodiscard]] bool is_beyond(double share) const { return after < (1.0 - share) * before; }
};

/// What `made` has lost of `given`.
///
/// The volume of `given` is that of the solid that it is meant to be: with cracks closed, its faces
/// made to agree, overlaps counted once (`repair` without filling). Where that is open, its area
/// counts, that of faces with the same corners once.
///
/// \pre  no two faces of `made` meet
/// \cost as `repair`
/// \same on any number of threads
[[nodiscard]] loss find_loss(mesh_view given, mesh_view made);

/// Whether a component, by vertices, has a negative volume.
[[nodiscard]] bool has_inward_component(mesh_view mesh);

}  // namespace treeform::detail::repair
