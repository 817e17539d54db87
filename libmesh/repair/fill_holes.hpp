#pragma once
/// \file
/// Holes of a surface filled.

#include <libmesh/repair/open_rims.hpp>
#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::repair {

struct filled_hole {
    std::uint32_t first_face = 0;  ///< of what fills it, in the mesh
    std::uint32_t edges = 0;       ///< around it
};

struct filled_holes {
    std::uint64_t holes = 0;
    std::uint64_t edges = 0;   ///< around them
    std::uint64_t faces = 0;   ///< that fill them
    std::uint64_t sheets = 0;  ///< rims left, as those of sheets
    std::vector<filled_hole> all{};

    /// Those of which some of the faces are used, and how many these are.
    /// \param is_used [faces of the mesh]
    [[nodiscard]] filled_holes used(std::span<const std::uint8_t> is_used) const;
};

/// Whether to fill what then bounds little or nothing.
enum class sheets_too : std::uint8_t { no, yes };

/// Fills each hole of at most `largest` edges: `triangulate_rim`, or else a cone over the rim.
/// Large holes of smooth surfaces are refined and made fair. Unless asked for, sheets stay open: a
/// hole whose filling has more than 0.6 times the area of the part that it is in, unless the rim is
/// plane and the part lies to one side of that plane, as of a plate without its top. Afterwards,
/// faces run as often one way as the other along each edge of every rim filled.
///
/// What fills a hole may meet other faces: to cut it is the next step's.
filled_holes fill_holes(working_mesh& mesh, std::uint64_t largest, sheets_too sheets,
                        rim_edges rims = rim_edges::open);

}  // namespace treeform::detail::repair
