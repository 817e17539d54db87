#include <libmesh/base/nearest_float.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace treeform {

namespace {

bool fits_float32(double x) { return !std::isfinite(x) || detail::base::nearest_float(x) == x; }

}  // namespace

bool fits_float32(std::span<const point3> points) {
    return std::all_of(points.begin(), points.end(), [](const point3& p) {
        return fits_float32(p.x) && fits_float32(p.y) && fits_float32(p.z);
    });
}

void mesh_file::split_polygons() {
    mesh_file& file = *this;
    if (file.face_of_triangle.empty()) return;
    for (element& e : file.attributes.elements)
        if (e.name == "face") e = e.gathered(file.face_of_triangle);
    for (named_faces& p : file.attributes.parts) {
        const auto at = std::lower_bound(file.face_of_triangle.begin(), file.face_of_triangle.end(),
                                         p.first_face);
        p.first_face = static_cast<std::uint32_t>(at - file.face_of_triangle.begin());
    }
    file.face_of_triangle = {};
    file.stored_faces = file.mesh.faces.size();
}

std::size_t mesh_file::drop_non_finite() {
    mesh_file& file = *this;
    constexpr std::uint32_t none = corner_values::none;
    treeform::mesh& m = file.mesh;
    std::vector<std::uint32_t> kept, new_of_old(m.points.size(), none);
    for (std::uint32_t p = 0; p < m.points.size(); ++p) {
        const point3& at = m.points[p];
        if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z)) continue;
        new_of_old[p] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(p);
    }
    const std::size_t dropped = m.points.size() - kept.size();
    if (dropped == 0) return 0;
    const auto stored_of = [&](std::uint32_t f) {
        return file.face_of_triangle.empty() ? f : file.face_of_triangle[f];
    };
    std::vector<bool> is_bad(file.face_of_triangle.empty() ? m.faces.size() : file.stored_faces,
                             false);
    for (std::uint32_t f = 0; f < m.faces.size(); ++f)
        for (const std::uint32_t corner : m.faces[f])
            if (new_of_old[corner] == none) is_bad[stored_of(f)] = true;
    std::vector<std::uint32_t> rows, new_row(is_bad.size() + 1, 0), triangles;
    for (std::uint32_t s = 0; s < is_bad.size(); ++s) {
        if (!is_bad[s]) rows.push_back(s);
        new_row[s + 1] = static_cast<std::uint32_t>(rows.size());
    }
    for (std::uint32_t f = 0; f < m.faces.size(); ++f)
        if (!is_bad[stored_of(f)]) triangles.push_back(f);
    for (element& e : file.attributes.elements) {
        if (e.name == "vertex") e = e.gathered(kept);
        if (e.name == "face") e = e.gathered(rows);
    }
    file.attributes.corners = file.attributes.corners.gathered(triangles);
    for (named_faces& p : file.attributes.parts) p.first_face = new_row[p.first_face];
    std::vector<std::uint32_t> stored;
    std::vector<face> faces;
    for (const std::uint32_t f : triangles) {
        face corners = m.faces[f];
        for (std::uint32_t& corner : corners) corner = new_of_old[corner];
        faces.push_back(corners);
        if (!file.face_of_triangle.empty()) stored.push_back(new_row[file.face_of_triangle[f]]);
    }
    std::vector<point3> points;
    for (const std::uint32_t p : kept) points.push_back(m.points[p]);
    m = {std::move(points), std::move(faces)};
    file.face_of_triangle = std::move(stored);
    file.stored_faces = file.face_of_triangle.empty() ? m.faces.size() : rows.size();
    return dropped;
}

}  // namespace treeform
