#pragma once
/// \file
/// Options that are shares or distances.

#include <cmath>
#include <stdexcept>
#include <string>

namespace treeform::detail::base {

/// \throws std::invalid_argument naming the `function` called and `what` is negative or not finite
inline void require_share(const char* function, double value, const char* what) {
    if (!(value >= 0.0) || !std::isfinite(value))
        throw std::invalid_argument("treeform::" + std::string(function) + ": " + what +
                                    " is negative or not finite");
}

/// \throws std::invalid_argument likewise, naming what is negative or NaN; infinity is no limit
inline void require_limit(const char* function, double value, const char* what) {
    if (!(value >= 0.0))
        throw std::invalid_argument("treeform::" + std::string(function) + ": " + what +
                                    " is negative or not a number");
}

}  // namespace treeform::detail::base
