#pragma once
/// \file
/// One body brought against another: slide, mate, separate.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

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
///         the operand and its lowest face with a corner out of range or not finite
/// \cost   O(V + F) of all for the check at the door; that of the search in motion; and for each
///         attempt at coordinates a `build_face_tree` of `moving` and a `relation` to what is near
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

struct separate_options {
    double clearance = 0.0;              ///< the least distance wanted; 0: not to penetrate
    std::optional<double> max_travel{};  ///< a length
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    std::size_t normals = 24;     ///< normals of faces that are tried as directions, at most
    std::size_t face_pairs = 64;  ///< pairs of faces whose normals are looked at, for each mesh
    std::size_t limit = 1000;     ///< contacts listed of each fixed mesh
    vertex_identity vertices = vertex_identity::by_coordinates;  ///< as in `relation`
    progress_callback progress{};
};

/// `moving` translated to where it penetrates none of `fixed` and keeps the clearance; it stays
/// when it does so where it is.
///
/// Some fifty directions are tried: the axes, away from the nearest points, the normals of faces
/// that meet, and others around the best. Of the places found the nearest is taken that holds in
/// the coordinates returned, which were checked, as `slide` does. It need not be the nearest there
/// is, which is a boundary point of a set with O(n^2 m^2) faces.
///
/// \throws std::invalid_argument as `slide`
/// \cost   for each direction up to a dozen `intersects` or `distance`, a `build_face_tree` of
///         `moving` and a search in motion
/// \same   on any number of threads
/// \source why the least translation is no target: Dobkin, Hershberger, Kirkpatrick and Suri,
///         Computing the Intersection-Depth of Polyhedra, Algorithmica 9 (1993)
[[nodiscard]] TREEFORM_API placement separate(const prepared_mesh& moving,
                                              std::span<const prepared_mesh> fixed,
                                              const separate_options& options = {});
[[nodiscard]] TREEFORM_API placement separate(const prepared_mesh& moving,
                                              const prepared_mesh& fixed,
                                              const separate_options& options = {});
[[nodiscard]] TREEFORM_API placement separate(mesh_view moving, mesh_view fixed,
                                              const separate_options& options = {});

}  // namespace treeform
