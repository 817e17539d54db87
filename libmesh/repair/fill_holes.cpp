#include <libmesh/base/point_math.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/repair/fair_patch.hpp>
#include <libmesh/repair/fill_hole.hpp>
#include <libmesh/repair/fill_holes.hpp>
#include <libmesh/repair/open_rims.hpp>
#include <libmesh/repair/refined_patch.hpp>
#include <libmesh/repair/triangulate_rim.hpp>
#include <treeform/mesh/repair.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace treeform::detail::repair {
namespace {

/// Triangles from the rim to the mean of its points, which is new: there is always this way.
std::vector<face> cone_over(working_mesh& mesh, const open_rim& rim) {
    const double share = 1.0 / static_cast<double>(rim.points.size());
    point3 mean{0.0, 0.0, 0.0};
    for (const std::uint32_t p : rim.points)
        mean = base::plus(mean, base::scaled(mesh.points[p], share));
    const auto middle = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(mean);
    std::vector<face> faces;
    for (std::size_t i = 0; i < rim.points.size(); ++i)
        faces.push_back({rim.points[i], rim.points[(i + 1) % rim.points.size()], middle});
    return faces;
}

}  // namespace

filled_holes fill_holes(working_mesh& mesh, std::uint64_t largest) {
    filled_holes done;
    const directed_edges edges(mesh.faces);
    std::optional<base::stars> stars;  // of the mesh before the first hole was filled
    for (const open_rim& rim : open_rims(mesh)) {
        if (rim.points.size() > largest) continue;
        std::vector<face> faces = triangulate_rim(mesh, rim, edges);
        if (faces.empty()) {
            faces = cone_over(mesh, rim);
        } else if (is_to_be_fair(mesh, rim, faces)) {
            if (!stars) stars.emplace(mesh.points.size(), mesh.faces);
            const std::size_t first = mesh.points.size();
            faces = refined_patch(mesh, rim, faces, edges);
            make_fair(mesh, rim, faces, first, *stars);
        }
        for (const face& f : faces) mesh.append(f, repair_result::none);
        ++done.holes;
        done.edges += rim.points.size();
        done.faces += faces.size();
    }
    return done;
}

}  // namespace treeform::detail::repair
