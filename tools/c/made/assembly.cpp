// Made by tools/bindings of assembly.h and the headers of C++: see its README.
#include <treeform/mesh/clash.hpp>

#include <tools/c/assembly.hpp>
#include <tools/c/made/structs.hpp>

namespace tf = treeform;

tf::clash_options glue::read(const treeform_clash_options* options) {
    return read(chosen(options, treeform_clash_options_init));
}
tf::clash_options glue::read(const treeform_clash_options& o) {
    tf::clash_options how;
    how.clearance = o.clearance;
    how.volumes = o.volumes != 0;
    how.depths = o.depths != 0;
    how.effort = o.effort;
    how.limit = limit(o.limit);
    how.first_only = o.first_only != 0;
    how.ignored = rows_of<tf::part_pair>(o.ignored, o.ignored_count, "ignored");

    how.vertices = choice<tf::vertex_identity>(o.vertices, 2, "vertices");
    how.progress = progress(o);

    return how;
}

void treeform_clash_options_init(treeform_clash_options* options, size_t size) {
    treeform_clash_options to{};
    const tf::clash_options from;
    to.clearance = from.clearance;
    to.volumes = from.volumes;
    to.depths = from.depths;
    to.effort = from.effort;
    to.limit = from.limit;
    to.first_only = from.first_only;
    to.vertices = static_cast<treeform_vertices>(from.vertices);
    glue::init(options, size, to);
}

void glue::fill(keeper&, const tf::contact_region& from, treeform_contact_region& to) {
    to.box = copied(from.box);
    to.face_pairs = from.face_pairs;
    to.faces_a = or_null(from.faces_a);
    to.face_count_a = from.faces_a.size();
    to.faces_b = or_null(from.faces_b);
    to.face_count_b = from.faces_b.size();
}

void glue::fill(keeper& kept, const tf::part_clash& from, treeform_part_clash& to) {
    to.a = from.a;
    to.b = from.b;
    to.how = static_cast<treeform_mesh_relation>(from.how);
    to.a_inside_b = from.a_inside_b;
    to.b_inside_a = from.b_inside_a;
    to.distance = from.distance;
    copy(from.nearest ? (*from.nearest)[0] : nowhere, to.on_a);
    copy(from.nearest ? (*from.nearest)[1] : nowhere, to.on_b);
    to.face_pairs = from.face_pairs;
    to.regions = list<treeform_contact_region>(kept, from.regions);
    to.region_count = from.regions.size();
    to.volume = from.volume.value_or(not_known);
    to.depth = from.depth.value_or(not_known);
    copy(from.move, to.move);
    to.depth_effort = same<treeform_search_effort>(from.depth_effort);
}

void glue::fill(keeper& kept, const tf::clash_result& from, treeform_clashes& to) {
    to.pairs = list<treeform_part_clash>(kept, from.pairs);
    to.count = from.pairs.size();
    std::copy(from.counts.begin(), from.counts.end(), to.counts);
    to.boxes_apart = from.boxes_apart;
    to.ignored = from.ignored;
    to.parts_indexed = from.parts_indexed;
    to.clashes = from.clashes;
}

static_assert(sizeof(treeform_pose_clash) == sizeof(tf::pose_clash));
static_assert(offsetof(treeform_pose_clash, a) == offsetof(tf::pose_clash, a));
static_assert(offsetof(treeform_pose_clash, b) == offsetof(tf::pose_clash, b));
static_assert(offsetof(treeform_pose_clash, how) == offsetof(tf::pose_clash, how));
static_assert(offsetof(treeform_pose_clash, distance) == offsetof(tf::pose_clash, distance));

treeform_code treeform_bodies_of(const treeform_file* const* files, const char* const* labels,
                                 size_t count, treeform_body_kind kind, treeform_bodies** bodies) {
    return glue::guard([&] {
        glue::start(bodies);
        return glue::give(glue::bodies_of(files, labels, count, kind), bodies);
    });
}

treeform_code treeform_put_back(treeform_bodies* bodies, size_t body, const double* points,
                                size_t count, const double* matrix, treeform_precision written_as,
                                treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        return glue::give(glue::put_back(bodies, body, points, count, matrix,
                                         glue::choice<tf::precision>(written_as, 2, "written_as")),
                          file);
    });
}

treeform_code treeform_clash(const treeform_mesh* const* parts, size_t count,
                             const treeform_clash_options* options, treeform_clashes** clashes) {
    return glue::guard([&] {
        glue::start(clashes);
        return glue::give(tf::clash(glue::refs(parts, count, "parts"), glue::read(options)),
                          clashes);
    });
}

treeform_code treeform_pairs_named(const char* const* names, size_t count, const char* first,
                                   const char* second, treeform_indices** indices) {
    return glue::guard([&] {
        glue::start(indices);
        return glue::give(glue::pairs_named(glue::texts(names, count, "names"),
                                            std::string(&glue::need(first, "first")),
                                            std::string(&glue::need(second, "second"))),
                          indices);
    });
}

treeform_code treeform_check_poses(const treeform_mesh* const* parts, size_t count,
                                   const double* poses, size_t pose_count,
                                   const treeform_clash_options* options,
                                   treeform_poses_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(glue::check_poses(parts, count, poses, pose_count, glue::read(options)),
                          result);
    });
}
