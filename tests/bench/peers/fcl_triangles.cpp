#include "bench/peers/fcl_triangles.hpp"

#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

#include <array>
#include <memory>

namespace treeform::bench {
namespace {

template <class Real>
using corners = std::array<fcl::Vector3<Real>, 6>;

template <class Real>
std::shared_ptr<const std::vector<corners<Real>>> convert(
    std::span<const test::triangle_pair> pairs) {
    auto result = std::make_shared<std::vector<corners<Real>>>();
    result->reserve(pairs.size());
    for (const auto& [a, b] : pairs) {
        corners<Real>& c = result->emplace_back();
        for (std::size_t i = 0; i < 6; ++i) {
            const point3& p = i < 3 ? a[i] : b[i - 3];
            c[i] = {static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)};
        }
    }
    return result;
}

template <class Real>
asker meet(std::span<const test::triangle_pair> pairs) {
    return [given = convert<Real>(pairs)](verdicts& verdicts) {
        for (std::size_t i = 0; i < given->size(); ++i) {
            const corners<Real>& c = (*given)[i];
            verdicts[i] =
                fcl::detail::Intersect<Real>::intersect_Triangle(c[0], c[1], c[2], c[3], c[4], c[5])
                    ? 1
                    : 0;
        }
    };
}

template <class Real>
std::function<void(std::vector<double>&)> distances(std::span<const test::triangle_pair> pairs) {
    return [given = convert<Real>(pairs)](std::vector<double>& found) {
        fcl::Vector3<Real> p, q;
        for (std::size_t i = 0; i < given->size(); ++i) {
            const corners<Real>& c = (*given)[i];
            found[i] = static_cast<double>(fcl::detail::TriangleDistance<Real>::triDistance(
                c[0], c[1], c[2], c[3], c[4], c[5], p, q));
        }
    };
}

}  // namespace

asker fcl_triangles_meet(std::span<const test::triangle_pair> pairs, bool in_float) {
    return in_float ? meet<float>(pairs) : meet<double>(pairs);
}

std::function<void(std::vector<double>&)> fcl_triangle_distances(
    std::span<const test::triangle_pair> pairs, bool in_float) {
    return in_float ? distances<float>(pairs) : distances<double>(pairs);
}

}  // namespace treeform::bench
