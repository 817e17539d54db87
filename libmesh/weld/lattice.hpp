#pragma once
/// \file
/// A lattice of 2^30 steps a side over the bounding box of points. Its integer coordinates, precise
/// to one part in 10^9, decide nearly always whether two points are within a tolerance.

#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace treeform::detail::weld {

/// A point in steps, truncated to integers: x, y, and instead of z the position s along a line in
/// general position.
struct lattice_record {
    std::int32_t s;
    std::int32_t x;
    std::int32_t y;
    std::uint32_t id;
};

/// A point in steps by x, y and z, truncated to integers.
struct place_record {
    std::int32_t x;
    std::int32_t y;
    std::int32_t z;
    std::uint32_t id;
};

/// The step is a power of two, so that the only error of X = (x - low) * scale is that of the
/// rounded difference: 2^-53 of at most 2^30 steps.
class lattice {
  public:
    static constexpr int steps_bits = 30;

    /// Empty if there is no suitable step: the tolerance is more than a fourth of the box, or the
    /// box is too small to be divided in doubles. Points that are not finite are ignored. A few
    /// outliers far from the others may be outside of the box.
    static std::optional<lattice> over(points_view points, double tolerance);

    /// \pre `p` is finite and one of the points
    [[nodiscard]] std::array<double, 3> steps(const point3& p) const {
        std::array<double, 3> at{(p.x * shrink_ - low_[0]) * scale_,
                                 (p.y * shrink_ - low_[1]) * scale_,
                                 (p.z * shrink_ - low_[2]) * scale_};
        if (cut_)
            for (std::size_t k = 0; k < 3; ++k) at[k] = std::clamp(at[k], 0.0, extent_[k]);
        return at;
    }
    [[nodiscard]] lattice_record record(const point3& p, std::uint32_t id) const {
        const std::array<double, 3> at = steps(p);
        const double s = direction_[0] * at[0] + direction_[1] * at[1] + direction_[2] * at[2];
        return {static_cast<std::int32_t>(s), static_cast<std::int32_t>(at[0]),
                static_cast<std::int32_t>(at[1]), id};
    }
    [[nodiscard]] place_record place(const point3& p, std::uint32_t id) const {
        const std::array<double, 3> at = steps(p);
        return {static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1]),
                static_cast<std::int32_t>(at[2]), id};
    }

    /// The tolerance in steps.
    [[nodiscard]] double tolerance() const { return tolerance_; }
    /// Largest difference of the truncated x (or y, or z) of two points within the tolerance.
    [[nodiscard]] std::int32_t reach() const { return reach_; }
    /// The same for s.
    [[nodiscard]] std::int32_t reach_along() const { return reach_along_; }
    /// Extent of the box in steps.
    [[nodiscard]] const std::array<double, 3>& extent() const { return extent_; }

    enum class verdict { within, beyond, unsure };
    /// Whether the points of two records are within the tolerance.
    [[nodiscard]] verdict compare(const lattice_record& a, const lattice_record& b) const {
        const double x = b.x - a.x;
        const double y = b.y - a.y;
        const double s = b.s - a.s;
        return compare(x, y, (s - direction_[0] * x - direction_[1] * y) * over_z_);
    }
    [[nodiscard]] verdict compare(const place_record& a, const place_record& b) const {
        return compare(b.x - a.x, b.y - a.y, b.z - a.z);
    }

  private:
    [[nodiscard]] verdict compare(double x, double y, double z) const {
        const double square = x * x + y * y + z * z;
        if (square < surely_within_) return verdict::within;
        return square > surely_beyond_ ? verdict::beyond : verdict::unsure;
    }

    std::array<double, 3> low_{};
    std::array<double, 3> extent_{};
    std::array<double, 3> direction_{};
    double over_z_ = 1.0;
    double shrink_ = 1.0;
    double scale_ = 1.0;
    double tolerance_ = 0.0;
    double surely_within_ = 0.0;
    double surely_beyond_ = 0.0;
    std::int32_t reach_ = 0;
    std::int32_t reach_along_ = 0;
    bool cut_ = false;  ///< some points are outside of the box and are clamped
};

}  // namespace treeform::detail::weld
