#pragma once
/// \file
/// Set operations by CGAL, answers as meshes of doubles.

#include "bench/peers/cgal_corefinement.hpp"
#include <treeform/mesh/mesh.hpp>

#include <gmpxx.h>

#include <memory>
#include <optional>

namespace treeform::bench {

/// Two solids as surface meshes of a kernel, converted before.
class cgal_solids {
  public:
    virtual ~cgal_solids() = default;
    /// `PMP::corefine_and_compute_*` with corners rounded to double at the end; none where it
    /// reports failure. May throw or worse.
    [[nodiscard]] virtual std::optional<mesh> computed(corefinement operation) const = 0;
    /// The volume of its answer before rounding.
    [[nodiscard]] virtual std::optional<mpq_class> volume(corefinement operation) const = 0;
};

/// With EPICK, which rounds every point it constructs, or with EPECK, which constructs exactly.
[[nodiscard]] std::shared_ptr<const cgal_solids> cgal_solids_of(const mesh& a, const mesh& b,
                                                                bool exact);

/// `PMP::experimental::autorefine_and_remove_self_intersections`, or the local
/// `remove_self_intersections`, with EPICK; none where it reports failure.
enum class cgal_repair { autorefine, local };
[[nodiscard]] std::optional<mesh> cgal_repaired(const mesh& given, cgal_repair how);

}  // namespace treeform::bench
