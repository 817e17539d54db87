#pragma once
/// \file
/// Made by tools/bindings of the headers of C++.

#include "../words.hpp"

namespace binding {

template <>
struct words_of<tf::align_end> {
    static constexpr words<4> all{"converged", "out_of_iterations", "doubtful", "nothing_to_align"};
};
template <>
struct words_of<tf::align_method> {
    static constexpr words<4> all{"point_to_plane", "point_to_point", "automatic",
                                  "plane_to_plane"};
};
template <>
struct words_of<tf::column_role> {
    static constexpr words<6> all{"data", "x", "y", "z", "corners", "texture"};
};
template <>
struct words_of<tf::feature> {
    static constexpr words<7> all{"v0", "v1", "v2", "e0", "e1", "e2", "interior"};
};
template <>
struct words_of<tf::feature_kind> {
    static constexpr words<2> all{"plane", "axis"};
};
template <>
struct words_of<tf::fill_rule> {
    static constexpr words<3> all{"nonzero", "odd", "positive"};
};
template <>
struct words_of<tf::location> {
    static constexpr words<3> all{"outside", "inside", "boundary"};
};
template <>
struct words_of<tf::mesh_relation> {
    static constexpr words<5> all{"separate", "touching", "penetrating", "closer_than_clearance",
                                  "clear"};
};
template <>
struct words_of<tf::node_order> {
    static constexpr words<3> all{"depth_first", "top_k_sorted", "best_first"};
};
template <>
struct words_of<tf::pair_kind> {
    static constexpr words<7> all{"crossing", "overlap",  "fold",      "duplicate",
                                  "pierce",   "touching", "degenerate"};
};
template <>
struct words_of<tf::placement_end> {
    static constexpr words<14> all{"contact",
                                   "bed",
                                   "unchanged",
                                   "moved_apart",
                                   "nothing_met",
                                   "too_far",
                                   "starts_penetrating",
                                   "starts_too_near",
                                   "starts_touching",
                                   "starts_below_bed",
                                   "not_representable",
                                   "too_many_steps",
                                   "out_of_range",
                                   "cancelled"};
};
template <>
struct words_of<tf::precision> {
    static constexpr words<2> all{"float32", "float64"};
};
template <>
struct words_of<tf::resolve_mode> {
    static constexpr words<3> all{"split", "outer", "remove"};
};
template <>
struct words_of<tf::scalar_type> {
    static constexpr words<10> all{"int8",   "uint8", "int16",  "uint16",  "int32",
                                   "uint32", "int64", "uint64", "float32", "float64"};
};
template <>
struct words_of<tf::status> {
    static constexpr words<10> all{"ok",           "open_input",    "sheet",    "excessive_loss",
                                   "not_manifold", "not_certified", "vanished", "out_of_range",
                                   "no_placement", "cancelled"};
};
template <>
struct words_of<tf::thickness_by> {
    static constexpr words<2> all{"ray", "sphere"};
};
template <>
struct words_of<tf::urdf_joint_kind> {
    static constexpr words<4> all{"fixed", "revolute", "continuous", "prismatic"};
};
template <>
struct words_of<tf::vertex_identity> {
    static constexpr words<2> all{"by_coordinates", "by_index"};
};
template <>
struct words_of<tf::weld_keep> {
    static constexpr words<5> all{"first", "last", "mean", "lowest", "highest"};
};

}  // namespace binding
