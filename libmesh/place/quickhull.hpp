#pragma once
/// \file
/// The convex hull of points that span space, point by point from the highest on; and how firmly a
/// mesh stands on its sides.

#include <libmesh/base/point_math.hpp>
#include <libmesh/base/work_progress.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <span>
#include <vector>

namespace treeform::detail::place {

/// Points scaled by a power of two to coordinates of about 1 at most, so that products of three
/// differences do not overflow.
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

/// Facets are triangles with their neighbors. Each point outside of the hull so far is listed at
/// one facet that it is above.
class quickhull {
  public:
    /// Starts from the tetrahedron of four points; the last one is below the plane of the others.
    quickhull(points_view points, const scaled_points& scaled,
              const std::array<std::uint32_t, 4>& first);

    /// Returns false when cancelled; the hull is then incomplete.
    bool run(base::work_progress& work);

    /// The facets, grouped by plane.
    [[nodiscard]] std::vector<std::vector<face>> sides() const;

  private:
    static constexpr std::uint32_t none = 0xffffffff;

    struct facet {
        face corner{};
        std::array<std::uint32_t, 3> beyond{};  ///< facets across the edges corner[i], corner[i+1]
        point3 normal{};                        ///< scaled, rounded
        double error = 0.0;                     ///< error bound of a height
        std::uint32_t first_above = none;       ///< list through `next_`
        std::uint32_t highest = none;
        double height = 0.0;  ///< height of the highest point
        bool used = false;
        bool seen = false;  ///< visible from the point being added
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
    std::vector<std::uint32_t> free_;    ///< facets for reuse
    std::queue<std::uint32_t> waiting_;  ///< facets that may have points above
    std::vector<std::uint32_t> next_;    ///< [V]
    /// [V] new facet at the rim edge that starts at the point
    std::vector<std::uint32_t> cone_at_;
    std::vector<std::uint32_t> seen_;
    std::vector<rim_edge> rim_;
    std::vector<std::uint32_t> cone_;
};

struct mass_center {
    point3 at{};
    int dimension = 3;  ///< as in `laid_flat`
};

/// The center of mass. For a mesh without faces it is that of the points `ids`. For a closed mesh
/// it does not depend on the orientation of the faces. For a closed mesh with almost no volume,
/// such as two sheets back to back, it is that of the surface.
///
/// \pre  there is a face, or `ids` is not empty
/// \cost O(F); rounded
[[nodiscard]] mass_center center_of_mass(mesh_view mesh, std::span<const std::uint32_t> ids);

/// The height of `center` above each side of `hull`.
[[nodiscard]] std::vector<double> heights_over_sides(const convex_hull_result& hull,
                                                     const point3& center);

/// For each side, the tilt at which a body with this center of mass, at these heights, tips over.
[[nodiscard]] std::vector<double> tip_angles(points_view points, const convex_hull_result& hull,
                                             const point3& center, std::span<const double> heights);

/// Total area of the faces that, with the side on the bed, face down by more than `angle` and are
/// not on the bed.
[[nodiscard]] double overhang_of(mesh_view mesh, const hull_side& side, double angle,
                                 double tolerance);

}  // namespace treeform::detail::place
