#pragma once
/// \file
/// Options of welding: which points are merged, and which values are kept.

#include <treeform/mesh/attributes.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform {

/// Which point of a group is kept, with its coordinates and properties.
enum class weld_keep : std::uint8_t {
    first,   ///< the lowest-numbered; kept points do not move
    last,    ///< the highest-numbered
    mean,    ///< the mean of coordinates and floating-point properties; the rest: the first point's
    lowest,  ///< the one with the least value of `keep_by`, not NaN if there are others; of equal
             ///< ones the first
    highest  ///< the one with the greatest value of `keep_by`, otherwise as `lowest`
};

/// A vertex property that must agree for two points to be merged.
struct weld_condition {
    /// A column of the element "vertex" with one value a row; "x", "y" or "z" for a coordinate;
    /// "normal", "uv" or "color" for all columns of that kind.
    std::string property{};
    /// Largest difference of two values, inclusive and decided exactly. NaN agrees only with NaN,
    /// an infinity only with itself, -0 with +0.
    double tolerance = 0.0;
};

/// How to weld. Most callers only set `tolerance`.
struct weld_options {
    double tolerance = 0.0;  ///< Euclidean, inclusive; 0: equal coordinates (-0 equals +0)
    /// The rule that forms groups. By default, points are visited in order, and one is dropped
    /// if an earlier kept point is within the tolerance. The dropped point joins the nearest of
    /// these kept points, and the earliest of equally near ones. So no two kept points are within
    /// the tolerance, no point is further than the tolerance from the kept point of its
    /// group, and welding the kept points again changes nothing. With `chain`, all points linked by
    /// steps of at most the tolerance are one group. Its earliest point is kept. A point may be
    /// many tolerances away from that point.
    bool chain = false;
    /// [V] or empty: points with different labels are never merged.
    std::span<const std::uint32_t> label{};
    /// Empty, or a function that returns whether two points may be merged. Called for pairs within
    /// the tolerance with equal labels, from several threads at once; must be symmetric.
    std::function<bool(std::uint32_t, std::uint32_t)> may_merge{};
    /// Properties that must agree, in addition to `label` and `may_merge`.
    std::vector<weld_condition> same{};
    /// For a mesh with faces: keep seams, that is, normals, texture coordinates and colors of
    /// points must agree, except for those named in `ignored_seams`.
    bool keep_seams = false;
    std::vector<std::string> ignored_seams{};
    weld_keep keep = weld_keep::first;
    std::string keep_by{};  ///< for `lowest` and `highest`: a property as in `weld_condition`
    /// A property as in `weld_condition`. Points are visited in the order of its values: the
    /// smallest first, NaN last, equal values by point number. The point of a group that is visited
    /// first is kept. Needs `weld_keep::first`. Empty: by point number. Kept points remain in the
    /// order of their numbers.
    std::string order_by{};
    bool highest_first = false;    ///< for `order_by`: the greatest value first
    bool only_borders = false;     ///< merge only points on edges of exactly one face
    bool keep_manifold = false;    ///< split groups that would make non-manifold edges or points
    bool keep_degenerate = false;  ///< keep faces that repeat a corner
    progress_callback progress{};

    /// The conditions that these options imply, on single columns: conditions of `same`, then
    /// conditions of seams.
    ///
    /// A property name is the name of a column, or else of a group of columns. `ignored_seams` may
    /// name groups that the vertices lack.
    ///
    /// \throws weld_property_error for an unknown name, or a column of lists
    [[nodiscard]] TREEFORM_API std::vector<weld_condition> conditions(const attributes& properties,
                                                                      bool has_faces) const;
};

/// Thrown if `weld_options` names a property that the vertices lack, or that cannot be used.
class TREEFORM_API weld_property_error : public std::invalid_argument {
  public:
    /// `option` is the member of `weld_options`, `name` the property. `reason` is a clause, see
    /// `reason()`; empty if the property is missing.
    weld_property_error(std::string option, std::string name, std::string reason);

    [[nodiscard]] const std::string& option() const { return option_; }
    [[nodiscard]] const std::string& name() const { return name_; }
    /// "has lists of values", "is more than one property"; empty if there is no property of that
    /// name.
    [[nodiscard]] const std::string& reason() const { return reason_; }

  private:
    std::string option_;
    std::string name_;
    std::string reason_;
};

}  // namespace treeform
