/* Solids combined, resolved, repaired, wrapped. */
#include "test.h"

#include <math.h>

static double volume_of(const treeform_arrays* mesh) {
    treeform_mesh* made = NULL;
    double volume = (double)NAN;
    OK(treeform_mesh_create(mesh->points, mesh->point_count, mesh->faces, mesh->face_count,
                            TREEFORM_ONE_USE, &made));
    OK(treeform_signed_volume(made, &volume));
    treeform_free(made);
    return volume;
}

/* A certified result is written in its coordinates, or not at all. */
static void test_a_result_is_written_as_certified(void) {
    treeform_mesh* a = cube(0.1, 0, 0, 1);
    treeform_mesh* b = cube(0.3, 0.2, 0.5, 1);
    treeform_boolean_options options;
    treeform_boolean_result* result = NULL;
    treeform_certificate broken;
    treeform_written* written = NULL;
    const char* const stl = path_in_work("result.stl");
    OK(treeform_unite(a, b, NULL, &result));
    OK(treeform_write_result(path_in_work("result.ply"), &result->mesh, result->certificate, NULL,
                             &written));
    CHECK(written->written_as == TREEFORM_FLOAT64 && written->max_displacement == 0.0);
    treeform_free(written);
    ENDS(TREEFORM_FILE, "float32",
         treeform_write_result(stl, &result->mesh, result->certificate, NULL, NULL));
    broken = *result->certificate;
    broken.status = TREEFORM_STATUS_NOT_CERTIFIED;
    INVALID("", treeform_write_result(stl, &result->mesh, &broken, NULL, NULL));
    treeform_free(result);
    treeform_boolean_options_init(&options, sizeof options);
    options.precision = TREEFORM_FLOAT32;
    OK(treeform_unite(a, b, &options, &result));
    OK(treeform_write_result(stl, &result->mesh, result->certificate, NULL, NULL));
    treeform_free(result);
    treeform_free(b);
    treeform_free(a);
}

/* Checks the volume of a certified result, and frees it. */
static void has_volume(treeform_boolean_result* result, double volume) {
    CHECK(result != NULL && result->certificate->status == TREEFORM_STATUS_OK);
    CHECK(result && near(volume_of(&result->mesh), volume));
    treeform_free(result);
}

static void test_booleans(void) {
    treeform_mesh* a = cube(0, 0, 0, 1);
    treeform_mesh* b = cube(0.5, 0.5, 0.5, 1);
    treeform_mesh* c = cube(0, 0, 0, 0.25);
    treeform_mesh* d = cube(1.125, 0, 0, 1);
    const treeform_mesh* all[3];
    const char* const names[3] = {"body", "bolt", "pin"};
    treeform_boolean_options options;
    treeform_boolean_result* result = NULL;
    treeform_strings* words = NULL;
    int calls = 0;
    all[0] = a;
    all[1] = b;
    all[2] = c;
    treeform_boolean_options_init(&options, sizeof options);
    OK(treeform_unite(a, b, NULL, &result));
    has_volume(result, 1.875);
    OK(treeform_difference(a, b, NULL, &result));
    has_volume(result, 0.875);
    OK(treeform_symmetric_difference(a, b, NULL, &result));
    has_volume(result, 1.75);
    options.volumes = 1;
    OK(treeform_intersection(a, b, &options, &result));
    CHECK(result->volumes && near(result->volumes->either, 1.875));
    CHECK(result->face_source[0].operand == 0 && result->mesh.face_count == 12);
    has_volume(result, 0.125);
    options.volumes = 0;
    OK(treeform_boolean(all, 3, "(a-b)-c", &options, &result));
    has_volume(result, 0.875 - 0.015625);
    OK(treeform_boolean_named(all, names, 3, "body-bolt*body-pin", &options, &result));
    has_volume(result, 0.875 - 0.015625);
    OK(treeform_unite_all(all, 3, NULL, &result));
    has_volume(result, 1.875);
    OK(treeform_difference_all(all[0], all + 1, 2, &options, &result));
    has_volume(result, 0.875 - 0.015625);
    OK(treeform_difference_all(all[0], NULL, 0, NULL, &result));
    has_volume(result, 1.0);
    options.min_volume = 0.5;
    OK(treeform_intersection(a, b, &options, &result));
    CHECK(result->small_parts == 1 && near(result->small_volume, 0.125));
    CHECK(result->mesh.face_count == 0);
    treeform_free(result);
    options.min_volume = 0.0;
    options.gap = 0.25;
    OK(treeform_unite(a, d, &options, &result));
    CHECK(result->filled_faces == 4);
    has_volume(result, 2.125);
    INVALID("union of all operands", treeform_difference(a, d, &options, &result));
    options.gap = -1.0;
    INVALID("the gap is negative", treeform_unite(a, d, &options, &result));
    options.gap = 0.0;
    OK(treeform_names_in("body-(bolt+'left bolt')", &words));
    CHECK(words->count == 3 && is(words->values[2], "left bolt"));
    treeform_free(words);
    OK(treeform_split(all, 2, NULL, &result));
    CHECK(result->mesh.face_count > 24);
    treeform_free(result);
    INVALID("position", treeform_boolean(all, 3, "(a-", NULL, &result));
    INVALID("", treeform_boolean(all, 2, "a-c", NULL, &result));
    INVALID("expression is null", treeform_boolean(all, 2, NULL, NULL, &result));
    options.merge_coplanar = 1;
    options.face_groups = cube_faces;
    options.face_group_count = 5;
    INVALID("face groups", treeform_unite(a, b, &options, &result));
    options.fill_rule = 3;
    INVALID("fill_rule is 3", treeform_unite(a, b, &options, &result));
    treeform_boolean_options_init(&options, sizeof options);
    options.progress = stop;
    options.progress_data = &calls;
    ENDS(TREEFORM_CANCELLED, "", treeform_unite(a, b, &options, &result));
    INVALID("null", treeform_unite(a, NULL, NULL, &result));
    CHECK(result == NULL && calls > 0);
    treeform_free(a);
    treeform_free(b);
    treeform_free(c);
    treeform_free(d);
}

static void test_open(void) {
    treeform_mesh* open = NULL;
    treeform_mesh* solid = cube(0.5, 0.5, -0.5, 1);
    const treeform_mesh* both[2];
    treeform_boolean_result* result = NULL;
    OK(treeform_mesh_create(cube_points, 8, cube_faces, 2, 0, &open));
    both[0] = open;
    both[1] = solid;
    ENDS(TREEFORM_NOT_CERTIFIED, "ends at 4 edges", treeform_unite(open, solid, NULL, &result));
    CHECK(result && result->certificate->status == TREEFORM_STATUS_OPEN_INPUT);
    CHECK(result && result->certificate->open_count > 0 && result->mesh.face_count == 0);
    treeform_free(result);
    OK(treeform_clip(both, 2, 0, "a*b", NULL, &result));
    CHECK(result->mesh.face_count > 0);
    treeform_free(result);
    INVALID("", treeform_clip(both, 2, 0, "a+b", NULL, &result));
    INVALID("", treeform_clip(both, 2, 5, "a*b", NULL, &result));
    treeform_free(open);
    treeform_free(solid);
}

/// That overlap, side by side.
static treeform_mesh* two_cubes(void) {
    double points[48];
    uint32_t faces[72];
    treeform_mesh* mesh = NULL;
    int i;
    for (i = 0; i < 48; ++i) points[i] = cube_points[i % 24] + (i >= 24 && i % 3 == 0 ? 0.5 : 0.0);
    for (i = 0; i < 72; ++i) faces[i] = cube_faces[i % 36] + (i >= 36 ? 8 : 0);
    OK(treeform_mesh_create(points, 16, faces, 24, TREEFORM_COPY, &mesh));
    return mesh;
}

static void test_resolve(void) {
    treeform_mesh* mesh = model("data/two_spheres.stl");
    treeform_resolve_options options;
    treeform_repair_result* result = NULL;
    treeform_resolve_options_init(&options, sizeof options);
    options.precision = TREEFORM_FLOAT32;
    OK(treeform_resolve_self_intersections(mesh, TREEFORM_RESOLVE_OUTER, &options, &result));
    CHECK(result->mesh.face_count == 648 && result->statistics->removed == 112);
    CHECK(result->certificate->precision == TREEFORM_FLOAT32);
    CHECK(result->certificate->max_displacement > 0.0 && result->face_source[0] < 640);
    treeform_free(result);
    INVALID("mode is 3", treeform_resolve_self_intersections(mesh, 3, NULL, &result));
    treeform_free(mesh);
    mesh = two_cubes();
    OK(treeform_resolve_self_intersections(mesh, TREEFORM_RESOLVE_OUTER, &options, &result));
    CHECK(result->mesh.face_count == 12);
    treeform_free(result);
    options.keep_cuts = 1;
    OK(treeform_resolve_self_intersections(mesh, TREEFORM_RESOLVE_OUTER, &options, &result));
    CHECK(result->mesh.face_count > 12);
    treeform_free(result);
    treeform_free(mesh);
}

static void test_repair(void) {
    const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, NAN, 0, 0};
    const uint32_t triangles[] = {0, 1, 2, 0, 1, 3};
    treeform_file* file = NULL;
    treeform_mesh* broken = NULL;
    treeform_mesh* mesh = model("data/dirty.stl");
    treeform_repair_options options;
    treeform_repair_result* result = NULL;
    treeform_solid_defects* defects = NULL;
    treeform_file_view* view = NULL;
    int calls = 0;
    OK(treeform_read("data/dirty.stl", NULL, &file));
    OK(treeform_find_solid_defects(mesh, NULL, NULL, &defects));
    CHECK(defects->any == 1 && defects->boundary_edges > 0 && defects->message[0] != 0);
    treeform_free(defects);
    OK(treeform_find_solid_defects_of_file(file, NULL, NULL, &defects));
    CHECK(defects->any == 1);
    CHECK(defects->nonfinite_vertices == 0 && defects->unusable_faces == 0);
    treeform_free(defects);
    OK(treeform_mesh_create(corners, 4, triangles, 2, TREEFORM_COPY, &broken));
    OK(treeform_find_solid_defects(broken, NULL, NULL, &defects));
    CHECK(defects->any == 1 && defects->nonfinite_vertices == 1 && defects->unusable_faces == 1);
    CHECK(defects->boundary_edges == 3 && defects->without_faces == 0);
    treeform_free(defects);
    treeform_free(broken);
    ENDS(TREEFORM_CANCELLED, "", treeform_find_solid_defects(mesh, stop, &calls, &defects));
    CHECK(defects == NULL);
    OK(treeform_repair(mesh, NULL, &result));
    CHECK(result->mesh.face_count == 1280 && result->statistics->flipped == 40);
    CHECK(result->statistics->holes == 2 && result->file == NULL && result->vertex_source);
    CHECK(is(result->statistics->message,
             "40 faces flipped, 1 stray face dropped, 2 holes filled (9 edges)"));
    treeform_free(result);
    treeform_repair_options_init(&options, sizeof options);
    options.as_one = 1;
    OK(treeform_repair_file(file, &options, &result));
    CHECK(result->mesh.face_count == 1280 && result->statistics->hole_edges == 9);
    OK(treeform_file_content(result->file, &view));
    CHECK(view->mesh.points == result->mesh.points);
    treeform_free(view);
    treeform_free(result);
    treeform_repair_options_init(&options, sizeof options);
    options.gap = -1.0;
    INVALID("", treeform_repair(mesh, &options, &result));
    treeform_repair_options_init(&options, sizeof options);
    options.fill_rule = 3;
    INVALID("fill_rule is 3", treeform_repair(mesh, &options, &result));
    treeform_repair_options_init(&options, sizeof options);
    options.fill = 0;
    ENDS(TREEFORM_NOT_CERTIFIED, "", treeform_repair(mesh, &options, &result));
    CHECK(result != NULL && result->certificate->status == TREEFORM_STATUS_OPEN_INPUT);
    treeform_free(result);
    options.sheet = 1;
    OK(treeform_repair(mesh, &options, &result));
    CHECK(result->certificate->status == TREEFORM_STATUS_SHEET);
    ENDS(TREEFORM_INVALID, "border",
         treeform_write_result(path_in_work("sheet.ply"), &result->mesh, result->certificate, NULL,
                               NULL));
    treeform_free(result);
    treeform_free(file);
    treeform_free(mesh);
    mesh = two_cubes();
    OK(treeform_repair(mesh, NULL, &result));
    CHECK(result->mesh.face_count == 12 && result->statistics->removed == 4);
    CHECK(result->is_kept[10] == 0 && result->is_kept[22] == 1);
    treeform_free(result);
    treeform_repair_options_init(&options, sizeof options);
    options.keep_cuts = 1;
    OK(treeform_repair(mesh, &options, &result));
    CHECK(result->mesh.face_count > 12 && result->statistics->removed == 4);
    treeform_free(result);
    treeform_free(mesh);
}

static void test_wrap(void) {
    treeform_mesh* mesh = NULL;
    treeform_offset_options options;
    treeform_offset_result* result = NULL;
    OK(treeform_mesh_create(cube_points, 8, cube_faces, 10, 0, &mesh));
    treeform_offset_options_init(&options, sizeof options);
    options.offset = 0.25;
    OK(treeform_wrap(mesh, 2.0, &options, &result));
    CHECK(result->distance == 0.25 && volume_of(&result->mesh) > 1.0);
    treeform_free(result);
    INVALID("", treeform_wrap(mesh, -2.0, NULL, &result));
    CHECK(result == NULL);
    treeform_free(mesh);
}

void test_solids(void) {
    test_booleans();
    test_a_result_is_written_as_certified();
    test_open();
    test_resolve();
    test_repair();
    test_wrap();
}
