#pragma once
/// \file
/// The curves along which faces meet: as segments, and joined into paths. Each point of a path says
/// which edges and faces meet there. Files of them.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace treeform {

/// What two faces have in common, or one side of it.
struct curve_segment {
    std::array<point3, 2> ends{};  ///< equal when the faces meet in a point
    std::uint32_t pair = 0;        ///< index into the pairs given
    friend bool operator==(const curve_segment&, const curve_segment&) = default;
};

/// What the two faces of each pair have in common, as segments, in the order of `pairs`: one
/// segment for a crossing, the 3 to 6 sides of the common area for faces that overlap, a segment of
/// length 0 for a single point.
///
/// Whether there is a segment is exact. Its ends are rounded, and finite.
///
/// \throws std::invalid_argument naming the pair with a face or a corner that is out of range or not
///         finite
/// \cost O(pairs)
/// \same on any number of threads
[[nodiscard]] TREEFORM_API std::vector<curve_segment> intersection_curves(
    mesh_view mesh, std::span<const face_pair> pairs);

/// A point of a curve, named by the lowest-numbered corners, edges or faces that meet there.
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

/// A path of different points, each joined to the next by a segment.
struct curve_path {
    std::vector<std::uint32_t> points;  ///< numbers in `curve_network::points`; one or more
    std::vector<std::uint32_t> pairs;   ///< the first pair of each segment, or of the single point
    bool closed = false;                ///< a segment leads from the last point to the first
    friend bool operator==(const curve_path&, const curve_path&) = default;
};

/// All curves of a mesh.
struct curve_network {
    std::vector<curve_point> points;  ///< no two are equal as exact points
    /// First the paths between points where one segment, or more than two, end. Then closed paths.
    /// Last single points, where faces meet in one point and no segment ends.
    std::vector<curve_path> paths;
};

/// The segments of `intersection_curves`, joined into paths where their ends are equal as exact
/// points.
///
/// A segment that several pairs have is listed once. Paths are in the order of the numbers of their
/// first points, and points in the order of their names.
///
/// \throws std::invalid_argument as `intersection_curves`, and for a face without area
/// \cost O(P log P) for P pairs
/// \same on any number of threads
[[nodiscard]] TREEFORM_API curve_network intersection_paths(mesh_view mesh,
                                                            std::span<const face_pair> pairs);

/// A whole number of each pair, for the segments of a PLY.
struct pair_numbers {
    std::string name{};
    std::vector<std::uint32_t> of_pair{};  ///< [P]
};

/// Writes the paths of `intersection_paths` as lines: OBJ `v` and `l`, or a text PLY with an element
/// `edge`, whose segments have `numbers`. Faces without area have no paths, but segments of their
/// own (`intersection_curves`). The format, `obj` or `ply`, is that of the extension where none is
/// given. "-" is standard output.
///
/// \pre    faces of `pairs` and their corners are in range, coordinates finite
/// \throws io_error for another format, or when the file cannot be written: then there is none, or
///         the one that was there. std::invalid_argument when there is not a number for each pair
/// \same   bytes on any number of threads
TREEFORM_API void write_curves(const std::filesystem::path& path, mesh_view mesh,
                               std::span<const face_pair> pairs,
                               std::span<const pair_numbers> numbers = {},
                               const std::string& format = {});

}  // namespace treeform
