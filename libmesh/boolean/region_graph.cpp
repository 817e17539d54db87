#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/region_graph.hpp>

#include <limits>
#include <utility>

namespace treeform::detail::boolean {
namespace {

constexpr std::uint32_t no_patch = std::numeric_limits<std::uint32_t>::max();

constexpr std::uint8_t known = 2;  // a region has been entered; plus 1 where it is inside

}  // namespace

region_graph::region_graph(const mesh_arrangement& cut,
                           std::span<const std::uint32_t> operand_of_face,
                           const arrange::surface_patches& patches, arrange::numbered_sets regions)
    : cut_(cut),
      operand_of_face_(operand_of_face),
      patches_(patches),
      region_(std::move(regions)),
      around_(region_, patches.count()) {}

buffer<std::uint32_t> region_graph::groups() const {
    base::union_find linked(size());
    for (std::uint32_t p = 0; p < patches_.count(); ++p)
        linked.join(around_.front(p), around_.behind(p));
    return linked.take_roots();
}

/// Adds what crossing a patch changes on the way out of a region.
void region_graph::cross(std::uint32_t patch, std::uint32_t from, partial_expression& state) const {
    const int way = around_.front(patch) == from ? 1 : -1;
    for (const covering_face& cover : cut_.covers_of(patches_.first_face(patch)))
        state.add(operand_of_face_[cover.face], winding_range::only(cover.opposite ? -way : way));
}

void region_graph::spread(const region_seed& from, partial_expression& state,
                          std::vector<std::uint8_t>& inside) const {
    struct step {
        std::uint32_t region;
        std::uint32_t patch;  ///< across which it was entered
        std::size_t next;     ///< of its patches
    };
    std::vector<std::uint32_t> seen;
    const auto enter = [&](std::uint32_t region) {
        seen.push_back(region);
        inside[region] = static_cast<std::uint8_t>(known + (*state.value() ? 1 : 0));
    };
    for (const auto& [operand, winding] : from.windings)
        state.add(operand, winding_range::only(winding));
    std::vector<step> way{{from.region, no_patch, 0}};
    enter(from.region);
    while (!way.empty()) {
        const std::uint32_t region = way.back().region;
        const auto patches = around_.around(region);
        if (way.back().next < patches.size()) {
            const std::uint32_t p = patches[way.back().next++];
            const std::uint32_t next = around_.beyond(p, region);
            if (inside[next] >= known) continue;
            cross(p, region, state);
            enter(next);
            way.push_back({next, p, 0});
        } else {
            const std::uint32_t entered = way.back().patch;
            way.pop_back();
            if (entered != no_patch) cross(entered, region, state);
        }
    }
    for (const auto& [operand, winding] : from.windings)
        state.add(operand, winding_range::only(-winding));
    for (const std::uint32_t region : seen)
        inside[region] = static_cast<std::uint8_t>(inside[region] - known);
}

}  // namespace treeform::detail::boolean
