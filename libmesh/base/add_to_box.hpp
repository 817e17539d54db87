#pragma once
/// \file
/// Grows bounding boxes.

#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace treeform::detail::base {

/// Extends `box` to the smallest box around both; an empty box adds nothing.
inline void add_to_box(std::optional<box3>& box, const std::optional<box3>& more) {
    if (!box || !more) {
        if (more) box = more;
        return;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        box->min[k] = std::min(box->min[k], more->min[k]);
        box->max[k] = std::max(box->max[k], more->max[k]);
    }
}

}  // namespace treeform::detail::base
