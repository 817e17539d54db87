#pragma once
/// \file
/// How an operation ended, what was checked about the coordinates that it returned, and how
/// rounding of coordinates changes a mesh.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform {

/// How an operation that makes a mesh has ended.
enum class status : std::uint8_t {
    ok,              ///< everything that the operation promises was checked and holds
    open_input,      ///< an operand is not closed; `open` says where; no mesh is returned
    sheet,           ///< the mesh has a border, as asked for; everything else holds
    excessive_loss,  ///< more was lost than the caller allows
    not_manifold,    ///< with equal coordinates joined, an edge has more than two faces, or a
                     ///< vertex more than one fan
    not_certified,   ///< faces still meet in the coordinates returned; `meeting` says which
    vanished,        ///< no face is left: the result is thinner than the coordinates can show, or
                     ///< faces cancel each other out
    out_of_range,    ///< a coordinate of the result is too large for the precision asked for
    no_place,        ///< of a placement: there is no such place; `placement::end` says why
    cancelled        ///< `progress` asked to stop; nothing is returned
};

/// The work of a bounded search, in pairs of faces looked at. It depends on the input alone. What
/// the search found is valid even where it was cut short.
struct search_effort {
    std::uint64_t pairs = 0;  ///< pairs of faces looked at; a pair in motion counts as two
    std::uint64_t bound = 0;  ///< the most that the search was to look at
    /// Candidates skipped, since each would take more than 1/32 of the bound, or than what was left
    /// of it. If not 0, a better answer may exist.
    std::uint64_t cut = 0;
    friend bool operator==(const search_effort&, const search_effort&) = default;
};

/// A vertex or face of an operand: its number within that operand.
struct operand_element {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t operand = none;
    std::uint32_t index = none;
    friend bool operator==(const operand_element&, const operand_element&) = default;
};

/// A place where a surface ends, or where its faces do not agree in their orientation.
struct open_edge {
    operand_element face{};        ///< a face at the edge
    std::array<point3, 2> ends{};  ///< ends of the open part of the edge; rounded where it is cut
};

/// What was checked about a mesh that an operation (`boolean`, `resolve_self_intersections`,
/// `slide`, `pack`) returns or places: with exact predicates, on the coordinates returned.
struct TREEFORM_API certificate {
    treeform::status status = treeform::status::ok;
    /// Pairs of faces that meet where they should not. A face paired with itself is degenerate or
    /// has its outside behind it. `meeting` lists the first 100.
    std::uint64_t meeting_count = 0;
    std::vector<std::array<std::uint32_t, 2>> meeting{};
    std::vector<point3> meeting_at{};  ///< a corner of the first face of each pair in `meeting`
    /// Edges whose signed face count is not zero, in pieces where others overlap them. The first
    /// 100 of `open_count`.
    std::uint64_t open_count = 0;
    std::vector<open_edge> open{};
    /// The same edges as the operands have them, with equal coordinates joined: those of an odd
    /// number of faces, where the surface ends, and those of an even number, where faces run the
    /// same way. Both are 0 if a vertex lies inside such an edge: edges may then fit together
    /// piece by piece.
    std::uint64_t boundary_edges = 0;
    std::uint64_t misoriented_edges = 0;
    /// Rounding moved no coordinate of a vertex further than this: from where it was, exactly, or,
    /// where it is new or gone since rounding broke something, from the nearest place of the
    /// surface. Measured; moves on the way do not add up.
    double max_displacement = 0.0;
    treeform::precision precision = treeform::precision::float64;  ///< of the coordinates
    /// Of `vanished`, the faces of the exact result, all of them thinner than the coordinates tell
    /// apart; 0 where there were none.
    std::uint64_t vanished_faces = 0;
    /// Of `excessive_loss`: the volume, or the area where there is no solid, before and after.
    double size_before = 0.0;
    double size_after = 0.0;
    bool size_is_volume = false;

    explicit operator bool() const { return status == treeform::status::ok; }
    /// A clause for people, without a full stop. It names a face by the numbers in
    /// `open`, and no operand where that is `operand_element::none`.
    [[nodiscard]] std::string message() const;
};

/// Thrown by `value()` of a result that is not certified. `what()` is the certificate's message.
class TREEFORM_API not_certified_error : public std::runtime_error {
  public:
    explicit not_certified_error(certificate why);
    [[nodiscard]] const certificate& why() const { return why_; }

  private:
    certificate why_;
};

/// Distance between neighboring numbers of precision `of` at the largest finite coordinate of
/// `points`. When there is none, or all are 0, the least positive number.
[[nodiscard]] TREEFORM_API double coordinate_step(points_view points, precision of);

/// The points with each coordinate rounded to the nearest number of precision `to`; infinite beyond
/// its range.
[[nodiscard]] TREEFORM_API std::vector<point3> rounded(points_view points, precision to);

/// How far rounding moved points, and what it has broken.
struct rounding_effects {
    double max_displacement = 0.0;  ///< largest change of a coordinate, apart from the move
    double step = 0.0;  ///< between neighboring numbers, at the largest coordinate written
    /// Doubles have become float32, or a change is more than a millionth of the size.
    bool noticeable = false;
    bool compared = false;        ///< faces were compared, because coordinates are coarser now
    std::uint64_t collapsed = 0;  ///< faces that have lost their area
    std::uint64_t meeting = 0;    ///< pairs of faces that meet now, and did not before
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest means nothing

    /// Adds the effects on another mesh.
    TREEFORM_API rounding_effects& operator+=(const rounding_effects& other);
};

/// What breaks when the points of `mesh` become `placed`, exactly. The mesh may have been moved and
/// turned, too: distances are not compared, only how faces lie to each other: `collapsed`
/// and `meeting` are found, the latter of all kinds except touching and degenerate.
///
/// \throws std::invalid_argument as `self_intersections` for either, or for another number of
///         points
/// \cost   `self_intersections` of the mesh at the new points, and at the old ones only if any meet
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API rounding_effects
find_rounding_defects(mesh_view mesh, points_view placed, const progress_callback& progress = {});

/// Compares `placed` with the points of `moving` moved by `by`. Where coordinates are coarser than
/// before, it also compares the faces (`find_rounding_defects`).
///
/// \throws std::invalid_argument for another number of points
/// \cost   O(V); where coordinates are coarser, two `self_intersections` at most
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API rounding_effects
effects_of_rounding(const mesh_ref& moving, const transform<3>& by, points_view placed,
                    precision before = precision::float64, precision after = precision::float64,
                    const progress_callback& progress = {});

}  // namespace treeform
