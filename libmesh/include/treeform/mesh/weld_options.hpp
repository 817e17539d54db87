#pragma once
/// \file
/// Options of welding: which points are merged, and what is kept of them.

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

/// Which points become one.
enum class weld_rule : std::uint8_t {
    /// Goes through the points in order, and drops a point when an earlier kept one is within the
    /// tolerance. The point then belongs to the nearest of these; among equally near ones, to the
    /// earliest. So no two kept points are within the tolerance, no point is further than that from
    /// the one it belongs to, and welding the kept points again changes nothing.
    first,
    /// All points that are linked by steps of at most the tolerance are one group. Its earliest
    /// point is kept. A point may be many tolerances away from it.
    chain
};

/// Which point of a group is kept, with its coordinates and properties.
enum class weld_keep : std::uint8_t {
    first,   ///< the lowest-numbered; kept points do not move
    last,    ///< the highest-numbered
    mean,    ///< the mean of coordinates and floating-point properties; the rest of the first point
    lowest,  ///< the one with the least value of `keep_by`, not NaN if there are others; of equal
             ///< ones the first
    highest  ///< the one with the greatest value of `keep_by`, otherwise as `lowest`
};

/// In which order the rules go through the points: which is the first of several.
enum class weld_order : std::uint8_t {
    given,   ///< as they are numbered
    lowest,  ///< by `order_by`, the least value first, NaN last; of equal ones the lowest-numbered
    highest  ///< by `order_by`, the greatest value first, otherwise as `lowest`
};

/// A vertex property that must agree for two points to become one.
struct weld_condition {
    /// A column of the element "vertex" with one value a row; "x", "y" or "z" for a coordinate;
    /// "normal", "uv" or "color" for all columns of that kind.
    std::string property{};
    /// Largest difference of two values, inclusive and decided exactly. NaN agrees only with NaN,
    /// an infinity only with itself, -0 with +0.
    double tolerance = 0.0;
};

/// How to weld. `tolerance` is all that most callers set.
struct weld_options {
    double tolerance = 0.0;  ///< Euclidean, inclusive; 0: equal coordinates (-0 equals +0)
    weld_rule rule = weld_rule::first;
    /// [V] or empty: points with different labels are never merged.
    std::span<const std::uint32_t> label{};
    /// Whether two points may be merged; or empty. It is asked about pairs within the tolerance
    /// with equal labels. It has to be symmetric, and is called from several threads at once.
    std::function<bool(std::uint32_t, std::uint32_t)> may_merge{};
    /// Properties that must agree, in addition to `label` and `may_merge`.
    std::vector<weld_condition> same{};
    /// For a mesh with faces: keep seams. Normals, texture coordinates and colors of points must
    /// agree, too, except for those named in `across`.
    bool keep_seams = false;
    std::vector<std::string> across{};
    weld_keep keep = weld_keep::first;
    std::string keep_by{};  ///< for `lowest` and `highest`: a property as in `weld_condition`
    /// Except for `given`, needs `weld_keep::first`: the point that is first in this order is kept.
    /// What the rules promise holds for it. Points that are kept stay in the order of numbers.
    weld_order order = weld_order::given;
    std::string order_by{};      ///< for `lowest` and `highest`: a property as in `weld_condition`
    bool only_borders = false;   ///< merge only points on edges of exactly one face
    bool keep_manifold = false;  ///< split groups that would make non-manifold edges or points
    bool keep_degenerate = false;  ///< keep faces that repeat a corner
    progress_callback progress{};

    /// The conditions on single columns that these imply: those of `same`, then of seams.
    ///
    /// A name is that of a column, or else of a group of columns. `across` may name a group that
    /// the vertices do not have.
    ///
    /// \throws weld_property_error for a name that is neither, or a column of lists
    [[nodiscard]] TREEFORM_API std::vector<weld_condition> conditions(const attributes& properties,
                                                                      bool has_faces) const;
};

/// `weld_options` names a property that the vertices do not have, or not in a usable form.
class TREEFORM_API weld_property_error : public std::invalid_argument {
  public:
    /// `option` is the member of `weld_options`; `reason` half a sentence, empty for a property
    /// that is missing.
    weld_property_error(std::string option, std::string name, std::string reason);

    [[nodiscard]] const std::string& option() const { return option_; }
    [[nodiscard]] const std::string& name() const { return name_; }
    /// "has lists of values", "is more than one property"; empty: there is none of that name.
    [[nodiscard]] const std::string& reason() const { return reason_; }

  private:
    std::string option_;
    std::string name_;
    std::string reason_;
};

}  // namespace treeform
