// Made by tools/bindings of mesh.h and the headers of C++: see its README.
#include <treeform/mesh/certificate.hpp>

#include <tools/c/made/structs.hpp>
#include <tools/c/mesh.hpp>

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

treeform_code treeform_mesh_create(const double* points, size_t point_count, const uint32_t* faces,
                                   size_t face_count, uint32_t flags, treeform_mesh** mesh) {
    return glue::guard([&] {
        glue::start(mesh);
        return glue::give(glue::mesh_create(points, point_count, faces, face_count, flags), mesh);
    });
}

treeform_code treeform_mesh_create_float(const float* points, size_t point_count,
                                         const uint32_t* faces, size_t face_count, uint32_t flags,
                                         treeform_mesh** mesh) {
    return glue::guard([&] {
        glue::start(mesh);
        return glue::give(glue::mesh_create_float(points, point_count, faces, face_count, flags),
                          mesh);
    });
}

treeform_code treeform_cloud_create(const double* points, size_t point_count, uint32_t flags,
                                    treeform_mesh** mesh) {
    return glue::guard([&] {
        glue::start(mesh);
        return glue::give(glue::cloud_create(points, point_count, flags), mesh);
    });
}

treeform_code treeform_cloud_create_float(const float* points, size_t point_count, uint32_t flags,
                                          treeform_mesh** mesh) {
    return glue::guard([&] {
        glue::start(mesh);
        return glue::give(glue::cloud_create_float(points, point_count, flags), mesh);
    });
}

treeform_code treeform_mesh_arrays(const treeform_mesh* mesh, treeform_arrays* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::mesh_arrays(mesh);
    });
}

treeform_code treeform_mesh_is_cloud(const treeform_mesh* mesh, int32_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::mesh_is_cloud(mesh);
    });
}

treeform_code treeform_mesh_indexes_built(const treeform_mesh* mesh, uint64_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::mesh_indexes_built(mesh);
    });
}

treeform_code treeform_mesh_set_create(const treeform_mesh* const* meshes, size_t count,
                                       treeform_mesh_set** set) {
    return glue::guard([&] {
        glue::start(set);
        return glue::give(glue::mesh_set_create(meshes, count), set);
    });
}

treeform_code treeform_join_equal_points(const treeform_mesh* mesh, treeform_made_mesh** made) {
    return glue::guard([&] {
        glue::start(made);
        return glue::give(glue::join_equal_points(glue::view(mesh)), made);
    });
}

treeform_code treeform_join_meshes(const treeform_mesh* const* meshes, size_t count,
                                   treeform_made_mesh** made) {
    return glue::guard([&] {
        glue::start(made);
        return glue::give(glue::join_meshes(meshes, count), made);
    });
}

treeform_code treeform_select_faces(const treeform_mesh* mesh, const uint32_t* faces, size_t count,
                                    treeform_made_mesh** made) {
    return glue::guard([&] {
        glue::start(made);
        return glue::give(
            glue::select_faces(glue::ref(mesh, "mesh"), glue::array(faces, count, "faces")), made);
    });
}

treeform_code treeform_round(const treeform_mesh* mesh, treeform_precision precision,
                             treeform_made_mesh** made) {
    return glue::guard([&] {
        glue::start(made);
        return glue::give(
            glue::round(glue::view(mesh), glue::choice<tf::precision>(precision, 2, "precision")),
            made);
    });
}

treeform_code treeform_coordinate_step(const treeform_mesh* mesh, treeform_precision of,
                                       double* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result =
            tf::coordinate_step(glue::view(mesh).points, glue::choice<tf::precision>(of, 2, "of"));
    });
}

treeform_code treeform_rounding_effects(const treeform_mesh* mesh, const double* matrix,
                                        const double* placed,
                                        const treeform_rounding_options* options,
                                        treeform_rounding** rounding) {
    return glue::guard([&] {
        glue::start(rounding);
        return glue::give(glue::rounding_effects(mesh, glue::matrix(matrix), placed, options),
                          rounding);
    });
}
