#include <libmesh/base/nearest_float.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <algorithm>
#include <cmath>

namespace treeform {

namespace {

bool fits_single(double x) { return !std::isfinite(x) || detail::base::nearest_float(x) == x; }

}  // namespace

bool fits_single(std::span<const point3> points) {
    return std::all_of(points.begin(), points.end(), [](const point3& p) {
        return fits_single(p.x) && fits_single(p.y) && fits_single(p.z);
    });
}

void split_polygons(mesh_file& file) {
    if (file.stored_face.empty()) return;
    for (element& e : file.attributes.elements)
        if (e.name == "face") e = gather(e, file.stored_face);
    for (part& p : file.attributes.parts) {
        const auto at =
            std::lower_bound(file.stored_face.begin(), file.stored_face.end(), p.first_face);
        p.first_face = static_cast<std::uint32_t>(at - file.stored_face.begin());
    }
    file.stored_face = {};
    file.stored_faces = file.mesh.faces.size();
}

}  // namespace treeform
