#pragma once
/// \file
/// Made by tools/bindings of the headers of C++.

#include "../fields.hpp"

namespace binding {

py::object object(of_result, tf::certificate&& from);
py::object object(of_result, tf::boolean_result&& from, const carrying& attributes);
py::object object(of_result, tf::section_loop&& from, const tf::section_result& whole);
py::object object(of_result, tf::section_result&& from);
py::object object(of_result, tf::cut_piece&& from, const carrying& attributes);
py::object object(of_result, tf::mesh_part&& from, const carrying& attributes);
py::object object(of_result, tf::mass_properties&& from);
py::object object(of_result, tf::offset_result&& from);
py::object object(of_result, tf::simplify_result&& from, const carrying& attributes);
py::object object(of_result, tf::thickness_result&& from);
py::object object(of_result, tf::oriented_box&& from);
py::object object(of_result, tf::isoline&& from);
py::object object(of_result, tf::isolines_result&& from);
py::object object(of_result, tf::repair_result&& from, const carrying& attributes);
py::object object(of_result, tf::convex_hull_result&& from);
py::object object(of_result, tf::solid_defects&& from);
py::object object(of_result, tf::mesh_defects&& from);
py::object object(of_result, tf::topology_counts&& from);
py::object object(of_result, tf::mesh_feature&& from);
py::object object(of_result, tf::intersection_result&& from);
py::object object(of_result, tf::intersection_region&& from);
py::object object(of_result, tf::stream_search_result&& from);
py::object object(of_result, tf::write_result&& from);
py::object object(of_result, tf::urdf_joint&& from, const tf::urdf_robot& robot);
py::object object(of_result, tf::urdf_robot&& from, std::vector<tf::urdf_mesh>& parts);
py::object object(of_result, tf::weld_result&& from, const file_data* data);
py::object object(of_result, tf::weld_stream_result&& from);
py::object object(of_result, tf::deviation_result&& from);
py::object object(of_result, tf::closest_points_result&& from);
py::object object(of_result, std::vector<std::optional<tf::closest_point_result>>&& from);
py::object object(of_result, std::vector<std::optional<tf::mesh_hit>>&& from);
py::object object(of_result, std::vector<tf::placement_contact>&& from);
py::object object(of_result, tf::search_effort&& from);
py::object object(of_result, tf::mesh_measure&& from);
py::object object(of_result, tf::placement&& from, const held_mesh& moving);
py::object object(of_result, tf::impact&& from);
py::object object(of_result, tf::penetration_depth_result&& from);
py::object object(of_result, tf::laid_flat&& from, const held_mesh& moving);
py::object object(of_result, tf::align_result&& from, const held_mesh& moving);
py::object object(of_result, tf::packed_part&& from, const held_mesh& moving);
py::object object(of_result, tf::packing&& from, const held_meshes& parts);
py::object object(of_result, tf::part_clash&& from);
py::object object(of_result, tf::pose_result&& from);
py::object object(of_result, tf::clash_result&& from);

py::dict counters(const tf::boolean_statistics& from);
py::dict counters(const tf::repair_statistics& from);
py::dict counters(const tf::weld_statistics& from);

}  // namespace binding
