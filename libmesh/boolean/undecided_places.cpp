#include <libmesh/boolean/undecided_places.hpp>
#include <libmesh/exact/box_around.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace treeform::detail::boolean {

undecided_places::undecided_places(const mesh_arrangement& cut, const undecided_space* space)
    : cut_(cut), space_(space) {
    if (space_ != nullptr) find();
}

aabb<double, 3> undecided_places::box_of(std::uint32_t point) const {
    if (point >= cut_.given_points.size())
        return exact::box_around(cut_.constructed[point - cut_.given_points.size()]);
    aabb<double, 3> box;
    box.include(cut_.given_points[point]);
    return box;
}

std::array<aabb<double, 3>, 3> undecided_places::corners_of(const face& f) const {
    return {box_of(f[0]), box_of(f[1]), box_of(f[2])};
}

void undecided_places::find() {
    is_within_.resize(cut_.faces.size(), 0);
    for_chunks(
        cut_.faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t f = begin; f < end; ++f) {
                const auto corners = corners_of(cut_.faces[f]);
                const bool may_be = std::ranges::all_of(
                    corners, [&](const auto& corner) { return space_->reaches_undecided(corner); });
                is_within_[f] = may_be && space_->is_within_undecided(corners) ? 1 : 0;
            }
        });
}

arrange::edge_use undecided_places::use_of(const std::array<std::uint32_t, 2>& points,
                                           std::span<const arrange::face_side> sides) const {
    using arrange::edge_use;
    if (sides.size() == 1) return edge_use::nothing;
    if (space_ == nullptr) return edge_use::all;
    const auto within = std::ranges::count_if(
        sides, [&](arrange::face_side side) { return is_within_[arrange::face_of(side)] != 0; });
    if (within == std::ssize(sides)) return edge_use::all;
    if (within > 0) return edge_use::junction;
    const std::array<aabb<double, 3>, 2> ends = {box_of(points[0]), box_of(points[1])};
    return space_->is_within_undecided(ends) ? edge_use::junction : edge_use::nothing;
}

std::vector<std::uint8_t> undecided_places::hidden(const arrange::surface_patches& patches) const {
    std::vector<std::uint8_t> result(patches.count(), 0);
    if (space_ == nullptr) return result;
    for_chunks(result.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t p = begin; p < end; ++p) {
            const std::uint32_t f = patches.first_face(static_cast<std::uint32_t>(p));
            result[p] =
                is_within_[f] == 0 && space_->leaves_undecided(corners_of(cut_.faces[f])) ? 1 : 0;
        }
    });
    return result;
}

}  // namespace treeform::detail::boolean
