#pragma once
/// \file
/// How files are written, and what was.

#include <treeform/mesh/write.hpp>

#include <tools/c/glue.hpp>

namespace glue {

[[nodiscard]] tf::write_options write_options_of(const treeform_write_options* options);
/// Nothing where `out` is null.
void give_written(tf::write_result from, treeform_written** out);

}  // namespace glue
