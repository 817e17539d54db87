#pragma once
/// \file
/// The convex hull of points that span space, point by point from the highest on.

#include <libmesh/base/point_math.hpp>
#include <libmesh/base/work_progress.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <vector>

namespace treeform::detail::place {

/// Points times a power of two that brings the largest coordinate to the size of 1, so that
/// products of three differences do not overflow.
class scaled_points {
  public:
    explicit scaled_points(points_view points);

    [[nodiscard]] const point3& operator[](std::uint32_t i) const { return points_[i]; }
    [[nodiscard]] point3 difference(std::uint32_t i, std::uint32_t from) const {
        return base::minus(points_[i], points_[from]);
    }
    /// The longest side of their box, rounded up.
    [[nodiscard]] double extent() const { return extent_; }

  private:
    std::vector<point3> points_;
    double extent_ = 0.0;
};

/// Facets are triangles; each knows its neighbors and the points above it that are not yet part
/// of the hull, of which each is kept by one facet that it is above of.
class quickhull {
  public:
    /// From the tetrahedron of four points, the last of which is below the plane of the others.
    quickhull(points_view points, const scaled_points& scaled,
              const std::array<std::uint32_t, 4>& first);

    /// False when it was asked to stop, with nothing done.
    bool run(base::work_progress& work);

    /// The facets, those in one plane together.
    [[nodiscard]] std::vector<std::vector<face>> sides() const;

  private:
    static constexpr std::uint32_t none = 0xffffffff;

    struct facet {
        face corner{};
        std::array<std::uint32_t, 3> beyond{};  ///< facets across the edges corner[i], corner[i+1]
        point3 normal{};                        ///< scaled, rounded
        double error = 0.0;                     ///< of a height
        std::uint32_t first_above = none;       ///< list through `next_`
        std::uint32_t highest = none;
        double height = 0.0;  ///< of the highest
        bool used = false;
        bool seen = false;  ///< from the point being added
    };
    struct rim_edge {
        std::uint32_t from, to, outside;
    };

    std::uint32_t make_facet(const face& corners);
    [[nodiscard]] double height(const facet& f, std::uint32_t p) const;
    [[nodiscard]] bool sees(const facet& f, std::uint32_t p, double height) const;
    [[nodiscard]] bool keep_above(std::uint32_t f, std::uint32_t p);
    void find_seen(std::uint32_t start, std::uint32_t p);
    void make_cone(std::uint32_t p);
    void hand_over_points(std::uint32_t p);

    points_view points_;
    const scaled_points& scaled_;
    std::vector<facet> facets_;
    std::vector<std::uint32_t> free_;     ///< facets that may be used again
    std::queue<std::uint32_t> waiting_;   ///< facets that may have points above
    std::vector<std::uint32_t> next_;     ///< [V]
    std::vector<std::uint32_t> cone_at_;  ///< [V] new facet of the rim's edge that starts there
    std::vector<std::uint32_t> seen_;
    std::vector<rim_edge> rim_;
    std::vector<std::uint32_t> cone_;
};

}  // namespace treeform::detail::place
