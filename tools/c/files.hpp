#pragma once
/// \file
/// How files are written, and what was.

#include <treeform/mesh/write.hpp>

#include <tools/c/glue.hpp>

#include <cstddef>
#include <vector>

namespace glue {

/// Null, and null among them, is an error that says `what`.
[[nodiscard]] std::vector<tf::named_column> columns_of(const treeform_named_column* columns,
                                                       std::size_t count, const char* what);
[[nodiscard]] tf::write_options write_options_of(const treeform_write_options* options);
/// Nothing where `out` is null.
void give_written(tf::write_result from, treeform_written** out);

}  // namespace glue
