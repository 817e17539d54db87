#pragma once
/// \file
/// What functions of meshes take: any mesh, and any number of them.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <ranges>
#include <span>
#include <type_traits>
#include <vector>

#ifdef __clang__
#define TREEFORM_LIFETIMEBOUND [[clang::lifetimebound]]
#else
#define TREEFORM_LIFETIMEBOUND
#endif

namespace treeform {

struct usable_mesh;

/// Refers to a mesh, a prepared one, a view, what `as_mesh` returns, or points and faces. For
/// parameters only: it is made by itself where a function takes one. A temporary mesh lives until the
/// call returns, so that `unite(as_mesh(f), as_mesh(g))` is right.
///
/// A prepared mesh keeps the indexes that a function builds; any other is indexed for the call.
class mesh_ref {
  public:
    mesh_ref(const mesh& mesh TREEFORM_LIFETIMEBOUND) : view_(mesh) {}  // NOLINT: all are implicit
    mesh_ref(mesh_view mesh) : view_(mesh) {}                           // NOLINT
    mesh_ref(points_view points, std::span<const face> faces) : view_{points, faces} {}
    mesh_ref(const prepared_mesh& mesh TREEFORM_LIFETIMEBOUND)  // NOLINT
        : view_(mesh.view()), prepared_(&mesh) {}
    TREEFORM_API mesh_ref(const usable_mesh& mesh TREEFORM_LIFETIMEBOUND);  // NOLINT

    [[nodiscard]] mesh_view view() const { return view_; }
    /// Null where the mesh is not prepared.
    [[nodiscard]] const prepared_mesh* prepared() const { return prepared_; }

  private:
    mesh_view view_;
    const prepared_mesh* prepared_ = nullptr;
};

/// Refers to several meshes of any kinds: `{a, b}`, a vector or span of meshes, prepared meshes or
/// views, or a single mesh.
class mesh_refs {
  public:
    mesh_refs() = default;
    mesh_refs(std::initializer_list<mesh_ref> meshes TREEFORM_LIFETIMEBOUND)  // NOLINT
        : refs_(meshes) {}
    template <class One>
    requires std::convertible_to<const One&, mesh_ref> mesh_refs(
        const One& mesh TREEFORM_LIFETIMEBOUND)
        : refs_{mesh_ref(mesh)} {}  // NOLINT
    template <std::ranges::sized_range Many>
    requires std::convertible_to<std::ranges::range_reference_t<const Many&>, mesh_ref> &&
        (!std::convertible_to<const Many&, mesh_ref>)
            mesh_refs(const Many& meshes TREEFORM_LIFETIMEBOUND)  // NOLINT
        : refs_(std::ranges::begin(meshes), std::ranges::end(meshes)) {}

    [[nodiscard]] std::span<const mesh_ref> all() const { return refs_; }
    [[nodiscard]] std::size_t size() const { return refs_.size(); }
    [[nodiscard]] bool empty() const { return refs_.empty(); }
    [[nodiscard]] const mesh_ref& operator[](std::size_t i) const { return refs_[i]; }
    [[nodiscard]] auto begin() const { return refs_.begin(); }
    [[nodiscard]] auto end() const { return refs_.end(); }

  private:
    std::vector<mesh_ref> refs_{};
};

}  // namespace treeform
