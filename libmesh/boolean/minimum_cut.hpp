#pragma once
/// \file
/// Least cuts of networks with whole-number capacities.

#include <treeform/tree/detail/function_ref.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// A way from one node to another.
struct network_edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::int64_t capacity = 0;
};

/// Nodes between a source and a sink.
struct network {
    std::vector<std::int64_t> from_source;  ///< [N] capacity of the way from the source
    std::vector<std::int64_t> to_sink;      ///< [N] of the way to the sink
    std::vector<network_edge> edges;        ///< there may be several from a node to another
};

/// [N] 1 for the nodes on the source's side of a least cut: one for which the capacities of the
/// ways from that side to the other add up to the least there is. Of several, the one with the
/// fewest nodes: they are part of the source's side of every other one. None where `stop` says so.
///
/// \pre    capacities are not negative, and add up to less than 2^62
/// \cost   O(N^2 E) at most, in practice little more than O(N + E); serial
/// \source Dinitz, Algorithm for Solution of a Problem of Maximum Flow in a Network with Power
///         Estimation, Soviet Math. Doklady 11 (1970)
[[nodiscard]] std::optional<std::vector<std::uint8_t>> minimum_cut(const network& given,
                                                                   function_ref<bool()> stop);

}  // namespace treeform::detail::boolean
