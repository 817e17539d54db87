#pragma once
/// \file
/// Set operations on solids bounded by triangle meshes.

#include <treeform/mesh/expression.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// What of an operand is solid: the points its surface winds around how often?
enum class inside_rule : std::uint8_t {
    nonzero,  ///< not 0 times
    odd,      ///< an odd number of times
    positive  ///< once or more
};

/// A corner or face of the input: `index` counts within operand `operand`.
struct operand_element {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t operand = none;
    std::uint32_t index = none;
    friend bool operator==(const operand_element&, const operand_element&) = default;
};

/// A place where an operand's surface ends.
struct open_operand_edge {
    operand_element face{};        ///< at the edge
    std::array<point3, 2> ends{};  ///< of the open part of the edge; rounded where it is cut
};

struct boolean_options {
    inside_rule inside = inside_rule::nonzero;
    /// The coordinates written: rounded to float (then widened), or to double.
    bool to_float = false;
    /// Steps of mending what rounding has broken before it is reported: two of the surface, or more
    /// while they help (see `round_surface`), then of the operands, whose faces next to such places
    /// are joined where they are nearer than 2^-48, 2^-44, 2^-40 ... of the largest coordinate
    /// (2^-22, 2^-18, 2^-14 ... for floats); then all is decided once more, exactly.
    int rounding_steps = 5;
    /// Of the result, faces in one plane are merged: corners go that nothing but such faces, or
    /// faces along one straight edge, has in common, exactly and before rounding.
    bool simplify = false;
    /// With `simplify`, [faces of all operands, one after the other], or empty: only faces with
    /// equal values are merged.
    std::span<const std::uint32_t> face_groups{};
    /// Of two operands, find `solid_result::volumes`.
    bool volumes = false;
    /// Of each operand it is known that it bounds a solid as a certified `solid_result` does: two
    /// of its faces have a common corner, a common edge or nothing in common, none is degenerate,
    /// corners with equal coordinates are one, every edge is closed, and what is behind the faces
    /// is inside. Then nothing of this is looked at again: of two operands only what is near the
    /// other one is, the rest is copied. `certified` speaks of the result only if this holds.
    /// It changes nothing in the result but `cells`, which may stay 0.
    bool sound_operands = false;
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

/// A solid's surface in rounded coordinates, and what is certain about it.
struct solid_result {
    /// Faces counter-clockwise from outside, in the order of the operands' faces they lie in;
    /// points of operands in their order, then those that were cut.
    mesh surface;
    /// [F] the lowest face that each lies in; where rounding was mended, perhaps one beside it.
    std::vector<operand_element> source_face;
    std::vector<operand_element> source_point;  ///< [V] the lowest point that each is, or none
    /// [V] with `simplify`, a face that each point that was cut lies in, else none; or empty.
    std::vector<operand_element> face_of_cut_point{};
    double max_move = 0.0;  ///< bound of how far rounding moved a point, in each coordinate
    /// Checked on the coordinates above: two faces have a common corner, a common edge or nothing
    /// in common, no face is degenerate, every edge runs as often one way as the other, and the
    /// inside is behind every face: around it the surface winds once, and not at all around what
    /// is in front.
    bool certified = false;
    /// Where it is not: pairs of faces, at most 100; twice the same face where it is degenerate or
    /// its outside is behind it.
    std::vector<std::array<std::uint32_t, 2>> meeting_faces{};
    std::uint64_t meeting_count = 0;  ///< of all such pairs
    int rounding_steps = 0;           ///< of mending that were taken
    /// Boxes of all faces that met after a step of mending or before; of faces as rounded.
    std::vector<aabb<double, 3>> broken{};
    /// Operands that bound no solid: the first open edges, at most 100. Then the rest is empty.
    std::vector<open_operand_edge> open{};
    std::uint64_t open_count = 0;
    std::uint64_t pairs = 0;       ///< of input faces that meet beyond their shared corners
    std::uint64_t cut_faces = 0;   ///< input faces that were cut or covered by others
    std::uint64_t degenerate = 0;  ///< input faces without an area, which bound nothing
    std::uint64_t cells = 0;       ///< parts of space that the operands' surfaces separate; 0 where
                                   ///< they were not looked for
    /// Of the exact result. Where it has some and `surface` has none, all of it was within what the
    /// coordinates written tell apart.
    std::uint64_t exact_faces = 0;
    /// Components, by points, of which no face is left when rounded. Where operands were mended, of
    /// what the mended ones make.
    std::uint64_t lost_parts = 0;
    std::vector<point3> lost_places{};  ///< a point of each, at most 100
    std::uint64_t covered = 0;  ///< of `split`, input faces that lie on lower ones altogether
    std::optional<operand_volumes> volumes{};
    bool cancelled = false;
};

/// The solid that `expression` makes of the operands, in one arrangement of all of them.
///
/// The surface is decided exactly on the coordinates as given; only then its constructed points are
/// rounded, and the rounded surface is checked. Where rounding makes faces meet, what is next to
/// each other is joined and cut again, step by step (`boolean_options::rounding_steps`). Given
/// points stay bit for bit unless floats are asked for or they are next to such a place.
///
/// Operands may overlap themselves, touch, be nested, be equal, consist of parts, be inside out or
/// empty; their corners with equal coordinates are one. Each has to bound a solid: along every
/// edge, after cutting, its faces run as often one way as the other. Where parts of the result
/// touch in an edge or a point, they share it; an edge then has four faces or more.
///
/// \throws std::invalid_argument when the expression has another number of operands, or naming a
///         face with a corner that is no point, or a corner with a coordinate that is not finite
///         or beyond 2^1000
/// \cost   as `arrange_faces`, `find_cells` and `round_surface`; of two sound operands that meet in
///         a few places, little more than a copy of them
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API solid_result boolean(std::span<const mesh_view> operands,
                                                const boolean_expression& expression,
                                                const boolean_options& options = {});

/// The part of an open surface that `expression` keeps, in one arrangement with the solids that
/// cut it: the pieces for which the expression is true when in operand `sheet`. A piece is in a
/// solid also when it lies on its surface; so a sheet without a solid and what it has in common
/// with it are the sheet, in two parts.
///
/// The sheet may end anywhere, overlap itself, and be closed, too. Pieces are oriented as the
/// sheet's lowest faces they lie in. `certified` says nothing of edges. Where another operand is
/// open, that is named as in `boolean`, and the rest is empty.
///
/// \throws std::invalid_argument as `boolean`, when `sheet` is no operand, or when the expression
///         may be true outside of it (`boolean_expression::needs`), as that of a union
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API solid_result clip(std::span<const mesh_view> operands,
                                             std::uint32_t sheet,
                                             const boolean_expression& expression,
                                             const boolean_options& options = {});

/// All faces of the operands, cut along each other and along themselves, every piece once: two of
/// them have a common corner, a common edge or nothing in common. Operands need not bound solids;
/// `certified` says nothing of edges, and `open` stays empty. Where faces of several operands lie
/// on each other, one piece stands for all; its source is the lowest of them. Nothing is
/// simplified.
///
/// \throws std::invalid_argument as `boolean`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API solid_result split(std::span<const mesh_view> operands,
                                              const boolean_options& options = {});

/// Whether a mesh bounds a solid, as an operand of `boolean` has to.
struct solid_check {
    std::vector<open_operand_edge>
        open{};  ///< where it does not: the first open edges, at most 100
    std::uint64_t open_count = 0;
    bool cancelled = false;
};

/// Looks for edges at which the surface ends. The mesh is cut along itself only when its edges as
/// they are leave it open: then its faces may still fit together piece by piece.
///
/// \throws std::invalid_argument as `boolean`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API solid_check check_solid(mesh_view mesh,
                                                   const progress_callback& progress = {});

}  // namespace treeform
