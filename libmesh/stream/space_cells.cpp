#include <libmesh/stream/space_cells.hpp>

#include <algorithm>
#include <span>

namespace treeform::detail::stream {
namespace {

std::size_t longest_axis(points_view points) {
    const box3 box = *bounding_box(points);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (box.max[k] - box.min[k] > box.max[axis] - box.min[axis]) axis = k;
    return axis;
}

}  // namespace

space_cells::space_cells(std::vector<point3> sample, std::size_t count) {
    const auto split = [&](const auto& self, std::span<point3> points, std::size_t cells) -> void {
        const auto at = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        if (cells > 1 && points.size() > 1) {
            const std::size_t axis = longest_axis(points);
            const auto before = [axis](const point3& a, const point3& b) {
                return a[axis] < b[axis];
            };
            std::sort(points.begin(), points.end(), before);
            const std::size_t below = cells / 2;
            // Where most are at the low end, all the others are beyond the plane.
            const double wanted = points[points.size() * below / cells][axis];
            const auto is_below = [axis](const point3& p, double c) { return p[axis] < c; };
            const auto is_above = [axis](double c, const point3& p) { return c < p[axis]; };
            auto high = std::lower_bound(points.begin(), points.end(), wanted, is_below);
            if (high == points.begin())
                high = std::upper_bound(points.begin(), points.end(), wanted, is_above);
            const auto low = static_cast<std::size_t>(high - points.begin());
            if (low < points.size()) {
                const double cut = (*high)[axis];
                nodes_[at].axis = axis;
                nodes_[at].cut = cut;
                self(self, points.first(low), below);
                nodes_[at].high = static_cast<std::uint32_t>(nodes_.size());
                return self(self, points.subspan(low), cells - below);
            }
        }
        nodes_[at].cell = static_cast<std::uint32_t>(size_++);
    };
    split(split, sample, std::max<std::size_t>(count, 1));
}

space_cells::space_cells(state_reader& state) {
    for (std::uint64_t left = state.number(); left > 0 && state.whole(); --left) {
        nodes_.push_back({state.real(), static_cast<std::uint32_t>(state.number()),
                          static_cast<std::uint32_t>(state.number()), state.number()});
        size_ += nodes_.back().axis == no_axis ? 1 : 0;
    }
}

void space_cells::store(state_writer& state) const {
    state.number(nodes_.size());
    for (const node& n : nodes_) {
        state.real(n.cut);
        state.numbers(n.high, n.cell, n.axis);
    }
}

std::uint32_t space_cells::cell_of(const point3& p) const {
    std::uint32_t at = 0;
    while (nodes_[at].axis != no_axis)
        at = p[nodes_[at].axis] < nodes_[at].cut ? at + 1 : nodes_[at].high;
    return nodes_[at].cell;
}

}  // namespace treeform::detail::stream
