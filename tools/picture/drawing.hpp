#pragma once
/// \file
/// A scene in the pixels of one view, and its tree: what stands where.

#include "tools/picture/canvas.hpp"
#include "tools/picture/scene.hpp"
#include "tools/picture/view.hpp"
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tools {

/// Of what lies within the band of the map.
inline constexpr rgb in_band{0x7f, 0xc9, 0x7f};

/// Where a view is in the picture, and how large: pixels a share of the scene's longest side.
struct pane {
    area box{};
    view from = view::iso;
    std::string variant{};
    double scale = 1.0;
    std::array<double, 2> middle{};  ///< shown in the middle of the box; to the right and up
};

/// Down and to the right in samples, two a pixel each way; z toward the eye, as long.
struct sample_point {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

/// A segment of some width, or a dot where its ends are one.
struct drawn_stroke {
    std::array<sample_point, 2> ends{};
    double reach = 0.0;  ///< half its width, in samples
    rgb color{};
    bool round = false;    ///< a ball, darker at its rim
    bool context = false;  ///< hides and is hidden; what was found shines through
};

/// What faces of one mesh have in common.
struct drawn_mesh {
    const scene_mesh* source = nullptr;
    std::uint32_t first_face = 0;   ///< in `drawing::corners`
    std::uint32_t first_point = 0;  ///< in `drawing::points`
};

struct drawn_label {
    sample_point at{};
    std::string text{};
    rgb color{};
};

/// Primitives by number: first all faces, then all strokes.
struct drawing {
    const scene* source = nullptr;
    std::vector<rgb> colors{};  ///< of classes
    std::vector<rgb> ramp{};    ///< of the map, from low to high
    std::vector<drawn_mesh> meshes{};
    std::vector<sample_point> points{};
    std::vector<std::array<std::uint32_t, 3>> corners{};
    std::vector<std::uint32_t> face{};  ///< its number in its mesh
    std::vector<std::uint8_t> kind{};   ///< [F] its class
    std::vector<drawn_stroke> strokes{};
    std::vector<drawn_label> labels{};
    tf::tree<2> tree{};

    [[nodiscard]] const drawn_mesh& mesh_of(std::uint32_t face_number) const;
    [[nodiscard]] std::array<sample_point, 3> triangle(std::uint32_t face_number) const {
        const auto& c = corners[face_number];
        return {points[c[0]], points[c[1]], points[c[2]]};
    }
    [[nodiscard]] bool is_finding(std::uint32_t face_number) const;
    /// Of a place on the map; none without one, or where the value is NaN.
    [[nodiscard]] std::optional<rgb> mapped(double value) const;
};

/// \cost O(V + F log F)
[[nodiscard]] drawing make_drawing(const scene& shown, const tf::box3& all, const pane& at);

/// Paints what `drawn` has within `box` of the picture: four samples a pixel, each with the surface
/// that is nearest to the eye, lit softly, with its contours. What was found shines faintly through
/// what hides it, and places too small to be seen have a halo.
///
/// Each sample asks which primitives it lies in; what is nearest wins, and of equals the lowest
/// number. Tiles ask the tree for theirs, and do not depend on each other.
///
/// \cost O(F + S D) for S samples and D surfaces behind each other
/// \same on any number of threads, and on any machine with IEEE arithmetic
void paint(picture& on, const drawing& drawn, const area& box);

}  // namespace tools
