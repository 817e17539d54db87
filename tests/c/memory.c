/* With one allocation failing, or all from there on, calls return TREEFORM_MEMORY or do without. */
#include <stdio.h>
#include <stdlib.h>
#include <treeform.h>

void fail_allocations(long n, int alone);

static const double corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
static const uint32_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                      {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                      {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

static treeform_code unite(long n, int alone) {
    double moved[8][3];
    treeform_mesh *a = NULL, *b = NULL;
    treeform_boolean_result* result = NULL;
    treeform_code code;
    for (int p = 0; p < 8; ++p)
        for (int k = 0; k < 3; ++k) moved[p][k] = corners[p][k] + 0.3;
    fail_allocations(n, alone);
    code = treeform_mesh_create(&corners[0][0], 8, &faces[0][0], 12, 0, &a);
    if (code == TREEFORM_OK) code = treeform_mesh_create(&moved[0][0], 8, &faces[0][0], 12, 0, &b);
    if (code == TREEFORM_OK) code = treeform_unite(a, b, NULL, &result);
    fail_allocations(0, 0);
    treeform_free(result);
    treeform_free(a);
    treeform_free(b);
    return code;
}

int main(void) {
    int failed = 0, without_memory = 0;
    if (unite(0, 0) != TREEFORM_OK) return 2;
    for (long n = 1; n < 600; n += 1 + n / 50)
        for (int alone = 0; alone < 2; ++alone) {
            const treeform_code code = unite(n, alone);
            without_memory += code == TREEFORM_MEMORY;
            if (code == TREEFORM_OK || code == TREEFORM_MEMORY) continue;
            fprintf(stderr, "allocation %ld: code %d\n", n, (int)code);
            ++failed;
        }
    if (without_memory < 100) fprintf(stderr, "only %d without memory\n", without_memory);
    return failed > 0 || without_memory < 100;
}
