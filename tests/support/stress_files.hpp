#pragma once
/// \file
/// The families of hard meshes as files, so that other programs can be tried on them.

#include <support/stress_families.hpp>

#include <cstddef>
#include <filesystem>
#include <span>

namespace treeform::test {

/// Writes FAMILY-SIZE-PLACEMENT-PRECISION.ply (binary) into `folder` for every family given (all of
/// them when none is), at sizes of 10^2 faces to `most_faces` by factors of ten, in every named
/// placement, with double and with float coordinates; and index.csv, a line a file:
/// file,family,placement,precision,points,faces. Where coordinates would be beyond the range of the
/// precision, that file is left out.
/// The same bytes each time.
///
/// \throws io_error, std::filesystem::filesystem_error when something cannot be written
/// \returns the number of meshes written
std::size_t write_stress_files(const std::filesystem::path& folder,
                               std::span<const stress_family> families, std::size_t most_faces);

}  // namespace treeform::test
