#pragma once
/// \file
/// Repair: solids made of defective meshes, and self-intersections resolved.
///
///     tf::mesh solid = tf::repair(mesh).value();

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace treeform {

/// What to do with faces that meet.
enum class resolve_mode : std::uint8_t {
    split,  ///< cut them along the curves where they meet, and keep every piece
    outer,  ///< cut them, and keep only the pieces that bound the solid
    remove  ///< delete them, and fill the holes
};

/// How to resolve self-intersections.
struct resolve_options {
    /// for `outer`: the rule that defines the inside
    treeform::fill_rule fill_rule = treeform::fill_rule::nonzero;
    /// Precision of the coordinates returned. float32 values are stored as doubles.
    treeform::precision precision = treeform::precision::float64;
    /// For `split` and `outer`: as in `boolean_options`.
    double max_displacement = std::numeric_limits<double>::infinity();
    bool keep_cuts = false;   ///< for `outer`: as in `boolean_options`; `split` keeps all cuts
    bool touching = false;    ///< for `remove`: also delete faces that only touch
    int removal_rounds = 16;  ///< for `remove`: largest number of rounds that make or widen holes
    /// For `outer` and `remove`: losing more than this share gives the status `excessive_loss`. The
    /// share is of the volume of the solid, or of the area if the mesh bounds none. 1 allows any
    /// loss. The loss is measured from the solid that `repair` makes without filling holes.
    double max_loss = 0.05;
    progress_callback progress{};
};

/// How to repair. All steps are on by default.
struct repair_options {
    bool join = true;     ///< drop degenerate and duplicate faces; close cracks and T-junctions
    bool orient = true;   ///< orient faces consistently and shells outward; drop strays
    bool fill = true;     ///< fill holes
    bool resolve = true;  ///< cut self-intersections; drop faces that bound no solid
    bool detach = true;   ///< separate parts that touch in an edge or a vertex
    /// Widest crack to close, in the mesh's length unit. By default the narrowest that leaves the
    /// fewest open edges, out of 0, a unit in the last place of float32, and 1e-6, 1e-5, 1e-4, 1e-3
    /// of the diagonal of the bounding box.
    std::optional<double> gap{};
    /// Fill holes of at most this many edges.
    std::uint64_t largest_hole = std::numeric_limits<std::uint64_t>::max();
    /// Drops loose open pieces below this share of the area, and loose pieces of one or two faces
    /// below 1% of the area. If a larger component vanishes because it bounds no solid, the status
    /// is `excessive_loss`, unless `max_loss` is 1.
    double stray_share = 0.001;
    /// The rule that defines the inside. By default `positive` if each shell is outward after
    /// `orient`, else `nonzero` or the labels of cells (see `repair`).
    std::optional<treeform::fill_rule> fill_rule{};
    /// Losing more than this share of the volume (of the area, if there were holes) gives the
    /// status `excessive_loss`. Faces that remain, or are inside the solid, do not count as lost. 1
    /// allows any loss.
    double max_loss = 0.05;
    bool sheet = false;   ///< the mesh is an open surface: keep its border, and fill nothing
    bool as_one = false;  ///< for `repair_file`: all parts of a scene become one solid
    /// Precision of the coordinates returned. float32 values are stored as doubles.
    treeform::precision precision = treeform::precision::float64;
    /// As in `boolean_options`.
    double max_displacement = std::numeric_limits<double>::infinity();
    /// as in `boolean_options`; faces that fill holes only merge with each other
    bool keep_cuts = false;
    progress_callback progress{};
};

/// Counts of each step's changes. Closed gaps, chosen orientations, filled holes and labeled cells
/// are heuristic.
struct TREEFORM_API repair_statistics {
    std::uint64_t tetrahedra = 0;    ///< tetrahedra formed by faces; only their boundary was kept
    std::uint64_t degenerate = 0;    ///< dropped faces without area, and slivers dropped with them
    std::uint64_t repeated = 0;      ///< faces that repeat another, dropped
    std::uint64_t closed_edges = 0;  ///< pairs of border edges joined into one edge
    std::uint64_t split_edges = 0;   ///< border edges split at vertices that lie on them
    double gap_limit = 0.0;          ///< largest width of cracks searched for
    double widest_closed = 0.0;      ///< widest crack that was closed
    std::uint64_t flipped = 0;       ///< faces flipped to agree with their neighbors
    std::uint64_t turned_outward = 0;  ///< components flipped outward
    std::uint64_t strays = 0;          ///< faces of loose and inner pieces, dropped
    std::uint64_t holes = 0;           ///< holes filled
    std::uint64_t hole_edges = 0;      ///< edges around them
    std::uint64_t filled = 0;          ///< faces that fill them
    std::uint64_t unfilled_rims = 0;   ///< rims not filled, since they are borders of sheets
    std::uint64_t open_edges = 0;      ///< open edges left after these steps
    bool resolved = false;             ///< whether faces met and were cut
    std::uint64_t pairs = 0;           ///< pairs of faces that met
    std::uint64_t labeled_cells = 0;   ///< cells labeled inside or outside, since faces disagreed
    double dropped_area = 0.0;         ///< area of faces dropped: equal labels on both sides
    double flipped_area = 0.0;         ///< area of faces flipped by the labels
    std::uint64_t removed = 0;         ///< input faces that resolving removed entirely
    /// For `resolve_self_intersections` with `split`: input faces that lie entirely on faces of
    /// lower numbers. Their pieces are those of the lower faces, so they do not count as removed.
    std::uint64_t covered = 0;
    /// For `resolve_self_intersections` with `remove`: edges that lost their second face.
    std::uint64_t left_open = 0;
    /// for `resolve_self_intersections`: as in `boolean_statistics`
    std::uint64_t exact_faces = 0;
    std::uint64_t split_vertices = 0;  ///< vertices split where parts of the solid touch
    std::uint64_t detached = 0;        ///< vertices moved apart
    std::uint64_t touching = 0;        ///< vertices that still have the coordinates of another
    /// Components (faces linked by vertices) that lost all of their faces; for `repair`, only those
    /// larger than `repair_options::stray_share`.
    std::uint64_t vanished_components = 0;
    /// closed shells inside the solid, dropped; `even_odd` makes them cavities
    std::uint64_t dropped_shells = 0;
    double volume_before = 0.0;  ///< after `join`, `orient` and `fill`; 0 if that is no solid
    double volume_after = 0.0;
    double area_before = 0.0;
    double area_after = 0.0;
    double area_lost = 0.0;  ///< as in `repair_options::max_loss`
    /// What was changed: "40 faces flipped, 2 holes filled (9 edges)"; empty if nothing was.
    /// Rounding is in the certificate: `max_displacement`.
    [[nodiscard]] std::string message() const;
};

/// The repaired mesh, its sources, and its certificate.
struct TREEFORM_API repair_result {
    /// No source: the face fills a hole, or the vertex is new.
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    treeform::mesh mesh;
    /// [F'] input face of each face, lowest of those merged; or none
    std::vector<std::uint32_t> face_source;
    std::vector<std::uint32_t> vertex_source;  ///< [V'] input vertex of each vertex, or none
    std::vector<std::uint8_t> is_kept{};  ///< [F] 1 if a part of the input face is left, else 0
    /// Status ok means, verified on the coordinates of `mesh`: a closed manifold, the inside behind
    /// every face, and any two faces share a corner, an edge or nothing. Status sheet means the
    /// same for a surface with a border. For `resolve_self_intersections` with `split` and
    /// `remove`, ok only means that any two faces share a corner, an edge or nothing, and that no
    /// face is degenerate; with `remove`, closed parts are still closed, and faces that touched
    /// before may still touch (`resolve_options::touching`).
    treeform::certificate certificate{};
    repair_statistics statistics{};

    /// The mesh.
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const&;
    [[nodiscard]] treeform::mesh value() &&;
};

/// `mesh` without self-intersections. Check the certificate: its status says whether this was
/// possible.
///
/// `split` and `outer` decide exactly, on the coordinates as given, what is cut and what is inside.
/// Then they round the points on cuts. Faces that meet no other face do not change.
///
/// `remove` is for surfaces that bound no solid, and works locally. It deletes the faces that meet
/// or are degenerate. It closes each hole by triangles of the least total area between the vertices
/// of its rim, but not beyond the former border of the mesh. Where the new triangles meet other
/// faces, the hole is widened. A part is a set of faces linked by edges:
/// - In a part that has a border, a hole stays open (`left_open`) if widening does not help, or if
///   the hole would surround the border. Then only one face of each pair is deleted.
/// - A closed part is not changed where a part with a border passes through it.
/// - If every face of a part has a copy, as in a sheet with a back, one copy stays.
///
/// \throws std::invalid_argument as `boolean`; for `remove`, a coordinate may be beyond 2^1000
/// \cost   as `boolean`; plus `repair` to measure the loss, for `remove`, and for `outer` if a
///         component is inside out; for `remove`, one `self_intersections` a round, and for a hole
///         of n vertices O(n^3) if n <= 200, else O(n^2)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API repair_result
resolve_self_intersections(const mesh_ref& mesh, resolve_mode mode = resolve_mode::outer,
                           const resolve_options& options = {});

/// Repairs a mesh to a solid: closed, oriented, manifold and free of self-intersections. Check the
/// certificate: its status says whether this was possible, and it lists where it was not.
///
/// The steps are those of `repair_options`, in this order. Each changes only what is defective: a
/// mesh that is a solid is returned bit for bit. Which faces meet and what is inside is decided
/// exactly. Which cracks are closed, how faces are oriented, and how holes are filled is decided by
/// heuristics, and counted in `statistics`. Points with equal coordinates are one. If faces are the
/// sides of tetrahedra, only the boundary of the tetrahedra is kept. If faces remain inconsistent,
/// a minimum cut labels cells inside or outside, by the orientations of faces and generalized
/// winding numbers. Its result is used if it loses less area than repair without labels, or if
/// there is no certified result otherwise.
///
/// Holes are filled with triangles between their vertices; large holes in smooth surfaces also with
/// new points, which continue the surface smoothly. Sheets are not filled, but reported as open,
/// unless any loss is allowed. A sheet is a part whose fillings would have more than 0.6 times its
/// area, unless its border is in a plane and it is on one side of the plane. In a mesh of F > 1000
/// faces, no hole is filled if more than F / 10 edges have three or more faces and a signed face
/// count that is not zero.
///
/// \throws std::invalid_argument as `boolean`; for a point cloud; if a gap or share is negative or
///         not finite
/// \cost   O(V log V + F log F), plus `resolve_self_intersections` if faces meet; for a hole of n
///         edges O(n^3) if n <= 100, else O(n^2)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API repair_result repair(const mesh_ref& mesh,
                                                const repair_options& options = {});

/// The defects that keep a mesh from being a solid. Points with equal coordinates are one.
struct TREEFORM_API solid_defects {
    std::uint64_t nonfinite_vertices = 0;  ///< with a NaN or infinite coordinate, used or not
    std::uint64_t unusable_faces = 0;      ///< with an invalid corner; ignored by the counts below
    bool without_faces = false;            ///< the mesh has points, but no usable face
    std::uint64_t tetrahedra = 0;         ///< tetrahedra whose sides are faces, as in a volume mesh
    std::uint64_t degenerate = 0;         ///< faces without area
    std::uint64_t repeated = 0;           ///< faces with the same corners as another
    std::uint64_t boundary_edges = 0;     ///< edges of one face
    std::uint64_t nonmanifold_edges = 0;  ///< edges of more than two faces
    std::uint64_t misoriented_edges = 0;  ///< edges of two inconsistently oriented faces
    std::uint64_t nonmanifold_vertices = 0;  ///< with more than one fan of faces
    std::uint64_t meeting_pairs = 0;         ///< pairs of faces that meet beyond common corners
    /// closed components that are inside out, without being inside another
    std::uint64_t inverted = 0;
    /// Disjoint closed components are nested, but not as a solid and its cavities.
    bool wrongly_nested = false;
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is invalid
    [[nodiscard]] bool any() const;
    /// "open at 37 edges, 2 pairs of faces meet"; "no defects" if there are none.
    [[nodiscard]] std::string message() const;
};

/// The defects that `repair` would mend or refuse. A mesh without points is a solid.
///
/// \throws std::invalid_argument as `self_intersections`, except that invalid corners are counted
/// \cost   O(V log V + F log F), plus `self_intersections`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API solid_defects find_solid_defects(const mesh_ref& mesh,
                                                            const progress_callback& progress = {});

}  // namespace treeform
