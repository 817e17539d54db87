#pragma once
/// \file
/// Faces that rounding has folded, in words.

#include "tools/common/run.hpp"
#include <treeform/mesh/rounding.hpp>
#include <treeform/tf.hpp>

namespace tools {

/// Says so if there are any. `to_single`: they were rounded to float32.
void warn_of_folds(job& work, const tf::rounding_defects& harm, bool to_single);

}  // namespace tools
