#include <treeform/mesh/weld.hpp>

#include <tools/c/made/structs.hpp>

namespace tf = treeform;

std::vector<tf::weld_condition> glue::conditions(const treeform_weld_condition* same,
                                                 std::size_t count, const char* what) {
    std::vector<tf::weld_condition> result;
    for (const treeform_weld_condition& one : array(same, count, what))
        result.push_back({&need(one.property, "a property of same"), one.tolerance});
    return result;
}

treeform_code treeform_weld(const treeform_mesh* mesh, const treeform_weld_options* options,
                            treeform_weld_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const tf::weld_options how = glue::read(options);
        if (glue::need(mesh, "mesh").prepared->is_cloud())
            return glue::give(tf::weld(glue::view(mesh).points, how), result);
        return glue::give(glue::asked(mesh, [&](const auto& m) { return tf::weld(m, how); }),
                          result);
    });
}

treeform_code treeform_weld_file(const treeform_file* file, const treeform_weld_options* options,
                                 treeform_weld_result** result) {
    return glue::guard([&] {
        glue::start(result);
        auto made = glue::make<treeform_weld_result>();
        treeform_weld_result& r = made->value;
        auto& kept = made->keep(tf::weld(glue::need(file, "file").content, glue::read(options)));
        glue::check(kept.status);
        glue::fill(*made, kept, r);
        r.file = glue::keep(*made, std::move(kept.file));
        r.mesh = glue::arrays(r.file->content.mesh);
        glue::give(std::move(made), result);
    });
}

treeform_code treeform_group_points(const treeform_mesh* mesh, const treeform_weld_options* options,
                                    treeform_weld_result** result) {
    return glue::guard([&] {
        glue::start(result);
        tf::weld_result groups;
        groups.groups = tf::group_points(glue::view(mesh).points, glue::read(options));
        glue::check(groups.groups.status);
        return glue::give(std::move(groups), result);
    });
}

treeform_code treeform_count_still_within(const treeform_file* welded,
                                          const treeform_weld_options* options,
                                          treeform_precision written_as, uint64_t* count,
                                          int32_t* known) {
    return glue::guard([&] {
        (void)glue::need(count, "count");
        (void)glue::need(known, "known");
        const auto found = tf::count_still_within(glue::need(welded, "the file").content,
                                                  glue::read(options), glue::precision(written_as));
        *count = found.value_or(0);
        *known = found.has_value();
    });
}

treeform_code treeform_withhold(treeform_file* file, const treeform_weld_result* welded) {
    return glue::guard([&] {
        tf::mesh_file& to = glue::need(file, "file").content;
        const treeform_weld_result& w = glue::need(welded, "welded");
        const auto copied = [](const std::uint32_t* data, std::size_t count) {
            const std::span all = glue::array(data, count, "the groups of a weld");
            return std::vector<std::uint32_t>(all.begin(), all.end());
        };
        tf::file_weld_result from;
        from.groups.group_of_point = copied(w.group_of_point, w.point_count);
        from.groups.first_of_group = copied(w.first_of_group, w.group_count);
        from.point_of_group = copied(w.point_of_group, w.group_count);
        for (const std::uint32_t group : from.groups.group_of_point)
            if (group >= w.group_count)
                throw std::invalid_argument("group " + std::to_string(group) +
                                            " of the weld is not there");
        from.withhold(to);
    });
}
