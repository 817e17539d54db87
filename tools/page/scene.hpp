#pragma once
/// \file
/// A mesh packed for the 3D view of a page. For looking at only: points are moved to a fine grid,
/// and where there are too many faces the plain ones are thinned out.

#include <treeform/mesh/curves.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tools {

struct scene_input {
    tf::mesh_view mesh{};                    ///< all coordinates finite
    std::span<const std::uint8_t> kind{};    ///< [F] 0: plain; others get a color of their own
    std::span<const std::int32_t> region{};  ///< [F] of the faces that are not plain
    std::vector<std::uint32_t> number{};     ///< [F] shown when a face is clicked
    std::span<const tf::curve_segment> curves{};
};

struct scene_limits {
    std::size_t plain = 200'000;   ///< faces
    std::size_t marked = 50'000;   ///< faces; those beyond are left out, highest regions first
    std::size_t curves = 100'000;  ///< segments
};

struct packed_scene {
    std::string geometry;                 ///< base64
    tf::point3 low;                       ///< corner of the box
    std::array<std::uint32_t, 3> size{};  ///< of the box, in steps
    std::uint32_t steps = 1;              ///< of the longest side
    double step = 1.0;                    ///< length of a step in the unit of the file
    std::size_t points = 0;
    std::size_t faces = 0;
    std::size_t segments = 0;
    std::size_t plain_left_out = 0;
    std::size_t marked_left_out = 0;
    std::size_t segments_left_out = 0;
};

/// \cost O(V + F) time
[[nodiscard]] packed_scene pack(const scene_input& input, const scene_limits& limits = {});

}  // namespace tools
