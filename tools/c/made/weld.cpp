// Made by tools/bindings of weld.h and the headers of C++: see its README.
#include <treeform/mesh/weld.hpp>

#include <tools/c/made/structs.hpp>
#include <tools/c/weld.hpp>

namespace tf = treeform;

static_assert(TREEFORM_KEEP_FIRST == static_cast<int>(tf::weld_keep::first));
static_assert(TREEFORM_KEEP_LAST == static_cast<int>(tf::weld_keep::last));
static_assert(TREEFORM_KEEP_MEAN == static_cast<int>(tf::weld_keep::mean));
static_assert(TREEFORM_KEEP_LOWEST == static_cast<int>(tf::weld_keep::lowest));
static_assert(TREEFORM_KEEP_HIGHEST == static_cast<int>(tf::weld_keep::highest));

void glue::fill(keeper&, const tf::weld_condition& from, treeform_weld_condition& to) {
    to.property = from.property.c_str();
    to.tolerance = from.tolerance;
}

tf::weld_options glue::read(const treeform_weld_options* options) {
    return read(chosen(options, treeform_weld_options_init));
}
tf::weld_options glue::read(const treeform_weld_options& o) {
    tf::weld_options how;
    how.tolerance = o.tolerance;
    how.chain = o.chain != 0;
    how.label = array(o.label, o.label_count, "label");

    if (o.may_merge)
        how.may_merge = [call = o.may_merge, data = o.may_merge_data](
                            std::uint32_t a, std::uint32_t b) { return call(a, b, data) != 0; };

    how.same = conditions(o.same, o.same_count, "same");

    how.keep_seams = o.keep_seams != 0;
    how.across = texts(o.across, o.across_count, "across");

    how.keep = choice<tf::weld_keep>(o.keep, 5, "keep");
    how.keep_by = text(o.keep_by);
    how.order_by = text(o.order_by);
    how.highest_first = o.highest_first != 0;
    how.only_borders = o.only_borders != 0;
    how.keep_manifold = o.keep_manifold != 0;
    how.keep_degenerate = o.keep_degenerate != 0;
    how.progress = progress(o);

    return how;
}

void treeform_weld_options_init(treeform_weld_options* options, size_t size) {
    treeform_weld_options to{};
    const tf::weld_options from;
    to.tolerance = from.tolerance;
    to.chain = from.chain;
    to.keep_seams = from.keep_seams;
    to.keep = static_cast<treeform_weld_keep>(from.keep);
    to.highest_first = from.highest_first;
    to.only_borders = from.only_borders;
    to.keep_manifold = from.keep_manifold;
    to.keep_degenerate = from.keep_degenerate;
    glue::init(options, size, to);
}

void glue::fill(keeper&, const tf::weld_result& from, treeform_weld_result& to) {
    to.mesh = arrays(from.mesh);
    to.group_of_point = or_null(from.groups.group_of_point);
    to.point_count = from.groups.group_of_point.size();
    to.first_of_group = or_null(from.groups.first_of_group);
    to.group_count = from.groups.first_of_group.size();
    to.point_of_group = or_null(from.point_of_group);
    to.face_of_new = or_null(from.face_of_new);
    to.merged_groups = from.statistics.groups;
    to.non_finite = from.statistics.non_finite;
    to.collapsed = from.statistics.collapsed;
    to.degenerate = from.statistics.degenerate;
    to.max_displacement = from.statistics.max_displacement;
    to.nonmanifold_before = from.statistics.nonmanifold_before;
    to.nonmanifold_after = from.statistics.nonmanifold_after;
    to.flipped = from.statistics.flipped;
    to.kept_apart = from.statistics.kept_apart;
}

void glue::fill(keeper&, const tf::file_weld_result& from, treeform_weld_result& to) {
    to.group_of_point = or_null(from.groups.group_of_point);
    to.point_count = from.groups.group_of_point.size();
    to.first_of_group = or_null(from.groups.first_of_group);
    to.group_count = from.groups.first_of_group.size();
    to.point_of_group = or_null(from.point_of_group);
    to.face_of_new = or_null(from.face_of_new);
    to.merged_groups = from.statistics.groups;
    to.non_finite = from.statistics.non_finite;
    to.collapsed = from.statistics.collapsed;
    to.degenerate = from.statistics.degenerate;
    to.max_displacement = from.statistics.max_displacement;
    to.nonmanifold_before = from.statistics.nonmanifold_before;
    to.nonmanifold_after = from.statistics.nonmanifold_after;
    to.flipped = from.statistics.flipped;
    to.kept_apart = from.statistics.kept_apart;
}

treeform_code treeform_weld(const treeform_mesh* mesh, const treeform_weld_options* options,
                            treeform_weld_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(glue::weld(mesh, glue::read(options)), result);
    });
}

treeform_code treeform_weld_file(const treeform_file* file, const treeform_weld_options* options,
                                 treeform_weld_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(glue::weld_file(glue::content(file, "file"), glue::read(options)),
                          result);
    });
}

treeform_code treeform_group_points(const treeform_mesh* mesh, const treeform_weld_options* options,
                                    treeform_weld_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(glue::group_points(glue::view(mesh), glue::read(options)), result);
    });
}

treeform_code treeform_count_nearly_equal(const treeform_mesh* mesh, double distance,
                                          uint64_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = tf::count_nearly_equal(glue::view(mesh).points, distance);
    });
}

treeform_code treeform_count_mergeable(const treeform_file* welded,
                                       const treeform_weld_options* options,
                                       treeform_precision written_as, uint64_t* count,
                                       int32_t* known) {
    return glue::guard([&] {
        glue::count_mergeable(glue::content(welded, "welded"), glue::read(options),
                              glue::choice<tf::precision>(written_as, 2, "written_as"), count,
                              known);
    });
}

treeform_code treeform_withhold(treeform_file* file, const treeform_weld_result* welded) {
    return glue::guard([&] { glue::withhold(glue::content(file, "file"), welded); });
}
