#pragma once
/// \file
/// Which faces penetrate, touch or are nearer than the clearance, and the colours that show it.

#include "tools/tf-place/move.hpp"
#include <treeform/tf.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace tools {

/// By triangle of a file, of a cloud by point: 0 none, 1 penetrating, 2 touching, 3 closer than the
/// clearance, or where MOVING stopped at it.
using face_classes = std::vector<std::uint8_t>;

/// "#rrggbb" of each class: grey, red, yellow, cyan.
inline constexpr std::array<const char*, 4> class_colors{"#b4bac2", "#e02020", "#ecd000",
                                                         "#00a0c0"};

struct all_classes {
    face_classes moving{};
    std::vector<face_classes> fixed{};  ///< by file
};

/// For MOVING at its place, and what it meets there. The contacts of the placement count, also
/// where rounding has left a gap.
[[nodiscard]] all_classes classify_faces(body& moving, const surroundings& among,
                                         const placement& p);

/// The gravest class of the triangles of each face as stored.
[[nodiscard]] face_classes by_stored_face(const tf::mesh_file& file, const face_classes& classes);

/// Gives the rows of an element of the file, "face" or "vertex", the property tf_class, and the
/// colours of their classes unless `keep_colors` and the file has some.
void set_classes(tf::mesh_file& file, const char* element, const face_classes& classes,
                 bool keep_colors);

}  // namespace tools
