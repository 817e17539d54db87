#pragma once
/// \file
/// Welding in C.

#include <treeform/mesh/weld.hpp>

#include <tools/c/made/structs.hpp>

namespace glue {

inline treeform_code give(tf::file_weld_result&& welded, treeform_weld_result** out) {
    check(welded.status);
    give_file(std::move(welded), out);
    return TREEFORM_OK;
}

/// Welds a file, with its attributes, parts and names.
inline tf::file_weld_result weld_file(const tf::mesh_file& file, const tf::weld_options& options) {
    return tf::weld(file, options);
}

/// Only the groups of the points of a mesh or cloud; `mesh` of the result is empty.
inline tf::weld_result group_points(tf::mesh_view mesh, const tf::weld_options& options) {
    tf::weld_result groups;
    groups.groups = tf::group_points(mesh.points, options);
    check(groups.groups.status);
    return groups;
}

/// How many points of a welded file would be merged if it were written with this precision, read
/// and welded again; `known` is 0 if options keep points apart on purpose.
inline void count_mergeable(const tf::mesh_file& welded, const tf::weld_options& options,
                            tf::precision written_as, std::uint64_t* count, std::int32_t* known) {
    (void)need(count, "count");
    (void)need(known, "known");
    const auto found = tf::count_mergeable(welded, options, written_as);
    *count = found.value_or(0);
    *known = found.has_value();
}

/// Sets the flag "withheld" of LAS at the points of `file` that its weld result `welded` does not
/// keep.
inline void withhold(tf::mesh_file& file, const treeform_weld_result* welded) {
    const treeform_weld_result& w = need(welded, "welded");
    const auto copied = [](const std::uint32_t* data, std::size_t count) {
        return copied_as<std::uint32_t>(data, count, "the groups of a weld");
    };
    tf::file_weld_result from;
    from.groups.group_of_point = copied(w.group_of_point, w.point_count);
    from.groups.first_of_group = copied(w.first_of_group, w.group_count);
    from.vertex_source = copied(w.vertex_source, w.group_count);
    for (const std::uint32_t group : from.groups.group_of_point)
        if (group >= w.group_count)
            throw std::invalid_argument("group " + std::to_string(group) +
                                        " of the weld does not exist");
    from.withhold(file);
}

}  // namespace glue
