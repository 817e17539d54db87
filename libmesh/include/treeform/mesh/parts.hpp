#pragma once
/// \file
/// Parts of a mesh as meshes of their own; meshes one after the other; meshes moved.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/transform.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform {

/// Faces of a mesh by themselves, with the points that they use.
struct mesh_part {
    treeform::mesh mesh;
    std::vector<std::uint32_t> face_source;    ///< [F] the number of each face in the whole
    std::vector<std::uint32_t> vertex_source;  ///< [V] that of each point; ascending
    double volume = 0.0;                       ///< as `signed_volume`
    double area = 0.0;                         ///< as `surface_area`
};

struct components_options {
    /// Parts with less are left out, in cubic units. Not negative.
    double min_volume = 0.0;
    /// So many parts of the greatest volume are kept; of equal ones, those of the greatest area.
    std::size_t largest = std::numeric_limits<std::size_t>::max();
};

/// The faces that corners link, as meshes, in the order of their lowest faces. Corners with equal
/// coordinates are one. A closed part that is inside out is a cavity, and goes with the smallest closed
/// part that it is in, if any. Volumes count without their sign, those of open parts as 0.
///
/// \pre    every coordinate of a corner is finite
/// \throws std::invalid_argument naming the lowest face with a corner out of range, and for a `min_volume`
///         that is negative or NaN
/// \cost   O(V + F); for cavities, as `contains`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<mesh_part> components(
    mesh_view mesh, const components_options& options = {});

/// The faces of these numbers, in this order, and the points that they use, in the order of `mesh`.
///
/// \throws std::invalid_argument as `select_faces`
[[nodiscard]] TREEFORM_API mesh_part submesh(mesh_view mesh, std::span<const std::uint32_t> faces);

/// Points and faces of all meshes, one after the other; nothing is joined.
///
/// \throws std::length_error for more points or faces than 32 bits can number
[[nodiscard]] TREEFORM_API mesh concatenate(std::span<const mesh_view> meshes);

/// The mesh with its points moved. Where `by` mirrors, faces are turned over, so that they look outward as
/// before.
[[nodiscard]] TREEFORM_API mesh transform_mesh(mesh_view mesh, const transform<3>& by);

}  // namespace treeform
