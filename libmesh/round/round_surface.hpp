#pragma once
/// \file
/// From points that are known exactly to coordinates that can be written, with proof that nothing
/// broke on the way.

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

/// Faces between exact points: corners below `given.size()` are given points, those from there on
/// constructed ones.
struct exact_surface {
    std::vector<point3> given;
    std::vector<implicit_point> constructed;
    std::vector<face> faces;
    /// [F], or empty: 1 for faces that have been found, in the coordinates given, to have an area
    /// and to meet each other in common corners and edges only; their corners are given points. As
    /// long as they stay where they are, they are not held against each other again.
    std::vector<std::uint8_t> certified{};
};

struct round_options {
    treeform::precision precision = treeform::precision::float64;  ///< of the rounded coordinates
    /// The faces bound a solid, which is behind them, and are to do so when rounded. Otherwise they
    /// are a complex of which every piece stays.
    bool solid = true;
    /// What rounding has broken is mended until nothing meets or no move may be as far as:
    double max_displacement = std::numeric_limits<double>::infinity();
    /// Where the surface has more faces: how often these wind around what. They are certified, stay
    /// where they are, and none of them meets a box of a face that is not certified. Faces at an
    /// edge with them are not touched, and what would have to be cut is not mended.
    detail::round::winding_of_rest rest{};
    progress_callback progress{};
};

struct rounded_surface {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    mesh surface;  ///< points and faces in the order of the exact ones
    /// [F] exact face that each one is, or is cut from; where it was mended, perhaps one beside it.
    std::vector<std::uint32_t> face_of;
    std::vector<std::uint32_t> point_of;  ///< [V] exact point that each one is, or `none`: where
                                          ///< rounded faces were cut
    /// Status ok: checked on the coordinates above, two faces have a common corner, a common edge
    /// or nothing in common, none is degenerate, and, of a solid, they run along every edge as
    /// often one way as the other and have its inside behind them.
    treeform::certificate certificate{};
    int rounds = 0;             ///< of cutting what was rounded along itself
    std::uint64_t slivers = 0;  ///< taken out where faces met
    /// Where anything was mended: how far, at most, vertices of the exact surface that are gone are
    /// from this one, in each coordinate. More than anything moved where parts have gone that were
    /// thinner than the coordinates tell apart; those that went as a whole are counted instead.
    double vanished_reach = 0.0;
    /// Components of the exact surface, by points, no face of which is left: all of each was within
    /// what the rounded coordinates tell apart.
    std::uint64_t vanished_components = 0;
    std::vector<point3> vanished_at{};  ///< a point of each, at most 100
};

/// `exact` in rounded coordinates, without the points that no face uses.
///
/// Every point is rounded once, to nearest; given points stay bit for bit unless float32 is asked
/// for. Then the surface is checked with the exact predicates: every face that has moved, or is not
/// certified, against all others. Where it is broken, it is mended in rounds:
/// - What all but touches is joined, and slivers are taken out, as long as less meets by that
///   (`remove_slivers`).
/// - What meets all the same is cut along each other (`arrange_faces`), of a solid what it does not
///   wind around any more is left out, and what was cut is rounded.
///
/// Where cuts of a solid make more than they mend, all begins anew, and before slivers flat parts
/// become what their rims describe (`flatten`). If that fails, too, cutting goes on to its end.
///
/// What is joined is at most 8 steps of the precision at the largest coordinate apart at first, and
/// never further than `max_displacement` and than 2^-10 of the largest coordinate. That stays while
/// a round leaves at most half of the pairs that met before it; else it becomes four times as much.
/// So each of three attempts has at most 6 lengths for float32 and 21 for float64, and of each at
/// most 1 + log2(m) rounds that cut at most m pairs. Success is not proved, but checked: the
/// certificate says so.
/// A round that would have to cut more than three times as many pairs of faces as there were faces
/// cuts nothing, and a surface that has grown to three times its faces is given up.
///
/// Where anything was mended, `certificate::max_displacement` and `vanished_reach` are measured at
/// the end (`detail::round::displacement`), so that moves on the way do not add up. Status
/// `out_of_range`: a coordinate was too large to be rounded.
///
/// Where a part of a solid is thinner than rounding moves its points, it may be turned inside out
/// and meet nothing: a line tells, and what is turned is mended.
///
/// \pre    faces have three different corners and, as exact ones, meet in common corners and edges
///         only; of a solid, they run along every edge as often one way as the other and have the
///         inside behind them
/// \cost   as `self_intersections` of the faces to be checked and those near them; as
///         `arrange_faces` and `find_cells` for each step, if any
/// \same   on any number of threads
/// \source CGAL 6.1's iterative snap rounding (Lazard and Valque, SGP 2025) has the same aim and
///         ends in the same check; here slivers go first, and winding numbers decide what stays
[[nodiscard]] TREEFORM_API rounded_surface round_surface(exact_surface exact,
                                                         const round_options& options = {});

/// The same of a surface that has more faces, and is as before afterwards.
/// \pre `options.rest` is not empty
[[nodiscard]] rounded_surface round_once(exact_surface& exact, const round_options& options);

}  // namespace treeform
