#pragma once
/// \file
/// Hollow solids and isolines in C.

#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/section.hpp>

#include <tools/c/made/structs.hpp>

namespace glue {

/// Hollows the solid: its points deeper inside than `wall` become cavities; the outer surface stays
/// bit for bit. The status is `vanished` if there is no cavity.
///
/// `drains` are holes through the wall: a point and a diameter. Each runs from the nearest point of
/// the surface along the shortest segment to a cavity, as a regular prism of 32 sides; the diameter
/// is that of the circle through its corners. It extends beyond both ends by its diameter, but at
/// most half of the way to the next surface.
inline tf::offset_result hollow(const tf::mesh_ref& mesh, double wall,
                                std::span<const std::pair<tf::point3, double>> drains,
                                const tf::offset_options& options) {
    tf::offset_options how = options;
    how.drains.assign(drains.begin(), drains.end());
    return tf::hollow(mesh, wall, how);
}

/// Checks that there is one value for each point.
inline std::span<const double> values_of(const tf::mesh_ref& mesh, const double* values) {
    return array(values, mesh.view().points.size(), "values");
}

/// Isolines: lines along which `values` [V], interpolated linearly in each face, have one of the
/// `levels` [count].
inline tf::isolines_result isolines(const tf::mesh_ref& mesh, const double* values,
                                    std::span<const double> levels,
                                    const tf::progress_callback& progress) {
    return tf::isolines(mesh, values_of(mesh, values), levels, {progress});
}

/// The mesh cut along its isolines: count + 1 pieces, ascending by value.
inline tf::cut_result cut_along(const tf::mesh_ref& mesh, const double* values,
                                std::span<const double> levels, const tf::cut_options& options) {
    return tf::cut_along(mesh, values_of(mesh, values), levels, options);
}

/// Writes isolines in the formats of `treeform_write_section`. SVG shows them as seen against the
/// direction `normal` (null: z).
inline void write_isolines(const std::filesystem::path& path, const treeform_isolines_result* lines,
                           const double normal[3], std::string_view format, std::string_view unit) {
    const treeform_isolines_result& given = need(lines, "lines");
    tf::isolines_result copy;
    copy.lines = copied_as<tf::isoline>(given.lines, given.line_count, "lines");
    copy.points = copied_as<tf::point3>(given.points, given.point_count, "points");
    tf::oriented_plane seen;
    if (normal != nullptr) seen.normal = point(normal, "normal");
    tf::write_isolines(path, copy, seen, std::string(format), std::string(unit));
}

}  // namespace glue
