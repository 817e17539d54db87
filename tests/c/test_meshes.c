/* Meshes and clouds of arrays. */
#include "test.h"

#include <math.h>
#include <string.h>

static void test_bad_arrays(void) {
    const uint32_t wrong[6] = {0, 1, 2, 0, 1, 8};
    treeform_mesh* mesh = NULL;
    INVALID("points is null", treeform_mesh_create(NULL, 8, cube_faces, 12, 0, &mesh));
    INVALID("faces is null", treeform_mesh_create(cube_points, 8, NULL, 12, 0, &mesh));
    INVALID("null", treeform_mesh_create(cube_points, 8, cube_faces, 12, 0, NULL));
    INVALID("face 1 has the corner 8", treeform_mesh_create(cube_points, 8, wrong, 2, 0, &mesh));
    INVALID("arrays is null", treeform_mesh_of(NULL, 0, &mesh));
    INVALID("flags", treeform_mesh_create(cube_points, 8, cube_faces, 12, 64, &mesh));
    ENDS(TREEFORM_RANGE, "32-bit",
         treeform_mesh_create(cube_points, (size_t)1 << 33, cube_faces, 12, 0, &mesh));
    ENDS(TREEFORM_RANGE, "32-bit",
         treeform_mesh_create(cube_points, (size_t)-1, NULL, 0, TREEFORM_COPY, &mesh));
    CHECK(mesh == NULL);
    INVALID("result is null", treeform_mesh_arrays(NULL, NULL));
}

static void test_borrowed_and_copied(void) {
    double points[24];
    float floats[24];
    treeform_mesh* borrowed = NULL;
    treeform_mesh* copied = NULL;
    treeform_mesh* of_floats = NULL;
    treeform_arrays arrays;
    double volume = 0.0;
    int32_t is_cloud = 2;
    uint64_t indexes = 9;
    int i;
    memcpy(points, cube_points, sizeof points);
    for (i = 0; i < 24; ++i) floats[i] = (float)cube_points[i];
    OK(treeform_mesh_create(points, 8, cube_faces, 12, 0, &borrowed));
    OK(treeform_mesh_create(points, 8, cube_faces, 12, TREEFORM_COPY, &copied));
    OK(treeform_mesh_create_float(floats, 8, cube_faces, 12, 0, &of_floats));
    OK(treeform_mesh_arrays(borrowed, &arrays));
    CHECK(arrays.points == points && arrays.faces == cube_faces);
    CHECK(arrays.point_count == 8 && arrays.face_count == 12);
    OK(treeform_mesh_arrays(copied, &arrays));
    CHECK(arrays.points != points && arrays.faces != cube_faces);
    for (i = 0; i < 24; ++i) points[i] *= 2.0;
    OK(treeform_signed_volume(copied, &volume));
    CHECK(volume == 1.0);
    OK(treeform_signed_volume(of_floats, &volume));
    CHECK(volume == 1.0);
    OK(treeform_mesh_is_cloud(copied, &is_cloud));
    CHECK(is_cloud == 0);
    OK(treeform_mesh_indexes_built(copied, &indexes));
    CHECK(indexes == 0);
    treeform_free(borrowed);
    treeform_free(copied);
    treeform_free(of_floats);
}

static void test_indexes_stay(void) {
    treeform_mesh* kept = cube(0, 0, 0, 1);
    treeform_mesh* once = NULL;
    const double inside[3] = {0.5, 0.5, 0.5};
    uint8_t in = 0;
    uint64_t first = 0, second = 0;
    OK(treeform_mesh_create(cube_points, 8, cube_faces, 12, TREEFORM_ONE_USE, &once));
    OK(treeform_contains(kept, inside, 1, &in));
    OK(treeform_mesh_indexes_built(kept, &first));
    OK(treeform_contains(kept, inside, 1, &in));
    OK(treeform_mesh_indexes_built(kept, &second));
    CHECK(in == 1 && first > 0 && first == second);
    in = 0;
    OK(treeform_contains(once, inside, 1, &in));
    OK(treeform_mesh_indexes_built(once, &first));
    CHECK(in == 1 && first == 0);
    treeform_free(kept);
    treeform_free(once);
}

static void test_clouds_and_sets(void) {
    float floats[6] = {0, 0, 0, 1, 2, 3};
    treeform_mesh* cloud = NULL;
    treeform_mesh* floating = NULL;
    treeform_mesh* solid = cube(0, 0, 0, 1);
    const treeform_box unit = {{0, 0, 0}, {1, 1, 1}};
    treeform_mesh* boxed = NULL;
    double volume = 0, turn[12];
    const double up[3] = {0, 0, 2}, origin[3] = {0, 0, 0};
    const double quarter[12] = {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0};
    const treeform_mesh* meshes[2];
    treeform_arrays arrays;
    treeform_relation_result* how = NULL;
    int32_t is_cloud = 0;
    int i;
    OK(treeform_mesh_create(cube_points, 8, NULL, 0, TREEFORM_COPY, &cloud));
    OK(treeform_mesh_create_float(floats, 2, NULL, 0, 0, &floating));
    OK(treeform_mesh_is_cloud(cloud, &is_cloud));
    CHECK(is_cloud == 1);
    OK(treeform_mesh_arrays(floating, &arrays));
    CHECK(arrays.face_count == 0 && arrays.point_count == 2 && arrays.points[5] == 3.0);
    meshes[0] = solid;
    meshes[1] = floating;
    OK(treeform_measure(meshes[0], meshes[1], NULL, &how));
    CHECK(how->relation == TREEFORM_RELATION_TOUCHING && how->distance == 0.0);
    treeform_free(how);
    INVALID("null", treeform_mesh_of_box(NULL, &boxed));
    OK(treeform_mesh_of_box(&unit, &boxed));
    OK(treeform_signed_volume(boxed, &volume));
    CHECK(volume == 1.0);
    OK(treeform_rotation(up, 90, turn));
    for (i = 0; i < 12; ++i) CHECK(turn[i] == quarter[i]);
    INVALID("axis", treeform_rotation(NULL, 90, turn));
    INVALID("matrix", treeform_rotation(up, 90, NULL));
    INVALID("axis", treeform_rotation(origin, 90, turn));
    treeform_free(boxed);
    treeform_free(cloud);
    treeform_free(floating);
    treeform_free(solid);
}

static void test_made_of_others(void) {
    const double soup[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const uint32_t corners[6] = {0, 1, 2, 3, 4, 5};
    const uint32_t second = 1, wrong = 2;
    treeform_mesh* mesh = NULL;
    treeform_mesh* other = cube(0, 0, 0, 1);
    const treeform_mesh* both[2];
    treeform_made_mesh* made = NULL;
    OK(treeform_mesh_create(soup, 6, corners, 2, 0, &mesh));
    OK(treeform_join_equal_points(mesh, &made));
    CHECK(made->mesh.point_count == 4 && made->mesh.face_count == 2 && made->index_count == 6);
    CHECK(made->index[3] == 1 && made->index[5] == 2 && made->mesh.faces[3] == 1);
    treeform_free(made);
    OK(treeform_select_faces(mesh, &second, 1, &made));
    CHECK(made->mesh.point_count == 3 && made->mesh.face_count == 1);
    CHECK(made->mesh.points[3] == 1.0 && made->mesh.points[4] == 1.0);
    treeform_free(made);
    INVALID("2", treeform_select_faces(mesh, &wrong, 1, &made));
    CHECK(made == NULL);
    both[0] = mesh;
    both[1] = other;
    OK(treeform_join_meshes(both, 2, &made));
    CHECK(made->mesh.face_count == 14 && made->index_count == 14);
    CHECK(made->mesh.point_count == 8 && made->index[1] == 0 && made->index[2] == 1);
    treeform_free(made);
    treeform_free(mesh);
    treeform_free(other);
}

static void test_rounding(void) {
    double points[24], placed[24];
    const double matrix[12] = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
    treeform_mesh* mesh = NULL;
    treeform_made_mesh* made = NULL;
    treeform_rounding_effects* effects = NULL;
    double step = 0.0;
    int calls = 0, i;
    for (i = 0; i < 24; ++i) points[i] = 0.1 * cube_points[i];
    OK(treeform_mesh_create(points, 8, cube_faces, 12, 0, &mesh));
    OK(treeform_rounded(mesh, TREEFORM_FLOAT32, &made));
    CHECK(made->mesh.face_count == 12 && made->mesh.points[3] == (double)0.1f);
    treeform_free(made);
    INVALID("precision is 2", treeform_rounded(mesh, 2, &made));
    OK(treeform_rounded(mesh, TREEFORM_FLOAT32, &made));
    OK(treeform_coordinate_step(mesh, TREEFORM_FLOAT32, &step));
    CHECK(step == ldexp(1.0, -27));
    OK(treeform_find_rounding_effects(mesh, NULL, made->mesh.points, TREEFORM_FLOAT64,
                                      TREEFORM_FLOAT32, 0, NULL, NULL, &effects));
    CHECK(near(effects->max_displacement, fabs((double)0.1f - 0.1)) && effects->noticeable == 1);
    CHECK(effects->collapsed == 0 && effects->meeting == 0);
    treeform_free(effects);
    /* All points at one place: every face has lost its area. */
    memset(placed, 0, sizeof placed);
    OK(treeform_find_rounding_effects(mesh, matrix, placed, TREEFORM_FLOAT64, TREEFORM_FLOAT32, 1,
                                      NULL, NULL, &effects));
    CHECK(effects->compared == 1 && effects->collapsed == 12);
    treeform_free(effects);
    ENDS(TREEFORM_CANCELLED, "cancelled",
         treeform_find_rounding_effects(mesh, matrix, placed, TREEFORM_FLOAT64, TREEFORM_FLOAT32, 1,
                                        stop, &calls, &effects));
    CHECK(effects == NULL && calls > 0);
    treeform_free(made);
    treeform_free(mesh);
}

void test_meshes(void) {
    test_bad_arrays();
    test_borrowed_and_copied();
    test_indexes_stay();
    test_clouds_and_sets();
    test_made_of_others();
    test_rounding();
}
