#pragma once
/// \file
/// Solids as values: `solid s = a + b - c;`.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <memory>

namespace treeform {

/// A solid bounded by a mesh, or made of others by `+` (union), `*` (intersection), `-`
/// (difference) and `^` (exclusive or).
///
/// A cheap handle: copies share what they hold. Operators collect the formula; all of it is
/// arranged at once, exactly, when the result is first asked for, and kept. Const functions may be
/// called from any threads.
class TREEFORM_API solid {
  public:
    /// The mesh bounds a solid as an operand of `boolean` has to.
    /// \throws not_certified_error naming where the mesh is open; std::invalid_argument as `boolean`
    /// \cost   as `check_solid`
    explicit solid(treeform::mesh&& owned);
    /// The same of a mesh that others ask about, too.
    explicit solid(std::shared_ptr<const prepared_mesh> shared);

    friend TREEFORM_API solid operator+(const solid& a, const solid& b);
    friend TREEFORM_API solid operator*(const solid& a, const solid& b);
    friend TREEFORM_API solid operator-(const solid& a, const solid& b);
    friend TREEFORM_API solid operator^(const solid& a, const solid& b);

    /// The result of `boolean` for the formula, whatever its certificate says; of a mesh alone, what
    /// it winds around. Sources name the meshes of the formula from left to right; one that stands
    /// in it several times counts once.
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
