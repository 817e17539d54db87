#pragma once
/// \file
/// Numbers the points of an arrangement.

#include <libmesh/arrange/cluster.hpp>
#include <libmesh/exact/implicit_point.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::arrange {

/// Final numbers of the points of all clusters.
struct point_numbering {
    std::vector<implicit_point> constructed;
    std::vector<std::uint32_t> of_item;  ///< [named + made] final number
    /// [clusters] item of the first point created by each cluster
    std::vector<std::uint32_t> made_begin;
};

/// `named` are the points of meetings; the points created by clusters are moved out of `cuts`.
/// \throws std::invalid_argument if two of the given points are equal
/// \same on any number of threads
[[nodiscard]] point_numbering number_points(std::size_t given, std::vector<implicit_point> named,
                                            std::vector<cut_cluster>& cuts);

}  // namespace treeform::detail::arrange
