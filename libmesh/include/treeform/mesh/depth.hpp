#pragma once
/// \file
/// How deep two meshes penetrate each other, and how many points of a cloud are inside others.

#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace treeform {

struct depth_options {
    std::size_t directions =
        256;  ///< spread over the sphere, tried beside those of faces that meet
    vertex_identity vertices = vertex_identity::by_coordinates;  ///< as in `relation`
    progress_callback progress{};
};

/// A way out.
struct penetration_depth_result {
    double depth = 0.0;  ///< the length of `move`, rounded
    /// Adding this to every point of `a`, each coordinate rounded, takes `a` out of `b`: then
    /// `relation` does not find them penetrating.
    point3 move{};
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing is known
};

/// The length of a short translation that takes `a` out of `b`: an upper bound of the depth of
/// penetration, which is the length of the shortest. None when they do not penetrate each other,
/// or one is a cloud.
///
/// The translation is verified exactly, in the coordinates that it leads to. It starts from what
/// `separate` finds, is shortened wherever one of `directions` other directions leads out sooner,
/// and then turned little by little, by less and less, as long as that makes it shorter. Among
/// shapes that are not convex, a shorter one may exist.
///
/// \throws std::invalid_argument as `relation`
/// \cost   `separate`; an `intersects` for each direction, and a `time_of_impact` for those that
///         lead out sooner
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<penetration_depth_result> penetration_depth(
    const prepared_mesh& a, const prepared_mesh& b, const depth_options& options = {});
[[nodiscard]] TREEFORM_API std::optional<penetration_depth_result> penetration_depth(
    mesh_view a, mesh_view b, const depth_options& options = {});

/// How many points are inside a solid, on a surface, outside of all.
struct side_counts {
    std::uint64_t inside = 0;
    std::uint64_t on = 0;
    std::uint64_t outside = 0;
};

/// Counts the points by where they are with respect to `solids`, exactly: strictly inside any of
/// them, else on the surface of any, else outside. Meshes that are open, and clouds, bound nothing
/// and are passed over.
///
/// \throws std::invalid_argument naming the point that is not finite, or a face as `locate` does
/// \cost   as `deviation` without distances, for points in the box of a solid
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API side_counts count_sides(points_view points,
                                                   std::span<const prepared_mesh> solids);

}  // namespace treeform
