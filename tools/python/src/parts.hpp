#pragma once
/// \file
/// Parts of results that look other than in C++.

#include "made/made.hpp"

namespace binding {

py::object volumes_of(const tf::boolean_result& from);
py::object contacts_of(const tf::placement& at);
py::array ends_of(const std::vector<tf::open_edge>& open);
py::list regions_of(tf::part_clash& from);
/// What is said in warnings.
py::list texts_of(const std::vector<tf::io_warning>& warnings);
py::array faces_in_file(const tf::usable_mesh& part);
/// What a welded mesh has, of what it had; None without.
py::object with_attributes(const file_data* data, tf::attributes&& attributes);

/// A cloud is no solid, not even the empty one.
inline void require_faces(const held_mesh& mesh, const std::string& name) {
    const auto [points, faces] = mesh.view();
    if (!points.empty() && faces.empty())
        throw std::invalid_argument(name + ": " + std::to_string(points.size()) +
                                    " points without a face are no solid");
}

void require_faces(const held_meshes& meshes, const std::vector<std::string>& names);
/// What is made of so many operands: by name, or by a formula in letters or names.
tf::boolean_expression expression_of(const std::string& operation, const std::string& formula,
                                     const std::vector<std::string>& names, std::size_t count);

std::vector<tf::face_pair> pairs_of(const ids_array& pairs, const array_of<std::uint8_t>& kinds);
/// The regions, and that of each pair.
py::object object(of_result, tf::intersection_regions&& from);
/// Points, and paths by their numbers.
py::object object(of_result, tf::curve_network&& from);

/// The pieces, the certificate of all, and whether the mesh was resolved.
py::object object(of_result, tf::cut_result&& from, const carrying& attributes);
/// As columns: of layers, of loops, of points.
py::object object(of_result, tf::section_result&& from);
/// The counts, as a pair.
py::object object(of_result, tf::rounding_effects&& from);

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
