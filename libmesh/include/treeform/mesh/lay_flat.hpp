#pragma once
/// \file
/// A mesh laid on a flat side: turned, and put on a bed.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/transform.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace treeform {

enum class lay_choice : std::uint8_t {
    largest,         ///< the side of the largest area
    nearest_normal,  ///< the side whose outward normal makes the least angle with `toward`
    holding_point,   ///< the side nearest to `toward`: the one that holds it, if one does
};

struct lay_flat_options {
    lay_choice choose = lay_choice::largest;
    point3 toward{};  ///< a direction of any length, or a point, in the coordinates of the mesh
    /// Turn no more than it takes to bring the side down. Otherwise the mesh is turned about the
    /// vertical too, by 45 degrees at most, until the longest edge of the side runs along x or y.
    bool keep_spin = false;
    /// Largest distance from the plane of a side at which a point still belongs to it. With 0 a
    /// side is what is exactly in one plane: right for what a program has made in round numbers,
    /// while a flat face that was turned and rounded before is many sides. Some 1e-6 of the size
    /// joins those again.
    double tolerance = 0.0;
    double bed = 0.0;                                              ///< z of the bed
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    progress_callback progress{};
};

struct laid_flat {
    std::vector<point3> points{};  ///< [V] as they are to be written
    /// new = M * old, a rotation and a translation. `points` are within a few units in the last
    /// place of the largest coordinate of it, old or new.
    transform<3> matrix{};
    double bed = 0.0;  ///< z of the points on the bed: a float32, not below it, where asked for
    /// What there was to choose from, as it was before: largest area first. With a tolerance, each
    /// is a side of the hull and all around it that belongs to its plane, a side being in one only.
    std::vector<hull_side> sides{};
    std::size_t chosen = 0;                      ///< of `sides`
    std::vector<std::uint32_t> on_bed{};         ///< points of that side, ascending
    std::optional<placement_contact> contact{};  ///< the lowest face with the lowest point
    /// The most that a z was changed to be on the bed or not below it, beyond the rotation: some
    /// units in the last place, and of the order of the tolerance with one.
    double corrected = 0.0;
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is empty

    /// The same in the terms of all placements; nothing fixed was looked at.
    [[nodiscard]] TREEFORM_API placement as_placement() const;
};

/// `mesh` turned so that a flat side of its convex hull is on the bed. The center of its box keeps
/// x and y.
///
/// Every point that lies in the plane of the side, exactly or within the tolerance, has exactly the
/// z of the bed afterwards, and no point is below. Areas and angles are compared as rounded: those
/// within 2^-40 of the best count as equal. Of equal sides it is the one that is down already, if
/// one is (exactly), else the largest, else the first in `sides`. Points that no face uses move
/// along but do not count; all count when there are no faces.
///
/// None when there is no side: fewer than three points, or all on a line.
///
/// \throws std::invalid_argument naming a point that is not finite or a face with a corner out of
///         range; for a direction that is zero where one is needed; for options not
///         finite, and a negative tolerance
/// \throws std::overflow_error for coordinates too large to be turned
/// \cost   that of `convex_hull`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<laid_flat> lay_flat(mesh_view mesh,
                                                             const lay_flat_options& options = {});

[[nodiscard]] TREEFORM_API std::optional<laid_flat> lay_flat(const prepared_mesh& mesh,
                                                             const lay_flat_options& options = {});

}  // namespace treeform
