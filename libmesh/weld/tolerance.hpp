#pragma once
/// \file
/// The check of a tolerance at the door.

#include <cmath>
#include <stdexcept>
#include <string>

namespace treeform::detail::weld {

/// \throws std::invalid_argument naming the function `called`
inline void check_tolerance(const char* called, double tolerance) {
    if (!(tolerance >= 0.0) || !std::isfinite(tolerance))
        throw std::invalid_argument(std::string("treeform::") + called +
                                    ": the tolerance must be finite and not negative");
}

}  // namespace treeform::detail::weld
