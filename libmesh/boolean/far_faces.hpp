#pragma once
/// \file
/// Faces that are not near a cut, in sets of faces that an operation treats alike.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// Faces linked by points, within each block of 64 faces in the order of the mesh's tree.
struct face_clusters {
    /// [F] cluster of the face at each place of the tree's order
    std::vector<std::uint32_t> of_place;
    std::vector<std::uint32_t> first_place;            ///< [C]
    std::vector<std::array<std::uint32_t, 2>> linked;  ///< pairs of clusters with a common point
};

/// The clusters of a mesh, which caches them. \cost O(F), about 5 bytes a face \same on any number
/// of threads
[[nodiscard]] const face_clusters& clusters_of(const prepared_mesh& mesh);

/// The far faces of a mesh, that is, those that are not near, in sets. Faces at a common point are
/// in one set, and so are clusters with a common point if none of their faces is near. Connected
/// far faces may be in several sets, which does no harm.
///
/// \cost O(F / 64), and O(F') for the F' faces of clusters of which a face is near
class far_faces {
  public:
    /// \param is_near [F] 1 for near faces, in the tree's order
    /// \pre   the arguments outlive this; at each point of a far face, the faces are one closed
    ///        fan, and none of them meets anything but its neighbors
    far_faces(const prepared_mesh& mesh, std::span<const std::uint8_t> is_near);

    /// A face of each set, in an order that depends on the mesh and the near faces alone.
    [[nodiscard]] std::span<const std::uint32_t> faces() const { return faces_; }

    /// Writes the value of its set, `of_set` [sets], to `of_face` [F] for each far face.
    template <class T>
    void write(std::span<const T> of_set, T* of_face) const {
        write_sets([&](std::uint32_t face, std::uint32_t set) { of_face[face] = of_set[set]; });
    }

  private:
    void number_sets();
    template <class Put>
    void write_sets(const Put& put) const;

    std::span<const std::uint32_t> face_at_;
    mesh_view mesh_;
    const face_clusters& clusters_;
    std::span<const std::uint8_t> is_near_;
    std::vector<std::uint8_t> is_mixed_;  ///< [C] whether a face of the cluster is near
    buffer<std::uint32_t> set_;           ///< [C + V] set of each cluster, then of each point
    std::vector<std::uint32_t> faces_{};
};

template <class Put>
void far_faces::write_sets(const Put& put) const {
    const std::size_t clusters = is_mixed_.size();
    for_chunks(face_at_.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t c = clusters_.of_place[i];
            if (is_mixed_[c] == 0)
                put(face_at_[i], set_[c]);
            else if (is_near_[i] == 0)
                put(face_at_[i], set_[clusters + mesh_.faces[face_at_[i]][0]]);
        }
    });
}

}  // namespace treeform::detail::boolean
