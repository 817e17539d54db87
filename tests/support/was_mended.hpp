#pragma once
/// \file
/// Whether rounding has made faces meet.

#include <treeform/mesh/boolean.hpp>

namespace test {

[[nodiscard]] inline bool was_mended(const treeform::boolean_statistics& did) {
    return did.rounding_repairs > 0 || did.rounding_rounds > 0;
}

}  // namespace test
