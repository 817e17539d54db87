#pragma once
/// \file
/// Materials and colors of triangles as indices into lists, for formats that refer to them by
/// number.

#include <libmesh/io/writers.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace treeform::detail::io {

/// The list to which the corners of a triangle refer.
enum class look_list : std::uint8_t { none, materials, colors };

struct face_look {
    look_list list = look_list::none;
    face entries{};  ///< entry of each corner

    friend bool operator==(const face_look&, const face_look&) = default;
};

/// The materials of parts with the colors of their faces; else the colors of faces; else the colors
/// of points, one for each corner. If only some faces have a color, the others are white. Colors
/// are 0xRRGGBBAA.
class face_looks {
  public:
    explicit face_looks(const write_job& job);

    [[nodiscard]] const face_look& of(std::uint32_t triangle) const {
        return looks_.empty() ? none_ : looks_[triangle];
    }
    /// Names and colors of materials, in the order of first use.
    [[nodiscard]] const auto& materials() const { return materials_; }
    [[nodiscard]] const std::vector<std::uint32_t>& colors() const { return colors_; }
    /// Whether points have colors that are not used.
    [[nodiscard]] bool leaves_out_points() const { return leaves_out_points_; }
    /// Whether some color is not representable with 8 bits a channel.
    [[nodiscard]] bool rounds_colors() const { return rounds_colors_; }
    /// Whether the colors of materials are in files that were not read.
    [[nodiscard]] bool lacks_colors() const { return lacks_colors_; }

  private:
    [[nodiscard]] std::uint32_t color_entry(std::uint32_t color);
    [[nodiscard]] std::uint32_t material_entry(const std::string& name, std::uint32_t color);

    face_look none_{};
    std::vector<face_look> looks_{};
    std::vector<std::pair<std::string, std::uint32_t>> materials_{};
    std::vector<std::uint32_t> colors_{};
    std::map<std::pair<std::string, std::uint32_t>, std::uint32_t> number_of_material_{};
    std::map<std::uint32_t, std::uint32_t> number_of_color_{};
    bool leaves_out_points_ = false;
    bool rounds_colors_ = false;
    bool lacks_colors_ = false;
};

}  // namespace treeform::detail::io
