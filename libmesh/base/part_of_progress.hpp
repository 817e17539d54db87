#pragma once
/// \file
/// Maps the progress of a step to the progress of the whole.

#include <treeform/tree/parallel.hpp>

namespace treeform::detail::base {

/// The callback for a step that covers the share from `begin` to `end` of the work of `callback`,
/// which must outlive it.
[[nodiscard]] inline progress_callback part_of(const progress_callback& callback, double begin,
                                               double end) {
    if (!callback) return {};
    return [&callback, begin, end](double done) { return callback(begin + (end - begin) * done); };
}

}  // namespace treeform::detail::base
