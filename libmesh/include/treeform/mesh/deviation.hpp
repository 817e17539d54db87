#pragma once
/// \file
/// How far the points of a mesh or cloud are from a surface, each with its sign, and what that
/// comes to: means, percentiles, a histogram, the share within a tolerance band.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// What to find besides distances.
struct deviation_options {
    /// Signed distances from the first to the second, both included, are within tolerance.
    std::optional<std::array<double, 2>> band{};
    std::size_t bins = 40;  ///< of the histogram; 0: none
    bool both_ways = true;  ///< also look from the points of `b` to `a`
    progress_callback progress{};
};

/// The largest distance of a point of one surface from another surface.
struct directed_distance {
    /// The largest distance of the vertices of the first, or of a cloud's points: a lower bound.
    double sampled = 0.0;
    /// No point of the first surface is further away: the largest, over its faces, of the largest
    /// distance of a corner plus the longest edge / sqrt(3). Of a cloud the same as `sampled`.
    double at_most = 0.0;
};

/// Counts of signed distances in `counts.size()` intervals of equal length from `low` to `high`.
/// The last one includes `high`.
struct distance_histogram {
    double low = 0.0;                     ///< the least signed distance
    double high = 0.0;                    ///< the greatest signed distance
    std::vector<std::uint64_t> counts{};  ///< points in each interval, from `low` up
};

/// How many signed distances are below, in and above the tolerance band.
struct band_counts {
    std::uint64_t below = 0;   ///< points below the band
    std::uint64_t within = 0;  ///< points in it, both ends included
    std::uint64_t above = 0;   ///< points above it
};

/// How far points are from a surface.
struct deviation_result {
    /// [V] of `a`: the distance of each point from the surface of `b`, negative inside the solid
    /// that `b` bounds, exactly 0 on its surface. Not negative when `b` bounds none.
    std::vector<double> distances{};
    std::vector<std::uint32_t> faces{};  ///< [V] the nearest face of `b`
    /// Whether `b` is closed, so that distances have a sign.
    bool is_signed = false;
    std::optional<side_counts> sides{};  ///< of the points of `a`, where distances have a sign
    double mean = 0.0;                   ///< mean of the signed distances
    double mean_absolute = 0.0;          ///< mean of their magnitudes
    double rms = 0.0;                    ///< root mean square of the distances
    double p50 = 0.0;         ///< the least value that half of the magnitudes do not exceed
    double p95 = 0.0;         ///< the same for 95 % of them
    double p99 = 0.0;         ///< the same for 99 % of them
    double max = 0.0;         ///< the largest magnitude
    std::uint32_t worst = 0;  ///< the lowest point with that distance
    double lowest = 0.0;      ///< the least signed distance
    double highest = 0.0;     ///< the greatest signed distance
    /// From `a` to `b`, and back where `both_ways`. The larger of the two is the Hausdorff
    /// distance, as sampled by points, and a bound of it.
    directed_distance there{};
    std::optional<directed_distance> back{};
    distance_histogram histogram{};
    std::optional<band_counts> band{};
    /// Points whose side was found by a winding number of their own; all others share that of a
    /// neighbor, from which no face separates them, or faces that were counted.
    std::uint64_t winding_numbers = 0;
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing else is set

    /// Gives the vertices of `file` the property "distance" and colors from blue (`low` or less)
    /// over white (0) to red (`high` or more); gray where a distance is NaN.
    ///
    /// \throws std::invalid_argument for another number of distances than of points, or unless
    ///         low <= 0 <= high
    TREEFORM_API static void color(mesh_file& file, std::span<const double> distances, double low,
                                   double high);
};

/// How far the points of `a` (all of them, used by faces or not) are from the surface of `b`: of
/// all meshes in it as one. Faces are numbered through, mesh after mesh.
///
/// The side is exact: that of the exact winding number of `b` about the point (`locate`). Corners
/// of `b` with equal coordinates are one vertex, as in a file that repeats them. When `b` is open,
/// or a cloud, it has no inside, and distances have no sign. A magnitude is within 16 u L of the
/// true distance, as `closest_point` says. A point that rounding puts at distance 0 keeps that as
/// its magnitude, and the sign of 0.
///
/// None when `a` has no points or `b` no faces.
///
/// \throws std::invalid_argument for a point of `a` that is not finite, a face of `b` as
///         `closest_point`, a band that is NaN or the wrong way round, or more bins than 2^20
/// \cost   `closest_point` for each point, in an order of space; and for signs a winding number for
///         one point in 1024, and the faces between neighbors for the others. A copy of `b` where
///         there are several
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<deviation_result> deviation(
    const mesh_ref& a, const mesh_refs& b, const deviation_options& options = {});

}  // namespace treeform
