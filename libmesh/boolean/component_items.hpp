#pragma once
/// \file
/// Subtrees of components, and the boxes into which they may reach.

#include <libmesh/boolean/interval_triangle.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/box_in_space.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::boolean {

/// A part of a component that reaches into a box: all faces below a node of its tree, or a single
/// face, which is one level lower.
struct item {
    std::uint32_t component;
    std::uint32_t level;
    std::uint32_t number;
};
using items = std::vector<item>;  // ascending by component

/// Whether one box is larger than the other along some axis.
template <class T>
bool is_larger(const aabb<T, 3>& a, const aabb<T, 3>& b) {
    constexpr T half = 0.5;  // halved, since differences might overflow
    for (std::size_t k = 0; k < 3; ++k)
        if (half * a.max[k] - half * a.min[k] > half * b.max[k] - half * b.min[k]) return true;
    return false;
}

/// A box in space, and rounded outward in the frame of a component's tree, where it is compared
/// with the stored boxes, without access to faces.
struct framed_box {
    aabb<double, 3> in_space;
    aabb<float, 3> in_frame;
};

class component_items {
  public:
    explicit component_items(const surface_components& components) : components_(components) {
        first_level_.reserve(components.size() + 1);
        first_level_.push_back(0);
        for (std::size_t c = 0; c < components.size(); ++c) {
            const tree<3>& index = components.tree_of(c);
            for (unsigned l = 0; l < index.levels(); ++l) level_.push_back(index.level(l).data());
            first_level_.push_back(level_.size());
        }
    }

    [[nodiscard]] framed_box framed(std::uint32_t c, const aabb<double, 3>& box) const {
        return {box, box_in_frame(components_.tree_of(c).frame(), box)};
    }

    [[nodiscard]] bool is_face(const item& i) const { return height(i) == 0; }
    [[nodiscard]] std::uint32_t face_of(const item& i) const {
        return components_.faces(i.component)[components_.tree_of(i.component).ids()[i.number]];
    }
    [[nodiscard]] std::size_t faces_below(const item& i) const {
        const unsigned capacity = 3 * height(i);
        return std::min(std::size_t{1} << capacity, components_.tree_of(i.component).size() -
                                                        (std::size_t{i.number} << capacity));
    }

    /// \pre `i` is not a face
    template <class Visit>
    void for_children(const item& i, const Visit& visit) const {
        const auto first = static_cast<std::uint32_t>(tree<3>::width * i.number);
        const unsigned capacity = 3 * (height(i) - 1);
        const std::size_t children =
            (faces_below(i) + (std::size_t{1} << capacity) - 1) >> capacity;
        for (std::uint32_t k = 0; k < children; ++k)
            visit(item{i.component, i.level + 1, first + k});
    }

    /// The box of an item in the frame of its tree. \pre `i` is not a root
    [[nodiscard]] aabb<float, 3> box_of(const item& i) const {
        const auto [node, slot] = place_of(i);
        aabb<float, 3> box;
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] = node.min[k][slot];
            box.max[k] = node.max[k][slot];
        }
        return box;
    }
    /// The same along one axis.
    [[nodiscard]] aabb<float, 1> extent_of(const item& i, std::size_t axis) const {
        const auto [node, slot] = place_of(i);
        aabb<float, 1> extent;
        extent.min[0] = node.min[axis][slot];
        extent.max[0] = node.max[axis][slot];
        return extent;
    }

    /// Whether an item, whose box in the frame is `own`, may reach into a box. For large faces,
    /// this also tests the triangle.
    [[nodiscard]] bool reaches(const item& i, const aabb<float, 3>& own,
                               const framed_box& box) const {
        if (!overlaps(own, box.in_frame)) return false;
        return !is_face(i) || !is_larger(own, box.in_frame) || does_face_reach(i, box.in_space);
    }
    /// False if a face certainly misses a box.
    [[nodiscard]] bool does_face_reach(const item& i, const aabb<double, 3>& box) const {
        const mesh_view mesh = components_.mesh();
        const face& f = mesh.faces[face_of(i)];
        return !interval_triangle({mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]})
                    .is_apart_from(box);
    }

  private:
    struct node_slot {
        const wide_node<3>& node;
        std::size_t slot;
    };

    /// Number of levels from the item down to faces.
    [[nodiscard]] unsigned height(const item& i) const {
        return static_cast<unsigned>(first_level_[i.component + 1] - first_level_[i.component]) -
               i.level;
    }
    [[nodiscard]] node_slot place_of(const item& i) const {
        return {level_[first_level_[i.component] + i.level - 1][i.number / tree<3>::width],
                i.number % tree<3>::width};
    }

    const surface_components& components_;
    std::vector<const wide_node<3>*> level_{};  ///< component by component
    std::vector<std::size_t> first_level_{};    ///< [C + 1]
};

}  // namespace treeform::detail::boolean
