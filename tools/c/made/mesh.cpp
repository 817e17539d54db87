// Made by tools/bindings of mesh.h and the headers of C++: see its README.
#include <treeform/mesh/certificate.hpp>

#include <tools/c/made/structs.hpp>
#include <tools/c/mesh.hpp>

namespace tf = treeform;

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
                                        const double* placed, treeform_precision before,
                                        treeform_precision after, int32_t always_compare,
                                        treeform_progress progress, void* progress_data,
                                        treeform_rounding** rounding) {
    return glue::guard([&] {
        glue::start(rounding);
        return glue::give(
            glue::rounding_effects(mesh, glue::matrix(matrix), placed,
                                   glue::choice<tf::precision>(before, 2, "before"),
                                   glue::choice<tf::precision>(after, 2, "after"),
                                   always_compare != 0, glue::progress(progress, progress_data)),
            rounding);
    });
}
