#pragma once
/// \file
/// nanoflann's tree over our points. For the sources of its peers alone: it includes all of
/// nanoflann.

#include <treeform/mesh/mesh.hpp>

#include <nanoflann.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::bench {

/// Points as nanoflann asks for them. They outlive it.
struct nanoflann_cloud {
    const std::vector<point3>& points;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t k) const { return points[i][k]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

using nanoflann_index =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, nanoflann_cloud>,
                                        nanoflann_cloud, 3, std::uint32_t>;

}  // namespace treeform::bench
