#pragma once
/// \file
/// Moves a mesh among others to representable coordinates at which it penetrates none of them.

#include <libmesh/base/effort.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::place {

struct snap_options {
    treeform::precision precision = treeform::precision::float64;  ///< of the coordinates returned
    double clearance = 0.0;  ///< minimum distance to the parts, as computed by `distance`
    /// If set, the lowest z allowed. Points that would be below it are put on it. So are, at the
    /// requested time, the lowest points if they are within 4 units in the last place (of the
    /// largest z before or after the motion) of it: the mesh then rests on it exactly.
    std::optional<double> floor{};
    bool forward = false;  ///< back off to later times instead of earlier ones
    unsigned attempts = 40;
    /// The time is that of a contact. If rounding leaves a gap, advance by up to 4 units in the
    /// last place, until the meshes touch or one more would penetrate. Only without a clearance and
    /// without `forward`.
    bool close_in = false;
    base::effort* effort = nullptr;  ///< a position whose test exceeds the effort is not good
    progress_callback progress{};
};

struct snapped {
    std::vector<point3> points{};  ///< [V] points of `a`, moved and rounded
    double time = 0.0;             ///< time of `points`
    unsigned backed_off = 0;       ///< number of steps back
    bool good = false;             ///< nothing is penetrated and the clearance is kept
    /// The closest relation of `points` to a part: penetrating, else touching, else disjoint.
    mesh_relation relation = mesh_relation::disjoint;
    std::size_t part = 0;  ///< lowest part with that relation, or a part nearer than the clearance
    /// or `cancelled`: the other members are meaningless
    treeform::status status = treeform::status::ok;
};

/// Moves `a` by `time` times `motion` and rounds every coordinate: first the product, then the sum,
/// then to float32 if requested.
///
/// If the moved mesh, with rounded coordinates, penetrates a part or is nearer than the clearance,
/// the time is stepped back (with `forward`, ahead). The first step moves some coordinate by one
/// unit in the last place of the largest one; each further step is twice as long; then the interval
/// to the last bad position is bisected. So the mesh stops at most two such units, along the
/// motion, from a position that is not good. Points of `a` that no face uses, and points that are
/// not finite, are moved but otherwise ignored.
///
/// \pre    time >= 0
/// \throws std::invalid_argument for a motion or time that is not finite, or a clearance that is
///         negative or NaN
/// \throws std::overflow_error for moved coordinates that are not finite
/// \cost   a `build_face_tree` of `a` for each attempt, with `relation` and `distance` for the
///         parts whose boxes are within the clearance of its box
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API snapped snap_to_representable(const prepared_mesh& a,
                                                         std::span<const shape> parts,
                                                         const point3& motion, double time,
                                                         const snap_options& options = {});

}  // namespace treeform::detail::place
