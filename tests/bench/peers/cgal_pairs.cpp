#include "bench/peers/cgal_pairs.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <iterator>

namespace treeform::bench {
namespace {

using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using triangles = std::vector<kernel::Triangle_3>;
using primitive = CGAL::AABB_triangle_primitive<kernel, triangles::const_iterator>;
using aabb_tree = CGAL::AABB_tree<CGAL::AABB_traits<kernel, primitive>>;

template <class Map>
triangles triangles_of(const mesh& mesh, const Map& map) {
    triangles result;
    result.reserve(mesh.faces.size());
    const auto at = [&](std::uint32_t i) {
        const point3 p = map(mesh.points[i]);
        return kernel::Point_3(p.x, p.y, p.z);
    };
    for (const face& f : mesh.faces) result.emplace_back(at(f[0]), at(f[1]), at(f[2]));
    return result;
}

}  // namespace

struct cgal_pair::state {
    triangles of_a;
    mesh b;
    aabb_tree tree;
};

cgal_pair::cgal_pair(const mesh& a, const mesh& b)
    : state_(std::make_unique<state>(
          state{triangles_of(a, [](const point3& p) { return p; }), b, {}})) {
    state_->tree.insert(state_->of_a.cbegin(), state_->of_a.cend());
    state_->tree.build();
}

cgal_pair::~cgal_pair() = default;

bool cgal_pair::collide(const transform<3>& pose) const {
    const auto at = [&](std::uint32_t i) {
        const point3 p = pose(state_->b.points[i]);
        return kernel::Point_3(p.x, p.y, p.z);
    };
    for (const face& f : state_->b.faces)
        if (state_->tree.do_intersect(kernel::Triangle_3(at(f[0]), at(f[1]), at(f[2]))))
            return true;
    return false;
}

std::size_t cgal_pair::intersect(const transform<3>& pose) const {
    std::vector<aabb_tree::Primitive_id> met;
    for (const kernel::Triangle_3& t : triangles_of(state_->b, pose))
        state_->tree.all_intersected_primitives(t, std::back_inserter(met));
    return met.size();
}

}  // namespace treeform::bench
