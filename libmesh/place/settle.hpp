#pragma once
/// \file
/// A mesh moved towards another in coordinates that can be written, without penetrating it.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/relation.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>
#include <treeform/tree/tree.hpp>

#include <cstdint>
#include <vector>

namespace treeform {

struct settle_options {
    bool to_single = false;  ///< coordinates become float32 values, as a binary STL holds them
    /// Steps tried before giving up; each backs off further than the one before.
    unsigned attempts = 40;
    /// The time is that of a contact: where rounding leaves a gap, go on by units in the last
    /// place, up to 4, until one more would penetrate, or the meshes touch.
    bool close_in = false;
    progress_callback progress{};
};

struct settled_mesh {
    std::vector<point3> points{};  ///< [V] of `a`, moved and rounded
    double time = 0.0;             ///< point + time * motion, rounded once, is what `points` holds
    unsigned backed_off = 0;       ///< steps taken back from the time asked for
    mesh_relation relation = mesh_relation::separate;  ///< of what `points` holds to `b`
    bool cancelled = false;  ///< `progress` said stop; the rest means nothing
};

/// `a` moved by `time` times `motion`, with every coordinate rounded: first the product, then the
/// sum, then to float32 if asked for. Where the moved mesh penetrates `b`, as `relation` decides
/// exactly on the rounded coordinates, the time is stepped back: by as little as moves some
/// coordinate by a unit in the last place of the largest, then by twice that, and so on, and from
/// the last step that penetrated forward again by halves. So the mesh stops at most two such units
/// short, along the motion, of a place where it penetrates.
///
/// \pre    0 <= time; `tree_b` is `face_tree(b)`
/// \throws std::invalid_argument as `relation`, and for a motion or time that is not finite
/// \cost   a `face_tree` of `a` and a `relation` for each attempt
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API settled_mesh settle(mesh_view a, mesh_view b, const tree<3>& tree_b,
                                               const point3& motion, double time,
                                               const settle_options& options = {});

}  // namespace treeform
