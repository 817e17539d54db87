#include <treeform/mesh/weld.hpp>

#include <tools/c/weld.hpp>

namespace tf = treeform;

namespace {

tf::weld_options options_of(const treeform_weld_options* options) {
    const auto o = glue::chosen(options, treeform_weld_options_init);
    tf::weld_options how;
    how.tolerance = o.tolerance;
    how.rule = glue::choice<tf::weld_rule>(o.rule, 2, "rule");
    how.label = glue::array(o.label, o.label_count, "label");
    if (o.may_merge)
        how.may_merge = [call = o.may_merge, data = o.may_merge_data](
                            std::uint32_t a, std::uint32_t b) { return call(a, b, data) != 0; };
    how.same = glue::conditions(o.same, o.same_count);
    how.keep_seams = o.keep_seams != 0;
    how.across = glue::texts(o.across, o.across_count, "across");
    how.keep = glue::choice<tf::weld_keep>(o.keep, 5, "keep");
    how.keep_by = glue::text(o.keep_by);
    how.order = glue::choice<tf::weld_order>(o.order, 3, "order");
    how.order_by = glue::text(o.order_by);
    how.only_borders = o.only_borders != 0;
    how.keep_manifold = o.keep_manifold != 0;
    how.keep_degenerate = o.keep_degenerate != 0;
    how.progress = glue::progress(o);
    return how;
}

void fill(treeform_weld_result& to, const tf::point_groups& from) {
    glue::check(from.status);
    to.group_of_point = from.group_of_point.data();
    to.point_count = from.group_of_point.size();
    to.first_of_group = from.first_of_group.data();
    to.group_count = from.first_of_group.size();
}

/// What all kinds of welding have in common.
template <class Result>
void fill_from(treeform_weld_result& to, const Result& kept) {
    glue::check(kept.status);
    fill(to, kept.groups);
    to.point_of_group = kept.point_of_group.data();
    const tf::weld_statistics& s = kept.statistics;
    to.merged_groups = s.groups;
    to.non_finite = s.non_finite;
    to.collapsed = s.collapsed;
    to.degenerate = s.degenerate;
    to.max_displacement = s.max_displacement;
    to.nonmanifold_before = s.nonmanifold_before;
    to.nonmanifold_after = s.nonmanifold_after;
    to.flipped = s.flipped;
    to.left_alone = s.left_alone;
}

}  // namespace

std::vector<tf::weld_condition> glue::conditions(const treeform_weld_condition* same,
                                                 std::size_t count) {
    std::vector<tf::weld_condition> result;
    for (const treeform_weld_condition& one : array(same, count, "same"))
        result.push_back({&need(one.property, "a property of same"), one.tolerance});
    return result;
}

void treeform_weld_options_init(treeform_weld_options* options, size_t size) {
    glue::init(options, size, treeform_weld_options{});
}

treeform_code treeform_weld(const treeform_mesh* mesh, const treeform_weld_options* options,
                            treeform_weld_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const tf::weld_options how = options_of(options);
        auto made = glue::make<treeform_weld_result>();
        treeform_weld_result& r = made->value;
        if (glue::need(mesh, "mesh").prepared->is_cloud()) {
            const auto& kept = made->keep(tf::weld(glue::view(mesh).points, how));
            fill_from(r, kept);
            r.mesh = glue::arrays({kept.mesh.points, {}});
        } else {
            const auto& kept =
                made->keep(glue::asked(mesh, [&](const auto& m) { return tf::weld(m, how); }));
            fill_from(r, kept);
            r.mesh = glue::arrays(kept.mesh);
            r.face_of_new = kept.face_of_new.data();
        }
        glue::give(std::move(made), result);
    });
}

treeform_code treeform_weld_file(const treeform_file* file, const treeform_weld_options* options,
                                 treeform_weld_result** result) {
    return glue::guard([&] {
        glue::start(result);
        auto made = glue::make<treeform_weld_result>();
        treeform_weld_result& r = made->value;
        auto& kept = made->keep(tf::weld(glue::need(file, "file").content, options_of(options)));
        fill_from(r, kept);
        r.face_of_new = kept.face_of_new.data();
        r.file = glue::keep(*made, std::move(kept.file));
        r.mesh = glue::arrays(r.file->content.mesh);
        glue::give(std::move(made), result);
    });
}

treeform_code treeform_group_points(const treeform_mesh* mesh, const treeform_weld_options* options,
                                    treeform_weld_result** result) {
    return glue::guard([&] {
        glue::start(result);
        auto made = glue::make<treeform_weld_result>();
        fill(made->value,
             made->keep(tf::group_points(glue::view(mesh).points, options_of(options))));
        glue::give(std::move(made), result);
    });
}

treeform_code treeform_count_nearly_equal(const treeform_mesh* mesh, double distance,
                                          uint64_t* count) {
    return glue::guard([&] {
        glue::need(count, "count") = tf::count_nearly_equal(glue::view(mesh).points, distance);
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
                                                  options_of(options), glue::precision(written_as));
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
