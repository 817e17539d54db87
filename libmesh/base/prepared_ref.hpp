#pragma once
/// \file
/// Meshes that were given in any form, as prepared meshes.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::base {

/// A mesh as a prepared one: as it was given, or for the time being. \pre what it refers to
/// outlives it
class prepared_ref {
  public:
    explicit prepared_ref(const mesh_ref& given) : given_(given.prepared()) {
        if (given_ == nullptr) own_ = prepared_mesh::borrow(given.view());
    }
    [[nodiscard]] const prepared_mesh& operator*() const {
        return given_ != nullptr ? *given_ : *own_;
    }
    operator const prepared_mesh&() const { return **this; }  // NOLINT: meant to be implicit
    [[nodiscard]] mesh_view view() const { return (**this).view(); }
    [[nodiscard]] bool is_cloud() const { return (**this).is_cloud(); }

  private:
    const prepared_mesh* given_;
    std::optional<prepared_mesh> own_{};
};

/// The same of several, one after the other in memory.
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
