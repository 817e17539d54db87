#pragma once
/// \file
/// Which faces penetrate, touch or are nearer than the clearance, and the colours that show it.

#include "tools/tf-place/move.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tools {

/// By triangle of a file: 0 none, 1 penetrating, 2 touching, 3 closer than the clearance.
using face_classes = std::vector<std::uint8_t>;

/// "#rrggbb" of each class: grey, red, yellow, cyan.
inline constexpr std::array<const char*, 4> class_colors{"#b4bac2", "#e02020", "#ecd000",
                                                         "#00a0c0"};

struct all_classes {
    face_classes moving{};
    std::vector<face_classes> fixed{};  ///< by file
};

/// For MOVING where it is, and what it meets.
[[nodiscard]] all_classes classify_faces(body& moving, const surroundings& among, double clearance);

/// Gives the faces of `file` these colours, and the property tf_class. \pre no polygons in it
void set_class_colors(tf::mesh_file& file, const face_classes& classes);

}  // namespace tools
