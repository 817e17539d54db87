#pragma once
/// \file
/// What may be said about welding: which points become one, and what is kept of them.

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

enum class weld_rule : std::uint8_t {
    /// In their order, a point is dropped when an earlier kept one lies within the tolerance of it;
    /// it then belongs to the nearest of these, the earliest among equally near ones. No two kept
    /// points are within the tolerance, no point is further than that from the one it belongs to,
    /// and welding what was kept again changes nothing.
    first,
    /// Everything linked by steps of at most the tolerance is one group; its earliest point is
    /// kept. A point may be many tolerances away from it.
    chain
};

/// How neighbors are found; the groups are the same with each. Where points have many within the
/// tolerance none of these is followed to its end: kept points are looked up by cube, and chains
/// join whole cubes.
enum class neighbor_search : std::uint8_t {
    automatic,  ///< by what a look at the points says of their number within the tolerance
    window,     ///< points sorted along a line in general position, and a window sliding over them
    cells,      ///< points sorted by cubes as wide as the tolerance
    tree        ///< self-search of a `treeform::tree`
};

/// Which point of a group gives its place and its properties to what is kept.
enum class weld_keep : std::uint8_t {
    first,   ///< the lowest-numbered; nothing that is kept moves
    last,    ///< the highest-numbered
    mean,    ///< the mean of the places and of floating-point properties; the rest is the first's
    lowest,  ///< the one with the least value of `keep_by`, never NaN if there are others; of equal
             ///< ones the first
    highest  ///< the one with the greatest, likewise
};

/// A vertex property that must agree for two points to become one.
struct weld_condition {
    /// A column of the element "vertex" with one value a row; "x", "y", "z" for a coordinate;
    /// "normal", "uv" or "color" ("color") for all columns that say it.
    std::string property{};
    /// Largest difference of two values, inclusive and decided exactly. NaN agrees with NaN alone,
    /// an infinity with itself, -0 with +0.
    double tolerance = 0.0;
};

/// How to weld. `tolerance` is all that most callers set.
struct weld_options {
    double tolerance = 0.0;  ///< Euclidean, inclusive; 0: equal coordinates (-0 equals +0)
    weld_rule rule = weld_rule::first;
    neighbor_search search = neighbor_search::automatic;
    /// [V] or empty: points with different numbers never become one.
    std::span<const std::uint32_t> label{};
    /// Asked for pairs within the tolerance and of one label, whether they may become one; may be
    /// empty. Symmetric, and called from several threads at once.
    std::function<bool(std::uint32_t, std::uint32_t)> may_merge{};
    /// Properties that must agree, on top of `label` and `may_merge`.
    std::vector<weld_condition> same{};
    /// Of a mesh with faces, the seams must agree, too: normals, texture coordinates and colors
    /// of points, except for those named in `across`.
    bool keep_seams = false;
    std::vector<std::string> across{};
    weld_keep keep = weld_keep::first;
    std::string keep_by{};       ///< for `lowest` and `highest`: a property as in `weld_condition`
    bool only_borders = false;   ///< only points on edges of exactly one face; the others stay
    bool keep_manifold = false;  ///< split groups that would make non-manifold edges or points
    bool keep_degenerate = false;  ///< keep faces that repeat a corner
    progress_callback progress{};
};

/// A property that `weld_options` names and the vertices do not have, or not in a usable form.
class TREEFORM_API weld_property_error : public std::invalid_argument {
  public:
    enum class option : std::uint8_t { same, across, keep_by };
    enum class fault : std::uint8_t { missing, is_list, is_several };

    weld_property_error(option where, fault what, std::string name);

    [[nodiscard]] option where() const { return where_; }
    [[nodiscard]] fault what_is_wrong() const { return fault_; }
    [[nodiscard]] const std::string& name() const { return name_; }

  private:
    option where_;
    fault fault_;
    std::string name_;
};

/// All conditions on single columns that `options` come to: `same`, then the seams that are kept.
///
/// A name is that of a column, or else of a group of columns. A group that is not there may be
/// named in `across` all the same.
///
/// \throws weld_property_error for a name that is neither, or a column of lists
[[nodiscard]] TREEFORM_API std::vector<weld_condition> weld_conditions(const attributes& properties,
                                                                       bool has_faces,
                                                                       const weld_options& options);

/// The conditions that keep seams: equality of each of the usual columns of normals (nx, ny, nz),
/// texture coordinates (u, v, s, t, texture_u, texture_v) and colors (red, green, blue, alpha)
/// that "vertex" has, in the order of the columns; empty when there is none.
[[nodiscard]] TREEFORM_API std::vector<weld_condition> seam_conditions(
    const attributes& properties);

}  // namespace treeform
