#pragma once
/// \file
/// The progress of a step, as a part of that of the whole.

#include <treeform/tree/parallel.hpp>

namespace treeform::detail::base {

/// `callback` as it is called for a step that does the share from `begin` to `end` of the work. It
/// outlives the step.
[[nodiscard]] inline progress_callback part_of(const progress_callback& callback, double begin,
                                               double end) {
    if (!callback) return {};
    return [&callback, begin, end](double done) { return callback(begin + (end - begin) * done); };
}

}  // namespace treeform::detail::base
