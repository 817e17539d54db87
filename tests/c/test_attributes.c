/* Attributes carried to results; colors. */
#include "test.h"

#include <string.h>

/* The column of that name of that element; null where there is none. */
static const treeform_column* column(const treeform_file_view* view, const char* element,
                                     const char* name) {
    size_t e, c;
    for (e = 0; e < view->element_count; ++e)
        for (c = 0; c < view->elements[e].column_count; ++c)
            if (is(view->elements[e].name, element) && is(view->elements[e].columns[c].name, name))
                return &view->elements[e].columns[c];
    return NULL;
}

static treeform_file* colored_cube(const treeform_mesh* mesh, uint8_t color) {
    uint8_t red[12];
    treeform_file* file = NULL;
    memset(red, color, sizeof red);
    OK(treeform_file_create(mesh, &file));
    OK(treeform_file_set_column(file, "face", "red", TREEFORM_UINT8, red, 12));
    OK(treeform_file_add_part(file, NULL, NULL, "paint", 0));
    OK(treeform_file_add_text(file, TREEFORM_MATERIAL_FILE, color == 10 ? "a.mtl" : "b.mtl"));
    return file;
}

static void test_of_two(void) {
    treeform_mesh* a = cube(0, 0, 0, 1);
    treeform_mesh* b = cube(0.5, 0.25, 0.25, 1);
    treeform_file* files[2];
    treeform_file* made_file = NULL;
    treeform_mesh* made_mesh = NULL;
    treeform_file_view* view = NULL;
    treeform_written* written = NULL;
    treeform_attribute_source sources[2];
    treeform_boolean_result* made = NULL;
    treeform_indices* groups = NULL;
    const char* const names[2] = {"a.stl", "b.stl"};
    const treeform_column* red;
    size_t f;
    int right = 1;
    files[0] = colored_cube(a, 10);
    files[1] = colored_cube(b, 20);
    memset(sources, 0, sizeof sources);
    sources[0].file = files[0];
    sources[1].file = files[1];
    OK(treeform_unite(a, b, NULL, &made));
    OK(treeform_mesh_of(&made->mesh, 0, &made_mesh));
    OK(treeform_file_create(made_mesh, &made_file));
    OK(treeform_transfer_attributes(made_file, sources, 2, made->face_source, made->vertex_source,
                                    NULL));
    OK(treeform_write(path_in_work("of_two.obj"), made_file, NULL, &written));
    CHECK(written->warning_count == 1 && strstr(written->warnings[0].text, "material paint;"));
    treeform_free(written);
    OK(treeform_add_source_columns(made_file, "from", made->face_source, names, 2));
    OK(treeform_file_content(made_file, &view));
    red = column(view, "face", "red");
    CHECK(red != NULL && column(view, "face", "from_mesh") != NULL);
    for (f = 0; red && f < made->mesh.face_count; ++f)
        right = right &&
                ((const uint8_t*)red->values)[f] == (made->face_source[f].operand == 0 ? 10 : 20);
    CHECK(right);
    treeform_free(view);
    OK(treeform_face_groups(sources, 2, 1, 0, &groups));
    CHECK(groups->count == 24 && groups->values[0] != groups->values[12]);
    treeform_free(groups);
    OK(treeform_corner_groups(sources, &groups));
    CHECK(groups->count == 36);
    treeform_free(groups);
    INVALID("operand 1", treeform_transfer_attributes(made_file, sources, 1, made->face_source,
                                                      made->vertex_source, NULL));
    treeform_free(made_file);
    treeform_free(made_mesh);
    treeform_free(made);
    treeform_free(files[0]);
    treeform_free(files[1]);
    treeform_free(a);
    treeform_free(b);
}

static void test_of_one(void) {
    treeform_mesh* mesh = cube(0, 0, 0, 1);
    treeform_file* file = colored_cube(mesh, 30);
    treeform_file* part_file = NULL;
    treeform_mesh* part_mesh = NULL;
    treeform_made_mesh* part = NULL;
    treeform_file_view* view = NULL;
    treeform_attribute_source source;
    const uint32_t seen[11] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    const uint32_t wrong[1] = {12};
    const uint32_t faces[1] = {0}, vertices[3] = {1, 3, TREEFORM_NONE}, out[1] = {11};
    OK(treeform_select_faces(mesh, seen, 1, &part));
    OK(treeform_mesh_create(part->mesh.points, 3, part->mesh.faces, 1, 0, &part_mesh));
    OK(treeform_file_create(part_mesh, &part_file));
    memset(&source, 0, sizeof source);
    source.file = file;
    source.triangle_of_face = seen;
    source.face_count = 11;
    OK(treeform_transfer_attributes_of_one(part_file, &source, faces, vertices, NULL, NULL));
    OK(treeform_file_content(part_file, &view));
    CHECK(column(view, "face", "red") != NULL);
    treeform_free(view);
    INVALID("face_source names 11",
            treeform_transfer_attributes_of_one(part_file, &source, out, vertices, NULL, NULL));
    source.triangle_of_face = wrong;
    source.face_count = 1;
    INVALID("triangle 12",
            treeform_transfer_attributes_of_one(part_file, &source, faces, vertices, NULL, NULL));
    treeform_free(part_file);
    treeform_free(part_mesh);
    treeform_free(part);
    treeform_free(file);
    treeform_free(mesh);
}

static void test_colors(void) {
    const double distances[8] = {-1, 0, 1, 0, 0, 0, 0, 0};
    uint8_t relations[12] = {1, 2, 3};
    treeform_mesh* mesh = cube(0, 0, 0, 1);
    treeform_file* file = NULL;
    treeform_file_view* view = NULL;
    OK(treeform_file_create(mesh, &file));
    OK(treeform_color_distances(file, distances, 8, -1.0, 1.0));
    INVALID("", treeform_color_distances(file, distances, 7, -1.0, 1.0));
    OK(treeform_color_contacts(file, relations, 12, 0.0));
    relations[5] = 5;
    INVALID("relation is 5", treeform_color_contacts(file, relations, 12, 0.0));
    OK(treeform_file_content(file, &view));
    CHECK(column(view, "vertex", "distance") != NULL && column(view, "face", "tf_class") != NULL);
    treeform_free(view);
    treeform_free(file);
    treeform_free(mesh);
}

void test_attributes(void) {
    test_of_two();
    test_of_one();
    test_colors();
}
