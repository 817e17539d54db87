#pragma once
/// \file
/// Made by tools/bindings: structs of C filled from those of C++, and options read.

#include <treeform/mesh/align.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/section.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/simplify.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/mesh/weld_options.hpp>
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/mesh/write.hpp>

#include <tools/c/handles.hpp>

namespace glue {

void fill(keeper& kept, const tf::certificate& from, treeform_certificate& to);
void fill(keeper& kept, const tf::rounding_effects& from, treeform_rounding& to);
void fill(keeper& kept, const tf::mass_properties& from, treeform_mass_properties& to);
void fill(keeper& kept, const tf::topology_counts& from, treeform_topology& to);
void fill(keeper& kept, const tf::mesh_defects& from, treeform_defects& to);
void fill(keeper& kept, const tf::mesh_feature& from, treeform_feature& to);
[[nodiscard]] tf::feature_options read(const treeform_feature_options* options);
[[nodiscard]] tf::feature_options read(const treeform_feature_options& o);
void fill(keeper& kept, const tf::intersection_result& from, treeform_pairs& to);
[[nodiscard]] tf::intersection_options read(const treeform_intersections_options* options);
[[nodiscard]] tf::intersection_options read(const treeform_intersections_options& o);
void fill(keeper& kept, const tf::intersection_region& from, treeform_region& to);
void fill(keeper& kept, const tf::curve_path& from, treeform_path& to);
void fill(keeper& kept, const tf::curve_network& from, treeform_paths& to);
[[nodiscard]] tf::stream_search_options read(const treeform_stream_search_options* options);
[[nodiscard]] tf::stream_search_options read(const treeform_stream_search_options& o);
void fill(keeper& kept, const tf::stream_search_result& from, treeform_stream_search_result& to);
[[nodiscard]] tf::boolean_options read(const treeform_boolean_options* options);
[[nodiscard]] tf::boolean_options read(const treeform_boolean_options& o);
void fill(keeper& kept, const tf::operand_volumes& from, treeform_volumes& to);
void fill(keeper& kept, const tf::boolean_result& from, treeform_boolean_result& to);
[[nodiscard]] tf::resolve_options read(const treeform_resolve_options* options);
[[nodiscard]] tf::resolve_options read(const treeform_resolve_options& o);
[[nodiscard]] tf::repair_options read(const treeform_repair_options* options);
[[nodiscard]] tf::repair_options read(const treeform_repair_options& o);
void fill(keeper& kept, const tf::repair_statistics& from, treeform_repair_statistics& to);
void fill(keeper& kept, const tf::repair_result& from, treeform_repair_result& to);
void fill(keeper& kept, const tf::repaired_file& from, treeform_repair_result& to);
void fill(keeper& kept, const tf::solid_defects& from, treeform_solid_defects& to);
void fill(keeper& kept, const tf::section_result& from, treeform_section_result& to);
[[nodiscard]] tf::cut_options read(const treeform_cut_options* options);
[[nodiscard]] tf::cut_options read(const treeform_cut_options& o);
void fill(keeper& kept, const tf::cut_piece& from, treeform_cut_piece& to);
void fill(keeper& kept, const tf::cut_result& from, treeform_cut_result& to);
void fill(keeper& kept, const tf::mesh_part& from, treeform_mesh_part& to);
[[nodiscard]] tf::offset_options read(const treeform_offset_options* options);
[[nodiscard]] tf::offset_options read(const treeform_offset_options& o);
void fill(keeper& kept, const tf::offset_result& from, treeform_offset_result& to);
[[nodiscard]] tf::simplify_options read(const treeform_simplify_options* options);
[[nodiscard]] tf::simplify_options read(const treeform_simplify_options& o);
void fill(keeper& kept, const tf::simplify_result& from, treeform_simplify_result& to);
void fill(keeper& kept, const tf::thickness_result& from, treeform_thickness_result& to);
void fill(keeper& kept, const tf::oriented_box& from, treeform_oriented_box& to);
void fill(keeper& kept, const tf::isolines_result& from, treeform_isolines_result& to);
[[nodiscard]] tf::measure_options read(const treeform_measure_options* options);
[[nodiscard]] tf::measure_options read(const treeform_measure_options& o);
void fill(keeper& kept, const tf::mesh_measure& from, treeform_relation& to);
[[nodiscard]] tf::deviation_options read(const treeform_deviation_options* options);
[[nodiscard]] tf::deviation_options read(const treeform_deviation_options& o);
void fill(keeper& kept, const tf::deviation_result& from, treeform_deviation_result& to);
void fill(keeper& kept, const tf::weld_condition& from, treeform_weld_condition& to);
[[nodiscard]] tf::weld_options read(const treeform_weld_options* options);
[[nodiscard]] tf::weld_options read(const treeform_weld_options& o);
void fill(keeper& kept, const tf::weld_result& from, treeform_weld_result& to);
void fill(keeper& kept, const tf::file_weld_result& from, treeform_weld_result& to);
[[nodiscard]] tf::weld_stream_options read(const treeform_weld_stream_options* options);
[[nodiscard]] tf::weld_stream_options read(const treeform_weld_stream_options& o);
void fill(keeper& kept, const tf::weld_stream_result& from, treeform_weld_stream_result& to);
[[nodiscard]] tf::placement_options read(const treeform_place_options* options);
[[nodiscard]] tf::placement_options read(const treeform_place_options& o);
void fill(keeper& kept, const tf::placement_contact& from, treeform_contact& to);
void fill(keeper& kept, const tf::placement& from, treeform_placement& to);
void fill(keeper& kept, const tf::impact& from, treeform_impact& to);
[[nodiscard]] tf::impact_options read(const treeform_impact_options* options);
[[nodiscard]] tf::impact_options read(const treeform_impact_options& o);
[[nodiscard]] tf::lay_flat_options read(const treeform_lay_flat_options* options);
[[nodiscard]] tf::lay_flat_options read(const treeform_lay_flat_options& o);
void fill(keeper& kept, const tf::laid_flat& from, treeform_laid_flat& to);
[[nodiscard]] tf::pack_options read(const treeform_pack_options* options);
[[nodiscard]] tf::pack_options read(const treeform_pack_options& o);
void fill(keeper& kept, const tf::packed_part& from, treeform_packed_part& to);
void fill(keeper& kept, const tf::packing& from, treeform_packing& to);
[[nodiscard]] tf::align_options read(const treeform_align_options* options);
[[nodiscard]] tf::align_options read(const treeform_align_options& o);
void fill(keeper& kept, const tf::align_result& from, treeform_align_result& to);
[[nodiscard]] tf::clash_options read(const treeform_clash_options* options);
[[nodiscard]] tf::clash_options read(const treeform_clash_options& o);
void fill(keeper& kept, const tf::contact_region& from, treeform_contact_region& to);
void fill(keeper& kept, const tf::part_clash& from, treeform_part_clash& to);
void fill(keeper& kept, const tf::clash_result& from, treeform_clashes& to);
void fill(keeper& kept, const tf::io_warning& from, treeform_warning& to);
void fill(keeper& kept, const tf::column& from, treeform_column& to);
void fill(keeper& kept, const tf::element& from, treeform_rows& to);
void fill(keeper& kept, const tf::part& from, treeform_named_faces& to);
void fill(keeper& kept, const tf::mesh_file& from, treeform_file_view& to);
[[nodiscard]] tf::read_options read(const treeform_read_options* options);
[[nodiscard]] tf::read_options read(const treeform_read_options& o);
[[nodiscard]] tf::write_options read(const treeform_write_options* options);
[[nodiscard]] tf::write_options read(const treeform_write_options& o);
void fill(keeper& kept, const tf::write_result& from, treeform_written& to);
[[nodiscard]] tf::part_options read(const treeform_part_options* options);
[[nodiscard]] tf::part_options read(const treeform_part_options& o);
void fill(keeper& kept, const tf::usable_mesh& from, treeform_part& to);
void fill(keeper& kept, const tf::urdf_joint& from, treeform_robot_joint& to);
void fill(keeper& kept, const tf::urdf_mesh& from, treeform_robot_mesh& to);
void fill(keeper& kept, const tf::urdf_robot& from, treeform_robot_view& to);
void fill(keeper& kept, const std::vector<tf::mesh_feature>& from, treeform_features& to);
void fill(keeper& kept, const std::vector<tf::mesh_part>& from, treeform_mesh_parts& to);
void fill(keeper& kept, const std::vector<tf::intersection_region>& from, treeform_regions& to);
void fill(keeper& kept, const std::vector<std::uint32_t>& from, treeform_indices& to);
void fill(keeper& kept, const std::vector<double>& from, treeform_heights& to);
void fill(keeper& kept, const std::vector<std::string>& from, treeform_strings& to);

}  // namespace glue
