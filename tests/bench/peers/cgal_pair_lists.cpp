#include "bench/peers/cgal_pair_lists.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace treeform::bench {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

template <class Kernel>
class surface final : public cgal_surface {
  public:
    using mesh_type = CGAL::Surface_mesh<typename Kernel::Point_3>;
    using face_index = typename mesh_type::Face_index;

    surface(const mesh& given, const std::vector<std::array<std::size_t, 3>>& polygons,
            std::vector<std::uint32_t> numbers)
        : numbers_(std::move(numbers)) {
        std::vector<typename Kernel::Point_3> points;
        for (const point3& p : given.points) points.emplace_back(p.x, p.y, p.z);
        PMP::polygon_soup_to_polygon_mesh(points, polygons, mesh_);
    }

    pair_list pairs() const override {
        std::vector<std::pair<face_index, face_index>> found;
        PMP::self_intersections<CGAL::Sequential_tag>(mesh_, std::back_inserter(found));
        pair_list result;
        for (const auto& [f, g] : found) {
            if (f == g) continue;
            const auto [low, high] = std::minmax(numbers_[f.idx()], numbers_[g.idx()]);
            result.push_back({low, high});
        }
        std::ranges::sort(result);
        return result;
    }

  private:
    mesh_type mesh_;
    std::vector<std::uint32_t> numbers_;
};

}  // namespace

std::shared_ptr<const cgal_surface> cgal_surface_of(const mesh& given, bool exact) {
    std::vector<std::array<std::size_t, 3>> polygons;
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t f = 0; f < given.faces.size(); ++f) {
        const face& c = given.faces[f];
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
        polygons.push_back({c[0], c[1], c[2]});
        numbers.push_back(f);
    }
    if (!PMP::is_polygon_soup_a_polygon_mesh(polygons)) return nullptr;
    if (exact)
        return std::make_shared<surface<CGAL::Exact_predicates_exact_constructions_kernel>>(
            given, polygons, std::move(numbers));
    return std::make_shared<surface<CGAL::Exact_predicates_inexact_constructions_kernel>>(
        given, polygons, std::move(numbers));
}

}  // namespace treeform::bench
