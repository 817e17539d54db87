#pragma once
/// \file
/// Sections of a mesh by parallel planes: closed loops, their nesting, areas and lengths. Isolines:
/// lines at given levels of a value at the vertices. Writing both to files.
///
///     tf::section_result layers = tf::section(mesh, {}, std::array{0.1, 0.3, 0.5});

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace treeform {

/// The plane through `at` with a normal: p is above it if normal . (p - at) > 0. The normal may
/// have any length except zero.
struct oriented_plane {
    point3 at{};
    point3 normal{0.0, 0.0, 1.0};

    /// The unit axes x and y of the plane, and its unit normal, rounded; right-handed. If the
    /// normal is an axis of space, x and y are the next two axes: (x, y) for +z, (y, z) for +x,
    /// (z, x) for +y.
    ///
    /// \throws std::invalid_argument for a normal that is zero or not finite
    [[nodiscard]] TREEFORM_API std::array<point3, 3> axes() const;

    /// The plane at a height above this one: through at + height n, for the unit normal n, each
    /// coordinate rounded to double. Exact if the normal is an axis and `at` is the origin.
    [[nodiscard]] TREEFORM_API oriented_plane parallel(double height) const;

    /// Heights above this plane of the middles of layers, from the lowest point to the highest: the
    /// first is half a thickness above the lowest point. Points that are not finite are ignored.
    ///
    /// \throws std::invalid_argument for a plane that is not finite, a thickness that is not
    ///         positive, or more than 2^24 layers
    [[nodiscard]] TREEFORM_API std::vector<double> layer_heights(points_view points,
                                                                 double thickness) const;

    friend bool operator==(const oriented_plane&, const oriented_plane&) = default;
};

/// A closed polygon, or an open polyline that ends at a border of the mesh.
struct section_loop {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::size_t first_point = 0;  ///< consecutive; the first is not repeated
    std::size_t point_count = 0;
    bool closed = true;
    /// Whether the faces along the loop are consistently oriented. Then the inside is to the left,
    /// seen from above the plane: outer loops run counter-clockwise, holes clockwise.
    bool oriented = true;
    std::uint32_t parent = none;  ///< the innermost loop around this one; none for open loops
    std::uint32_t depth = 0;      ///< number of loops around this one; odd for holes in a solid
    double area = 0.0;            ///< positive if counter-clockwise; 0 for open loops
    double length = 0.0;
};

/// The section in one plane.
struct section_layer {
    double height = 0.0;
    point3 at{};                   ///< a point of its plane
    std::uint32_t first_loop = 0;  ///< number of its first loop; its loops are consecutive
    std::uint32_t loop_count = 0;
    std::uint32_t open_count = 0;  ///< open polylines among the loops
    double area = 0.0;             ///< sum over the loops: the area inside a solid
    double length = 0.0;
};

/// Sections, in the order of their heights as given.
struct section_result {
    std::vector<section_layer> layers{};
    std::vector<section_loop> loops{};
    /// In the plane: (x . p, y . p) for a point p in space, which is accurate to 2^-45 of its
    /// largest coordinate.
    std::vector<point2> points{};
    /// [points] the face in which the segment from each point begins
    std::vector<std::uint32_t> faces{};
    /// the axes x and y, and the normal (`oriented_plane::axes`)
    std::array<point3, 3> axes{point3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is invalid

    /// A point of a layer in space, rounded.
    [[nodiscard]] TREEFORM_API point3 in_space(const section_layer& layer, const point2& p) const;
};

/// Sections of a mesh by the planes at `heights` above `plane` (`oriented_plane::parallel`).
///
/// The side of each vertex, the loops and their nesting are decided exactly, on the coordinates as
/// given. Then points are rounded.
///
/// A vertex in a plane counts as above it, so a section shows the mesh just below the plane: a box
/// from height 0 to 1 has no section at 0, and its full top at 1. A point or line in which the mesh
/// touches the plane from below gives no loop. A face in the plane is part of the section if the
/// mesh continues below it.
///
/// If the mesh is closed and consistently oriented, all polylines are closed. Loops may touch where
/// faces touch; at an edge of four or more faces, segments that bound the same wedge of the solid
/// are joined. Where the mesh has a border, polylines are open; across inconsistently oriented
/// neighbors they continue, but are not `oriented`. If faces cross each other, so do loops:
/// `parent` is then the innermost loop around one point of the loop, and areas count as often as
/// the surface winds around them. Corners with equal coordinates are one.
///
/// Where a loop runs straight from one face to a coplanar one, it has no point: the section of a
/// box has four. The segment after a point begins in the face in `faces`, and may continue in
/// others.
///
/// The loops of a layer are in the order of their lowest face numbers.
///
/// \throws std::invalid_argument naming a face with a corner out of range or not finite, for a
///         plane or height that is not finite, or a normal that is zero
/// \cost   O(V log K + F + S log L) for K planes, and L loops of S segments in one plane
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API section_result section(const mesh_ref& mesh, const oriented_plane& plane,
                                                  std::span<const double> heights,
                                                  const progress_callback& progress = {});

/// The section by `plane` itself.
[[nodiscard]] inline section_result section(const mesh_ref& mesh, const oriented_plane& plane,
                                            const progress_callback& progress = {}) {
    return section(mesh, plane, std::array{0.0}, progress);
}

/// A line on a mesh along which a value equals a level.
struct isoline {
    double level = 0.0;           ///< the value along the line
    std::size_t first_point = 0;  ///< number of its first point; its points are consecutive
    std::size_t point_count = 0;  ///< number of its points
    /// Whether the last point is joined to the first; otherwise the line ends at borders of the
    /// mesh.
    bool closed = true;
    /// Whether the faces along it are consistently oriented: seen from outside, larger values are
    /// to its left.
    bool oriented = true;
    double length = 0.0;  ///< sum of the lengths of its segments
};

/// The isolines of all levels, in the given order of levels.
struct isolines_result {
    std::vector<isoline> lines{};  ///< level after level
    std::vector<point3> points{};  ///< on edges of the mesh, rounded
    std::vector<std::uint32_t>
        faces{};  ///< [points] the face that contains the segment after each point
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is invalid
};

/// Lines at given levels of a value: `values` has one value for each vertex, interpolated linearly
/// in each face.
///
/// Lines are decided exactly; their points are interpolated and rounded. A vertex at a level counts
/// as above it, as in `section`: with heights as values, the lines are sections by planes
/// perpendicular to z. Vertices with equal coordinates are joined if their values are equal;
/// otherwise lines end there.
///
/// \throws std::invalid_argument naming a face with a corner out of range or not finite, a corner
///         or level with a value that is not finite, or if there is not one value for each vertex
/// \cost   O(V log K + F + S log S) for K levels and S segments of lines
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API isolines_result isolines(const mesh_ref& mesh,
                                                    std::span<const double> values,
                                                    std::span<const double> levels,
                                                    const progress_callback& progress = {});

/// Writes sections as `svg`, `dxf`, `obj` or `json`; by default the format of the extension. SVG (a
/// group for each layer, y up), DXF (polylines with the height as z) and JSON (all data) have loops
/// in the plane; OBJ has lines in space. "-" is standard output. With a `unit` (mm, cm, m, in, ft
/// or um), SVG has a size on paper, and DXF has $INSUNITS.
///
/// \throws io_error for an unknown format, or if the file cannot be written: then a previous file
///         is unchanged; std::invalid_argument for an unknown unit
/// \same   bytes
TREEFORM_API void write_section(const std::filesystem::path& path, const section_result& section,
                                const std::string& format = {}, const std::string& unit = {});

/// The same for isolines: SVG has their projection onto the plane `seen`, in a group for each
/// level; DXF and OBJ have lines in space; JSON has all data.
TREEFORM_API void write_isolines(const std::filesystem::path& path, const isolines_result& isolines,
                                 const oriented_plane& seen = {}, const std::string& format = {},
                                 const std::string& unit = {});

}  // namespace treeform
