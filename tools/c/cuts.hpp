#pragma once
/// \file
/// Sections, cuts and parts in C.

#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/section.hpp>

#include <tools/c/made/structs.hpp>

namespace glue {

/// Heights above `plane` (null: as above) of the middles of layers of this thickness, from the
/// lowest point of the mesh to the highest.
inline std::vector<double> layer_heights(tf::mesh_view mesh, const tf::oriented_plane& plane,
                                         double thickness) {
    return plane.layer_heights(mesh.points, thickness);
}

/// Writes sections as svg, dxf, obj or json: `format`, or by the extension where that is null.
/// `unit` of lengths: mm, cm, m, in, ft or um, or null: SVG has no size on paper then.
inline void write_section(const std::filesystem::path& path, const treeform_section_result* section,
                          std::string_view format, std::string_view unit) {
    const treeform_section_result& s = need(section, "section");
    tf::section_result copy;
    copy.layers = copied_as<tf::section_layer>(s.layers, s.layer_count, "layers");
    copy.loops = copied_as<tf::section_loop>(s.loops, s.loop_count, "loops");
    copy.points = copied_as<tf::point2>(s.points, s.point_count, "points");
    copy.axes = {point(s.axes[0], "axes"), point(s.axes[1], "axes"), point(s.axes[2], "axes")};
    tf::write_section(path, copy, std::string(format), std::string(unit));
}

/// The faces that corners link, as meshes, by their lowest faces; a cavity goes with what is around
/// it. Parts of a volume below `min_volume` are left out (open ones have none), and all but the
/// `largest` ones where that is not 0.
inline std::vector<tf::mesh_part> components(const tf::mesh_ref& mesh, double min_volume,
                                             std::size_t largest) {
    return tf::components(mesh, min_volume, largest);
}

/// Points and faces of all meshes, one after the other; nothing is joined. `index` [F] is the mesh
/// that each face is of.
inline made_mesh concatenate(const treeform_mesh* const* meshes, std::size_t count) {
    const std::vector<tf::mesh_view> all = views(meshes, count, "meshes");
    std::vector<std::uint32_t> mesh_of_face;
    for (std::uint32_t i = 0; i < count; ++i)
        mesh_of_face.insert(mesh_of_face.end(), all[i].faces.size(), i);
    return {tf::concatenate(all), std::move(mesh_of_face)};
}

}  // namespace glue
