/* Offsets, fewer faces, thickness, boxes, isolines. */
#include "test.h"

#include <math.h>

static void test_offsets(void) {
    treeform_mesh* mesh = cube(0, 0, 0, 2);
    const double points[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const uint32_t faces[6] = {0, 1, 2, 0, 2, 3};
    const double holes[4] = {1, 1, 0, 0.5};
    treeform_mesh* sheet = NULL;
    treeform_offset_options options;
    treeform_offset_result* made = NULL;
    int calls = 0;
    treeform_offset_options_init(&options, sizeof options);
    options.resolution = 0.1;
    OK(treeform_offset(mesh, 0.25, &options, &made));
    CHECK(made && made->certificate->status == TREEFORM_STATUS_OK && made->mesh.face_count > 100);
    CHECK(made && made->resolution == 0.1 && made->least_distance > 0.2 &&
          made->greatest_distance < 0.3);
    treeform_free(made);
    INVALID("distance", treeform_offset(mesh, 0, &options, &made));
    options.progress = stop;
    options.progress_data = &calls;
    ENDS(TREEFORM_CANCELLED, "", treeform_offset(mesh, 0.25, &options, &made));
    OK(treeform_hollow(mesh, 0.25, holes, 1, NULL, &made));
    CHECK(made && made->certificate->status == TREEFORM_STATUS_OK);
    treeform_free(made);
    INVALID("wall", treeform_hollow(mesh, -1, NULL, 0, NULL, &made));
    OK(treeform_mesh_create(points, 4, faces, 2, TREEFORM_COPY, &sheet));
    OK(treeform_thicken(sheet, 0.2, NULL, &made));
    CHECK(made && made->certificate->status == TREEFORM_STATUS_OK);
    treeform_free(made);
    treeform_offset_options_init(&options, sizeof options);
    options.shift = 0.1;
    OK(treeform_thicken(sheet, 0.2, &options, &made));
    CHECK(made && made->certificate->status == TREEFORM_STATUS_OK);
    treeform_free(made);
    options.shift = HUGE_VAL;
    INVALID("shift", treeform_thicken(sheet, 0.2, &options, &made));
    treeform_free(sheet);
    treeform_free(mesh);
}

static void test_simplified(void) {
    treeform_mesh* mesh = cube(0, 0, 0, 2);
    treeform_simplify_options options;
    treeform_simplify_result* made = NULL;
    treeform_simplify_options_init(&options, sizeof options);
    OK(treeform_simplify(mesh, 0.01, &options, &made));
    CHECK(made && made->mesh.face_count == 12 && made->input_to_result_bound <= 0.01);
    CHECK(made && made->vertex_source[0] == 0 && made->face_of_new_vertex[0] == UINT32_MAX);
    treeform_free(made);
    INVALID("max_distance", treeform_simplify(mesh, -1, NULL, &made));
    treeform_free(mesh);
}

static void test_measured_shapes(void) {
    treeform_mesh* mesh = cube(0, 0, 0, 2);
    treeform_thickness_result* walls = NULL;
    treeform_oriented_box* box = NULL;
    OK(treeform_wall_thickness(mesh, TREEFORM_THICKNESS_BY_RAY, NULL, NULL, &walls));
    CHECK(walls && walls->min == 2 && walls->of_face[11] == 2);
    treeform_free(walls);
    OK(treeform_find_oriented_box(mesh, &box));
    CHECK(box && box->size[0] == 2 && box->size[2] == 2 && box->center[1] == 1);
    treeform_free(box);
    treeform_free(mesh);
}

static void test_isolines(void) {
    treeform_mesh* mesh = cube(0, 0, 0, 2);
    double values[8];
    const double levels[2] = {0.5, 1}, normal[3] = {1, 1, 0};
    treeform_isolines_result* lines = NULL;
    treeform_cut_result* pieces = NULL;
    int calls = 0, i = 0;
    for (i = 0; i < 8; ++i) values[i] = 2 * cube_points[3 * i + 2];
    OK(treeform_isolines(mesh, values, levels, 2, NULL, NULL, &lines));
    CHECK(lines && lines->line_count == 2 && lines->lines[0].closed && lines->lines[1].length == 8);
    CHECK(lines && lines->points[3 * lines->lines[1].first_point + 2] == 1);
    OK(treeform_write_isolines(path_in_work("lines.obj"), lines, NULL, NULL, NULL));
    OK(treeform_write_isolines(path_in_work("lines.txt"), lines, normal, "svg", "in"));
    INVALID("normal",
            treeform_write_isolines(path_in_work("lines.svg"), lines, values, NULL, NULL));
    treeform_free(lines);
    ENDS(TREEFORM_CANCELLED, "", treeform_isolines(mesh, values, levels, 2, stop, &calls, &lines));
    INVALID("values", treeform_isolines(mesh, NULL, levels, 2, NULL, NULL, &lines));
    OK(treeform_cut_along(mesh, values, levels, 2, NULL, &pieces));
    CHECK(pieces && pieces->count == 3 && pieces->pieces[1].mesh.face_count > 8);
    treeform_free(pieces);
    treeform_free(mesh);
}

void test_shapes(void) {
    test_offsets();
    test_simplified();
    test_measured_shapes();
    test_isolines();
}
