#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/face_boxes.hpp>
#include <libmesh/intersect/overlap_trees.hpp>
#include <treeform/tree/build.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>
#include <stdexcept>
#include <vector>

namespace treeform::detail::intersect {
namespace {

void check_finite_faces_moved(const char* function, mesh_view mesh, const transform<3>& by) {
    std::vector<point3> moved(mesh.points.begin(), mesh.points.end());
    for (point3& p : moved) p = by(p);
    base::check_finite_faces(function, {moved, mesh.faces});
}

using box3 = aabb<double, 3>;
using trees = std::pair<tree<3>, tree<3>>;

constexpr std::size_t most_sampled = 1024;

/// The boxes of some faces, evenly spread; none of few, of which it does not matter.
template <class BoxOf>
std::vector<box3> sample(std::span<const face> faces, const BoxOf& box_of) {
    std::vector<box3> boxes;
    if (faces.size() < most_sampled) return boxes;
    const std::size_t step = faces.size() / most_sampled;
    for (std::size_t f = 0; f < faces.size(); f += step) boxes.push_back(box_of(faces[f]));
    return boxes;
}

/// Whether most of a sample reach into what is around another.
bool most_reach(const std::vector<box3>& some, const std::vector<box3>& others) {
    box3 around;
    for (const box3& box : others) around.include(box);
    const auto count =
        std::ranges::count_if(some, [&](const box3& box) { return overlaps(box, around); });
    return 2 * count > std::ssize(some);
}

/// Over all faces where that is most likely faster: to find out which ones are left out costs as
/// much as to have half of them in the trees. Which it is makes no difference to any answer.
template <class BoxOfA, class BoxOfB>
trees build_trees(std::span<const face> a, const BoxOfA& box_of_a, std::span<const face> b,
                  const BoxOfB& box_of_b) {
    const std::vector<box3> some_of_a = sample(a, box_of_a), some_of_b = sample(b, box_of_b);
    if (most_reach(some_of_a, some_of_b) && most_reach(some_of_b, some_of_a))
        return {build(a, box_of_a), build(b, box_of_b)};
    return build_overlap(a, box_of_a, b, box_of_b);
}

}  // namespace

std::pair<tree<3>, tree<3>> overlap_trees(const std::string& function, mesh_view a, mesh_view b,
                                          const mesh_pair_options& positions) {
    const std::string name_a = function + ": a", name_b = function + ": b";
    const transform<3>& transform_a = positions.transform_a;
    const transform<3>& transform_b = positions.transform_b;
    if (!transform_a.finite() || !transform_b.finite())
        throw std::invalid_argument("treeform::" + function + ": a transform is not finite");
    base::check_faces(name_a.c_str(), a.points.size(), a.faces);
    base::check_faces(name_b.c_str(), b.points.size(), b.faces);
    try {
        if (transform_a == transform<3>{} && transform_b == transform<3>{})
            return build_trees(a.faces, base::face_boxes(a.points), b.faces,
                               base::face_boxes(b.points));
        return build_trees(a.faces, base::face_boxes(a.points, transform_a), b.faces,
                           base::face_boxes(b.points, transform_b));
    } catch (const std::invalid_argument&) {  // a box, and so a face, that is not finite
        check_finite_faces_moved(name_a.c_str(), a, transform_a);
        check_finite_faces_moved(name_b.c_str(), b, transform_b);
        throw;
    }
}

}  // namespace treeform::detail::intersect
