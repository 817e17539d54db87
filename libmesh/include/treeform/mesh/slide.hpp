#pragma once
/// \file
/// A mesh moved in a direction until it meets something: `slide`, and `drop` onto a bed.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace treeform {

struct slide_options {
    double clearance = 0.0;              ///< the gap to leave, a distance; 0: until contact
    std::optional<double> max_travel{};  ///< a length; what is met beyond it counts as nothing
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    /// z of a bed that stops the mesh, too. The points that rest on it have exactly its z (the
    /// least float32 not below it where these are asked for), and none is below.
    std::optional<double> bed{};
    /// Where rounding leaves a gap at a contact, close it by units in the last place.
    bool close_in = true;
    std::size_t limit = 1000;                                    ///< contacts listed
    vertex_identity vertices = vertex_identity::by_coordinates;  ///< as in `relation`
    progress_callback progress{};
};

/// `moving` at the place where it first meets one of `fixed` on its way along `direction` (of any
/// length), or first comes as near to one as the clearance.
///
/// The time of the contact is exact without a clearance (`time_of_impact`), else as
/// `time_to_distance` says. The coordinates returned are looked at again, and moved back by units
/// in their last place where rounding has made them penetrate, or come nearer than the clearance as
/// computed. What touches at the start stays there; what penetrates has no place. Points of
/// `moving` that no face uses move along and count for nothing.
///
/// Of the fixed meshes only those on the way are looked at and indexed; to ask again, keep them as
/// prepared meshes. Clouds are `prepared_mesh::cloud`.
///
/// \throws std::invalid_argument for a direction that is zero or not finite, a clearance that is
///         negative or not finite, a bed that is not finite or that no float32 holds, and naming
///         the operand and its lowest face with a corner that is no point or not finite
/// \cost   O(V + F) of all for the check at the door; that of the search in motion; and for each
///         attempt at coordinates a `face_tree` of `moving` and a `relation` to what is near
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API placement slide(const prepared_mesh& moving,
                                           std::span<const prepared_mesh> fixed,
                                           const point3& direction,
                                           const slide_options& options = {});
[[nodiscard]] TREEFORM_API placement slide(const prepared_mesh& moving, const prepared_mesh& fixed,
                                           const point3& direction,
                                           const slide_options& options = {});
[[nodiscard]] TREEFORM_API placement slide(mesh_view moving, mesh_view fixed,
                                           const point3& direction,
                                           const slide_options& options = {});

struct drop_options {
    double clearance = 0.0;
    std::optional<double> max_travel{};
    treeform::precision precision = treeform::precision::float64;
    /// z of the bed; with fixed meshes there is none unless this is given, else it is 0.
    std::optional<double> bed{};
    point3 direction{0.0, 0.0, -1.0};  ///< leads down
    std::size_t limit = 1000;
    vertex_identity vertices = vertex_identity::by_coordinates;
    progress_callback progress{};
};

/// `moving` on the bed: `slide` down to it. From below the bed it goes up to it, back along the
/// direction.
///
/// \throws std::invalid_argument as `slide`, and for a direction that does not lead down
/// \cost   O(V)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API placement drop(const prepared_mesh& moving,
                                          const drop_options& options = {});
[[nodiscard]] TREEFORM_API placement drop(mesh_view moving, const drop_options& options = {});

/// `moving` on the first that it meets, of `fixed` and of the bed, if there is one: `slide`. What
/// reaches below the bed has no place.
[[nodiscard]] TREEFORM_API placement drop(const prepared_mesh& moving,
                                          std::span<const prepared_mesh> fixed,
                                          const drop_options& options = {});
[[nodiscard]] TREEFORM_API placement drop(const prepared_mesh& moving, const prepared_mesh& fixed,
                                          const drop_options& options = {});
[[nodiscard]] TREEFORM_API placement drop(mesh_view moving, mesh_view fixed,
                                          const drop_options& options = {});

}  // namespace treeform
