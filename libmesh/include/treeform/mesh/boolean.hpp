#pragma once
/// \file
/// Set operations on solids bounded by triangle meshes, and formulas of them.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

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
/// intersection, `-` difference, `^` exclusive or, and brackets. `*` and `&` bind tighter than the
/// others, which go from left to right. Blanks and the case of letters do not matter.
class TREEFORM_API boolean_expression {
  public:
    /// \throws std::invalid_argument naming the position, from 1, of what is not a formula or of an
    ///         operand beyond `operand_count`
    /// \cost   O(characters) time, however deep the brackets
    boolean_expression(std::string_view text, std::size_t operand_count);
    /// The same with names in place of letters, "body-(bolt_1+'left bolt')": words of letters,
    /// digits, underscores and dots, or anything in quotes. The first operand of a name is meant.
    boolean_expression(std::string_view text, std::span<const std::string> names);
    /// Those of a formula with names, each once, in the order in which they come first.
    [[nodiscard]] static std::vector<std::string> names_in(std::string_view text);

    /// What is in any operand. Without operands, this and the formulas below are empty.
    [[nodiscard]] static boolean_expression union_of(std::size_t operand_count);
    /// What is in all operands.
    [[nodiscard]] static boolean_expression intersection_of(std::size_t operand_count);
    /// The first operand without all others.
    [[nodiscard]] static boolean_expression difference_of(std::size_t operand_count);
    /// What is in an odd number of operands.
    [[nodiscard]] static boolean_expression xor_of(std::size_t operand_count);

    [[nodiscard]] std::size_t operand_count() const { return operand_count_; }

    /// Whether a point belongs to the result when it is in these operands and in no others.
    /// \pre `in_operand` has a value for each operand
    [[nodiscard]] bool operator()(std::span<const bool> in_operand) const;

    /// True when no point outside this operand can belong to the result: in `a-b` for a, in `a+b`
    /// for neither. Found in one pass, so it may be false for long formulas where that holds.
    [[nodiscard]] bool needs(std::size_t operand) const;

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
    nonzero,  ///< any number of times except 0
    odd,      ///< an odd number of times
    positive  ///< once or more
};

/// How to combine solids.
struct boolean_options {
    fill_rule inside = fill_rule::nonzero;  ///< what is solid
    /// Precision of the coordinates returned. float32 values are stored as doubles.
    treeform::precision precision = treeform::precision::float64;
    /// Where rounding makes faces meet, only what is at most this far apart is joined, in the
    /// mesh's own length unit, and never what is further apart than 2^-10 of the largest
    /// coordinate. Not negative.
    double max_displacement = std::numeric_limits<double>::infinity();
    /// Keep coplanar faces apart that were cut, or that overlap. By default they are merged,
    /// exactly and before rounding: a vertex goes where only such faces meet, or two flat parts of
    /// them along a straight edge. Faces that nothing has cut stay. `split` keeps all cuts.
    bool keep_cuts = false;
    bool simplify = false;  ///< merge all coplanar faces of the result, also those not cut
    /// [faces of all operands, one after the other] or empty: only those of equal numbers are
    /// merged.
    std::span<const std::uint32_t> face_groups{};
    /// Compute `boolean_result::volumes`, of two operands; not where a `gap` was filled.
    bool volumes = false;
    /// Parts of the result with a volume below this, in cubic units, are left out: specks are
    /// dropped, and voids are filled, with all that is in them. A part is a component connected by
    /// edges; its volume is what it encloses. Of solids only. Finite and not negative.
    double min_volume = 0.0;
    /// In a union, gaps of at most this width, in the mesh's own length unit, are filled between
    /// faces of different operands, where they lie over each other: both look into the gap, they
    /// lean by at most 45 degrees, and it is measured straight up from either. Nothing else moves.
    /// Beyond this width what fills it tapers off. Between curved faces there are no seams: at an
    /// edge of faces that lean less than that, it ends midway. Finite and not negative.
    double gap = 0.0;
    progress_callback progress{};
};

/// The volumes of two operands, their union and intersection: first + second = either + both.
struct operand_volumes {
    /// For an operand that winds once around its inside, `signed_volume` without the sign. For
    /// others, the sum over the cells inside, as are all volumes below.
    double first = 0.0;
    double second = 0.0;
    double either = 0.0;  ///< in the first or the second
    double both = 0.0;    ///< in the first and in the second
};

/// Counts of what a set operation has done, for reports. Pairs and faces that are cut, where a
/// `gap` was filled, are also those of what fills it.
struct boolean_statistics {
    std::uint64_t pairs = 0;          ///< of faces looked at that meet beyond their shared corners
    std::uint64_t cut_faces = 0;      ///< input faces that were cut or covered by others
    std::uint64_t degenerate = 0;     ///< input faces without area
    std::uint64_t skipped_faces = 0;  ///< input faces not looked at, as the result cannot be there
    std::uint64_t covered = 0;        ///< for `split`: input faces that lie entirely on lower ones
    /// Faces of the exact result, before rounding. When there are some and `mesh` has none, all of
    /// the result is thinner than the coordinates can show, or was left out as `small_parts`.
    std::uint64_t exact_faces = 0;
    std::uint64_t split_vertices = 0;  ///< added where parts touch, so that edges have two faces
    /// Where rounding made faces meet: changes that join what all but touches and take out thin
    /// faces, and how often what met all the same was cut and rounded once more.
    std::uint64_t slivers = 0;
    int rounding_rounds = 0;
    std::uint64_t small_parts = 0;   ///< left out, voids and specks: below `min_volume`
    double small_volume = 0.0;       ///< of these, in cubic units, added up
    std::uint64_t filled_faces = 0;  ///< of operands, at gaps that were filled (`gap`)
};

/// The surface of a solid in rounded coordinates, and what was checked about it.
struct TREEFORM_API boolean_result {
    /// Faces are counter-clockwise from outside, in the order of their sources. Vertices of
    /// operands come first, in their order, then new ones on cuts.
    treeform::mesh mesh;
    /// [F] the lowest operand face that each face, or a part of it, lies in. Next to places where
    /// rounding was mended, it may be a neighbor of that face. A face of what fills a `gap` has the
    /// operand face that it stands on, or lies opposite of; those come last.
    std::vector<operand_element> face_source;
    std::vector<operand_element> vertex_source;  ///< [V] the lowest operand vertex each is, or none
    /// [V] for each new vertex, an operand face that it lies in, or of what fills a `gap`, as
    /// `face_source`. Empty with `keep_cuts`.
    std::vector<operand_element> face_of_cut_vertex{};
    /// Status ok says, checked on the coordinates above: any two faces have a corner, an edge or
    /// nothing in common; no face is degenerate; the signed face count of every edge is zero; and
    /// the inside is behind every face: the surface winds once around points just behind it, and
    /// not around those in front.
    treeform::certificate certificate{};
    /// Components, by vertices, of the exact result that have
    /// no face left, because they are thinner than the coordinates can show.
    std::uint64_t vanished_components = 0;
    /// How far places of the exact result are, at most, from `mesh`, as seen from vertices that are
    /// gone: far where a part too thin to be shown went from a component that is still there.
    double vanished_reach = 0.0;
    std::vector<point3> vanished_at{};  ///< a point of each, at most 100
    std::optional<operand_volumes> volumes{};
    boolean_statistics statistics{};

    /// The mesh.
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const&;
    [[nodiscard]] treeform::mesh value() &&;
};

/// The solid that `expression` makes of the operands. All of them are cut along each other at once.
///
/// The surface is decided exactly, on the coordinates as given. Then points on cuts are rounded,
/// and the rounded surface is checked. Where rounding makes faces meet, thin faces are taken out,
/// and what still meets is cut and rounded again, in rounds. Vertices of
/// operands stay bit for bit, except next to such a place, or when float32 is asked for.
///
/// Each operand has to bound a solid: after cutting, the signed face count of every edge is zero.
/// Operands may overlap themselves, touch, be nested, be equal, consist of parts, be inside out or
/// empty. Their corners with equal coordinates are one vertex. Where parts of the result touch in
/// an edge or at a vertex, each part has vertices of its own there, with equal coordinates, so that
/// every edge has two faces.
///
/// \throws std::invalid_argument when the expression has another number of operands, or naming a
///         face with a corner out of range, or a corner with a coordinate that is not finite
///         or beyond 2^1000; for a `gap` when it is not a union of all operands
/// \cost   O(F log F) for the faces where the result's surface may be. Of one or two closed
///         manifolds that meet in few places, that of finding these (prepared meshes: once) and of
///         a copy. With a `gap`, O(P) more for the P pairs of faces whose boxes are that near
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API boolean_result boolean(const mesh_refs& operands,
                                                  const boolean_expression& expression,
                                                  const boolean_options& options = {});
/// The same by a formula: `boolean({a, b, c}, "(a-b)*c")`. See `boolean_expression`.
[[nodiscard]] TREEFORM_API boolean_result boolean(const mesh_refs& operands, const char* formula,
                                                  const boolean_options& options = {});

/// What is in `a` or `b` (unite), in both (intersection), in `a` but not in `b` (subtract), in
/// exactly one of them (symmetric_difference). For everything else, see `boolean`.
[[nodiscard]] TREEFORM_API boolean_result unite(const mesh_ref& a, const mesh_ref& b,
                                                const boolean_options& options = {});
[[nodiscard]] TREEFORM_API boolean_result intersection(const mesh_ref& a, const mesh_ref& b,
                                                       const boolean_options& options = {});
[[nodiscard]] TREEFORM_API boolean_result subtract(const mesh_ref& a, const mesh_ref& b,
                                                   const boolean_options& options = {});
[[nodiscard]] TREEFORM_API boolean_result symmetric_difference(const mesh_ref& a, const mesh_ref& b,
                                                               const boolean_options& options = {});

/// An open surface cut by solids: the pieces of operand `sheet` for which `expression` is true. A
/// piece that lies on the surface of a solid is inside that solid. So the sheet minus a solid, and
/// the sheet inside it, together are the sheet.
///
/// The sheet may end anywhere, overlap itself, and even be closed. A piece is oriented as the
/// lowest face of the sheet that it lies in. The certificate does not check edges, since the result
/// is open. Where another operand is open, it says so as in `boolean`, and the mesh is empty.
///
/// \throws std::invalid_argument as `boolean`, when `sheet` is not an operand, or when the
///         expression may be true outside of it (`boolean_expression::needs`), as in a union, and
///         for `min_volume` or `gap`
/// \cost   faces of solids that do not reach into the box of a face of the sheet are not looked at
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API boolean_result clip(const mesh_refs& operands, std::uint32_t sheet,
                                               const boolean_expression& expression,
                                               const boolean_options& options = {});

/// All faces of the operands, cut along each other and along themselves, each piece once. Any two
/// pieces have a corner, an edge or nothing in common. Operands need not bound solids, and the
/// certificate does not check edges. Where faces of several operands lie on each other, one piece
/// stands for all; its source is the lowest of them. Nothing is simplified.
///
/// \throws std::invalid_argument as `boolean`, and for `min_volume` or `gap`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API boolean_result split(const mesh_refs& operands,
                                                const boolean_options& options = {});

/// Whether a mesh bounds a solid, as an operand of `boolean` has to. The certificate is ok, or says
/// where the surface ends. When the edges as they are leave the mesh open, it is cut along itself
/// first: its faces may still fit together piece by piece.
///
/// \throws std::invalid_argument as `boolean`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API certificate check_solid(const mesh_ref& mesh,
                                                   const progress_callback& progress = {});

}  // namespace treeform
