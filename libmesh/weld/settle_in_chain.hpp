#pragma once
/// \file
/// The result of a tile for a point, with the rule `chain`.

#include <libmesh/weld/tile_weld.hpp>

#include <cstdint>

namespace treeform::detail::weld {

/// The component of a point inside a tile.
struct chain_component {
    std::uint64_t lowest;  ///< its lowest point number
    point3 at;             ///< coordinates of that point
    bool elsewhere;        ///< some of its points are also in other tiles
};

inline void settle_in_chain(const tile_point& p, const chain_component& c, tile_result& out) {
    if (p.role() != tile_role::halo) {
        if (p.id() != c.lowest) out.dropped.push_back({p.id(), c.lowest});
        if (c.elsewhere)
            out.members.push_back({p.at, c.lowest, c.at});
        else
            out.move.consider(p.at, c.at);
    }
    if (p.role() == tile_role::own) return;
    border_point link = border_point::make(p.id(), border_kind::link);
    link.at = p.at;
    link.leader = c.lowest;
    link.leader_at = c.at;
    out.border.push_back(link);
}

}  // namespace treeform::detail::weld
