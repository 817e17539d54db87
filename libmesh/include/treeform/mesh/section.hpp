#pragma once
/// \file
/// Sections of a mesh by parallel planes: closed loops, how they lie in each other, areas and
/// lengths; files of them. Isolines: where a value at vertices has given levels.
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

/// Axes of planes, of length 1, rounded; x, y and the normal are right-handed. Along an axis of
/// space, x and y are the next two: (x, y) for +z, (y, z) for +x, (z, x) for +y.
struct plane_frame {
    point3 x{1.0, 0.0, 0.0};
    point3 y{0.0, 1.0, 0.0};
    point3 normal{0.0, 0.0, 1.0};
};

/// The plane through a point across a normal: p is above it where normal . (p - at) > 0. The length
/// of the normal does not matter, only that it is not zero.
struct oriented_plane {
    point3 at{};
    point3 normal{0.0, 0.0, 1.0};

    /// Its axes.
    /// \throws std::invalid_argument for a normal that is zero or not finite
    [[nodiscard]] TREEFORM_API plane_frame frame() const;

    /// The plane at a height above this one: through at + height n, n the normal at length 1, each
    /// number rounded to a double. Along an axis, from the origin, these are exact.
    [[nodiscard]] TREEFORM_API oriented_plane parallel(double height) const;

    /// Heights above this plane of the middles of layers of this thickness, from the lowest point
    /// to the highest: half a thickness above the lowest is the first. Points that are not finite
    /// do not count.
    ///
    /// \throws std::invalid_argument for a plane that is not finite, a thickness that is not
    ///         positive, or of which there would be more than 2^24 layers
    [[nodiscard]] TREEFORM_API std::vector<double> layer_heights(points_view points,
                                                                 double thickness) const;

    friend bool operator==(const oriented_plane&, const oriented_plane&) = default;
};

/// A closed polygon, or, where the mesh ends, an open polyline.
struct section_loop {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::size_t first_point = 0;  ///< its points follow one another; the first is not repeated
    std::size_t point_count = 0;
    bool closed = true;
    /// The faces along it agree in their orientation. What is inside is to the left then, seen from
    /// above the plane: outer loops run counter-clockwise, holes clockwise.
    bool oriented = true;
    std::uint32_t parent = none;  ///< the innermost loop around it; none for open ones
    std::uint32_t depth = 0;  ///< how many loops are around it: of a solid, holes have an odd one
    double area = 0.0;        ///< positive where it runs counter-clockwise; 0 for open ones
    double length = 0.0;
};

/// What is in one plane.
struct section_layer {
    double height = 0.0;
    point3 at{};                   ///< of its plane
    std::uint32_t first_loop = 0;  ///< its loops follow one another
    std::uint32_t loop_count = 0;
    std::uint32_t open_count = 0;  ///< of these, open polylines
    double area = 0.0;             ///< of its loops, added up: what is inside a solid
    double length = 0.0;
};

/// Sections, in the order of their heights as given.
struct section_result {
    std::vector<section_layer> layers{};
    std::vector<section_loop> loops{};
    /// In the frame: of p in space, (x . p, y . p), for p within 2^-45 of its largest coordinate.
    std::vector<point2> points{};
    /// [points] the face in which the segment from each point begins
    std::vector<std::uint32_t> faces{};
    plane_frame frame{};
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing is returned

    /// Where a point of a layer is in space, rounded.
    [[nodiscard]] TREEFORM_API point3 in_space(const section_layer& layer, const point2& p) const;
};

/// Sections of a mesh by the planes at `heights` above `plane` (`oriented_plane::parallel`).
///
/// Which side of a plane a vertex is on, which segments make a loop, and which loop lies in which
/// are decided exactly, on the coordinates as given. Then points are rounded.
///
/// A vertex in a plane counts as above it. So a section is that of a plane just below: a box from
/// height 0 to 1 has none at 0, and its full top at 1. A point or line in which the mesh only
/// touches the plane from below gives no loop. A face in the plane counts where the mesh goes on
/// below it.
///
/// Of a mesh that is closed and agrees in its orientation, all polylines are closed. Loops may
/// touch where faces do; at an edge of four faces or more, those that bound one wedge of the solid
/// are joined. Where the mesh has a border, polylines are open; where neighbors disagree, they go
/// on, not `oriented`. Loops of faces that cross each other do, too: `parent` is then that of one
/// of their points, and areas are added up as often as the surface winds around them. Corners with
/// equal coordinates are one.
///
/// Where a loop goes straight on from one face to another in the same plane, exactly, there is no
/// point: a box has four. The side from a point on lies in the face named, and may go on in others.
///
/// Loops are in the order of their lowest faces.
///
/// \throws std::invalid_argument naming a face with a corner out of range or not finite, for a
///         plane or height that is not finite, or a normal that is zero
/// \cost   O(V log K + F + S log L) for K planes and L loops in one of S sides
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API section_result section(const mesh_ref& mesh, const oriented_plane& plane,
                                                  std::span<const double> heights,
                                                  const progress_callback& progress = {});

/// The section by `plane` itself.
[[nodiscard]] inline section_result section(const mesh_ref& mesh, const oriented_plane& plane,
                                            const progress_callback& progress = {}) {
    return section(mesh, plane, std::array{0.0}, progress);
}

/// A line on a mesh along which a value has a level.
struct isoline {
    double level = 0.0;           ///< of the value, along it
    std::size_t first_point = 0;  ///< its points follow one another; the first is not repeated
    std::size_t point_count = 0;  ///< of its points
    bool closed = true;           ///< otherwise it ends where the mesh does
    bool oriented = true;  ///< the faces along it agree: seen from outside, higher is to its left
    double length = 0.0;   ///< of its sides
};

/// Lines of all levels, in the order of the levels as given.
struct isolines_result {
    std::vector<isoline> lines{};  ///< one after the other
    std::vector<point3> points{};  ///< on edges of the mesh, rounded
    std::vector<std::uint32_t>
        faces{};  ///< [points] the face that the side from each point on lies in
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing is returned
};

/// Where a value has given levels: `values` has one for each vertex, and is linear in each face.
///
/// Which side of a level a vertex is on, and which sides make a line, is exact. A vertex at a level
/// counts as above it, so that lines are those just below, as in `section`: a height as the value
/// gives the sections by planes across z. Points are linear interpolations, rounded. Where
/// neighbors with equal coordinates are vertices of their own, lines go on when the values there
/// are equal; else they end.
///
/// \throws std::invalid_argument naming a face with a corner out of range or not finite, a corner
///         or level whose value is not finite, or for another number of values than of vertices
/// \cost   O(V log K + F + S log S) for K levels and S sides of lines
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API isolines_result isolines(const mesh_ref& mesh,
                                                    std::span<const double> values,
                                                    std::span<const double> levels,
                                                    const progress_callback& progress = {});

/// Writes sections as `svg`, `dxf`, `obj` or `json`, by the extension where no format is given:
/// loops in the frame (SVG: a group a layer, y up; DXF: polylines at the height as z; JSON: all
/// that is known), OBJ lines in space. "-" is standard output. Of lengths in a `unit` (mm, cm, m,
/// in, ft or um), SVG has the size on paper, and DXF $INSUNITS; otherwise neither.
///
/// \throws io_error for another format, or when the file cannot be written: then there is none, or
///         the one that was there; std::invalid_argument for another unit
/// \same   bytes
TREEFORM_API void write_section(const std::filesystem::path& path, const section_result& section,
                                const std::string& format = {}, const std::string& unit = {});

/// The same for isolines: SVG as seen from the normal of a frame, a group a level; DXF and OBJ
/// lines in space; JSON all that is known.
TREEFORM_API void write_isolines(const std::filesystem::path& path, const isolines_result& isolines,
                                 const plane_frame& seen = {}, const std::string& format = {},
                                 const std::string& unit = {});

}  // namespace treeform
