#pragma once
/// \file
/// Sections, cuts and parts in C.

#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/section.hpp>

#include <tools/c/made/structs.hpp>

namespace glue {

/// Heights above `plane` (null: the plane z = 0) of the middles of layers of this thickness, from
/// the lowest point of the mesh to the highest.
inline std::vector<double> layer_heights(tf::mesh_view mesh, const tf::oriented_plane& plane,
                                         double thickness) {
    return plane.layer_heights(mesh.points, thickness);
}

/// Writes sections as svg, dxf, obj or json: `format`, or if null, the extension. `unit` of
/// lengths: mm, cm, m, in, ft or um; if null, SVG has no size on paper.
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

/// The connected components of a mesh (faces linked by common corners), in the order of their
/// lowest faces; a cavity is returned with the component around it. Parts with a volume below
/// `min_volume` are omitted (open parts have volume 0). If `largest` is not 0, only that many parts
/// are returned, those of the greatest volume.
inline std::vector<tf::mesh_part> components(const tf::mesh_ref& mesh, double min_volume,
                                             std::size_t largest) {
    return tf::components(mesh, min_volume, largest);
}

/// The points and faces of all meshes, one mesh after the other; points are not joined. `index` [F]
/// is the number of each face's mesh.
inline made_mesh concatenate(const treeform_mesh* const* meshes, std::size_t count) {
    const std::vector<tf::mesh_view> all = views(meshes, count, "meshes");
    std::vector<std::uint32_t> mesh_of_face;
    for (std::uint32_t i = 0; i < count; ++i)
        mesh_of_face.insert(mesh_of_face.end(), all[i].faces.size(), i);
    return {tf::concatenate(all), std::move(mesh_of_face)};
}

}  // namespace glue
