/* Volumes, defects, features, hulls, predicates. */
#include "test.h"

#include <math.h>

static void test_measures(void) {
    treeform_mesh* mesh = cube(1, 2, 3, 2);
    treeform_mesh* empty = NULL;
    treeform_mesh* bad = NULL;
    double points[24], value = 0.0;
    treeform_box box;
    int32_t solid = 0;
    int i;
    OK(treeform_signed_volume(mesh, &value));
    CHECK(value == 8.0);
    OK(treeform_surface_area(mesh, &value));
    CHECK(value == 24.0);
    OK(treeform_bounding_box(mesh, &box));
    CHECK(box.min[0] == 1.0 && box.min[2] == 3.0 && box.max[1] == 4.0);
    OK(treeform_is_solid(mesh, &solid));
    CHECK(solid == 1);
    OK(treeform_mesh_create(NULL, 0, NULL, 0, 0, &empty));
    OK(treeform_bounding_box(empty, &box));
    CHECK(box.min[0] > box.max[0]);
    OK(treeform_surface_area(empty, &value));
    CHECK(value == 0.0);
    for (i = 0; i < 24; ++i) points[i] = cube_points[i];
    points[4] = (double)NAN;
    OK(treeform_mesh_create(points, 8, cube_faces, 12, 0, &bad));
    INVALID("face 0", treeform_signed_volume(bad, &value));
    INVALID("face 0", treeform_surface_area(bad, &value));
    OK(treeform_is_solid(bad, &solid));
    CHECK(!solid);
    INVALID("null", treeform_signed_volume(mesh, NULL));
    treeform_free(mesh);
    treeform_free(empty);
    treeform_free(bad);
}

static void test_open_mesh(void) {
    treeform_mesh* open = NULL;
    treeform_mesh* closed = cube(0, 0, 0, 1);
    treeform_certificate* certificate = NULL;
    treeform_topology_counts* topology = NULL;
    treeform_invalid_faces* defects = NULL;
    uint32_t edge[2] = {0, 0}, component[12];
    const double tolerances[2] = {0.5, 0.75};
    double apart[24];
    size_t count = 0, which = 9;
    int32_t same = 0;
    int calls = 0, i;
    OK(treeform_mesh_create(cube_points, 8, cube_faces, 11, 0, &open));
    OK(treeform_check_operand(open, NULL, NULL, &certificate));
    CHECK(certificate->status == TREEFORM_STATUS_OPEN_INPUT && certificate->open_count == 3);
    CHECK(certificate->open_listed == 3 && certificate->message[0] != 0);
    treeform_free(certificate);
    OK(treeform_check_operand(closed, NULL, NULL, &certificate));
    CHECK(certificate->status == TREEFORM_STATUS_OK);
    treeform_free(certificate);
    (void)calls;
    OK(treeform_count_topology(open, &topology));
    CHECK(topology->edges == 18 && topology->boundary_edges == 3 && topology->closed_manifold == 0);
    CHECK(topology->faces == 11 && topology->points_used == 8);
    treeform_free(topology);
    OK(treeform_face_components(closed, component, &count));
    CHECK(count == 1 && component[11] == 0);
    OK(treeform_find_open_edge(open, edge));
    CHECK(edge[0] == 3 && edge[1] == 5);
    OK(treeform_find_open_edge(closed, edge));
    CHECK(edge[0] == TREEFORM_NONE && edge[1] == TREEFORM_NONE);
    OK(treeform_closing_tolerance(closed, tolerances, 2, &which));
    CHECK(which == 2);
    OK(treeform_same_triangles(open, open, 0, &same));
    CHECK(same == 1);
    OK(treeform_same_triangles(open, closed, 1, &same));
    CHECK(same == 0);
    for (i = 0; i < 24; ++i) apart[i] = cube_points[i];
    apart[3] = (double)INFINITY;
    treeform_free(open);
    OK(treeform_mesh_create(apart, 8, cube_faces, 12, 0, &open));
    OK(treeform_find_invalid_faces(open, &defects));
    CHECK(defects->nonfinite_point_count == 1 && defects->nonfinite_points[0] == 1);
    CHECK(defects->nonfinite_face_count == 5 && defects->degenerate_face_count == 0);
    treeform_free(defects);
    treeform_free(open);
    treeform_free(closed);
}

static void test_features(void) {
    treeform_mesh* mesh = cube(0, 0, 0, 2);
    treeform_features* features = NULL;
    treeform_feature_options options;
    const double top[3] = {1, 1, 5};
    const uint32_t faces[2] = {0, 1};
    OK(treeform_find_features(mesh, TREEFORM_PLANE, NULL, &features));
    CHECK(features->count == 6 && near(features->features[5].area, 4.0));
    CHECK(features->features[0].face_count == 2);
    treeform_free(features);
    OK(treeform_feature_at_face(mesh, TREEFORM_PLANE, 2, NULL, &features));
    CHECK(features->count == 1 && near(features->features[0].direction[2], 1.0));
    treeform_free(features);
    INVALID("12", treeform_feature_at_face(mesh, TREEFORM_PLANE, 12, NULL, &features));
    OK(treeform_feature_at_point(mesh, TREEFORM_PLANE, top, NULL, &features));
    CHECK(features->count == 1 && near(features->features[0].origin[2], 2.0));
    treeform_free(features);
    OK(treeform_fit_feature(mesh, TREEFORM_PLANE, faces, 2, &features));
    CHECK(features->count == 1 && near(features->features[0].direction[2], -1.0));
    treeform_free(features);
    treeform_feature_options_init(&options, sizeof options);
    options.plane_angle = -1.0;
    INVALID("", treeform_find_features(mesh, TREEFORM_PLANE, &options, &features));
    INVALID("kind is 7", treeform_find_features(mesh, 7, NULL, &features));
    treeform_free(mesh);
}

static void test_hull(void) {
    treeform_mesh* cloud = NULL;
    treeform_hull* hull = NULL;
    OK(treeform_mesh_create(cube_points, 8, NULL, 0, 0, &cloud));
    OK(treeform_convex_hull(cloud, NULL, NULL, &hull));
    CHECK(hull->dimension == 3 && hull->face_count == 12 && hull->side_count == 6);
    CHECK(hull->sides[0].area == 1.0 && hull->corner_begin[6] == 24);
    CHECK(hull->corners[0] < 8);
    CHECK(hull->mesh.point_count == 8 && hull->mesh.face_count == 12);
    treeform_free(hull);
    treeform_free(cloud);
}

static void test_predicates(void) {
    const double a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0, 1, 0}, d[3] = {0, 0, 1e-300};
    const double nowhere[3] = {0, (double)NAN, 0};
    const double first[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const double through[9] = {0.25, 0.25, -1, 0.25, 0.25, 1, 2, 2, 0};
    const double away[9] = {0, 0, 5, 1, 0, 5, 0, 1, 5};
    treeform_triangle_contact contact;
    int32_t sign = 0;
    OK(treeform_orient2d(a, b, c, &sign));
    CHECK(sign == 1);
    OK(treeform_orient3d(a, b, c, d, &sign));
    CHECK(sign == 1);
    OK(treeform_compare_distance(a, b, a, d, &sign));
    CHECK(sign == 1);
    INVALID("d is not finite", treeform_orient3d(a, b, c, nowhere, &sign));
    INVALID("b is not finite", treeform_orient2d(a, nowhere, c, &sign));
    OK(treeform_intersect_triangles(first, through, &contact));
    CHECK(contact.dimension == 1 && contact.crossing == 1 && contact.coplanar == 0);
    OK(treeform_intersect_triangles(first, first, &contact));
    CHECK(contact.dimension == 2 && contact.coplanar == 1);
    OK(treeform_intersect_triangles(first, away, &contact));
    CHECK(contact.dimension == -1);
}

void test_properties(void) {
    test_measures();
    test_open_mesh();
    test_features();
    test_hull();
    test_predicates();
}
