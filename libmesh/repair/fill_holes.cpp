#include <libmesh/repair/fill_hole.hpp>
#include <libmesh/repair/fill_holes.hpp>
#include <treeform/mesh/repair.hpp>

#include <vector>

namespace treeform::detail::repair {

filled_holes fill_holes(working_mesh& mesh, std::uint64_t largest) {
    filled_holes done;
    const directed_edges edges(mesh.faces);
    for (const std::vector<std::uint32_t>& rim : find_rims(mesh.faces, edges)) {
        if (rim.size() > largest) continue;
        const std::vector<face> faces = fill(mesh.points, rim, edges);
        if (faces.empty()) continue;
        for (const face& f : faces) mesh.append(f, repair_result::none);
        ++done.holes;
        done.edges += rim.size();
        done.faces += faces.size();
    }
    return done;
}

}  // namespace treeform::detail::repair
