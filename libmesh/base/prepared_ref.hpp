#pragma once
/// \file
/// Mesh arguments of any type as prepared meshes.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::base {

/// A mesh argument as a prepared mesh: the given one, or a temporary one. \pre the argument
/// outlives this
class prepared_ref {
  public:
    explicit prepared_ref(const mesh_ref& given) : given_(given.prepared_) {
        if (given_ == nullptr) own_ = prepared_mesh::borrow(given.view());
    }
    [[nodiscard]] const prepared_mesh& operator*() const {
        return given_ != nullptr ? *given_ : *own_;
    }
    operator const prepared_mesh&() const { return **this; }  // NOLINT: meant to be implicit
    [[nodiscard]] mesh_view view() const { return (**this).indexed_view(); }
    [[nodiscard]] bool is_cloud() const { return (**this).is_cloud(); }

  private:
    const prepared_mesh* given_;
    std::optional<prepared_mesh> own_{};
};

/// Whether a query of both needs prepared meshes: those keep indexes, and give faces to a cloud.
[[nodiscard]] inline bool is_prepared_or_cloud(const mesh_ref& a, const mesh_ref& b) {
    return a.prepared() != nullptr || a.is_cloud() || b.prepared() != nullptr || b.is_cloud();
}

/// The same for several, contiguous in memory.
class prepared_refs {
  public:
    explicit prepared_refs(const mesh_refs& given);

    [[nodiscard]] std::span<const prepared_mesh> all() const { return all_; }
    operator std::span<const prepared_mesh>() const { return all_; }  // NOLINT

  private:
    std::vector<prepared_mesh> own_{};
    std::span<const prepared_mesh> all_{};
};

}  // namespace treeform::detail::base
