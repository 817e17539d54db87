#pragma once
/// \file
/// Dirt of every kind that real meshes have, put on clean solids, and what a repair may change.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <support/random.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace test {

enum class dirt_kind : std::uint8_t {
    missing,     ///< faces here and there are not there
    hole,        ///< a disk of faces is not there
    flipped,     ///< faces here and there are turned
    cracks,      ///< every face has corners of its own, moved a little
    seam,        ///< along a plane, the faces of one side have points of their own, moved a little
    strays,      ///< small triangles in the middle of nowhere
    inner,       ///< triangles from edges of the solid to other points of it
    bottomless,  ///< a box without a bottom stands in the solid
    inverted,    ///< all faces are turned
    junctions,   ///< edges that only one of their faces has cut
    overlap,     ///< the solid is there twice, moved
    copies,      ///< faces are there twice
    zero_area,   ///< faces without area, on edges and in them
    unjoined     ///< faces have corners of their own
};
inline constexpr std::size_t dirt_kinds = 14;
inline constexpr std::size_t dirt_sizes = 3;

[[nodiscard]] std::string_view name_of(dirt_kind kind);

struct dirty_mesh {
    tf::mesh mesh{};
    /// Faces that the dirt did not touch, as they are to come back.
    std::vector<std::array<tf::point3, 3>> untouched{};
    /// How far the dirt is from the clean surface; where it has none, that of a rounding.
    double size = 0.0;
    /// By how much the volume may change: a hole's area times its depth.
    double volume_change = 0.0;
    /// What is meant is the union of the clean solid and this one, if it has faces.
    tf::mesh added{};
};

/// \param clean a closed manifold of at least a hundred faces
/// \param size  0 to 2: few or small, more or larger, many or large
[[nodiscard]] dirty_mesh soil(const tf::mesh& clean, dirt_kind kind, std::size_t size,
                              random& source);

}  // namespace test
