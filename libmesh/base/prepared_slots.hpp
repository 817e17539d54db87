#pragma once
/// \file
/// The typed slots of a prepared mesh. They are declared without the types of the indexes: each
/// room gives its slot a type, and fills it.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <cstddef>
#include <memory>

namespace treeform::detail::base {

/// A name for each kind of index, so that no two rooms use the same slot.
enum class slot_name : std::size_t {
    face_tree,
    triangle_blocks,
    closest_triangles,
    joined_corners,
    closed,
    facing,
    cut_operand,
    face_clusters,
    few_own_pairs,
    own_pairs,
    count
};

/// A slot whose value is a T.
template <class T>
struct slot {
    slot_name name;
};

class prepared_slots {
  public:
    /// The value of slot `s` of `mesh`. If the slot is empty, it is first filled by `make()`; if
    /// that throws, the slot stays empty.
    template <class T, class Make>
    [[nodiscard]] static const T& get(const prepared_mesh& mesh, slot<T> s, const Make& make) {
        const auto build = [&]() -> std::shared_ptr<const void> {
            return std::make_shared<const T>(make());
        };
        return *static_cast<const T*>(get(mesh, s.name, build));
    }

    /// Another prepared mesh with the same slots and arrays. \pre `mesh` outlives it
    [[nodiscard]] static prepared_mesh shared(const prepared_mesh& mesh);

    /// Refers to arrays of which only the faces count, as those of a solid: never a cloud.
    [[nodiscard]] static prepared_mesh of_faces(mesh_view view);

  private:
    static const void* get(const prepared_mesh& mesh, slot_name name,
                           function_ref<std::shared_ptr<const void>()> build);
};

}  // namespace treeform::detail::base
