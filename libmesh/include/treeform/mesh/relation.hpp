#pragma once
/// \file
/// Whether two meshes are apart, touch, or penetrate each other.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>
#include <treeform/tree/tree.hpp>

#include <cstdint>

namespace treeform {

enum class mesh_relation : std::uint8_t { separate, touching, penetrating };

struct mesh_relation_result {
    mesh_relation relation = mesh_relation::separate;
    /// Faces that tell why: two that pass through each other or overlap facing the same way, or
    /// two that touch; of a mesh inside the other, or reaching into it, the lowest face there.
    /// Both 0 when the meshes are separate.
    std::uint32_t face_a = 0;
    std::uint32_t face_b = 0;
    bool a_inside_b = false;  ///< a part of `a` lies in the solid `b`, and touches nothing there
    bool b_inside_a = false;
    bool cancelled = false;  ///< `progress` said stop; nothing is known
};

/// How `a` and `b` lie to each other, exactly on the coordinates as given.
///
/// They are penetrating when two faces pass through each other; or, where both are closed
/// (`find_open_edge`), when coplanar faces overlap and face the same way; or when a corner of one
/// lies strictly inside the other one, if that is closed: so also when one is wholly inside the
/// other. Else they touch when they have a common point, and are separate when they have none.
///
/// For closed meshes penetrating means that interiors have a common point, but for one case that
/// counts as touching: a body that passes through the other along nothing but edges and corners of
/// both, with all its corners on the other's surface or outside.
///
/// \pre    `tree_a` and `tree_b` are `face_tree(a)` and `face_tree(b)`; equal corners have been
///         joined, or else no mesh counts as closed
/// \throws std::invalid_argument as `mesh_intersections`
/// \cost   as `intersects` for meshes that penetrate or are far apart; else O(V) more, and a ray
///         for each component, or for each corner when the meshes touch
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API mesh_relation_result relation(mesh_view a, const tree<3>& tree_a,
                                                         mesh_view b, const tree<3>& tree_b,
                                                         const progress_callback& progress = {});
[[nodiscard]] TREEFORM_API mesh_relation_result relation(mesh_view a, mesh_view b);

}  // namespace treeform
