// Made by tools/bindings of mesh.h and the headers of C++: see its README.
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/cut.hpp>

#include <tools/c/made/structs.hpp>

namespace tf = treeform;

tf::rounding_options glue::read(const treeform_rounding_options* options) {
    return read(chosen(options, treeform_rounding_options_init));
}
tf::rounding_options glue::read(const treeform_rounding_options& o) {
    tf::rounding_options how;
    how.before = choice<tf::precision>(o.before, 2, "before");
    how.after = choice<tf::precision>(o.after, 2, "after");
    how.progress = progress(o);

    return how;
}

void treeform_rounding_options_init(treeform_rounding_options* options, size_t size) {
    treeform_rounding_options to{};
    const tf::rounding_options from;
    to.before = static_cast<treeform_precision>(from.before);
    to.after = static_cast<treeform_precision>(from.after);
    glue::init(options, size, to);
}

void glue::fill(keeper&, const tf::rounding_effects& from, treeform_rounding& to) {
    to.max_displacement = from.max_displacement;
    to.step = from.step;
    to.noticeable = from.noticeable;
    to.compared = from.compared;
    to.collapsed = from.collapsed;
    to.meeting = from.meeting;
}

treeform_code treeform_mesh_is_cloud(const treeform_mesh* mesh, int32_t* is_cloud) {
    return glue::guard([&] {
        (void)glue::need(is_cloud, "is_cloud");
        *is_cloud = glue::need(mesh, "mesh").prepared->is_cloud();
    });
}

treeform_code treeform_mesh_indexes_built(const treeform_mesh* mesh, uint64_t* indexes) {
    return glue::guard([&] {
        (void)glue::need(indexes, "indexes");
        *indexes = glue::need(mesh, "mesh").prepared->indexes_built();
    });
}

treeform_code treeform_select_faces(const treeform_mesh* mesh, const uint32_t* faces, size_t count,
                                    treeform_made_mesh** made) {
    return glue::guard([&] {
        glue::start(made);
        return glue::give(
            tf::submesh(glue::ref(mesh, "mesh"), glue::array(faces, count, "faces")).mesh, made);
    });
}

treeform_code treeform_coordinate_step(const treeform_mesh* mesh, treeform_precision precision,
                                       double* step) {
    return glue::guard([&] {
        (void)glue::need(step, "step");
        *step = tf::coordinate_step(glue::view(mesh).points,
                                    glue::choice<tf::precision>(precision, 2, "precision"));
    });
}
