#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <tools/c/made/structs.hpp>
#include <tools/c/pairs.hpp>

#include <algorithm>

namespace tf = treeform;

treeform_code treeform_self_intersections(const treeform_mesh* mesh,
                                          const treeform_self_intersections_options* options,
                                          treeform_pairs** pairs) {
    return glue::guard([&] {
        glue::start(pairs);
        tf::self_intersection_options how = glue::read(options);
        if (options && options->component_of_face)
            how.component_of_face = {options->component_of_face, glue::view(mesh).faces.size()};
        return glue::give(tf::self_intersections(glue::ref(mesh, "mesh"), how), pairs);
    });
}

treeform_code treeform_intersects_poses(const treeform_mesh* a, const treeform_mesh* b,
                                        const double* moves_a, const double* moves_b, size_t count,
                                        uint8_t* meet) {
    return glue::guard([&] {
        const std::span out = glue::array(meet, count, "meet");
        const auto where = glue::positions(moves_a, moves_b, count);
        glue::asked_in_pieces(
            a, b, count, [&](const auto& x, const auto& y, std::size_t begin, std::size_t end) {
                const std::vector<bool> found =
                    tf::intersects(x, y, std::span(where).subspan(begin, end - begin));
                std::copy(found.begin(), found.end(), out.data() + begin);
            });
    });
}

treeform_code treeform_faces_in_box(const treeform_mesh* mesh, const treeform_box* box,
                                    treeform_indices** faces) {
    return glue::guard([&] {
        glue::start(faces);
        const tf::box3 in = glue::box(glue::need(box, "box"));
        const tf::mesh_view view = glue::view(mesh);
        if (const auto bad = tf::find_defects(view).nonfinite_faces; !bad.empty())
            throw std::invalid_argument("face " + std::to_string(bad[0]) +
                                        " has a corner that is not finite");
        return glue::give(tf::faces_in_box(view, in.min, in.max), faces);
    });
}

treeform_code treeform_color_pairs(treeform_file* file, const treeform_part* part,
                                   const treeform_face_pair* pairs, size_t count) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        const treeform_part& p = glue::need(part, "part");
        const std::size_t faces = p.mesh.face_count;
        tf::usable_mesh looked_at;
        const tf::points_view points = glue::points(p.mesh.points, p.mesh.point_count, "points");
        const std::span corners = glue::faces(p.mesh.faces, faces, "faces");
        looked_at.mesh.points.assign(points.begin(), points.end());
        looked_at.mesh.faces.assign(corners.begin(), corners.end());
        if (p.triangle_of_face)
            looked_at.triangle_of_face.assign(p.triangle_of_face, p.triangle_of_face + faces);
        looked_at.stored_face = to.stored_face;
        for (std::uint32_t f = 0; f < faces; ++f)
            if (looked_at.triangle(f) >= to.mesh.faces.size())
                throw std::invalid_argument("the part is not of this file");
        const auto found = glue::pairs_of(faces, pairs, count);
        tf::face_marks(faces, found, tf::group_pairs(looked_at.mesh, found)).color(to, looked_at);
    });
}
