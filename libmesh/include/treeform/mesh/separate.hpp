#pragma once
/// \file
/// A mesh taken out of others, or away from them, by a short translation.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace treeform {

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
/// \cost   for each direction up to a dozen `intersects` or `distance`, a `face_tree` of `moving`
///         and a search in motion
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
