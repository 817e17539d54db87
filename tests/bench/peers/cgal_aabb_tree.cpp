#include "bench/peers/cgal_aabb_tree.hpp"

#include "bench/peers/versions.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>

#include <memory>
#include <vector>

namespace treeform::bench {
namespace {

using kernel = CGAL::Simple_cartesian<double>;
using triangles = std::vector<kernel::Triangle_3>;
using primitive = CGAL::AABB_triangle_primitive<kernel, triangles::const_iterator>;
using aabb_tree = CGAL::AABB_tree<CGAL::AABB_traits<kernel, primitive>>;

}  // namespace

job cgal_aabb_tree(const mesh& mesh) {
    const auto given = std::make_shared<triangles>();
    given->reserve(mesh.faces.size());
    const auto point = [&](std::uint32_t i) {
        const point3& p = mesh.points[i];
        return kernel::Point_3(p.x, p.y, p.z);
    };
    for (const face& f : mesh.faces) given->emplace_back(point(f[0]), point(f[1]), point(f[2]));
    return make_job([given] {
        auto tree = std::make_unique<aabb_tree>(given->cbegin(), given->cend());
        tree->build();
        return tree;
    });
}

std::string cgal_name() { return "CGAL " CGAL_VERSION_STR; }

}  // namespace treeform::bench
