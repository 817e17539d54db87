#pragma once
/// \file
/// A search of two trees in motion that does not open more nodes than it may.

#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace treeform::detail {

/// As `visit_swept`, but ends after opening `most` pairs of nodes, or visiting those of pairs of
/// leaves. Returns how many these were: more than `most`, then, by one.
template <std::size_t D>
TREEFORM_API std::uint64_t sweep_within(const transformed<D>& a, const transformed<D>& b,
                                        const std::array<double, D>& motion, double latest,
                                        std::uint64_t most,
                                        function_ref<double(std::uint32_t, std::uint32_t)> visit);

}  // namespace treeform::detail
