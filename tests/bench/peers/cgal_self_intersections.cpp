#include "bench/peers/cgal_self_intersections.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace treeform::bench {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using surface = CGAL::Surface_mesh<kernel::Point_3>;
using face_pairs = std::vector<std::pair<surface::Face_index, surface::Face_index>>;

struct converted {
    surface mesh;
    bool was_cut = false;
};

std::shared_ptr<const converted> convert(const mesh& mesh) {
    std::vector<kernel::Point_3> points;
    points.reserve(mesh.points.size());
    for (const point3& p : mesh.points) points.emplace_back(p.x, p.y, p.z);
    std::vector<std::array<std::size_t, 3>> polygons;
    polygons.reserve(mesh.faces.size());
    for (const face& f : mesh.faces)
        if (f[0] != f[1] && f[1] != f[2] && f[2] != f[0]) polygons.push_back({f[0], f[1], f[2]});
    auto result = std::make_shared<converted>();
    result->was_cut = !PMP::is_polygon_soup_a_polygon_mesh(polygons);
    if (result->was_cut) PMP::orient_polygon_soup(points, polygons);
    PMP::polygon_soup_to_polygon_mesh(points, polygons, result->mesh);
    return result;
}

template <class Tag>
face_pairs find(const surface& mesh) {
    face_pairs pairs;
    PMP::self_intersections<Tag>(mesh, std::back_inserter(pairs));
    return pairs;
}

/// Degenerate faces are listed as meeting themselves.
double count_of(const face_pairs& pairs) {
    return static_cast<double>(std::count_if(
        pairs.begin(), pairs.end(), [](const auto& pair) { return pair.first != pair.second; }));
}

}  // namespace

job cgal_self_intersections(const mesh& mesh, unsigned threads,
                            std::function<std::optional<double>()> expected) {
    const auto given = convert(mesh);
    const auto run = [given, threads] {
        return threads == 1 ? find<CGAL::Sequential_tag>(given->mesh)
                            : find<CGAL::Parallel_tag>(given->mesh);
    };
    const auto error = [given, expected](const face_pairs& pairs) -> std::optional<double> {
        const std::optional<double> count = given->was_cut ? std::nullopt : expected();
        return count ? std::optional(std::abs(count_of(pairs) - *count)) : std::nullopt;
    };
    return make_job(run, error);
}

std::optional<double> cgal_pair_count(const mesh& mesh) {
    const auto given = convert(mesh);
    if (given->was_cut) return {};
    return count_of(find<CGAL::Sequential_tag>(given->mesh));
}

}  // namespace treeform::bench
