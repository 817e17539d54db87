#include "bench/peers/cgal_closest.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>

namespace treeform::bench {
namespace {

using kernel = CGAL::Simple_cartesian<double>;
using triangles = std::vector<kernel::Triangle_3>;
using primitive = CGAL::AABB_triangle_primitive<kernel, triangles::const_iterator>;
using aabb_tree = CGAL::AABB_tree<CGAL::AABB_traits<kernel, primitive>>;

kernel::Point_3 at(const point3& p) { return {p.x, p.y, p.z}; }

}  // namespace

struct cgal_closest::state {
    triangles given;
    aabb_tree tree;
};

cgal_closest::cgal_closest(const mesh& mesh) : state_(std::make_unique<state>()) {
    const auto& points = mesh.points;
    for (const face& f : mesh.faces)
        state_->given.emplace_back(at(points[f[0]]), at(points[f[1]]), at(points[f[2]]));
    state_->tree.insert(state_->given.cbegin(), state_->given.cend());
    state_->tree.build();
    state_->tree.accelerate_distance_queries();
}

cgal_closest::~cgal_closest() = default;

std::vector<double> cgal_closest::distances(const std::vector<point3>& queries) const {
    std::vector<double> result;
    result.reserve(queries.size());
    for (const point3& q : queries)
        result.push_back(
            std::sqrt(CGAL::squared_distance(at(q), state_->tree.closest_point(at(q)))));
    return result;
}

}  // namespace treeform::bench
