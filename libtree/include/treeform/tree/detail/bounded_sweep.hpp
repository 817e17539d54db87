#pragma once
/// \file
/// A search of two trees in motion with a limit on the nodes opened.

#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace treeform::detail {

/// As `visit_swept`, but stops when the number of processed pairs of nodes (opened, or visited as
/// pairs of leaf blocks) exceeds `most`. Returns that number: `most` + 1 if it stopped early.
template <std::size_t D>
TREEFORM_API std::uint64_t sweep_within(const transformed<D>& a, const transformed<D>& b,
                                        const std::array<double, D>& motion, double latest,
                                        std::uint64_t most,
                                        function_ref<double(std::uint32_t, std::uint32_t)> visit);

}  // namespace treeform::detail
