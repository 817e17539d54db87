#pragma once
/// \file
/// What a picture shows of a scene; where one looks from, and where things are then.

#include "tools/picture/scene.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tools {

/// Views are parallel: lengths across are true to one scale, and what is near hides what is far.
enum class view : std::uint8_t { iso, top, bottom, front, back, left, right };
inline constexpr std::array<const char*, 7> view_names{"iso",  "top",  "bottom", "front",
                                                       "back", "left", "right"};

/// What a picture may measure on a side.
inline constexpr std::size_t least_side = 16;
inline constexpr std::size_t most_side = 16384;

struct picture_options {
    std::size_t width = 1600;
    std::size_t height = 1200;
    std::vector<view> views{view::iso};  ///< one or more, each a pane; before and after: two each
};

/// Points to the right, up and toward the eye, in shares of the scene's longest side: neither
/// huge nor tiny coordinates overflow. Points that are not finite give what is not.
class eye {
  public:
    eye(view from, bool y_is_up, const tf::box3& scene_box);
    [[nodiscard]] std::array<double, 3> operator()(const tf::point3& p) const;
    /// Of a direction, as it is.
    [[nodiscard]] std::array<double, 3> turned(const tf::point3& direction) const;

  private:
    std::array<std::array<double, 3>, 3> rows_{};
    tf::point3 low_{};
    double quarter_ = 1.0;  ///< of the longest side
};

/// What to fit into the picture: all, unless that is so thin, as with two long rods, that it would
/// be lines; then what was found, with some of what is around it.
[[nodiscard]] tf::box3 box_that_matters(const scene& shown, const tf::box3& all);

/// Whether an item's class is shown, and of what sort it is.
[[nodiscard]] inline const scene_class& class_of(const scene& shown,
                                                 const std::vector<std::uint8_t>& kind,
                                                 std::size_t at) {
    return shown.classes[kind[kind.size() == 1 ? 0 : at]];
}

}  // namespace tools
