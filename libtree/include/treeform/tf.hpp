#pragma once
/// \file
/// The short name `tf` for the namespace `treeform`. No other header includes this one: `tf` is a
/// common name (ROS, Taskflow and TensorFlow use it, too), so programs must include it explicitly.

namespace treeform {}
namespace tf = treeform;
