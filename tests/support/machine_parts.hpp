#pragma once
/// \file
/// Large solids as machines have them, turned so that no coordinate is a round number: their faces
/// are long and thin, pass through each other, and lie on each other except for rounding.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <support/random.hpp>

#include <cstddef>
#include <vector>

namespace test {

/// Two toothed wheels of `faces` faces each, side by side so that their teeth overlap. Their walls
/// are as high as the wheel, their lids fans around one point; some points of a rim lie before the
/// one they follow, so that each wheel passes through itself. Closed.
[[nodiscard]] std::vector<tf::mesh> gears(random& source, std::size_t faces);

/// `shells` closed beams and pins that overlap, in one mesh of about `faces` faces. Each is turned
/// against the others by 1e-5 to 1e-9, or not at all.
[[nodiscard]] tf::mesh gantry(random& source, std::size_t shells, std::size_t faces);

}  // namespace test
