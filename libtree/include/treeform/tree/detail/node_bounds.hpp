#pragma once
/// \file
/// The box of a node, for its slot in the parent.

#include <treeform/tree/tree.hpp>

#include <array>
#include <cstddef>
#include <limits>

namespace treeform::detail {

/// The box around the boxes of a node; [+inf, -inf] if it has none.
template <std::size_t D>
struct node_bounds {
    std::array<float, D> min, max;

    explicit node_bounds(const wide_node<D>& node) {
        for (std::size_t k = 0; k < D; ++k) {
            min[k] = least<false>(node.min[k]);
            max[k] = least<true>(node.max[k]);
        }
    }

  private:
    /// By halves, which compilers vectorize. The result is one of the elements, bit for bit.
    template <bool Greatest>
    static float least(const float (&of)[8]) {
        const auto better = [](float a, float b) { return (Greatest ? a > b : a < b) ? a : b; };
        float four[4];
        for (std::size_t i = 0; i < 4; ++i) four[i] = better(of[i], of[i + 4]);
        return better(better(four[0], four[2]), better(four[1], four[3]));
    }
};

template <std::size_t D>
void clear_slot(wide_node<D>& node, std::size_t slot) {
    for (std::size_t k = 0; k < D; ++k) {
        node.min[k][slot] = std::numeric_limits<float>::infinity();
        node.max[k][slot] = -std::numeric_limits<float>::infinity();
    }
}

/// Writes the box of node `node` of `level` into its slot of the level above.
/// \pre level > 0
template <std::size_t D>
void lift(tree<D>& tree, unsigned level, std::size_t node) {
    const node_bounds<D> box(tree.level_data(level)[node]);
    wide_node<D>& parent = tree.level_data(level - 1)[node / tree.width];
    for (std::size_t k = 0; k < D; ++k) {
        parent.min[k][node % tree.width] = box.min[k];
        parent.max[k][node % tree.width] = box.max[k];
    }
}

}  // namespace treeform::detail
