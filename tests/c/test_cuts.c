/* Sections, cuts, parts. */
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
    CHECK(made && made->layer_count == 3 && made->loop_count == 2 && made->point_count == 8);
    CHECK(made && made->layers[0].area == 4 && made->layers[1].length == 8);
    CHECK(made && made->layers[2].loop_count == 0 && made->layers[2].at[2] == 3);
    CHECK(made && made->loops[1].closed && made->loops[1].oriented && made->loops[1].depth == 0);
    CHECK(made && made->loops[1].parent == TREEFORM_NONE && made->faces[0] < 12);
    CHECK(made && made->axes[0][0] == 1 && made->axes[1][1] == 1 && made->axes[2][2] == 1);
    OK(treeform_write_section(path_in_work("section.svg"), made, NULL, "mm"));
    OK(treeform_write_section(path_in_work("section.txt"), made, "json", NULL));
    INVALID("yard", treeform_write_section(path_in_work("section.svg"), made, NULL, "yard"));
    file = fopen(path_in_work("section.txt"), "r");
    CHECK(file != NULL && fgetc(file) == '{');
    if (file) fclose(file);
    ENDS(TREEFORM_FILE, "svg, dxf, obj or json",
         treeform_write_section(path_in_work("section.stl"), made, NULL, NULL));
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

static void test_halves(void) {
    treeform_mesh* mesh = cube(0, 0, 0, 2);
    treeform_mesh* open = NULL;
    const treeform_plane across = {{0.5, 0, 0}, {1, 0, 0}};
    const double heights[2] = {0, 1};
    const double fit[3] = {1, 3, 1};
    treeform_cut_options options;
    treeform_cut_result* made = NULL;
    size_t i;
    size_t caps = 0;
    treeform_cut_options_init(&options, sizeof options);
    options.precision = TREEFORM_FLOAT32;
    OK(treeform_cut(mesh, &across, heights, 2, &options, &made));
    CHECK(made && made->count == 3 && made->certificate->status == TREEFORM_STATUS_OK);
    for (i = 0; made && i < made->pieces[1].mesh.face_count; ++i)
        if (made->pieces[1].cap[i] != TREEFORM_NONE) {
            CHECK(made->pieces[1].face_source[i] == TREEFORM_NONE);
            ++caps;
        }
    CHECK(caps > 4 && made && made->pieces[1].vertex_source[0] == TREEFORM_NONE);
    CHECK(made && made->pieces[1].certificate->status == TREEFORM_STATUS_OK);
    treeform_free(made);
    OK(treeform_cut(mesh, NULL, NULL, 0, NULL, &made));
    CHECK(made && made->count == 2 && made->pieces[0].mesh.face_count == 0);
    treeform_free(made);
    OK(treeform_cut_to_fit(mesh, fit, NULL, &made));
    CHECK(made && made->count == 4);
    treeform_free(made);
    OK(treeform_mesh_create(cube_points, 8, cube_faces, 11, 0, &open));
    ENDS(TREEFORM_NOT_CERTIFIED, "", treeform_cut(open, &across, NULL, 0, NULL, &made));
    CHECK(made && made->count == 0);
    treeform_free(made);
    options.caps = 0;
    OK(treeform_cut(open, &across, NULL, 0, &options, &made));
    CHECK(made && made->count == 2);
    treeform_free(made);
    treeform_free(open);
    treeform_free(mesh);
}

static void test_parts(void) {
    const treeform_mesh* both[2];
    treeform_mesh* a = cube(0, 0, 0, 1);
    treeform_mesh* b = cube(5, 0, 0, 2);
    treeform_mesh* all = NULL;
    treeform_made_mesh* made = NULL;
    treeform_mesh_parts* parts = NULL;
    treeform_mass_properties mass;
    const double mirror[12] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    both[0] = a;
    both[1] = b;
    OK(treeform_concatenate(both, 2, &made));
    CHECK(made && made->mesh.point_count == 16 && made->index_count == 24 && made->index[12] == 1);
    OK(treeform_mesh_create(made->mesh.points, 16, made->mesh.faces, 24, 0, &all));
    OK(treeform_components(all, 0, 0, &parts));
    CHECK(parts && parts->count == 2 && near(parts->parts[1].volume, 8));
    CHECK(parts && parts->parts[1].face_source[0] == 12 && parts->parts[1].vertex_source[0] == 8);
    treeform_free(parts);
    OK(treeform_components(all, 0, 1, &parts));
    CHECK(parts && parts->count == 1 && near(parts->parts[0].area, 24));
    treeform_free(parts);
    INVALID("min_volume", treeform_components(all, -1, 0, &parts));
    treeform_free(all);
    treeform_free(made);
    OK(treeform_transform_mesh(b, mirror, &made));
    CHECK(made && made->mesh.points[0] == -5 && made->index == NULL);
    OK(treeform_mesh_create(made->mesh.points, 8, made->mesh.faces, 12, 0, &all));
    OK(treeform_find_mass_properties(all, &mass));
    CHECK(near(mass.volume, 8) && near(mass.center[0], -6) && near(mass.inertia[4], 16.0 / 3));
    treeform_free(all);
    treeform_free(made);
    treeform_free(a);
    treeform_free(b);
}

void test_cuts(void) {
    test_sections();
    test_halves();
    test_parts();
}
