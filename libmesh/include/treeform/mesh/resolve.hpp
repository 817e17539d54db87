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

/// What to do with faces that meet.
enum class resolve_mode : std::uint8_t {
    split,  ///< cut them along the curves where they meet, and keep every piece
    outer,  ///< cut them, and keep only the pieces that bound the solid
    remove  ///< delete them, and fill the holes
};

struct resolve_options {
    fill_rule inside = fill_rule::nonzero;  ///< for `outer`: what is solid
    /// Precision of the coordinates returned. float32 values are stored as doubles.
    treeform::precision precision = treeform::precision::float64;
    int rounding_steps = 5;  ///< for `split` and `outer`: see `boolean_options`
    /// For `remove`: delete faces that only touch (`pair_kind::touching`), too. Otherwise they
    /// stay.
    bool touching = false;
    /// For `remove`: give up after making or widening holes this often.
    int removal_rounds = 16;
    progress_callback progress{};
};

/// Counts of what was done, for reports.
struct resolve_statistics {
    std::uint64_t removed = 0;  ///< input faces of which no part is left
    /// For `split`: input faces that lie entirely on faces of lower numbers. One piece stands for
    /// all of them, so they are not counted as removed.
    std::uint64_t covered = 0;
    std::uint64_t filled = 0;          ///< faces that fill holes
    std::uint64_t left_open = 0;       ///< for `remove`: edges that lost their second face
    std::uint64_t exact_faces = 0;     ///< for `split` and `outer`, as in `boolean_statistics`
    std::uint64_t split_vertices = 0;  ///< for `outer`, as in `boolean_statistics`
};

/// The mesh without self-intersections, where its parts came from, and what was checked.
struct TREEFORM_API resolve_result {
    /// Instead of a source: the face fills a hole, or the vertex is new.
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    treeform::mesh mesh;                       ///< faces in the order of their sources
    std::vector<std::uint32_t> face_source;    ///< [F'] input face that each lies in, or none
    std::vector<std::uint32_t> vertex_source;  ///< [V'] input vertex that each is, or none
    /// Status ok says, checked on the coordinates above: no face is degenerate, and any two faces
    /// have a corner, an edge or nothing in common. For `outer` also: the mesh is a closed
    /// manifold, and the inside is behind every face. For `remove`: closed parts are still closed;
    /// faces that touched before may still touch (`resolve_options::touching`).
    treeform::certificate certificate{};
    std::uint64_t vanished_components = 0;  ///< components, by vertices, that have no face left
    resolve_statistics statistics{};

    /// The mesh.
    ///
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const&;
    [[nodiscard]] treeform::mesh value() &&;
};

/// `mesh` without self-intersections. Look at the certificate: it says whether this was possible.
///
/// `split` and `outer` decide exactly, on the coordinates as given, what is cut and what is inside.
/// Then they round the points on cuts. Faces that meet nothing stay as they are.
///
/// `remove` is for surfaces that bound no solid. It works locally and does not keep the volume. It
/// deletes the faces that meet or are degenerate. It closes each hole by triangles of the least
/// total area between the vertices of its rim, but not beyond where the mesh ended. Where the new
/// triangles meet other faces, the hole is made wider. A part is a set of faces linked by edges:
/// - In a part that has a border, a hole stays open (`left_open`) where widening does not help, or
///   where the hole would surround the border. Then of each pair only one face is deleted.
/// - A closed part stays as it is where a part with a border passes through it.
/// - Where every face of a part has a copy, as in a sheet with a back, one copy stays.
///
/// \throws std::invalid_argument as `boolean`; for `remove`, a coordinate may be beyond 2^1000
/// \cost   as `boolean`; for `remove`, one `self_intersections` a round, and for a hole of n
///         vertices O(n^3) when n <= 200, else O(n^2)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API resolve_result resolve_self_intersections(
    mesh_view mesh, resolve_mode mode = resolve_mode::outer, const resolve_options& options = {});

}  // namespace treeform
