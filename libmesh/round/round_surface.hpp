#pragma once
/// \file
/// Rounds exact points to representable coordinates, and verifies that the surface is still valid.

#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/round/turned_faces.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform {

/// Faces between exact points: corners below `given.size()` are given points, the others
/// constructed ones.
struct exact_surface {
    std::vector<point3> given;
    std::vector<implicit_point> constructed;
    std::vector<face> faces;
    /// [F] or empty: 1 for certified faces: on the given coordinates, they are not degenerate, and
    /// meet each other only in common corners and edges; their corners are given points. As long as
    /// they do not move, they are not tested against each other again.
    std::vector<std::uint8_t> certified{};
};

struct round_options {
    treeform::precision precision = treeform::precision::float64;  ///< of the rounded coordinates
    /// The faces bound a solid, which is behind them, and must do so after rounding. Otherwise they
    /// are a complex of which every piece is kept.
    bool solid = true;
    /// Upper limit of the distance of points that repairs after rounding may join:
    double max_displacement = std::numeric_limits<double>::infinity();
    /// If the surface has further faces: their winding numbers. These faces are certified, do not
    /// move, and none of them meets the box of a face that is not certified. Faces that share an
    /// edge with them are not changed, and nothing is repaired by cutting.
    detail::round::winding_of_rest rest{};
    progress_callback progress{};
};

struct rounded_surface {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    mesh surface;  ///< its points and faces are in the order of the exact ones
    /// [F] exact face of which each is the whole or a part; in repaired places perhaps a neighbor
    /// of it.
    std::vector<std::uint32_t> face_of;
    /// [V] exact point of each point; `none` for points at which rounded faces were cut
    std::vector<std::uint32_t> point_of;
    /// Status ok means, verified on these coordinates: any two faces share a corner, an edge or
    /// nothing, and none is degenerate; for a solid also: the signed face count of every edge is
    /// zero, and the inside is behind every face.
    treeform::certificate certificate{};
    int rounds = 0;             ///< how often rounded faces were cut along each other
    std::uint64_t slivers = 0;  ///< number of changes that removed slivers
    /// If anything was repaired: the largest distance, in each coordinate, of a removed vertex of
    /// the exact surface from this one. Larger than the displacement if a part too thin for the
    /// coordinates was removed; components that vanished as a whole are counted instead.
    double vanished_distance = 0.0;
    /// Number of components of the exact surface (faces linked by points) of which no face is left,
    /// since they are too thin for the rounded coordinates.
    std::uint64_t vanished_components = 0;
    std::vector<point3> vanished_at{};  ///< a point of each, at most 100
};

/// `exact` with rounded coordinates, without unused points.
///
/// Every point is rounded once, to nearest; given points stay bit for bit unless float32 is
/// requested. Then the surface is checked with exact predicates: every face that moved, or is not
/// certified, against all others. Defects are repaired in rounds:
/// - Points and edges that nearly touch are joined, and slivers removed, as long as this reduces
///   the number of faces that meet (`remove_slivers`).
/// - Faces that still meet are cut along each other (`arrange_faces`); for a solid, only faces that
///   bound it are kept. The new points are rounded.
///
/// If cuts of a solid create more intersections than they remove, the algorithm restarts, and
/// flattens nearly flat parts before removing slivers (`flatten`). If that fails, too, it continues
/// to cut.
///
/// The largest distance of joined elements is at first 8 steps of the precision at the largest
/// coordinate; it never exceeds `max_displacement` or 2^-10 of the largest coordinate. It is
/// multiplied by 4 after a round that leaves more than half of the pairs that met. So each of three
/// attempts has at most 6 distances for float32 and 21 for float64, and for each at most 1 +
/// log2(m) rounds that cut at most m pairs. Success is not guaranteed, but verified, and reported
/// in the certificate. A round with more pairs to cut than three times the number of faces cuts
/// nothing; a surface that grew to three times its number of faces is given up.
///
/// If anything was repaired, `max_displacement` and `vanished_distance` are measured at the end
/// (`detail::round::displacement`), so that intermediate moves do not add up. Status
/// `out_of_range`: a coordinate was too large to be rounded.
///
/// A part of a solid that is thinner than rounding moves its points may be turned inside out
/// without meeting anything; this is detected by winding numbers, and repaired.
///
/// \pre    exact faces have three different corners and meet only in common corners and edges; for
///         a solid, the signed face count of every edge is zero, and the inside is behind every
///         face
/// \cost   as `self_intersections` of the faces to be checked and those near them; as
///         `arrange_faces` and `find_cells` for each round that cuts
/// \same   on any number of threads
/// \source CGAL 6.1's iterative snap rounding (Lazard and Valque, SGP 2025) has the same aim and
///         the same final check; here slivers are removed first, and winding numbers decide which
///         faces are kept
[[nodiscard]] TREEFORM_API rounded_surface round_surface(exact_surface exact,
                                                         const round_options& options = {});

/// The same for a surface with further faces (`options.rest`); does not change `exact` in the end.
/// \pre `options.rest` is not empty
[[nodiscard]] rounded_surface round_once(exact_surface& exact, const round_options& options);

}  // namespace treeform
