#pragma once
/// \file
/// A mesh brought to others so that nearest points come together.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace treeform {

struct mate_options {
    double clearance = 0.0;              ///< the gap to leave, a distance; 0: until contact
    std::optional<double> max_travel{};  ///< a length
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    std::size_t limit = 1000;                                      ///< contacts listed
    vertex_identity vertices = vertex_identity::by_coordinates;    ///< as in `relation`
    progress_callback progress{};
};

/// `moving` translated so that its nearest points to `fixed` come together, or to the clearance; in
/// coordinates that were checked, as `slide` does. What touches stays; what penetrates has no
/// place.
///
/// \throws std::invalid_argument as `slide`
/// \cost   `measure` for the fixed meshes that may be the nearest, and a `slide`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API placement mate(const prepared_mesh& moving,
                                          std::span<const prepared_mesh> fixed,
                                          const mate_options& options = {});
[[nodiscard]] TREEFORM_API placement mate(const prepared_mesh& moving, const prepared_mesh& fixed,
                                          const mate_options& options = {});
[[nodiscard]] TREEFORM_API placement mate(mesh_view moving, mesh_view fixed,
                                          const mate_options& options = {});

}  // namespace treeform
