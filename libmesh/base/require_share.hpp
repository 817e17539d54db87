#pragma once
/// \file
/// Checks options that are shares or distances.

#include <cmath>
#include <stdexcept>
#include <string>

namespace treeform::detail::base {

/// \throws std::invalid_argument naming the called `function`, and `what` if it is negative or not
///         finite
inline void require_share(const char* function, double value, const char* what) {
    if (!(value >= 0.0) || !std::isfinite(value))
        throw std::invalid_argument("treeform::" + std::string(function) + ": " + what +
                                    " is negative or not finite");
}

/// \throws std::invalid_argument naming `function` and `what` if `value` is negative or NaN;
///         infinity means no limit
inline void require_limit(const char* function, double value, const char* what) {
    if (!(value >= 0.0))
        throw std::invalid_argument("treeform::" + std::string(function) + ": " + what +
                                    " is negative or not a number");
}

}  // namespace treeform::detail::base
