#pragma once
/// \file
/// Decides which faces of a sheet an expression keeps.

#include <libmesh/arrange/escape_ray.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/far_faces.hpp>
#include <libmesh/boolean/interaction_zone.hpp>
#include <libmesh/boolean/near_labels.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/tree/aabb.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// The winding numbers of solids around the faces of the first bundle, which need not be closed.
/// Computed exactly, by a ray from each patch of its pieces, and from each set of its faces that
/// are not near.
class sheet_labels {
  public:
    /// \param cut the arrangement of `near.local`
    /// \param far the far faces of the sheet
    /// \pre   the second bundle is closed; the arguments outlive this
    sheet_labels(const bundles& operands, const interaction_zone& near, mesh_arrangement& cut,
                 const far_faces& far);

    /// A piece is in a solid if one of its sides is. The sources of kept pieces become faces of the
    /// sheet, and their orientation that of its lowest face there.
    ///
    /// \cost  a ray for each patch and set
    /// \same  on any number of threads
    [[nodiscard]] chosen_surface choose(const boolean_expression& expression, fill_rule rule) const;

  private:
    [[nodiscard]] bool is_of_sheet(std::uint32_t local) const { return local < near_.first_of_b; }
    /// \param covers the faces that cover the one from which `out` starts
    [[nodiscard]] bool keeps(const arrange::escape_ray& out, std::span<const covering_face> covers,
                             const boolean_expression& expression, fill_rule rule) const;

    const bundles& operands_;
    const interaction_zone& near_;
    const mesh_arrangement& cut_;
    const far_faces& far_;
    aabb<double, 3> box_{};
    std::vector<std::uint8_t>
        way_;  ///< [F'] of the sheet: 1 if oriented as its lowest face there, 2 if opposite
};

}  // namespace treeform::detail::boolean
