#pragma once
/// \file
/// Whether the faces of a closed mesh are oriented outward or inward.

#include <libmesh/place/shape.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::place {

/// Whether the space in front of a face, and that behind it, is inside the mesh. For an outward
/// face only the space behind it is inside; where the mesh winds twice, both may be.
struct inside_sides {
    bool front = false;
    bool behind = true;
};

/// A point is inside where the winding number is not 0, as in `locate` and `boolean`. For an
/// edge-connected component that intersects neither itself nor others, the sides are the same at
/// all of its faces: its own winding number is 0 on one side and 1 or -1 on the other, by the sign
/// of its volume, and that of the other components is constant.
class facing {
  public:
    /// \pre the mesh is closed, with corners of equal coordinates joined
    explicit facing(const prepared_mesh& mesh);

    [[nodiscard]] inside_sides of(std::uint32_t face) const {
        return sides_[component_of_face_[face]];
    }
    /// Number of components with a negative volume that are inside no other component.
    [[nodiscard]] std::uint64_t inside_out() const { return inside_out_; }

  private:
    std::vector<std::uint32_t> component_of_face_{};
    std::vector<inside_sides> sides_{};  ///< by component
    std::uint64_t inside_out_ = 0;
};

/// The `facing` of `mesh`, which `mesh` caches.
///
/// \pre  as `facing`
/// \cost once, O(F log d), and a ray for each component if there are several
/// \same on any number of threads
[[nodiscard]] const facing& facing_of(const prepared_mesh& mesh);

/// The sides of a face of the placed mesh; a mirrored placement exchanges them. \pre it is closed
[[nodiscard]] inside_sides sides_beside(const shape& of, std::uint32_t face);

/// Whether the space in front of the face is inside and the space behind it is not. False for open
/// meshes and clouds, which have no inside.
[[nodiscard]] bool looks_inward(const shape& of, std::uint32_t face);

}  // namespace treeform::detail::place
