#pragma once
/// \file
/// Whether two meshes are apart, touch, or penetrate each other.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>

#include <cstdint>

namespace treeform {

enum class mesh_relation : std::uint8_t { separate, touching, penetrating };

struct relation_options {
    /// Only closed meshes have an inside; whether a mesh is closed depends on this.
    vertex_identity vertices = vertex_identity::by_coordinates;
    progress_callback progress{};
};

struct mesh_relation_result {
    mesh_relation relation = mesh_relation::separate;
    /// Faces that tell why: two that pass through each other or overlap facing the same way, or
    /// two that touch; of a mesh inside the other, or reaching into it, the lowest face there.
    /// Both 0 when the meshes are separate.
    std::uint32_t face_a = 0;
    std::uint32_t face_b = 0;
    bool a_inside_b = false;  ///< a part of `a` lies in the solid `b`, and touches nothing there
    bool b_inside_a = false;
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing is known
};

/// How `a` and `b` lie to each other, exactly on the coordinates as given.
///
/// They are penetrating when two faces pass through each other; or, where both are closed
/// (`find_open_edge`), when coplanar faces overlap and face the same way; or when a corner of one
/// lies strictly inside the other one, if that is closed: so also when one is wholly inside the
/// other. Else they touch when they have a common point, and are separate when they have none.
///
/// Corners with equal coordinates are one vertex unless the options say otherwise: a file that
/// repeats its corners, as STL does, is closed when its surface is. With `by_index` such a mesh is
/// open, and what is inside it is separate.
///
/// For closed meshes penetrating means that interiors have a common point, except for one case that
/// counts as touching: a body that passes through the other along nothing but edges and corners of
/// both, with all its corners on the other's surface or outside.
///
/// \throws std::invalid_argument naming the mesh and its lowest face with a corner that is no point
///         or not finite
/// \cost   as `intersects` for meshes that penetrate or are far apart; else O(V) more, and a ray
///         for each component, or for each corner when the meshes touch
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API mesh_relation_result relation(const prepared_mesh& a,
                                                         const prepared_mesh& b,
                                                         const relation_options& options = {});
[[nodiscard]] TREEFORM_API mesh_relation_result relation(mesh_view a, mesh_view b,
                                                         const relation_options& options = {});

}  // namespace treeform
