#include <libmesh/arrange/edge_stars.hpp>
#include <libmesh/base/stars.hpp>

namespace treeform::detail::arrange {

edge_stars::edge_stars(std::size_t point_count, std::span<const face> faces)
    : at_(base::faces_at_lower_ends<std::uint32_t>(point_count, faces)) {}

}  // namespace treeform::detail::arrange
