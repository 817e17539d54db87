#pragma once
/// \file
/// The curves along which faces meet: as segments, and joined into paths with every point named by
/// what meets there.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform {

struct curve_segment {
    std::array<point3, 2> ends{};  ///< equal when the faces meet in a point
    std::uint32_t pair = 0;        ///< index into the pairs given
    friend bool operator==(const curve_segment&, const curve_segment&) = default;
};

/// What the two faces of each pair have in common, as segments: one for a crossing, the rim for
/// faces that overlap (3 to 6), a segment without length for a single point. In the order of
/// `pairs`.
///
/// That there is a segment is exact; where it ends is rounded (`approximate_point`), and the
/// coordinates are finite.
///
/// \pre  faces of `pairs` and their corners are in range, every coordinate is finite
/// \cost O(pairs)
/// \same on any number of threads
[[nodiscard]] TREEFORM_API std::vector<curve_segment> intersection_curves(
    mesh_view mesh, std::span<const face_pair> pairs);

/// A point of a curve: the lowest-numbered of the features that meet there.
struct curve_point {
    enum class origin : std::uint8_t {
        corner,    ///< a point of the mesh: `edge` holds it twice, and `by` too
        edges,     ///< two edges cross: `edge` and `by`, each by its points, ascending
        edge_face  ///< `edge` meets the inside of face `by[0]`
    };
    origin kind = origin::corner;
    std::array<std::uint32_t, 2> edge{};
    std::array<std::uint32_t, 2> by{};
    point3 position{};  ///< the exact point rounded to nearest
    friend bool operator==(const curve_point&, const curve_point&) = default;
};

/// Points one after the other, each of them different, joined by segments.
struct curve_path {
    std::vector<std::uint32_t> points;  ///< as numbers of `curve_network::points`; one or more
    std::vector<std::uint32_t> pairs;   ///< of each segment, or of the single point, the first pair
    bool closed = false;                ///< a segment leads from the last point to the first
    friend bool operator==(const curve_path&, const curve_path&) = default;
};

struct curve_network {
    std::vector<curve_point> points;  ///< different as exact points
    /// Between points where one or more than two segments end; closed ones for the rest; at last
    /// single points for faces that meet in no more than that, where no segment ends.
    std::vector<curve_path> paths;
};

/// What the two faces of each pair have in common, as `intersection_curves` gives it, joined where
/// ends are equal as exact points.
///
/// Segments that several pairs have are listed once. Paths are in the order of their first points'
/// numbers, which are in the order of the points' names.
///
/// \pre  faces of `pairs` and their corners are in range and not degenerate, coordinates finite
/// \cost O(P log P) for P pairs
/// \same on any number of threads
[[nodiscard]] TREEFORM_API curve_network intersection_paths(mesh_view mesh,
                                                            std::span<const face_pair> pairs);

}  // namespace treeform
