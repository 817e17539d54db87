#pragma once
/// \file
/// Which way the faces of a closed mesh look: out of what is inside, or into it.

#include <libmesh/place/shape.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::place {

/// Whether what is in front of a face is inside its mesh, and what is behind it. Of a face that
/// looks outward only what is behind it is; where a mesh winds twice, both may be.
struct inside_sides {
    bool front = false;
    bool behind = true;
};

/// What is inside is where the winding number is not 0, as in `locate` and `boolean`. It is the
/// same beside all faces of a component, which edges link, that does not pass through itself or
/// others: there its own winding number is 0 on one side and 1 or -1 on the other, by the sign of
/// its volume, and that of the other components is the same everywhere.
class facing {
  public:
    /// \pre the mesh is closed, with corners of equal coordinates joined
    explicit facing(const prepared_mesh& mesh);

    [[nodiscard]] inside_sides of(std::uint32_t face) const {
        return sides_[component_of_face_[face]];
    }
    /// Components with a negative volume that are in no other one.
    [[nodiscard]] std::uint64_t inside_out() const { return inside_out_; }

  private:
    std::vector<std::uint32_t> component_of_face_{};
    std::vector<inside_sides> sides_{};  ///< of each component
    std::uint64_t inside_out_ = 0;
};

/// The same, which the mesh keeps.
///
/// \pre  as `facing`
/// \cost once, O(F log d), and a ray for each component where there are several
/// \same on any number of threads
[[nodiscard]] const facing& facing_of(const prepared_mesh& mesh);

/// Of a face of the mesh where it is: a mirror exchanges the sides. \pre it is closed
[[nodiscard]] inside_sides sides_beside(const shape& of, std::uint32_t face);

/// Whether what is in front of a face is inside, and what is behind it is not; false for an open
/// mesh and for a cloud, which have no inside.
[[nodiscard]] bool looks_inward(const shape& of, std::uint32_t face);

}  // namespace treeform::detail::place
