#pragma once
/// \file
/// Which faces of a sheet an expression keeps among solids.

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

/// What winds around the faces of an operand that need not be closed: the first of two bundles. A
/// line from each patch of its pieces, and from each set of its faces that are not near, tells,
/// exactly.
class sheet_labels {
  public:
    /// \param cut the arrangement of `near.local`
    /// \param far of the sheet
    /// \pre   the second bundle is closed; what is referred to outlives this
    sheet_labels(const bundles& operands, const interaction_zone& near, mesh_arrangement& cut,
                 const far_faces& far);

    /// A piece is in a solid when one of its sides is. Those that are kept are now first covered by
    /// the sheet, and face as its lowest face there.
    ///
    /// \cost  a line for each patch and set
    /// \same  on any number of threads
    [[nodiscard]] chosen_surface choose(const boolean_expression& expression, fill_rule rule) const;

  private:
    [[nodiscard]] bool is_of_sheet(std::uint32_t local) const { return local < near_.first_of_b; }
    /// \param covers of the face that `out` starts from
    [[nodiscard]] bool keeps(const arrange::escape_ray& out, std::span<const covering_face> covers,
                             const boolean_expression& expression, fill_rule rule) const;

    const bundles& operands_;
    const interaction_zone& near_;
    const mesh_arrangement& cut_;
    const far_faces& far_;
    aabb<double, 3> box_{};
    std::vector<std::uint8_t>
        way_;  ///< [F'] of the sheet: 1 as its lowest face there, 2 against it
};

}  // namespace treeform::detail::boolean
