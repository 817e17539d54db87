#pragma once
/// \file
/// Fills the holes of a surface.

#include <libmesh/repair/open_rims.hpp>
#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::repair {

struct filled_hole {
    std::uint32_t first_face = 0;  ///< number of the first face that fills it
    std::uint32_t edges = 0;       ///< number of edges around it
};

struct filled_holes {
    std::uint64_t holes = 0;
    std::uint64_t edges = 0;   ///< edges around them
    std::uint64_t faces = 0;   ///< faces that fill them
    std::uint64_t sheets = 0;  ///< rims not filled, since they belong to sheets
    std::vector<filled_hole> all{};

    /// The holes of which some faces are used, with the number of these.
    /// \param is_used [faces of the mesh]
    [[nodiscard]] filled_holes used(std::span<const std::uint8_t> is_used) const;
};

/// Whether to fill sheets, which then bound little or nothing.
enum class sheets_too : std::uint8_t { no, yes };

/// Fills each hole of at most `largest` edges: `triangulate_rim`, or else a cone over the rim.
/// Large holes of smooth surfaces are refined and made fair. Unless requested, sheets stay open: a
/// hole is not filled if its filling has more than 0.6 times the area of its part, unless the rim
/// is planar and the part lies on one side of its plane, as for a plate without its top.
/// Afterwards, the signed face count of every edge of a filled rim is zero.
///
/// A filling may meet other faces, which the next step cuts.
filled_holes fill_holes(working_mesh& mesh, std::uint64_t largest, sheets_too sheets,
                        rim_edges rims = rim_edges::open);

}  // namespace treeform::detail::repair
