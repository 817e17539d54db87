/* Runs every test. argv[1] is a folder in which the tests may write; the working folder is the top
   of the project. */
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;
static int checks = 0;
static const char* work = ".";

void check(int holds, const char* what, const char* file, int line) {
    ++checks;
    if (holds) return;
    ++failures;
    printf("%s:%d: %s does not hold\n", file, line, what);
}

void check_code(treeform_code got, treeform_code wanted, const char* words, const char* what,
                const char* file, int line) {
    ++checks;
    if (got == wanted && (got == TREEFORM_OK || strstr(treeform_last_error(), words))) return;
    ++failures;
    printf("%s:%d: %s: %s instead of %s; \"%s\" instead of \"%s\"\n", file, line, what,
           treeform_code_name(got), treeform_code_name(wanted),
           got == TREEFORM_OK ? "" : treeform_last_error(), words);
}

int is(const char* a, const char* b) { return strcmp(a, b) == 0; }

int near(double a, double b) { return fabs(a - b) < 1e-9; }

int stop(double done, void* calls) {
    (void)done;
    ++*(int*)calls;
    return 1;
}

const char* path_in_work(const char* name) {
    static char paths[8][1024];
    static int next = 0;
    char* const path = paths[next++ % 8];
    sprintf(path, "%.900s/%.100s", work, name);
    return path;
}

const double cube_points[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0,
                                0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
const uint32_t cube_faces[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};

treeform_mesh* cube(double x, double y, double z, double size) {
    double points[24];
    const double corner[3] = {x, y, z};
    treeform_mesh* mesh = NULL;
    int i;
    for (i = 0; i < 24; ++i) points[i] = corner[i % 3] + size * cube_points[i];
    OK(treeform_mesh_create(points, 8, cube_faces, 12, TREEFORM_COPY, &mesh));
    return mesh;
}

treeform_mesh* model(const char* path) {
    treeform_mesh* mesh = NULL;
    OK(treeform_read_mesh(path, NULL, &mesh));
    return mesh;
}

int main(int argc, char** argv) {
    if (argc > 1) work = argv[1];
    test_base();
    test_meshes();
    test_properties();
    test_cuts();
    test_shapes();
    test_files();
    test_attributes();
    test_intersections();
    test_search();
    test_solids();
    test_weld();
    test_streams();
    test_nearness();
    test_placement();
    test_layouts();
    test_assembly();
    test_trees();
    test_progress();
    printf("%d checks, %d failed\n", checks, failures);
    return failures == 0 ? 0 : 1;
}
