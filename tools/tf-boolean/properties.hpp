#pragma once
/// \file
/// Properties of the inputs' points and faces, for the points and faces of the result.

#include "tools/tf-boolean/solids.hpp"
#include <libmesh/boolean/boolean.hpp>
#include <libmesh/io/mesh_file.hpp>

#include <vector>

namespace tools {

/// Gives `file`, which holds the surface of `result`, the columns that elements "vertex" and "face"
/// of the inputs have with one value a row, by name.
///
/// A face has the values of the face it lies in, a point those of the point it is; a point that was
/// cut has values between those of the corners of the face it lies in, of the lowest where there
/// are several. Where an input has no such column, 0 or NaN stands. Normals of points are left out:
/// what is subtracted turns around, and a cut has one on each side.
void carry_properties(tf::mesh_file& file, const std::vector<solid>& solids,
                      const tf::solid_result& result);

/// Whether an input has values that `carry_properties` leaves out.
[[nodiscard]] bool leaves_out_properties(const std::vector<solid>& solids);

}  // namespace tools
