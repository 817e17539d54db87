#include "bench/pose_askers.hpp"

#include "bench/face_boxes.hpp"
#include "bench/nary_nearness.hpp"
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libtree/paper/nary_search.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace treeform::bench {
namespace {

using box = aabb<double, 3>;

struct own_trees {
    shared_mesh a, b;
    tree<3> tree_a, tree_b;
};

std::shared_ptr<const own_trees> own_trees_of(const scene& scene) {
    return std::make_shared<const own_trees>(
        own_trees{scene.a, scene.b, build_face_tree(*scene.a), build_face_tree(*scene.b)});
}

struct paper_trees {
    shared_mesh a, b;
    nary_tree<double, 3> tree_a, tree_b;
};

std::shared_ptr<const paper_trees> paper_trees_of(const scene& scene,
                                                  const tree_config& config = {}) {
    const auto tree_of = [&](const mesh& mesh) {
        return build(mesh.faces, face_box(mesh), config);
    };
    return std::make_shared<const paper_trees>(
        paper_trees{scene.a, scene.b, tree_of(*scene.a), tree_of(*scene.b)});
}

/// The box around a box that is moved: its center is moved, its half extents by the magnitudes.
class box_mover {
  public:
    explicit box_mover(const transform<3>& pose) : pose_(pose) {}

    [[nodiscard]] box operator()(const box& given) const {
        std::array<double, 3> center, half;
        for (std::size_t k = 0; k < 3; ++k) {
            center[k] = 0.5 * (given.min[k] + given.max[k]);
            half[k] = 0.5 * (given.max[k] - given.min[k]) + rounding;
        }
        const auto moved = pose_(center);
        box result;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& row = pose_.rows[k];
            const double reach = std::abs(row[0]) * half[0] + std::abs(row[1]) * half[1] +
                                 std::abs(row[2]) * half[2];
            result.min[k] = moved[k] - reach;
            result.max[k] = moved[k] + reach;
        }
        return result;
    }

  private:
    static constexpr double rounding = 1e-14;  // the models lie within 3 of the origin
    transform<3> pose_;
};

/// Moves a box when it is not the one it moved last: the searches take the second tree's boxes one
/// after the other, each with several of the first tree.
class last_mover {
  public:
    explicit last_mover(const transform<3>& pose) : move_(pose) {}

    [[nodiscard]] const box& operator()(const box& given) {
        if (&given != last_) {
            last_ = &given;
            moved_ = move_(given);
        }
        return moved_;
    }

  private:
    box_mover move_;
    const box* last_ = nullptr;
    box moved_;
};

triangle3 triangle_of(const mesh& mesh, std::uint32_t f) {
    const face& corners = mesh.faces[f];
    return {mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]};
}

triangle3 moved(const triangle3& t, const transform<3>& pose) {
    return {pose(t[0]), pose(t[1]), pose(t[2])};
}

box box_of(const triangle3& t) {
    box result;
    for (const point3& p : t) result.include(p);
    return result;
}

/// Whether faces i of a and j of b, which is moved, meet.
auto faces_meet(const paper_trees& trees, const transform<3>& pose) {
    return [&trees, &pose](std::uint32_t i, std::uint32_t j) {
        const triangle3 a = triangle_of(*trees.a, i);
        const triangle3 b = moved(triangle_of(*trees.b, j), pose);
        return overlaps(box_of(a), box_of(b)) && intersect(a, b).count != 0;
    };
}

template <class Strategy>
ask_pose paper_distance_by(const scene& scene, const tree_config& config,
                           std::shared_ptr<box_count> counted) {
    return [trees = paper_trees_of(scene, config), counted](const transform<3>& pose) {
        last_mover mover(pose);
        std::uint64_t boxes = 0;
        double best = std::numeric_limits<double>::infinity();
        std::optional<std::uint32_t> last;  // the face of the second mesh that `placed` is
        triangle3 placed;
        box box_of_placed;
        const double squared = nary_nearest_pair<Strategy>(
            trees->tree_a, trees->tree_b,
            [&](const box& a, const box& b) {
                ++boxes;
                return squared_distance(a, mover(b));
            },
            [&](std::uint32_t i, std::uint32_t j) {
                if (j != last) {
                    last = j;
                    placed = moved(triangle_of(*trees->b, j), pose);
                    box_of_placed = box_of(placed);
                }
                const triangle3 a = triangle_of(*trees->a, i);
                // Most pairs of a leaf are told by their boxes not to be the nearest.
                if (squared_distance(box_of(a), box_of_placed) < best)
                    best = std::min(best, closest_pair(a, placed).squared_distance);
                return best;
            });
        if (counted) {
            counted->boxes += boxes;
            ++counted->poses;
        }
        return std::sqrt(squared);
    };
}

}  // namespace

ask_pose own_collide(const scene& scene) {
    return [trees = own_trees_of(scene)](const transform<3>& pose) {
        const auto& [a, b, tree_a, tree_b] = *trees;
        return detail::intersect::intersects(*a, tree_a, *b, tree_b, {.transform_b = pose}) ? 1.0
                                                                                            : 0.0;
    };
}

ask_pose own_intersect(const scene& scene) {
    const auto a = std::make_shared<const prepared_mesh>(prepared_mesh::borrow(*scene.a));
    const auto b = std::make_shared<const prepared_mesh>(prepared_mesh::borrow(*scene.b));
    return [a, b](const transform<3>& pose) {
        return static_cast<double>(mesh_intersections(*a, *b, {.transform_b = pose}).pairs.size());
    };
}

ask_pose own_distance(const scene& scene) {
    const auto a = std::make_shared<const prepared_mesh>(prepared_mesh::borrow(*scene.a));
    const auto b = std::make_shared<const prepared_mesh>(prepared_mesh::borrow(*scene.b));
    return [a, b](const transform<3>& pose) {
        return closest_pair(*a, *b, {.transform_b = pose}).value().distance;
    };
}

ask_pose paper_collide(const scene& scene) {
    return [trees = paper_trees_of(scene)](const transform<3>& pose) {
        last_mover mover(pose);
        return nary_any_pair(
                   trees->tree_a, trees->tree_b,
                   [&](const box& a, const box& b) { return overlaps(a, mover(b)); },
                   faces_meet(*trees, pose))
                   ? 1.0
                   : 0.0;
    };
}

ask_pose paper_intersect(const scene& scene) {
    return [trees = paper_trees_of(scene)](const transform<3>& pose) {
        const box_mover mover(pose);
        const auto meet = faces_meet(*trees, pose);
        using list = std::vector<id_pair>;
        const auto found = search<list>(
            trees->tree_a, trees->tree_b,
            [&](const box& a, const box& b) { return overlaps(a, mover(b)); },
            [&](list& mine, std::uint32_t i, std::uint32_t j) {
                if (meet(i, j)) mine.emplace_back(i, j);
            });
        std::size_t count = 0;
        for (const list& part : found) count += part.size();
        return static_cast<double>(count);
    };
}

ask_pose paper_distance(const scene& scene, open_by order, const tree_config& config,
                        std::shared_ptr<box_count> counted) {
    return order == open_by::top_k
               ? paper_distance_by<strategy::top_k_sorted>(scene, config, std::move(counted))
               : paper_distance_by<strategy::priority_queue>(scene, config, std::move(counted));
}

}  // namespace treeform::bench
