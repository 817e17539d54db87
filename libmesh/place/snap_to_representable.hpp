#pragma once
/// \file
/// A mesh moved among others in coordinates that can be written, so that it keeps off all of them.

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
    double clearance = 0.0;  ///< the least distance to the parts, as `distance` computes it
    /// Where given, a level that the mesh stays above. What would come to lie below it is put on
    /// it, and so are, at the time asked for, its lowest points, when these come to lie within 4
    /// units in the last place of the largest z, before or after: then the mesh rests on it
    /// exactly.
    std::optional<double> floor{};
    bool forward = false;  ///< back off to later times, not to earlier ones
    unsigned attempts = 40;
    /// The time is that of a contact: where rounding leaves a gap, go on by units in the last
    /// place, up to 4, until one more would penetrate, or the meshes touch. Without a clearance and
    /// backing off to earlier times only.
    bool close_in = false;
    base::effort* effort = nullptr;  ///< a place of which it does not suffice to judge is not good
    progress_callback progress{};
};

struct snapped {
    std::vector<point3> points{};  ///< [V] of `a`, moved and rounded
    double time = 0.0;             ///< the one that `points` belong to
    unsigned backed_off = 0;       ///< steps taken
    bool good = false;             ///< nothing is penetrated, all clearances are kept
    /// Of what `points` holds to the parts, the closest: penetrating, else touching, else separate.
    mesh_relation relation = mesh_relation::separate;
    std::size_t part = 0;  ///< the lowest part of that relation, or one nearer than the clearance
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest means nothing
};

/// `a` moved by `time` times `motion`, with every coordinate rounded: first the product, then the
/// sum, then to float32 if asked for.
///
/// Where the moved mesh penetrates a part, or is nearer than the clearance, as decided on the
/// rounded coordinates, the time is stepped back (or on): by as little as moves some coordinate by
/// a unit in the last place of the largest, then by twice that, and so on, and from the last bad
/// step forward again by halves. So the mesh stops at most two such units, along the motion, from a
/// place that is not good. Points of `a` that no face uses, and those not finite, move along and
/// count for nothing.
///
/// \pre    time >= 0
/// \throws std::invalid_argument for a motion or time that is not finite, or a clearance that is
///         negative or NaN
/// \throws std::overflow_error for coordinates that are not finite at the place
/// \cost   a `build_face_tree` of `a` for each attempt, with `relation` and `distance` for the
///         parts whose boxes are within the clearance of its box
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API snapped snap_to_representable(const prepared_mesh& a,
                                                         std::span<const shape> parts,
                                                         const point3& motion, double time,
                                                         const snap_options& options = {});

}  // namespace treeform::detail::place
