/* Files: read, looked into, changed, written; robots. */
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char ply[] =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty double x\n"
    "property double y\nproperty double z\nproperty uchar red\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n"
    "0 0 0 7\n1 0 0 8\n1 1 0 9\n0 1 0 10\n4 0 1 2 3\n";

static void test_look(void) {
    treeform_file* file = NULL;
    treeform_file* copy = NULL;
    treeform_file_view* view = NULL;
    OK(treeform_read_memory(ply, sizeof ply - 1, "square", "ply", &file));
    OK(treeform_file_copy(file, &copy));
    treeform_free(file);
    OK(treeform_file_content(copy, &view));
    CHECK(view->mesh.point_count == 4 && view->mesh.face_count == 2 && view->stored_faces == 1);
    CHECK(view->face_of_triangle[1] == 0 && view->indexed == 1 && is(view->format, "ply-ascii"));
    CHECK(view->element_count == 2 && is(view->elements[0].name, "vertex"));
    CHECK(view->elements[0].column_count == 4 && is(view->elements[0].columns[3].name, "red"));
    CHECK(view->elements[0].columns[0].is_stored_elsewhere == 1);
    CHECK(view->elements[0].columns[3].type == TREEFORM_UINT8);
    CHECK(((const uint8_t*)view->elements[0].columns[3].values)[2] == 9);
    CHECK(view->comment_count == 1 && is(view->comments[0], "by hand"));
    CHECK(view->texture == NULL && view->is_las == 0 && view->warning_count == 0);
    treeform_free(view);
    treeform_free(copy);
}

static void test_change(void) {
    const double moved[12] = {0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    const float heat[4] = {1, 2, 3, 4};
    const double uv[6] = {0, 0, 0, 1, 1, 0};
    const double turned[12] = {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0};
    const double mirror[12] = {-1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
    const double nowhere[12] = {HUGE_VAL, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    const uint32_t of_corner[6] = {0, 1, 1, 0, 1, TREEFORM_NONE};
    const uint32_t wrong[6] = {0, 1, 2, 0, 1, 1};
    treeform_file* file = NULL;
    treeform_file_view* view = NULL;
    double furthest = 9.0;
    OK(treeform_read_memory(ply, sizeof ply - 1, NULL, "ply", &file));
    OK(treeform_file_set_points(file, moved, 4));
    INVALID("3 points", treeform_file_set_points(file, moved, 3));
    OK(treeform_file_set_column(file, "vertex", "heat", TREEFORM_SCALAR_FLOAT32, heat, 4));
    INVALID("4 rows", treeform_file_set_column(file, "vertex", "heat", TREEFORM_INT8, heat, 3));
    INVALID("stands for",
            treeform_file_set_column(file, "vertex", "x", TREEFORM_SCALAR_FLOAT32, heat, 4));
    INVALID("type is 10", treeform_file_set_column(file, "vertex", "heat", 10, heat, 4));
    OK(treeform_file_split_polygons(file));
    OK(treeform_file_set_texture(file, uv, 2, of_corner));
    INVALID("", treeform_file_set_texture(file, uv, 2, wrong));
    OK(treeform_file_add_part(file, "lid", NULL, "steel", 0));
    INVALID("face 3", treeform_file_add_part(file, "lid", NULL, NULL, 3));
    OK(treeform_file_add_text(file, TREEFORM_COMMENT, "turned"));
    INVALID("kind is 9", treeform_file_add_text(file, 9, "turned"));
    OK(treeform_file_transform_normals(file, turned));
    OK(treeform_file_transform(file, mirror));
    OK(treeform_file_transform(file, mirror));
    INVALID("not finite", treeform_file_transform(file, nowhere));
    OK(treeform_file_round_to_float32(file, &furthest));
    CHECK(furthest == 0.0);
    OK(treeform_file_round_to_las(file, &furthest));
    CHECK(furthest < 1e-6);
    OK(treeform_file_content(file, &view));
    CHECK(view->mesh.points[2] == 1.0 && view->face_of_triangle == NULL && view->stored_faces == 2);
    CHECK(is(view->elements[0].columns[4].name, "heat"));
    CHECK(((const float*)view->elements[0].columns[4].values)[3] == 4.0f);
    CHECK(view->texture_count == 2 && view->texture_of_corner[5] == TREEFORM_NONE);
    CHECK(view->part_count == 1 && is(view->parts[0].material, "steel"));
    CHECK(is(view->parts[0].group, "") && view->comment_count == 2);
    treeform_free(view);
    treeform_free(file);
}

static void test_write(void) {
    treeform_mesh* mesh = cube(0.1, 0, 0, 1);
    treeform_file* file = NULL;
    treeform_file* back = NULL;
    treeform_file_view* view = NULL;
    treeform_written* written = NULL;
    treeform_bytes* bytes = NULL;
    treeform_write_options options;
    const char* const path = path_in_work("cube.ply");
    int calls = 0;
    OK(treeform_file_create(mesh, &file));
    OK(treeform_write(path, file, NULL, &written));
    CHECK(is(written->format, "ply-binary-le") && written->written_as == TREEFORM_FLOAT64);
    CHECK(written->max_displacement == 0.0);
    treeform_free(written);
    OK(treeform_read(path, NULL, &back));
    OK(treeform_file_content(back, &view));
    CHECK(view->mesh.point_count == 8 && view->mesh.points[0] == 0.1);
    treeform_free(view);
    treeform_free(back);
    treeform_write_options_init(&options, sizeof options);
    options.format = "off";
    OK(treeform_write_memory(file, &options, &bytes));
    CHECK(bytes->count > 3 && memcmp(bytes->bytes, "OFF", 3) == 0);
    treeform_free(bytes);
    options.format = "stl";
    OK(treeform_write_mesh(path_in_work("cube.stl"), mesh, &options, &written));
    CHECK(written->written_as == TREEFORM_FLOAT32 && written->max_displacement > 0.0);
    treeform_free(written);
    options.progress = stop;
    options.progress_data = &calls;
    ENDS(TREEFORM_CANCELLED, "", treeform_write(path_in_work("none.stl"), file, &options, NULL));
    CHECK(calls == 1);
    ENDS(TREEFORM_FILE, "none", treeform_read(path_in_work("none.stl"), NULL, &back));
    options.progress = NULL;
    options.precision = 5;
    INVALID("precision is 5, which is not from 0 to 1", treeform_write(path, file, &options, NULL));
    ENDS(TREEFORM_FILE, "cube: the path has no extension, and no format is given",
         treeform_write(path_in_work("cube"), file, NULL, NULL));
    ENDS(TREEFORM_FILE, "nowhere", treeform_write("/nowhere/at/all.ply", file, NULL, NULL));
    ENDS(TREEFORM_FILE, "no_such", treeform_read("no_such.stl", NULL, &back));
    ENDS(TREEFORM_FILE, "damaged", treeform_read_memory("ply\n", 4, "damaged", "ply", &back));
    CHECK(back == NULL);
    INVALID("path is null", treeform_read(NULL, NULL, &back));
    treeform_free(file);
    treeform_free(mesh);
}

/* Whether the first line of a file is this one. */
static int begins_with(const char* path, const char* text) {
    char line[200] = "";
    FILE* const in = fopen(path, "r");
    CHECK(in != NULL && fgets(line, sizeof line, in) != NULL);
    if (in) fclose(in);
    return is(line, text);
}

static void test_links(void) {
    const char* const path = path_in_work("linked.obj");
    treeform_file* file = NULL;
    treeform_file_view* view = NULL;
    treeform_bytes* bytes = NULL;
    treeform_write_options options;
    FILE* const out = fopen(path, "w");
    CHECK(out != NULL && fputs("mtllib no/a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", out) >= 0);
    fclose(out);
    OK(treeform_read(path, NULL, &file));
    OK(treeform_file_content(file, &view));
    CHECK(view->material_file_count == 1 && strstr(view->material_files[0], "/./no/a.mtl"));
    treeform_free(view);
    OK(treeform_write(path_in_work("again.obj"), file, NULL, NULL));
    CHECK(begins_with(path_in_work("again.obj"), "mtllib no/a.mtl\n"));
    OK(treeform_write(path_in_work("../beside.obj"), file, NULL, NULL));
    CHECK(begins_with(path_in_work("../beside.obj"), "mtllib work/no/a.mtl\n"));
    treeform_write_options_init(&options, sizeof options);
    options.format = "obj";
    OK(treeform_write_memory(file, &options, &bytes));
    CHECK(bytes->count > 16 && memcmp(bytes->bytes, "mtllib no/a.mtl\n", 16) == 0);
    treeform_free(bytes);
    treeform_free(file);
}

static void test_columns(void) {
    const char* const table = "id;E;N;H\n7;1;2;3\n8;4;nan;6\n9;7;8;9\n";
    const treeform_named_column columns[] = {{"x", "E"}, {"y", "N"}, {"z", "4"}};
    const treeform_named_column rename[] = {{"number", "id"}};
    const char* const drop[] = {"number"};
    const double scale[] = {0.5, 0.5, 0.5};
    const char* const path = path_in_work("table.csv");
    treeform_read_options how;
    treeform_write_options options;
    treeform_file* file = NULL;
    treeform_file_view* view = NULL;
    FILE* out = fopen(path, "w");
    CHECK(out != NULL && fputs(table, out) >= 0 && fclose(out) == 0);
    treeform_read_options_init(&how, sizeof how);
    how.columns = columns;
    how.column_count = 3;
    how.drop_non_finite = 1;
    OK(treeform_read_as(path, &how, &file));
    treeform_write_options_init(&options, sizeof options);
    options.rename = rename;
    options.rename_count = 1;
    options.las_scale = scale;
    OK(treeform_write(path_in_work("table.las"), file, &options, NULL));
    treeform_free(file);
    OK(treeform_read(path_in_work("table.las"), NULL, &file));
    OK(treeform_file_content(file, &view));
    CHECK(view->mesh.point_count == 2 && view->mesh.points[3] == 7.0);
    CHECK(view->las_scale[0] == 0.5);
    CHECK(is(view->elements[0].columns[view->elements[0].column_count - 1].name, "number"));
    treeform_free(view);
    treeform_write_options_init(&options, sizeof options);
    options.drop = drop;
    options.drop_count = 1;
    OK(treeform_write(path_in_work("table.ply"), file, &options, NULL));
    INVALID("rename", (options.rename_count = 1,
                       treeform_write(path_in_work("table.ply"), file, &options, NULL)));
    treeform_free(file);
    file = NULL;
    how.format = "stl";
    ENDS(TREEFORM_FILE, "", treeform_read_as(path, &how, &file));
}

static void test_parts(void) {
    treeform_file* file = NULL;
    treeform_file* sphere = NULL;
    treeform_file* boxed = NULL;
    treeform_mesh* box_mesh = cube(5, 5, 5, 1);
    treeform_file* joined = NULL;
    treeform_file* scene = NULL;
    treeform_file_view* view = NULL;
    const treeform_file* both[2];
    const char* names[2] = {"soup", "ball"};
    treeform_usable_mesh* part = NULL;
    treeform_mesh* mesh = NULL;
    treeform_arrays arrays;
    treeform_usable_options options;
    treeform_scene_parts* parts = NULL;
    const treeform_box box = {{-10, -10, -10}, {10, 10, 0}};
    OK(treeform_read("data/two_spheres.stl", NULL, &file));
    OK(treeform_as_mesh(file, &part));
    CHECK(part->mesh.face_count == 640 && part->mesh.point_count == 1920 && part->non_finite == 0);
    OK(treeform_read_mesh("data/two_spheres.stl", NULL, &mesh));
    OK(treeform_mesh_arrays(mesh, &arrays));
    CHECK(arrays.face_count == 640 && arrays.point_count == 1920);
    CHECK(memcmp(arrays.faces, part->mesh.faces, 640 * 3 * sizeof *arrays.faces) == 0);
    treeform_free(mesh);
    CHECK(treeform_read_mesh("data/none.stl", NULL, &mesh) == TREEFORM_FILE && mesh == NULL);
    CHECK(part->triangle_of_face == NULL && part->face_in_file[639] == 639);
    treeform_free(part);
    treeform_usable_options_init(&options, sizeof options);
    options.details = 1;
    OK(treeform_usable_faces(file, &options, &part));
    CHECK(part->mesh.face_count == 640 && part->mesh.point_count == 324);
    CHECK(part->component[0] == 0 && part->component[639] == 1 && part->degenerate == 0);
    treeform_free(part);
    options.box = &box;
    OK(treeform_usable_faces(file, &options, &part));
    CHECK(part->mesh.face_count < 640 && part->triangle_of_face != NULL);
    treeform_free(part);
    options.vertices = 4;
    INVALID("vertices is 4", treeform_usable_faces(file, &options, &part));
    OK(treeform_read("data/sphere.ply", NULL, &sphere));
    both[0] = file;
    both[1] = sphere;
    OK(treeform_concatenate_files(both, names, 2, &joined));
    OK(treeform_file_content(joined, &view));
    CHECK(view->mesh.face_count == 640 + 1280);
    treeform_free(view);
    treeform_free(joined);
    OK(treeform_file_create(box_mesh, &boxed));
    both[0] = boxed;
    OK(treeform_scene_of(both, names, 2, &scene));
    OK(treeform_file_parts(scene, 1, &parts));
    CHECK(parts->count == 2);
    if (parts->count == 2) {
        CHECK(is(parts->parts[0].name, "soup") && is(parts->parts[1].name, "ball"));
        CHECK(parts->parts[1].face_count == 1280 && parts->parts[1].face_in_file[0] == 12);
        OK(treeform_file_content(parts->parts[1].file, &view));
        CHECK(view->mesh.point_count == 642);
        treeform_free(view);
    }
    treeform_free(parts);
    INVALID("no files", treeform_concatenate_files(both, names, 0, &joined));
    CHECK(joined == NULL);
    CHECK(treeform_reads_scenes() == 0 || treeform_reads_scenes() == 1);
    treeform_free(scene);
    treeform_free(boxed);
    treeform_free(box_mesh);
    treeform_free(file);
    treeform_free(sphere);
}

static void test_robots(void) {
    static const char urdf[] =
        "<robot name=\"arm\"><link name=\"base\"/><link name=\"hand\"><collision><geometry>"
        "<mesh filename=\"hand.stl\"/></geometry></collision><collision><geometry>"
        "<box size=\"1 2 3\"/></geometry></collision></link><joint name=\"turn\" "
        "type=\"revolute\"><parent link=\"base\"/><child link=\"hand\"/><axis xyz=\"0 0 1\"/>"
        "<limit lower=\"-1\" upper=\"2\"/></joint></robot>";
    const char* const joints[1] = {"turn"};
    const double quarter = acos(0.0);
    double places[24];
    treeform_mesh* mesh = cube(0, 0, 0, 1);
    treeform_robot* robot = NULL;
    treeform_robot_view* view = NULL;
    treeform_robot_parts* parts = NULL;
    treeform_box bounds;
    FILE* const out = fopen(path_in_work("arm.urdf"), "wb");
    CHECK(out != NULL && fwrite(urdf, 1, sizeof urdf - 1, out) == sizeof urdf - 1);
    fclose(out);
    OK(treeform_write_mesh(path_in_work("hand.stl"), mesh, NULL, NULL));
    OK(treeform_read_urdf(path_in_work("arm.urdf"), NULL, 0, 0, &robot));
    OK(treeform_robot_content(robot, &view));
    CHECK(is(view->name, "arm") && view->link_count == 2 && is(view->links[1], "hand"));
    CHECK(view->joint_count == 1 && view->joints[0].kind == 1 && view->joints[0].upper == 2.0);
    CHECK(view->mesh_count == 2 && view->meshes[0].link == 1 && view->meshes[0].place[0] == 1.0);
    CHECK(strstr(view->meshes[0].file, "hand.stl") != NULL && view->adjacent_count == 1);
    CHECK(view->meshes[0].face_count == 0 && is(view->meshes[1].file, ""));
    CHECK(view->meshes[1].point_count == 8 && view->meshes[1].face_count == 12);
    CHECK(view->meshes[1].points[2] == -1.5 && view->meshes[1].faces[35] == 5);
    treeform_free(view);
    OK(treeform_link_transforms(robot, joints, &quarter, 1, places));
    CHECK(places[0] == 1.0 && near(places[12], 0.0) && near(places[13], -1.0));
    INVALID("null", treeform_link_transforms(robot, joints, &quarter, 1, NULL));
    OK(treeform_robot_parts_of(robot, &parts));
    CHECK(parts->count == 1 && parts->links[0] == 1 && parts->adjacent_count == 0);
    OK(treeform_bounding_box(parts->meshes[0], &bounds));
    CHECK(bounds.min[2] == -1.5 && bounds.max[0] == 1.0 && bounds.max[2] == 1.5);
    treeform_free(parts);
    INVALID("robot is null", treeform_robot_parts_of(NULL, &parts));
    treeform_free(robot);
    ENDS(TREEFORM_FILE, "", treeform_read_urdf("data/cube.stl", NULL, 0, 0, &robot));
    CHECK(robot == NULL);
    treeform_free(mesh);
}

void test_files(void) {
    test_look();
    test_change();
    test_write();
    test_links();
    test_columns();
    test_parts();
    test_robots();
}
