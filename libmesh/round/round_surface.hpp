#pragma once
/// \file
/// From points that are known exactly to coordinates that can be written, with proof that nothing
/// broke on the way.

#include <libmesh/exact/implicit_point.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>
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
    std::vector<std::uint8_t> sound{};
};

struct round_options {
    treeform::precision precision = treeform::precision::float64;  ///< of the rounded coordinates
    /// The faces bound a solid, which is behind them, and are to do so when rounded. Otherwise they
    /// are a complex of which every piece stays.
    bool solid = true;
    /// Steps of mending before what rounding has broken is reported, and more, to 4, or 12 where
    /// no points are joined, while each leaves fewer faces that meet; none for 0.
    int steps = 4;
    /// Mending on grids puts the corners of faces that meet on one of these steps, instead of
    /// joining what is near; each grid begins from the surface as it was first rounded, as long as
    /// none before has done. Powers of two, at least the precision's step at the largest coordinate.
    std::vector<double> grids{};
    /// With grids: whether joining what is near comes first, instead of them, or not at all.
    enum class joining : std::uint8_t {
        first,
        where_few_meet,  ///< there instead of grids, elsewhere not at all
        never
    } join = joining::never;
    /// Steps of mending on grids, of all grids together; for float32, of any mending.
    int most_rounds = 15;
    /// Where more pairs of faces meet at first, nothing is mended.
    std::uint64_t most_meeting = std::numeric_limits<std::uint64_t>::max();
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
    int steps = 0;                          ///< of mending that were taken
    bool on_grid = false;                   ///< the last were on one of `round_options::grids`
    std::vector<aabb<double, 3>> broken{};  ///< boxes of all faces that met in any step
    /// Components of the exact surface, by points, no face of which is left: all of each was within
    /// what the rounded coordinates tell apart.
    std::uint64_t vanished_components = 0;
    std::vector<point3> vanished_at{};  ///< a point of each, at most 100
};

/// `exact` in rounded coordinates, without the points that no face uses.
///
/// Every point is rounded once, to nearest; given points stay bit for bit unless float32 is asked
/// for. Then the surface is checked with the exact predicates: every face that has moved, or is not
/// known to be sound, against all others. Where it is broken, it is mended,
/// step by step: corners, edges and faces next to each other are joined where faces meet, the
/// surface is cut along itself (`arrange_faces`), of a solid what it does not wind around any more
/// is left out, and what was cut is rounded. Next to each other is what is nearer than 2^-48 of the
/// largest coordinate in the first step (2^-22 for float32), four times as far in each that
/// follows. Faces that lose their area or cover each other in opposite directions vanish; points of
/// these places may move by that much.
///
/// On a grid (`round_options::grids`), corners of faces that meet are put there instead, with what
/// would come to the same places. It ends, too, where a step would have to cut more than three
/// times as many pairs of faces as there were faces. What is left broken on all of several grids
/// is given back as it was first rounded.
///
/// Where anything was mended, `certificate::max_displacement` is measured at the end
/// (`detail::round::displacement`), and moves on the way do not add up.
///
/// No number of steps is sure to suffice: the certificate tells. Mending also ends when the surface
/// only grows by it. Status `out_of_range`: a coordinate was too large to be rounded.
///
/// Where a part of a solid is thinner than rounding moves its points, it may be turned inside out
/// and meet nothing: then the cells of the whole surface are found, and what is turned is mended.
///
/// \pre    faces have three different corners and, as exact ones, meet in common corners and edges
///         only; of a solid, they run along every edge as often one way as the other and have the
///         inside behind them
/// \cost   as `self_intersections` of the faces to be checked and those near them; as
///         `arrange_faces` and `find_cells` for each step, if any
/// \same   on any number of threads
/// \source CGAL 6.1's iterative snap rounding has the same aim and ends in the same check; here
///         faces take the points next to them, and winding numbers decide what stays
[[nodiscard]] TREEFORM_API rounded_surface round_surface(exact_surface exact,
                                                         const round_options& options = {});

}  // namespace treeform
