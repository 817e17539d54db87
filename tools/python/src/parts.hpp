#pragma once
/// \file
/// Parts of results that look other than in C++.

#include "made/made.hpp"

namespace binding {

py::object volumes_of(const tf::boolean_result& from);
py::object contacts_of(const tf::placement& at);
py::list regions_of(tf::part_clash& from);
/// What is said in warnings.
py::list texts_of(const std::vector<tf::io_warning>& warnings);
py::array faces_in_file(const tf::usable_mesh& part);
/// What a welded mesh has, of what it had; None without.
py::object with_attributes(const file_data* data, tf::attributes&& attributes);

/// `of(pose, clash)` of all clashes, pose after pose.
template <class Of>
auto column_of_poses(const tf::pose_result& from, const Of& of) {
    std::vector<decltype(of(0U, tf::pose_clash{}))> values;
    for (std::uint32_t pose = 0; pose < from.poses.size(); ++pose)
        for (const tf::pose_clash& one : from.poses[pose]) values.push_back(of(pose, one));
    return column(values, [](const auto& value) { return value; });
}

py::list warnings_of(const tf::weld_stream_result& from);

}  // namespace binding
