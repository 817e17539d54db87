#pragma once
/// \file
/// Solids as values: `solid s = a + b - c;`.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <memory>

namespace treeform {

/// A solid bounded by a mesh, or made from others by `+` or `|` (union), `*` or `&` (intersection),
/// `-` (difference) and `^` (symmetric difference). Put `&`, `^` and `|` in parentheses: C++
/// evaluates them after `+` and `-`.
///
/// Cheap to copy: copies share their data. Operators only build a formula. The first call of
/// `result` or `mesh` evaluates all of it at once, exactly, and caches the result. Const functions
/// may be called from several threads.
class TREEFORM_API solid {
  public:
    /// \throws not_certified_error, with the open edges, if the mesh does not bound a solid, as
    ///         operands of `boolean` must; std::invalid_argument as `boolean`
    /// \cost   as `check_operand`
    explicit solid(treeform::mesh&& owned);
    explicit solid(usable_mesh&& owned);
    /// The same for a copy.
    explicit solid(const treeform::mesh& mesh) : solid(treeform::mesh(mesh)) {}
    /// The same for a mesh that is shared with other code.
    explicit solid(std::shared_ptr<const prepared_mesh> shared);

    friend TREEFORM_API solid operator+(const solid& a, const solid& b);
    friend TREEFORM_API solid operator*(const solid& a, const solid& b);
    friend TREEFORM_API solid operator-(const solid& a, const solid& b);
    friend TREEFORM_API solid operator^(const solid& a, const solid& b);
    friend solid operator|(const solid& a, const solid& b) { return a + b; }
    friend solid operator&(const solid& a, const solid& b) { return a * b; }

    /// The result of `boolean` for the formula, certified or not. For a single mesh, the solid that
    /// it winds around. In sources, the meshes of the formula are numbered from left to right; a
    /// mesh that occurs several times has one number.
    /// \cost   as `boolean` of all meshes in the formula, once
    [[nodiscard]] const boolean_result& result() const;
    /// The surface.
    ///
    /// \throws not_certified_error unless its certificate's status is ok
    [[nodiscard]] const treeform::mesh& mesh() const;

  private:
    struct formula;
    explicit solid(std::shared_ptr<const formula> made) : formula_(std::move(made)) {}
    static solid join(const solid& a, char operation, const solid& b);

    std::shared_ptr<const formula> formula_;
};

}  // namespace treeform
