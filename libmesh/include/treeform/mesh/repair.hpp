#pragma once
/// \file
/// A mesh without self-intersections, made from one that has some.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform {

enum class repair_mode : std::uint8_t {
    split,  ///< cut along the curves where faces meet, keep every piece
    outer,  ///< then keep the pieces that bound the solid, and no others
    remove  ///< delete the faces that meet, and fill the holes
};

struct repair_options {
    repair_mode mode = repair_mode::outer;
    inside_rule inside = inside_rule::nonzero;  ///< what is solid, for `outer`
    bool to_float = false;                      ///< coordinates become floats (then widened)
    /// Of `split` and `outer`: see `boolean_options`.
    int rounding_steps = 5;
    /// Of `remove`: faces that only touch (`pair_kind::touching`) are deleted, too. Otherwise they
    /// stay, and touch.
    bool touching = false;
    /// Of `remove`: how often holes are made and made wider before giving up.
    int removal_rounds = 16;
    progress_callback progress{};
};

struct repaired_mesh {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    mesh surface;                         ///< faces in the order of those they lie in
    std::vector<std::uint32_t> face_of;   ///< [F'] the face each lies in, none if it fills a hole
    std::vector<std::uint32_t> point_of;  ///< [V'] the point each is, none if it is a new one
    double max_move = 0.0;  ///< bound of how far points were moved, in each coordinate
    /// Checked on the coordinates above: no face is degenerate, and two faces have a common corner,
    /// a common edge or nothing in common. Of `outer`, also that every edge runs as often one way
    /// as the other and the inside is behind every face, and of `remove` that no edge of a closed
    /// part is open; there, what touched may touch (`repair_options::touching`).
    bool certified = false;
    /// Pairs of faces that still meet, at most 100; twice the same face where it is degenerate.
    std::vector<std::array<std::uint32_t, 2>> meeting{};
    std::uint64_t meeting_count = 0;
    std::vector<open_operand_edge> open{};  ///< of `outer`, where the mesh bounds no solid: then
    std::uint64_t open_count = 0;           ///< the rest is empty
    std::uint64_t lost_components = 0;      ///< components, by points, no face of which is left
    std::uint64_t removed = 0;              ///< faces of the mesh no part of which is left
    /// Of `split`, faces that lie on lower ones altogether: one piece stands for all, and they are
    /// not counted as removed.
    std::uint64_t covered = 0;
    std::uint64_t filled = 0;       ///< faces that fill holes
    std::uint64_t left_open = 0;    ///< of `remove`, edges that have no second face any more
    std::uint64_t exact_faces = 0;  ///< of `split` and `outer`, as in `solid_result`
    bool cancelled = false;
};

/// `mesh` without self-intersections, as `certified` and nothing else tells.
///
/// `split` and `outer` decide exactly on the coordinates as given what is cut and what is inside,
/// and then round (`round_surface`); faces that meet nothing come out as they are. `remove` is for
/// surfaces that bound nothing: it is local and keeps no volume. It deletes the faces that meet, or
/// are degenerate, and closes each hole by triangles of the least total area between the points of
/// its rim, up to where the mesh ended. Where these meet something, the hole becomes wider. In a
/// part, of faces linked by edges, that has a border, holes stay open (`left_open`) where even that
/// does not help, or where they would go around the border; then few faces go, of each pair that
/// meets one. Closed parts that parts with a border pass through stay as they are. Of parts whose
/// every face has a copy, as of a sheet with a back, one copy stays.
///
/// \throws std::invalid_argument as `boolean`; of `remove`, a coordinate may be beyond 2^1000
/// \cost   as `boolean`; of `remove` a `self_intersections` a round, and O(n^3) for a hole of n <=
///         200 points, O(n^2) beyond
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API repaired_mesh repair(mesh_view mesh, const repair_options& options = {});

}  // namespace treeform
