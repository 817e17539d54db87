#pragma once
/// \file
/// How a long operation tells its caller where it is, and hears that it should stop.

#include <functional>

namespace treeform {

/// Called now and then with the share of the work done, in [0, 1] and never decreasing; returning
/// false asks the operation to stop, which it does after the items under way. May be empty. It is
/// called from one thread at a time, not always the same one, and must not throw.
using progress_callback = std::function<bool(double done)>;

}  // namespace treeform
