#pragma once
/// \file
/// Set operations on solids bounded by triangle meshes.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace treeform {

/// A formula over operands a, b, c, ..., z (then aa, ab, ...): `+` or `|` union, `*` or `&`
/// intersection, `-` difference, `^` exclusive or, and brackets. `*` and `&` bind tighter than the
/// others, which go from left to right. Blanks and the case of letters do not matter.
class TREEFORM_API boolean_expression {
  public:
    /// \throws std::invalid_argument naming the position, from 1, of what cannot be read or of an
    ///         operand beyond `operand_count`
    /// \cost   O(characters) time, however deep the brackets
    boolean_expression(std::string_view text, std::size_t operand_count);

    /// What lies in any of them; of no operands nothing, as all below.
    [[nodiscard]] static boolean_expression union_of(std::size_t operand_count);
    [[nodiscard]] static boolean_expression intersection_of(std::size_t operand_count);
    /// The first without all others.
    [[nodiscard]] static boolean_expression difference_of(std::size_t operand_count);
    /// What lies in an odd number of them.
    [[nodiscard]] static boolean_expression xor_of(std::size_t operand_count);

    [[nodiscard]] std::size_t operand_count() const { return operand_count_; }

    /// Its value for points that are in these operands and in no others.
    /// \pre `in_operand` has a value for each operand
    [[nodiscard]] bool operator()(std::span<const bool> in_operand) const;

    /// Whether it is false for all points outside of that operand, whatever others they are in, as
    /// far as going through it once tells: of `a-b` for a, of `a+b` for none.
    [[nodiscard]] bool needs(std::size_t operand) const;

  private:
    boolean_expression(std::size_t operand_count, std::int32_t operation);

    std::size_t operand_count_ = 0;
    std::vector<std::int32_t> postfix_;  ///< operands as numbers from 0, operations below 0
};

/// What of an operand is solid: the points that its surface winds around how often?
enum class fill_rule : std::uint8_t {
    nonzero,  ///< not 0 times
    odd,      ///< an odd number of times
    positive  ///< once or more
};

/// What set operations take: a mesh, or one that is prepared. It refers to it.
class mesh_operand {
  public:
    mesh_operand(mesh_view mesh) : view_(mesh) {}    // NOLINT: meant to be implicit
    mesh_operand(const mesh& mesh) : view_(mesh) {}  // NOLINT
    mesh_operand(const prepared_mesh& mesh)          // NOLINT
        : view_(mesh.view()), prepared_(&mesh) {}

    [[nodiscard]] mesh_view view() const { return view_; }
    [[nodiscard]] const prepared_mesh* prepared() const { return prepared_; }

  private:
    mesh_view view_;
    const prepared_mesh* prepared_ = nullptr;
};

struct boolean_options {
    fill_rule inside = fill_rule::nonzero;
    /// The numbers of the coordinates returned; float32 values are widened to double.
    treeform::precision precision = treeform::precision::float64;
    /// Steps of mending what rounding has broken before it is reported: two of the surface, or more
    /// while they help (see `round_surface`), then of the operands, whose faces next to such places
    /// are joined where they are nearer than 2^-48, 2^-44, 2^-40 ... of the largest coordinate
    /// (2^-22, 2^-18, 2^-14 ... for float32); then all is decided once more, exactly.
    int rounding_steps = 5;
    /// Coplanar faces of the result are merged: a vertex goes where nothing meets but such faces,
    /// or faces along one straight edge; exactly, and before rounding.
    bool simplify = false;
    /// With `simplify`, [faces of all operands, one after the other], or empty: only faces with
    /// equal values are merged.
    std::span<const std::uint32_t> face_groups{};
    /// Of two operands, find `boolean_result::volumes`.
    bool volumes = false;
    progress_callback progress{};
};

/// The volumes of two operands and of what they make, for the identity
/// first + second = either + both.
struct operand_volumes {
    /// Of operands that wind once around what is inside, as `signed_volume` without the sign; of
    /// others, from the cells, as all below.
    double first = 0.0;
    double second = 0.0;
    double either = 0.0;  ///< in the first or the second
    double both = 0.0;    ///< in the first and in the second
};

/// What a set operation has done; for reports, and for nothing else.
struct boolean_statistics {
    std::uint64_t pairs = 0;       ///< of input faces that meet beyond their shared corners
    std::uint64_t cut_faces = 0;   ///< input faces that were cut or covered by others
    std::uint64_t degenerate = 0;  ///< input faces without an area, which bound nothing
    std::uint64_t cells = 0;       ///< parts of space that the operands' surfaces separate; 0 where
                                   ///< they were not looked for
    std::uint64_t covered = 0;     ///< of `split`, input faces that lie on lower ones altogether
    /// Of the exact result. Where it has some and `mesh` has none, all of it was thinner than the
    /// coordinates tell apart.
    std::uint64_t exact_faces = 0;
    std::uint64_t split_vertices = 0;  ///< added where parts touch, so that edges have two faces
    int rounding_steps = 0;            ///< of mending that were taken
};

/// A solid's surface in rounded coordinates, and what is certain about it.
struct TREEFORM_API boolean_result {
    /// Faces counter-clockwise from outside, in the order of the operands' faces they lie in;
    /// vertices of operands in their order, then those that were cut.
    treeform::mesh mesh;
    /// [F] the lowest face that each lies in; where rounding was mended, perhaps one beside it.
    std::vector<operand_element> face_source;
    std::vector<operand_element> vertex_source;  ///< [V] the lowest vertex that each is, or none
    /// [V] with `simplify`, a face that each vertex that was cut lies in, else none; or empty.
    std::vector<operand_element> face_of_cut_vertex{};
    /// Status ok: checked on the coordinates above, two faces have a common corner, a common edge
    /// or nothing in common, no face is degenerate, every edge runs as often one way as the other,
    /// and the inside is behind every face: around it the surface winds once, and not at all around
    /// what is in front.
    treeform::certificate certificate{};
    /// Components, by vertices, of the exact result that are thinner than the coordinates tell
    /// apart and have no face. Where operands were mended, of what the mended ones make.
    std::uint64_t vanished_components = 0;
    std::vector<point3> vanished_at{};  ///< a point of each, at most 100
    std::optional<operand_volumes> volumes{};
    boolean_statistics statistics{};

    /// The mesh.
    ///
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const&;
    [[nodiscard]] treeform::mesh value() &&;
};

/// The solid that `expression` makes of the operands, in one arrangement of all of them.
///
/// The surface is decided exactly on the coordinates as given; only then its constructed points are
/// rounded, and the rounded surface is checked. Where rounding makes faces meet, what is next to
/// each other is joined and cut again, step by step (`boolean_options::rounding_steps`). Given
/// vertices stay bit for bit unless float32 is asked for or they are next to such a place.
///
/// Operands may overlap themselves, touch, be nested, be equal, consist of parts, be inside out or
/// empty; their corners with equal coordinates are one. Each has to bound a solid: along every
/// edge, after cutting, its faces run as often one way as the other. Where parts of the result
/// touch in an edge or at a vertex, each has vertices of its own there, with equal coordinates, so
/// that every edge has two faces.
///
/// \throws std::invalid_argument when the expression has another number of operands, or naming a
///         face with a corner out of range, or a corner with a coordinate that is not finite
///         or beyond 2^1000
/// \cost   as `arrange_faces`, `find_cells` and `round_surface`; of two prepared operands
///         that bound solids cleanly and meet in a few places, little more than a copy of them
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API boolean_result boolean(std::span<const mesh_view> operands,
                                                  const boolean_expression& expression,
                                                  const boolean_options& options = {});

/// The same of meshes and prepared meshes: `boolean({a, b, c}, {"(a-b)*c", 3})`.
[[nodiscard]] TREEFORM_API boolean_result boolean(std::span<const mesh_operand> operands,
                                                  const boolean_expression& expression,
                                                  const boolean_options& options = {});
[[nodiscard]] inline boolean_result boolean(std::initializer_list<mesh_operand> operands,
                                            const boolean_expression& expression,
                                            const boolean_options& options = {}) {
    return boolean(std::span(operands.begin(), operands.size()), expression, options);
}

/// What is in `a` or `b`, in both, in `a` without `b`, in one of them; as `boolean` for the rest.
[[nodiscard]] TREEFORM_API boolean_result unite(const mesh_operand& a, const mesh_operand& b,
                                                const boolean_options& options = {});
[[nodiscard]] TREEFORM_API boolean_result intersection(const mesh_operand& a, const mesh_operand& b,
                                                       const boolean_options& options = {});
[[nodiscard]] TREEFORM_API boolean_result subtract(const mesh_operand& a, const mesh_operand& b,
                                                   const boolean_options& options = {});
[[nodiscard]] TREEFORM_API boolean_result symmetric_difference(const mesh_operand& a,
                                                               const mesh_operand& b,
                                                               const boolean_options& options = {});

/// The part of an open surface that `expression` keeps, in one arrangement with the solids that
/// cut it: the pieces for which the expression is true when in operand `sheet`. A piece is in a
/// solid also when it lies on its surface; so a sheet without a solid and what it has in common
/// with it are the sheet, in two parts.
///
/// The sheet may end anywhere, overlap itself, and be closed, too. Pieces are oriented as the
/// sheet's lowest faces they lie in. The certificate says nothing of edges. Where another
/// operand is open, that is named as in `boolean`, and the rest is empty.
///
/// \throws std::invalid_argument as `boolean`, when `sheet` is no operand, or when the expression
///         may be true outside of it (`boolean_expression::needs`), as that of a union
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API boolean_result clip(std::span<const mesh_view> operands,
                                               std::uint32_t sheet,
                                               const boolean_expression& expression,
                                               const boolean_options& options = {});

/// All faces of the operands, cut along each other and along themselves, every piece once: two of
/// them have a common corner, a common edge or nothing in common. Operands need not bound solids;
/// the certificate says nothing of edges. Where faces of several operands lie
/// on each other, one piece stands for all; its source is the lowest of them. Nothing is
/// simplified.
///
/// \throws std::invalid_argument as `boolean`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API boolean_result split(std::span<const mesh_view> operands,
                                                const boolean_options& options = {});

/// Whether a mesh bounds a solid, as an operand of `boolean` has to: the certificate is ok, or says
/// where the surface ends. The mesh is cut along itself only when its edges as they are leave it
/// open: then its faces may still fit together piece by piece.
///
/// \throws std::invalid_argument as `boolean`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API certificate check_solid(mesh_view mesh,
                                                   const progress_callback& progress = {});

}  // namespace treeform
