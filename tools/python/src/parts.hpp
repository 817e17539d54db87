#pragma once
/// \file
/// Parts of results that look other than in C++.

#include "made/made.hpp"
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/weld_stream.hpp>

namespace binding {

py::object volumes_of(const tf::boolean_result& from);
py::object contacts_of(const tf::placement& at);
py::list regions_of(tf::part_clash& from);
py::list warnings_of(const tf::weld_stream_result& from);

}  // namespace binding
