#pragma once
/// \file
/// A mesh without self-intersections, made from one that has some.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace treeform {

enum class resolve_mode : std::uint8_t {
    split,  ///< cut along the curves where faces meet, keep every piece
    outer,  ///< then keep the pieces that bound the solid, and no others
    remove  ///< delete the faces that meet, and fill the holes
};

struct resolve_options {
    fill_rule inside = fill_rule::nonzero;  ///< what is solid, for `outer`
    /// The numbers of the coordinates returned; float32 values are widened to double.
    treeform::precision precision = treeform::precision::float64;
    int rounding_steps = 5;  ///< of `split` and `outer`: see `boolean_options`
    /// Of `remove`: faces that only touch (`pair_kind::touching`) are deleted, too. Otherwise they
    /// stay, and touch.
    bool touching = false;
    /// Of `remove`: how often holes are made and made wider before giving up.
    int removal_rounds = 16;
    progress_callback progress{};
};

/// What was done; for reports.
struct resolve_statistics {
    std::uint64_t removed = 0;  ///< faces of the mesh no part of which is left
    /// Of `split`, faces that lie on lower ones altogether: one piece stands for all, and they are
    /// not counted as removed.
    std::uint64_t covered = 0;
    std::uint64_t filled = 0;          ///< faces that fill holes
    std::uint64_t left_open = 0;       ///< of `remove`, edges that have no second face any more
    std::uint64_t exact_faces = 0;     ///< of `split` and `outer`, as in `boolean_statistics`
    std::uint64_t split_vertices = 0;  ///< of `outer`, as in `boolean_statistics`
};

struct TREEFORM_API resolve_result {
    /// In place of a number: a face that fills a hole, a vertex that is new.
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    treeform::mesh mesh;                       ///< faces in the order of those they lie in
    std::vector<std::uint32_t> face_source;    ///< [F'] the face each lies in, or none
    std::vector<std::uint32_t> vertex_source;  ///< [V'] the vertex each is, or none
    /// Status ok: checked on the coordinates above, no face is degenerate, and two faces have a
    /// common corner, a common edge or nothing in common. Of `outer`, also that the mesh is a
    /// manifold, every edge runs as often one way as the other and the inside is behind every face;
    /// of `remove`, that no edge of a closed part is open. There, what touched may touch
    /// (`resolve_options::touching`).
    treeform::certificate certificate{};
    std::uint64_t vanished_components = 0;  ///< components, by vertices, without a face left
    resolve_statistics statistics{};

    /// The mesh.
    ///
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const&;
    [[nodiscard]] treeform::mesh value() &&;
};

/// `mesh` without self-intersections, as the certificate and nothing else tells.
///
/// `split` and `outer` decide exactly on the coordinates as given what is cut and what is inside,
/// and then round; faces that meet nothing come out as they are. `remove` is for surfaces that
/// bound nothing: it is local and keeps no volume. It deletes the faces that meet, or are
/// degenerate, and closes each hole by triangles of the least total area between the vertices of
/// its rim, up to where the mesh ended. Where these meet something, the hole becomes wider. In a
/// part (faces linked by edges) that has a border, holes stay open (`left_open`) where even that
/// does not help, or where they would go around the border; then few faces go, of each pair that
/// meets one. Closed parts that parts with a border pass through stay as they are. Of parts whose
/// every face has a copy, as of a sheet with a back, one copy stays.
///
/// \throws std::invalid_argument as `boolean`; of `remove`, a coordinate may be beyond 2^1000
/// \cost   as `boolean`; of `remove` a `self_intersections` a round, and O(n^3) for a hole of n <=
///         200 vertices, O(n^2) beyond
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API resolve_result resolve_self_intersections(
    mesh_view mesh, resolve_mode mode = resolve_mode::outer, const resolve_options& options = {});

}  // namespace treeform
