#pragma once
/// \file
/// The status of an operation, the certificate of the coordinates that it returns, and the effects
/// of rounding on a mesh.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform {

namespace detail {
template <class Kind>
inline constexpr std::array<const char*, 0> names_of{};
}

/// The name of an enumerator of results: `name_of(status::open_input)` is "open-input".
template <class Kind>
requires(detail::names_of<Kind>.size() > 0) [[nodiscard]] constexpr const char* name_of(Kind kind) {
    return detail::names_of<Kind>[static_cast<std::size_t>(kind)];
}

/// Counts by kind: `counts[pair_kind::crossing]`. Also an array, in the order of the enumerators.
template <class Kind, std::size_t N>
struct counts_by : std::array<std::uint64_t, N> {
    using std::array<std::uint64_t, N>::operator[];
    [[nodiscard]] constexpr std::uint64_t operator[](Kind kind) const {
        return (*this)[static_cast<std::size_t>(kind)];
    }
    [[nodiscard]] constexpr std::uint64_t& operator[](Kind kind) {
        return (*this)[static_cast<std::size_t>(kind)];
    }
};

/// The outcome of an operation that makes a mesh.
enum class status : std::uint8_t {
    ok,              ///< everything that the operation guarantees was verified
    open_input,      ///< an operand is not closed; `open_edges` lists where; no mesh is returned
    sheet,           ///< the mesh has a border, as requested; all other guarantees hold
    excessive_loss,  ///< more volume or area was lost than the options allow
    not_manifold,    ///< with equal coordinates joined, an edge has more than two faces, or a
                     ///< vertex more than one fan
    not_certified,   ///< faces still meet in the returned coordinates; `meeting` lists them
    /// no face is left: the result is thinner than the coordinates can represent, or its faces
    /// cancel each other out
    vanished,
    out_of_range,  ///< a coordinate of the result overflows the requested precision
    no_placement,  ///< a placement found no position; `placement::outcome` has the reason
    cancelled      ///< stopped by `progress`; there is no result
};
template <>
inline constexpr auto detail::names_of<status> = std::array{
    "ok",       "open-input",   "sheet",        "excessive-loss", "not-manifold", "not-certified",
    "vanished", "out-of-range", "no-placement", "cancelled"};

/// The work of a bounded search, in pairs of faces tested. It depends on the input alone. A result
/// is valid even if the bound was reached.
struct search_effort {
    std::uint64_t pairs = 0;  ///< pairs of faces tested; a pair in motion counts as two
    std::uint64_t bound = 0;  ///< the limit of `pairs`
    /// Number of candidates skipped because testing one would take more than 1/32 of the bound, or
    /// more than the rest of it. If not 0, a better result may exist.
    std::uint64_t skipped_candidates = 0;
    friend bool operator==(const search_effort&, const search_effort&) = default;
};

/// A vertex or face of an operand: its number within that operand.
struct operand_element {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t operand = none;
    std::uint32_t index = none;
    friend bool operator==(const operand_element&, const operand_element&) = default;
};

/// The outcome of checking the mesh that an operation (`boolean`, `repair`, `slide`, `pack`, ...)
/// returns or places. The check is exact, on the returned coordinates.
struct TREEFORM_API certificate {
    treeform::status status = treeform::status::ok;
    /// Number of pairs of faces that meet beyond common corners and edges. A face paired with
    /// itself means that this face is degenerate, or that the outside of the solid is behind it.
    /// `meeting` lists the first 100.
    std::uint64_t meeting_count = 0;
    std::vector<std::array<std::uint32_t, 2>> meeting{};
    std::vector<point3> meeting_at{};  ///< a corner of the first face of each pair in `meeting`
    /// Number of edges whose signed face count is not zero. Where edges overlap, their pieces are
    /// counted. `open_edges` and `open_faces` list the first 100.
    std::uint64_t open_count = 0;
    /// Ends of the open part of each edge; rounded if the edge is cut.
    std::vector<std::array<point3, 2>> open_edges{};
    /// One face at each edge in `open_edges`. Functions of one mesh, such as `repair`, name no
    /// operand.
    std::vector<operand_element> open_faces{};
    /// The open edges counted in the operands, after joining equal coordinates: `boundary_edges`
    /// have an odd number of faces (the surface ends there), `misoriented_edges` an even number of
    /// inconsistently oriented faces. Both are 0 if a vertex lies inside such an edge, since edges
    /// may then match piece by piece.
    std::uint64_t boundary_edges = 0;
    std::uint64_t misoriented_edges = 0;
    /// The largest change of a coordinate by rounding, from the exact position of the vertex; for
    /// vertices added or removed to repair what rounding did, from the nearest point of the exact
    /// surface. Measured on the result: intermediate moves do not add up.
    double max_displacement = 0.0;
    treeform::precision precision = treeform::precision::float64;  ///< of the coordinates
    /// For status `vanished`: number of faces of the exact result, all too thin for the
    /// coordinates; 0 if it had no faces.
    std::uint64_t vanished_faces = 0;
    double size_before = 0.0;     ///< for status `excessive_loss`: volume or area before
    double size_after = 0.0;      ///< the same after
    bool size_is_volume = false;  ///< `size_before` and `size_after` are volumes, not areas

    explicit operator bool() const { return status == treeform::status::ok; }
    /// The outcome as a clause for messages, without a full stop. Faces have the numbers in
    /// `open_faces`; an operand that is `operand_element::none` is not named.
    [[nodiscard]] std::string message() const;
};

/// Thrown by `value()` of a result without a certificate of status ok. `what()` is the
/// certificate's message; for a `placed_mesh`, that of the placement.
class TREEFORM_API not_certified_error : public std::runtime_error {
  public:
    explicit not_certified_error(certificate why);
    /// `what()` is `message`, unless that is empty.
    not_certified_error(certificate why, const std::string& message);
    [[nodiscard]] const certificate& why() const { return why_; }

  private:
    certificate why_;
};

/// The unit in the last place, in precision `of`, of the finite coordinate of largest magnitude.
/// The least positive number of that precision if no coordinate is finite, or all are 0.
[[nodiscard]] TREEFORM_API double coordinate_step(points_view points, precision of);

/// The points with each coordinate rounded to the nearest number of precision `to`; infinite beyond
/// its range.
[[nodiscard]] TREEFORM_API std::vector<point3> rounded(points_view points, precision to);

/// How far rounding moved points, and the defects that it caused.
struct rounding_effects {
    double max_displacement = 0.0;  ///< largest change of a coordinate, after the transform
    double step = 0.0;              ///< spacing of numbers at the largest written coordinate
    /// True if doubles became float32 and points moved, or if points moved by more than a millionth
    /// of the diagonal of the bounding box.
    bool noticeable = false;
    /// Whether `collapsed` and `meeting` were computed: only if points moved, coordinates became
    /// coarser, and there are faces.
    bool compared = false;
    std::uint64_t collapsed = 0;                     ///< faces that became degenerate
    std::uint64_t meeting = 0;                       ///< new pairs of faces that meet
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is invalid

    /// Adds the effects on another mesh.
    TREEFORM_API rounding_effects& operator+=(const rounding_effects& other);
};

/// Counts the defects that arise when `placed` replaces the points of `mesh`: faces that become
/// degenerate (`collapsed`), and pairs of faces that newly meet (`meeting`; all kinds except
/// touching and degenerate). Exact. Distances are not compared, so `placed` may also be moved and
/// rotated.
///
/// \throws std::invalid_argument as `self_intersections` for either, or if the numbers of points
///         differ
/// \cost   `self_intersections` of the mesh at the new points; also at the old points if any faces
///         meet
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API rounding_effects
find_rounding_defects(mesh_view mesh, points_view placed, const progress_callback& progress = {});

/// Compares `placed` with the points of `moving` transformed by `by`. `before` and `after` are the
/// precisions of `moving` and of `placed`. If coordinates became coarser, also counts defects of
/// faces (`find_rounding_defects`).
///
/// \throws std::invalid_argument if the numbers of points differ
/// \cost   O(V); if coordinates became coarser, also up to two `self_intersections`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API rounding_effects
find_rounding_effects(const mesh_ref& moving, const transform<3>& by, points_view placed,
                      precision before = precision::float64, precision after = precision::float64,
                      const progress_callback& progress = {});

}  // namespace treeform
