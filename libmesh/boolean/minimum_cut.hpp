#pragma once
/// \file
/// Minimum cuts of networks with integer capacities.

#include <treeform/tree/detail/function_ref.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// A directed edge.
struct network_edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::int64_t capacity = 0;
};

/// Nodes between a source and a sink.
struct network {
    std::vector<std::int64_t> from_source;  ///< [N] capacity of the edge from the source
    std::vector<std::int64_t> to_sink;      ///< [N] capacity of the edge to the sink
    std::vector<network_edge> edges;        ///< parallel edges are allowed
};

/// [N] 1 for the nodes on the source's side of a minimum cut. Of several minimum cuts, the one with
/// the fewest nodes on this side, which are on the source's side in all of them. None if `stop`
/// returned true.
///
/// \pre    capacities are not negative, and add up to less than 2^62
/// \cost   O(N^2 E) at most, in practice little more than O(N + E); serial
/// \source Dinitz, Algorithm for Solution of a Problem of Maximum Flow in a Network with Power
///         Estimation, Soviet Math. Doklady 11 (1970)
[[nodiscard]] std::optional<std::vector<std::uint8_t>> minimum_cut(const network& given,
                                                                   function_ref<bool()> stop);

}  // namespace treeform::detail::boolean
