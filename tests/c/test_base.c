/* Codes, messages, versions, threads, options. */
#include "test.h"

#include <string.h>

static void test_options_of_other_sizes(void) {
    treeform_mesh* const mesh = cube(0, 0, 0, 1);
    treeform_face_pair_options options;
    treeform_face_pair_result* pairs = NULL;
    /* One that ends before `kinds`, as an older program has it: all kinds are looked for. */
    memset(&options, 0, sizeof options);
    treeform_face_pair_options_init(&options, 2 * sizeof(size_t));
    CHECK(options.struct_size == 2 * sizeof(size_t) && options.kinds == 0);
    OK(treeform_self_intersections(mesh, &options, &pairs));
    treeform_free(pairs);
    /* Never initialized, or from a later version. */
    options.struct_size = 0;
    INVALID("options of 0 bytes", treeform_self_intersections(mesh, &options, &pairs));
    options.struct_size = sizeof options + 8;
    INVALID("init", treeform_self_intersections(mesh, &options, &pairs));
    CHECK(pairs == NULL);
    /* Init writes no more than it is told, and takes a null pointer. */
    memset(&options, 0x55, sizeof options);
    treeform_face_pair_options_init(&options, 2 * sizeof(size_t));
    CHECK(options.limit == 0x5555555555555555u);
    treeform_face_pair_options_init(&options, 1);
    treeform_face_pair_options_init(NULL, sizeof options);
    treeform_free(mesh);
}

void test_base(void) {
    treeform_thread_limit* limit = NULL;
    CHECK(treeform_version() == TREEFORM_C_VERSION);
    CHECK(TREEFORM_C_VERSION >= TREEFORM_C_VERSION_OF(0, 1, 0));
    CHECK(strlen(treeform_version_string()) >= 5);
    CHECK(is(treeform_code_name(TREEFORM_OK), "ok"));
    CHECK(is(treeform_code_name(TREEFORM_FILE), "file"));
    CHECK(is(treeform_code_name(77), "unknown"));
    CHECK(treeform_last_error() != NULL);
    treeform_free(NULL);
    CHECK(treeform_thread_count() >= 1);
    OK(treeform_limit_threads(1, &limit));
    CHECK(treeform_thread_count() == 1);
    treeform_free(limit);
    INVALID("null", treeform_limit_threads(1, NULL));
    test_options_of_other_sizes();
}
