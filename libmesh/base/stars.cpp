#include <libmesh/base/stars.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>

namespace treeform::detail::base {

stars::stars(std::size_t point_count, std::span<const face> faces)
    : begin_(nameable_points(point_count) + 1) {
    std::fill_n(begin_.data(), begin_.size(), std::size_t{0});
    for (const face& f : faces) {
        if (!has_three_corners(f)) continue;
        for (const std::uint32_t corner : f) ++begin_[corner];
    }
    // Ends of the stars; filling them from the last face on turns them into beginnings.
    std::size_t total = 0;
    for (std::size_t v = 0; v < begin_.size(); ++v) begin_[v] = total += begin_[v];
    faces_.resize(total);
    for (std::size_t i = faces.size(); i-- > 0;) {
        if (!has_three_corners(faces[i])) continue;
        for (const std::uint32_t corner : faces[i])
            faces_[--begin_[corner]] = static_cast<std::uint32_t>(i);
    }
}

}  // namespace treeform::detail::base
