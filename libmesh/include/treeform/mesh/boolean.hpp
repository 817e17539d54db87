#pragma once
/// \file
/// Set operations (booleans) on solids bounded by triangle meshes, and formulas of several.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treeform {

/// A formula over operands a, b, c, ..., z (then aa, ab, ...): `+` or `|` union, `*` or `&`
/// intersection, `-` difference, `^` symmetric difference, and parentheses. `*` and `&` bind first,
/// and the others are evaluated from left to right. Blanks and case of letters do not matter.
class TREEFORM_API boolean_expression {
  public:
    /// \throws std::invalid_argument naming the position, from 1, of a syntax error or of an
    ///         operand beyond `operand_count`
    /// \cost   O(characters) time, for any nesting depth
    boolean_expression(std::string_view text, std::size_t operand_count);
    /// The same with names for letters, "body-(bolt_1+'left bolt')": words of letters, digits,
    /// underscores and dots, or any text in quotes. A repeated name means its first operand.
    boolean_expression(std::string_view text, std::span<const std::string> names);
    /// The names in a formula, each once, in the order of first use.
    [[nodiscard]] static std::vector<std::string> names_in(std::string_view text);

    /// Points in any operand. Without operands, this and the formulas below are empty.
    [[nodiscard]] static boolean_expression union_of(std::size_t operand_count);
    /// Points in all operands.
    [[nodiscard]] static boolean_expression intersection_of(std::size_t operand_count);
    /// The first operand minus all others.
    [[nodiscard]] static boolean_expression difference_of(std::size_t operand_count);
    /// Points in an odd number of operands.
    [[nodiscard]] static boolean_expression symmetric_difference_of(std::size_t operand_count);

    [[nodiscard]] std::size_t operand_count() const { return operand_count_; }

    /// Whether a point that is in exactly these operands belongs to the result.
    /// \pre `in_operand` has a value for each operand
    [[nodiscard]] bool operator()(std::span<const bool> in_operand) const;

    /// Whether the result is inside this operand, whatever the shapes: true for a in `a-b`, false
    /// for a and b in `a+b`. False may also mean not proven, for a long formula.
    [[nodiscard]] bool is_inside(std::size_t operand) const;

    /// The formula in postfix notation: operands as numbers from 0, and these operations.
    enum : std::int32_t { add = -1, intersect = -2, minus = -3, exclude = -4 };
    [[nodiscard]] std::span<const std::int32_t> postfix() const { return postfix_; }

  private:
    boolean_expression(std::size_t operand_count, std::int32_t operation);

    std::size_t operand_count_ = 0;
    std::vector<std::int32_t> postfix_;
};

/// Which points are inside an operand, by how often its surface winds around them.
enum class fill_rule : std::uint8_t {
    nonzero,   ///< any number of times except 0
    even_odd,  ///< an odd number of times
    positive   ///< once or more
};

/// How to combine solids.
struct boolean_options {
    treeform::fill_rule fill_rule = treeform::fill_rule::nonzero;  ///< what is inside
    /// Precision of the coordinates returned. float32 values are stored as doubles.
    treeform::precision precision = treeform::precision::float64;
    /// Where rounding makes faces meet, points are joined, but only if they are at most this far
    /// apart, in the mesh's length unit, and at most 2^-10 of the largest coordinate. Not negative.
    double max_displacement = std::numeric_limits<double>::infinity();
    /// Do not merge coplanar faces that were cut, or that overlap. By default they are merged
    /// before rounding, which removes vertices inside a flat region and on straight edges between
    /// two regions. Uncut faces are not changed.
    bool keep_cuts = false;
    bool merge_coplanar = false;  ///< merge all coplanar faces of the result, also those not cut
    /// [F of all operands, in order] or empty: only faces of the same group are merged.
    std::span<const std::uint32_t> face_groups{};
    /// Compute `boolean_result::volumes`; only for two operands, without filled gaps.
    bool volumes = false;
    /// Parts of the result with a smaller volume, in cubic units, are removed: small solids are
    /// dropped, and small voids are filled, with all that is in them. A part is connected by edges;
    /// its volume is the volume that it encloses. For solids only. Finite and not negative.
    double min_volume = 0.0;
    /// In a union, fills gaps of at most this width, in the mesh's length unit, between faces of
    /// different operands that face each other across the gap, at an angle of at most 45 degrees.
    /// The width is measured along the normal of either face. Nothing else moves. Where the gap is
    /// wider, the filling tapers off. At an edge between faces that differ by less than 45 degrees,
    /// the fillings of both meet midway, without a seam. Finite and not negative.
    double gap = 0.0;
    progress_callback progress{};
};

/// The volumes of two operands, their union and intersection: first + second = either + both.
struct operand_volumes {
    /// The magnitude of `signed_volume`, for an operand that winds once around its inside. For
    /// others the sum over the cells inside, like the volumes below.
    double first = 0.0;
    double second = 0.0;
    double either = 0.0;  ///< in the first or the second
    double both = 0.0;    ///< in the first and in the second
};

/// Counts of the steps, for reports. Pairs and cut faces include those of a filled `gap`.
struct boolean_statistics {
    std::uint64_t pairs = 0;          ///< pairs of tested faces that meet beyond shared corners
    std::uint64_t cut_faces = 0;      ///< input faces that were cut or covered by others
    std::uint64_t degenerate = 0;     ///< input faces without area
    std::uint64_t skipped_faces = 0;  ///< input faces skipped, since the result cannot contain them
    /// If all pieces are kept: input faces that are entirely covered by faces with lower numbers.
    std::uint64_t covered = 0;
    /// Faces of the exact result, before rounding. If not 0 while `mesh` has no faces, all of the
    /// result was too thin for the coordinates, or removed as `small_parts`.
    std::uint64_t exact_faces = 0;
    std::uint64_t split_vertices = 0;  ///< added where parts touch, so that edges have two faces
    /// Number of changes that joined points or removed thin faces where rounding made faces meet.
    std::uint64_t rounding_repairs = 0;
    int rounding_rounds = 0;         ///< how often faces that still met were cut and rounded again
    std::uint64_t small_parts = 0;   ///< number of solids and voids removed by `min_volume`
    double small_volume = 0.0;       ///< their total volume, in cubic units
    std::uint64_t filled_faces = 0;  ///< faces of operands at filled gaps (`gap`)
};

/// The surface of a solid in rounded coordinates, with its sources and certificate.
struct TREEFORM_API boolean_result {
    /// Faces are counter-clockwise from outside, in the order of their sources. Vertices of
    /// operands come first, in their order, then new ones on cuts.
    treeform::mesh mesh;
    /// [F] the lowest operand face that contains each face or a part of it. Where rounding made
    /// faces meet, it may be a neighbor of that face. For a face that fills a `gap`, it is the
    /// operand face at or opposite to it; such faces come last.
    std::vector<operand_element> face_source;
    /// [V] the lowest operand vertex equal to each vertex, or none
    std::vector<operand_element> vertex_source;
    /// [V] for each new vertex, an operand face that contains it; in a filled `gap`, as in
    /// `face_source`. Empty with `keep_cuts`.
    std::vector<operand_element> face_of_cut_vertex{};
    /// Status ok means, verified on the coordinates of `mesh`: any two faces share a corner, an
    /// edge or nothing; no face is degenerate; the signed face count of every edge is zero; and the
    /// inside is behind every face: the surface winds once around points just behind the face, and
    /// not around those in front.
    treeform::certificate certificate{};
    /// Components of the exact result that have no face left, being too thin for the coordinates.
    std::uint64_t vanished_components = 0;
    /// The largest distance from `mesh` to a removed vertex of the exact result. It is large if a
    /// component lost a part too thin for the coordinates.
    double vanished_distance = 0.0;
    std::vector<point3> vanished_at{};  ///< one point of each vanished component; at most 100
    std::optional<operand_volumes> volumes{};
    boolean_statistics statistics{};

    /// The mesh.
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const&;
    [[nodiscard]] treeform::mesh value() &&;
};

/// The solid that `expression` defines. All operands are cut along each other in one arrangement.
///
/// The surface is decided exactly, on the coordinates as given. Then points on cuts are rounded,
/// and the rounded surface is checked. Where rounding makes faces meet, thin faces are removed, and
/// faces that still meet are cut and rounded again, in rounds. Vertices of operands stay bit for
/// bit, except next to such a place, or if float32 is requested.
///
/// Each operand must bound a solid: after cutting, the signed face count of every edge is zero.
/// Operands may overlap themselves, touch, be nested, be equal, consist of parts, be inside out or
/// empty. Their corners with equal coordinates are one vertex. Where parts of the result touch,
/// each has its own vertices, with equal coordinates, so that every edge has two faces.
///
/// \throws std::invalid_argument naming a face with a corner out of range, or a corner with a
///         coordinate that is not finite or beyond 2^1000; if the `boolean_expression` has another
///         number of operands; for a `gap` if the expression is not a union of all operands
/// \cost   O(F log F) for the F faces where the result's surface may be. For one or two closed
///         manifolds that meet in few places: a search for these places (only once for a prepared
///         mesh), and a copy. A `gap` adds O(P) for the P pairs of faces whose boxes are that near
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API boolean_result boolean(const mesh_refs& operands,
                                                  const boolean_expression& expression,
                                                  const boolean_options& options = {});
/// The same with a formula: `boolean({a, b, c}, "(a-b)*c")`. See `boolean_expression`.
template <std::convertible_to<std::string_view> Text>
[[nodiscard]] boolean_result boolean(const mesh_refs& operands, const Text& formula,
                                     const boolean_options& options = {}) {
    return boolean(operands, boolean_expression(formula, operands.size()), options);
}

/// Union: points in `a` or `b`.
[[nodiscard]] TREEFORM_API boolean_result unite(const mesh_ref& a, const mesh_ref& b,
                                                const boolean_options& options = {});
/// Intersection: points in `a` and in `b`.
[[nodiscard]] TREEFORM_API boolean_result intersection(const mesh_ref& a, const mesh_ref& b,
                                                       const boolean_options& options = {});
/// Difference: points in `a`, but in none of `b`.
[[nodiscard]] TREEFORM_API boolean_result difference(const mesh_ref& a, const mesh_refs& b,
                                                     const boolean_options& options = {});
/// Symmetric difference: points in exactly one of `a` and `b`.
[[nodiscard]] TREEFORM_API boolean_result symmetric_difference(const mesh_ref& a, const mesh_ref& b,
                                                               const boolean_options& options = {});
/// The union, and the intersection, of any number of meshes: `unite(parts)`, `unite({a, b, c})`.
[[nodiscard]] TREEFORM_API boolean_result unite(const mesh_refs& meshes,
                                                const boolean_options& options = {});
[[nodiscard]] TREEFORM_API boolean_result intersection(const mesh_refs& meshes,
                                                       const boolean_options& options = {});

/// An open surface cut by solids: the pieces of operand `sheet` for which `expression` is true. A
/// piece on the surface of a solid counts as inside, so the sheet minus a solid and the sheet
/// inside that solid together are the sheet.
///
/// The sheet may have borders, overlap itself, or even be closed. A piece is oriented as the
/// lowest face of the sheet that it lies in. The certificate does not check edges, since the result
/// is open. If another operand is open, the status is `open_input` and the mesh is empty.
///
/// \throws std::invalid_argument as `boolean`; if `sheet` is not the number of an operand; if the
///         `boolean_expression` may be true outside of the sheet
///         (`boolean_expression::is_inside`), as in a union; for `min_volume` or `gap`
/// \cost   as `boolean`; faces of solids whose boxes overlap no face of the sheet are skipped
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API boolean_result clip(const mesh_refs& operands, std::uint32_t sheet,
                                               const boolean_expression& expression,
                                               const boolean_options& options = {});

/// All faces of the operands, cut along each other and along themselves, each piece once. Any two
/// pieces share a corner, an edge or nothing. Operands need not bound solids, and the certificate
/// does not check edges. Where faces overlap, one piece stands for all; its source is the lowest of
/// them. Coplanar pieces are not merged.
///
/// \throws std::invalid_argument as `boolean`, and for `min_volume` or `gap`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API boolean_result split(const mesh_refs& operands,
                                                const boolean_options& options = {});

/// Whether a mesh can be an operand of `boolean`: it must be closed, as given or after it is cut
/// along itself. If not, the certificate lists open edges. `find_solid_defects` is stricter.
///
/// \throws std::invalid_argument as `boolean`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API certificate check_operand(const mesh_ref& mesh,
                                                     const progress_callback& progress = {});

}  // namespace treeform
