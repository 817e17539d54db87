/* Sections. */
#include "test.h"

#include <stdio.h>

static void test_sections(void) {
    treeform_mesh* mesh = cube(0, 0, 0, 2);
    const treeform_plane across = {{0, 0, 0}, {1, 0, 0}};
    const treeform_plane no_plane = {{0, 0, 0}, {0, 0, 0}};
    const double heights[3] = {1, 2, 3};
    treeform_section_result* made = NULL;
    treeform_heights* middles = NULL;
    int calls = 0;
    FILE* file = NULL;
    OK(treeform_section(mesh, NULL, heights, 3, NULL, NULL, &made));
    CHECK(made && made->layer_count == 3 && made->loop_count == 2 && made->point_count == 12);
    CHECK(made && made->layers[0].area == 4 && made->layers[1].length == 8);
    CHECK(made && made->layers[2].loop_count == 0 && made->layers[2].at[2] == 3);
    CHECK(made && made->loops[1].closed && made->loops[1].oriented && made->loops[1].depth == 0);
    CHECK(made && made->loops[1].parent == TREEFORM_NONE && made->faces[0] < 12);
    CHECK(made && made->x[0] == 1 && made->y[1] == 1 && made->normal[2] == 1);
    OK(treeform_write_section(path_in_work("section.svg"), made, NULL));
    OK(treeform_write_section(path_in_work("section.txt"), made, "json"));
    file = fopen(path_in_work("section.txt"), "r");
    CHECK(file != NULL && fgetc(file) == '{');
    if (file) fclose(file);
    ENDS(TREEFORM_FILE, "svg, dxf, obj or json",
         treeform_write_section(path_in_work("section.stl"), made, NULL));
    treeform_free(made);
    OK(treeform_section(mesh, &across, NULL, 0, NULL, NULL, &made));
    CHECK(made && made->layer_count == 1 && made->loop_count == 0);
    treeform_free(made);
    INVALID("normal", treeform_section(mesh, &no_plane, heights, 3, NULL, NULL, &made));
    ENDS(TREEFORM_CANCELLED, "", treeform_section(mesh, NULL, heights, 3, stop, &calls, &made));
    CHECK(calls == 1);
    OK(treeform_layer_heights(mesh, NULL, 0.5, &middles));
    CHECK(middles && middles->count == 4 && middles->heights[3] == 1.75);
    treeform_free(middles);
    INVALID("thickness", treeform_layer_heights(mesh, NULL, 0, &middles));
    treeform_free(mesh);
}

void test_cuts(void) { test_sections(); }
