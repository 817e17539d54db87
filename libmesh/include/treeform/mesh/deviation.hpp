#pragma once
/// \file
/// Signed distances of the points of a mesh or cloud from a surface, with statistics: means,
/// percentiles, a histogram, counts within a tolerance band.

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

/// What to compute besides distances.
struct deviation_options {
    /// Tolerance band: signed distances from the first to the second value, inclusive.
    std::optional<std::array<double, 2>> band{};
    std::size_t bins = 40;  ///< number of intervals of the histogram; 0: none
    bool both_ways = true;  ///< also compute distances of the points of `b` from `a`
    progress_callback progress{};
};

/// Distances of points from a surface, and their statistics.
struct deviation_result {
    /// [V] of `a`: the distance of each point from the surface of `b`, negative inside the solid
    /// that `b` bounds, exactly 0 on its surface. Never negative if `b` bounds no solid.
    std::vector<double> distances{};
    std::vector<std::uint32_t> faces{};  ///< [V] the nearest face of `b`
    /// Whether `b` is closed, so that distances have a sign.
    bool is_signed = false;
    /// If distances have a sign: points of `a` inside, on and outside of `b`.
    std::optional<std::array<std::uint64_t, 3>> side_counts{};
    double mean = 0.0;           ///< mean of the signed distances
    double mean_absolute = 0.0;  ///< mean of their magnitudes
    double rms = 0.0;            ///< root mean square of the distances
    /// Median of the magnitudes: the least value that half of them do not exceed.
    double p50 = 0.0;
    double p95 = 0.0;         ///< the same for 95% of them
    double p99 = 0.0;         ///< the same for 99% of them
    double max = 0.0;         ///< the largest magnitude
    std::uint32_t worst = 0;  ///< the lowest point number with that magnitude
    double lowest = 0.0;      ///< the least signed distance
    double highest = 0.0;     ///< the greatest signed distance
    /// Bound of the distance from any point of the surface `a` to `b`: the maximum, over its faces,
    /// of the largest corner distance plus the longest edge / sqrt(3). For a cloud it
    /// is `max`, rounded up.
    double max_bound = 0.0;
    /// With `both_ways`, the largest distance of a vertex of `b` from `a`. The larger of this and
    /// `max` is the Hausdorff distance of the points.
    std::optional<double> reverse_max{};
    /// With `both_ways`, a bound of the distance from any point of the surface `b` to `a`. The
    /// larger of this and `max_bound` bounds the Hausdorff distance of the surfaces.
    std::optional<double> reverse_max_bound{};
    /// [bins] points by signed distance, in intervals of equal length from `lowest` to `highest`;
    /// the last one includes `highest`.
    std::vector<std::uint64_t> histogram{};
    /// With a band: points below, within and above it. Both ends are within.
    std::optional<std::array<std::uint64_t, 3>> band_counts{};
    /// Number of points whose winding number was computed; for the others it follows from that of a
    /// neighbor and the faces between.
    std::uint64_t winding_numbers = 0;
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is invalid

    /// Gives the vertices of `file` the property "distance" and colors from blue (`low` or less)
    /// over white (0) to red (`high` or more); gray where a distance is NaN.
    ///
    /// \throws std::invalid_argument unless there is one distance for each point, and low <= 0 <=
    ///         high
    TREEFORM_API static void color(mesh_file& file, std::span<const double> distances, double low,
                                   double high);
    /// The same with `distances`, from -`p99` to `p99` (to `max` if `p99` is 0). `file` is the file
    /// of `a`. For the colors of a band, pass its ends to the other function.
    ///
    /// \throws std::invalid_argument unless `file` has the points of `a`
    TREEFORM_API void color(mesh_file& file) const;
};

/// The signed distances of all points of `a`, used by faces or not, from the surface of `b`.
/// Several meshes `b` count as one, with faces numbered mesh after mesh.
///
/// The sign is exact: that of the winding number of `b` around the point (`locate`). Corners of `b`
/// with equal coordinates are one vertex. If `b` is open, or a cloud, it has no inside, and
/// distances have no sign. Magnitudes have the error bound of `closest_point`; a distance
/// may round to 0.
///
/// None if `a` or `b` is empty.
///
/// \throws std::invalid_argument for a point of `a` that is not finite; a face of `b` as in
///         `closest_point`; a band that is NaN or reversed; more than 2^20 bins
/// \cost   `closest_point` for each point, in a spatial order; for signs a winding number for one
///         point in 1024, and the faces between neighbors for the others. A copy of `b` if it is
///         `mesh_refs` of several meshes
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<deviation_result> deviation(
    const mesh_ref& a, const mesh_refs& b, const deviation_options& options = {});

}  // namespace treeform
