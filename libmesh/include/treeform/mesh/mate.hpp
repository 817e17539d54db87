#pragma once
/// \file
/// A mesh brought to others so that nearest points come together.

#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/still_part.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace treeform {

struct mate_options {
    double clearance = 0.0;    ///< the gap to leave; 0: until contact
    std::size_t limit = 1000;  ///< contacts listed
    progress_callback progress{};
};

struct mate_result {
    std::size_t part = 0;    ///< the nearest one, of equals the lowest
    mesh_measure nearest{};  ///< where `a` is
    /// From the nearest point of `a` to that of the part; 0 when they meet, or are the same but for
    /// rounding.
    point3 motion{};
    /// How far along it `a` goes: 1 but for the clearance and for rounding. Not beyond the exact
    /// time of contact, as `slide` says.
    double time = 0.0;
    slide_result met{};      ///< what stops it there; `at_start`: nearer than the clearance already
    bool cancelled = false;  ///< `progress` said stop; nothing is known
};

/// The translation that brings the nearest points of `a` and of `parts` together, or to the
/// clearance; none when `a` or all parts have no faces. What touches or penetrates stays.
///
/// `settle_among` makes coordinates of it that can be written.
///
/// \pre    `tree_a` is `face_tree(a)`
/// \throws std::invalid_argument as `measure` and `slide`
/// \throws std::overflow_error where the way is beyond the range of doubles; `way_between` too
/// \cost   that of `measure` for the parts that may be nearest, and of a `slide`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<mate_result> mate(mesh_view a, const tree<3>& tree_a,
                                                           std::span<const still_part> parts,
                                                           const mate_options& options = {});

/// The same where it is known how `a` lies to what is nearest to it: `parts` are those that may be
/// in the way, and the result's `part` means nothing.
[[nodiscard]] TREEFORM_API mate_result mate(const mesh_measure& nearest, mesh_view a,
                                            const tree<3>& tree_a,
                                            std::span<const still_part> parts,
                                            const mate_options& options = {});

/// From the nearest point of the one mesh to that of the other.
[[nodiscard]] TREEFORM_API point3 way_between(const mesh_measure& nearest);

}  // namespace treeform
