/* The union of two cubes, from arrays. */
#include <stdio.h>
#include <treeform.h>

static const uint32_t faces[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};

static treeform_mesh* cube(double* points, double at) {
    treeform_mesh* mesh = NULL;
    int i;
    for (i = 0; i < 24; ++i) points[i] = at + (double)(i / 3 >> i % 3 & 1);
    if (treeform_mesh_create(points, 8, faces, 12, 0, &mesh) != TREEFORM_OK)
        fprintf(stderr, "%s\n", treeform_last_error());
    return mesh;
}

int main(void) {
    double first[24], second[24], volume = 0;
    treeform_mesh* a = cube(first, 0.0);
    treeform_mesh* b = cube(second, 0.5);
    treeform_mesh* both = NULL;
    treeform_boolean_result* made = NULL;
    if (treeform_version() != TREEFORM_C_VERSION) return 1;
    if (treeform_unite(a, b, NULL, &made) == TREEFORM_OK &&
        treeform_mesh_create(made->mesh.points, made->mesh.point_count, made->mesh.faces,
                             made->mesh.face_count, 0, &both) == TREEFORM_OK)
        treeform_signed_volume(both, &volume);
    printf("volume %g\n", volume);
    treeform_free(both);
    treeform_free(made);
    treeform_free(b);
    treeform_free(a);
    return volume == 1.875 ? 0 : 1;
}
