#pragma once
/// \file
/// The default: selection that brackets the cut by a sample and scatters without branches.

namespace treeform::strategy {

/// Names the built-in selection of `build` (libtree/split.cpp). It works on packed records with a
/// scratch array, so unlike the others it has no `partition` over arbitrary iterators.
struct bracketed_select {};

}  // namespace treeform::strategy
