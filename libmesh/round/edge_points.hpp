#pragma once
/// \file
/// Which points are next to edges, and which edges pass each other next to each other.

#include <libmesh/round/joint_geometry.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace treeform::detail::round {

/// A place on an edge, from 0 at its lower end to 1, and how far away it is.
struct place {
    double along = 0.0;
    double distance = 0.0;
};

/// A point to be put into an edge.
struct edge_point {
    edge_name edge{};
    double along = 0.0;
    std::uint32_t point = 0;
    double distance = 0.0;
};

/// Two edges that pass each other.
struct passing_edges {
    edge_name a{}, b{};
    place on_a{}, on_b{};
    point3 between{};
    friend bool operator<(const passing_edges& x, const passing_edges& y) {
        return std::tie(x.a, x.b) < std::tie(y.a, y.b);
    }
};

/// Where an edge is nearest to a point.
[[nodiscard]] place nearest_on(points_view points, std::uint32_t p, const edge_name& e);

/// Those of the points `among` that are within `near` of some of the edges, no ends of theirs. By
/// edges; of more than `most`, some that are more than that.
/// \same on any number of threads, if there are no more than `most`
[[nodiscard]] std::vector<edge_point> points_near_edges(points_view points,
                                                        std::span<const std::uint32_t> among,
                                                        std::span<const edge_name> edges,
                                                        double near, std::size_t most);

/// The pairs of edges without a common end that are within `near` of each other inside of both,
/// ascending; likewise.
[[nodiscard]] std::vector<passing_edges> edges_passing(points_view points,
                                                       std::span<const edge_name> edges,
                                                       double near, std::size_t most);

}  // namespace treeform::detail::round
