#pragma once
/// \file
/// The configuration of a tree of the paper's layout.

namespace treeform {

/// The shape of an `nary_tree`. The wide tree has none: its arity and leaf size are those of a
/// vector register.
struct tree_config {
    /// Children of an inner node, 2 to 16. A larger number makes the tree flatter, and each visit
    /// more expensive.
    unsigned inner_size = 4;
    /// Largest number of primitives of a leaf, at least 1.
    unsigned leaf_size = 4;
};

}  // namespace treeform
