/* Points merged. */
#include "test.h"

#include <string.h>

static const double scan[12] = {0, 0, 0, 0.004, 0, 0, 1, 0, 0, 1, 0.01, 0};

static int never(uint32_t a, uint32_t b, void* asked) {
    (void)a;
    (void)b;
    *(int*)asked = 1;
    return 0;
}

static void test_cloud(void) {
    treeform_mesh* cloud = NULL;
    treeform_weld_options options;
    treeform_weld_result* result = NULL;
    const uint32_t labels[4] = {0, 1, 2, 2};
    uint64_t count = 9;
    int asked = 0, calls = 0;
    OK(treeform_mesh_create(scan, 4, NULL, 0, 0, &cloud));
    treeform_weld_options_init(&options, sizeof options);
    options.tolerance = 0.01;
    OK(treeform_weld(cloud, &options, &result));
    CHECK(result->mesh.point_count == 2 && result->mesh.face_count == 0);
    CHECK(result->point_count == 4 && result->group_of_point[3] == 1 && result->group_count == 2);
    CHECK(result->first_of_group[1] == 2 && result->merged_groups == 2);
    CHECK(result->max_displacement >= 0.01 && result->max_displacement < 0.0101);
    treeform_free(result);
    options.label = labels;
    options.label_count = 4;
    OK(treeform_weld(cloud, &options, &result));
    CHECK(result->mesh.point_count == 3);
    treeform_free(result);
    options.label_count = 3;
    INVALID("label", treeform_weld(cloud, &options, &result));
    options.label_count = 0;
    options.may_merge = never;
    options.may_merge_data = &asked;
    OK(treeform_group_points(cloud, &options, &result));
    CHECK(result->group_count == 4 && asked == 1 && result->mesh.point_count == 0);
    treeform_free(result);
    treeform_weld_options_init(&options, sizeof options);
    options.tolerance = -1.0;
    INVALID("", treeform_weld(cloud, &options, &result));
    options.tolerance = 0.01;
    options.progress = stop;
    options.progress_data = &calls;
    ENDS(TREEFORM_CANCELLED, "", treeform_weld(cloud, &options, &result));
    OK(treeform_count_nearly_equal(cloud, 0.005, &count));
    CHECK(count == 1 && result == NULL);
    treeform_free(cloud);
}

static void test_mesh(void) {
    const double points[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1.001, 0};
    const uint32_t faces[6] = {0, 1, 2, 3, 4, 5};
    treeform_mesh* mesh = NULL;
    treeform_weld_options options;
    treeform_weld_result* result = NULL;
    OK(treeform_mesh_create(points, 6, faces, 2, 0, &mesh));
    treeform_weld_options_init(&options, sizeof options);
    options.tolerance = 0.01;
    options.keep = TREEFORM_KEEP_MEAN;
    OK(treeform_weld(mesh, &options, &result));
    CHECK(result->mesh.point_count == 4 && result->mesh.face_count == 2);
    CHECK(near(result->mesh.points[7], 1.0005) && result->face_source[1] == 1);
    treeform_free(result);
    options.keep = 5;
    INVALID("keep is 5", treeform_weld(mesh, &options, &result));
    treeform_free(mesh);
}

static void test_file(void) {
    static const char csv[] = "x,y,z,class\n0,0,0,1\n0.004,0,0,2\n1,0,0,1\n1,0.01,0,1\n";
    treeform_file* file = NULL;
    treeform_weld_options options;
    treeform_weld_condition same;
    treeform_weld_result* result = NULL;
    treeform_file_view* view = NULL;
    const treeform_column* last;
    uint64_t count = 9;
    int32_t known = 9;
    OK(treeform_read_memory(csv, sizeof csv - 1, NULL, "csv", &file));
    treeform_weld_options_init(&options, sizeof options);
    options.tolerance = 0.01;
    same.property = "class";
    same.tolerance = 0.0;
    options.same = &same;
    options.same_count = 1;
    OK(treeform_weld_file(file, &options, &result));
    CHECK(result->mesh.point_count == 3 && result->vertex_source[1] == 1);
    OK(treeform_count_mergeable(result->file, &options, TREEFORM_FLOAT32, &count, &known));
    CHECK(known == 1 && count == 0);
    OK(treeform_withhold(file, result));
    OK(treeform_file_content(file, &view));
    last = view->elements[0].columns + view->elements[0].column_count - 1;
    CHECK(is(last->name, "withheld") && last->value_count == 4);
    CHECK(((const uint8_t*)last->values)[2] == 0 && ((const uint8_t*)last->values)[3] == 1);
    treeform_free(view);
    treeform_free(result);
    same.property = "color";
    INVALID("color", treeform_weld_file(file, &options, &result));
    same.property = NULL;
    INVALID("null", treeform_weld_file(file, &options, &result));
    treeform_free(file);
}

void test_weld(void) {
    test_cloud();
    test_mesh();
    test_file();
}
