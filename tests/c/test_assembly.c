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
    treeform_clashes* clashes = NULL;
    int calls = 0;
    parts[0] = a;
    parts[1] = b;
    parts[2] = c;
    treeform_clash_options_init(&options, sizeof options);
    options.clearance = 0.5;
    OK(treeform_clash(parts, 3, &options, &clashes));
    CHECK(clashes->count == 2 && clashes->clashes == 2 && clashes->counts[2] == 1);
    CHECK(clashes->pairs[0].how == TREEFORM_PENETRATING && near(clashes->pairs[0].volume, 0.25));
    CHECK(near(clashes->pairs[0].depth, 0.25) && clashes->pairs[0].region_count > 0);
    CHECK(clashes->pairs[0].regions[0].face_count_a > 0 && isnan(clashes->pairs[0].on_a[0]));
    CHECK(clashes->pairs[1].how == TREEFORM_TOO_CLOSE && clashes->pairs[1].distance == 0.25);
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
    treeform_poses_options options;
    treeform_poses_result* result = NULL;
    parts[0] = a;
    parts[1] = b;
    treeform_poses_options_init(&options, sizeof options);
    OK(treeform_check_poses(parts, 2, poses, 2, &options, &result));
    CHECK(result->pose_count == 2 && result->clashing == 1);
    CHECK(result->begin[0] == 0 && result->begin[1] == 0 && result->begin[2] == 1);
    CHECK(result->clashes[0].a == 0 && result->clashes[0].how == TREEFORM_PENETRATING);
    treeform_free(result);
    poses[12] = (double)NAN;
    INVALID("pose 0", treeform_check_poses(parts, 2, poses, 2, &options, &result));
    INVALID("poses is null", treeform_check_poses(parts, 2, NULL, 2, &options, &result));
    ENDS(TREEFORM_RANGE, "", treeform_check_poses(parts, 2, poses, (size_t)-1, NULL, &result));
    CHECK(result == NULL);
    treeform_free(a);
    treeform_free(b);
}

void test_assembly(void) {
    test_clashes();
    test_names();
    test_poses();
}
