/* Many parts, and many poses of them. */
#include "test.h"

#include <math.h>

static void test_clashes(void) {
    treeform_mesh* a = cube(0, 0, 0, 1);
    treeform_mesh* b = cube(0.75, 0, 0, 1);
    treeform_mesh* c = cube(2, 0, 0, 1);
    const treeform_mesh* parts[3];
    const uint32_t ignored[2] = {0, 1}, wrong[2] = {0, 3};
    treeform_clash_options options;
    treeform_clash_result* clashes = NULL;
    int calls = 0;
    parts[0] = a;
    parts[1] = b;
    parts[2] = c;
    treeform_clash_options_init(&options, sizeof options);
    options.clearance = 0.5;
    OK(treeform_clash(parts, 3, &options, &clashes));
    CHECK(clashes->count == 2 && clashes->clashes == 2 && clashes->counts[2] == 1);
    CHECK(clashes->pairs[0].relation == TREEFORM_RELATION_PENETRATING &&
          near(clashes->pairs[0].volume, 0.25));
    CHECK(near(clashes->pairs[0].depth, 0.25) && clashes->pairs[0].region_count > 0);
    CHECK(clashes->pairs[0].regions[0].face_count_a > 0 && isnan(clashes->pairs[0].on_a[0]));
    CHECK(clashes->pairs[1].relation == TREEFORM_RELATION_CLOSER_THAN_CLEARANCE &&
          clashes->pairs[1].distance == 0.25);
    CHECK(clashes->pairs[1].on_b[0] == 2.0 && isnan(clashes->pairs[1].volume));
    treeform_free(clashes);
    options.ignored = ignored;
    options.ignored_count = 1;
    OK(treeform_clash(parts, 3, &options, &clashes));
    CHECK(clashes->count == 1 && clashes->ignored == 1);
    treeform_free(clashes);
    options.ignored = wrong;
    INVALID("", treeform_clash(parts, 3, &options, &clashes));
    treeform_clash_options_init(&options, sizeof options);
    options.progress = stop;
    options.progress_data = &calls;
    ENDS(TREEFORM_CANCELLED, "", treeform_clash(parts, 3, &options, &clashes));
    CHECK(clashes == NULL);
    treeform_free(a);
    treeform_free(b);
    treeform_free(c);
}

static void test_names(void) {
    const char* const names[3] = {"bolt_1", "nut", "bolt_2"};
    treeform_indices* pairs = NULL;
    OK(treeform_pairs_named(names, 3, "bolt*", "nut", &pairs));
    CHECK(pairs->count == 4 && pairs->values[0] == 0 && pairs->values[1] == 1);
    CHECK(pairs->values[2] == 1 && pairs->values[3] == 2);
    treeform_free(pairs);
    INVALID("first is null", treeform_pairs_named(names, 3, NULL, "nut", &pairs));
}

static void test_poses(void) {
    treeform_mesh* a = cube(0, 0, 0, 1);
    treeform_mesh* b = cube(0, 0, 0, 1);
    const treeform_mesh* parts[2];
    /* Two poses of two parts: one beside the other, then one half in the other. */
    double poses[48] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 3,   0, 1, 0, 0, 0, 0, 1, 0,
                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0};
    treeform_clash_options options;
    treeform_poses_result* result = NULL;
    parts[0] = a;
    parts[1] = b;
    treeform_clash_options_init(&options, sizeof options);
    OK(treeform_check_poses(parts, 2, poses, 2, &options, &result));
    CHECK(result->pose_count == 2 && result->clashing == 1);
    CHECK(result->in_collision[0] == 0 && result->in_collision[1] == 1);
    CHECK(result->begin[0] == 0 && result->begin[1] == 0 && result->begin[2] == 1);
    CHECK(result->clashes[0].a == 0 &&
          result->clashes[0].relation == TREEFORM_RELATION_PENETRATING);
    treeform_free(result);
    poses[12] = (double)NAN;
    INVALID("pose 0", treeform_check_poses(parts, 2, poses, 2, &options, &result));
    INVALID("poses is null", treeform_check_poses(parts, 2, NULL, 2, &options, &result));
    ENDS(TREEFORM_RANGE, "", treeform_check_poses(parts, 2, poses, (size_t)-1, NULL, &result));
    CHECK(result == NULL);
    treeform_free(a);
    treeform_free(b);
}

static void test_bodies(void) {
    treeform_mesh* low = cube(0, 0, 0, 1);
    treeform_mesh* high = cube(0, 0, 1, 1);
    treeform_file* files[2];
    treeform_file* scene = NULL;
    treeform_file* moved = NULL;
    const treeform_file* inputs[1];
    const char* const names[2] = {"low", "high"};
    const char* const label[1] = {"stack.obj"};
    const double shift[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 5};
    treeform_bodies* bodies = NULL;
    treeform_clash_result* clashes = NULL;
    treeform_file_view* view = NULL;
    OK(treeform_file_create(low, &files[0]));
    OK(treeform_file_create(high, &files[1]));
    OK(treeform_scene_of((const treeform_file* const*)files, names, 2, &scene));
    inputs[0] = scene;
    OK(treeform_bodies_of(inputs, label, 1, TREEFORM_BODY_PARTS, &bodies));
    CHECK(bodies->count == 1);
    treeform_free(bodies);
    OK(treeform_bodies_of(inputs, label, 1, TREEFORM_BODY_NAMED, &bodies));
    CHECK(bodies->count == 2 && is(bodies->bodies[1].name, "high"));
    CHECK(is(bodies->bodies[0].label, "stack.obj: low") && bodies->bodies[1].face_count == 12);
    CHECK(bodies->bodies[1].face_in_file[0] == 12 && bodies->meshes[1] == bodies->bodies[1].mesh);
    OK(treeform_clash(bodies->meshes, bodies->count, NULL, &clashes));
    CHECK(clashes->count == 1 && clashes->pairs[0].relation == TREEFORM_RELATION_TOUCHING);
    treeform_free(clashes);
    treeform_free(bodies);
    OK(treeform_bodies_of(inputs, label, 1, TREEFORM_BODY_FILE, &bodies));
    CHECK(bodies->count == 1 && is(bodies->bodies[0].name, ""));
    treeform_free(bodies);
    inputs[0] = files[0];
    OK(treeform_bodies_of(inputs, label, 1, TREEFORM_BODY_FILE, &bodies));
    OK(treeform_move_in_file(bodies, 0, cube_points, 8, shift, TREEFORM_FLOAT64, &moved));
    OK(treeform_file_content(moved, &view));
    CHECK(view->mesh.point_count == 8 && view->mesh.points[3] == 1.0);
    treeform_free(view);
    treeform_free(moved);
    INVALID("7 points", treeform_move_in_file(bodies, 0, cube_points, 7, shift, 1, &moved));
    INVALID("body 1", treeform_move_in_file(bodies, 1, cube_points, 8, shift, 1, &moved));
    treeform_free(bodies);
    INVALID("kind is 3", treeform_bodies_of(inputs, label, 1, 3, &bodies));
    INVALID("labels is null", treeform_bodies_of(inputs, NULL, 1, TREEFORM_BODY_FILE, &bodies));
    CHECK(bodies == NULL && moved == NULL);
    treeform_free(scene);
    treeform_free(files[0]);
    treeform_free(files[1]);
    treeform_free(low);
    treeform_free(high);
}

void test_assembly(void) {
    test_bodies();
    test_clashes();
    test_names();
    test_poses();
}
