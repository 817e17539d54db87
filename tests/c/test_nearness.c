/* Distances, inside and outside, rays, relations, deviation. */
#include "test.h"

#include <math.h>
#include <string.h>

static void test_distances(void) {
    treeform_mesh* a = cube(0, 0, 0, 1);
    treeform_mesh* b = cube(3, 0, 0, 1);
    const double queries[6] = {0.5, 0.5, 2.0, 0.5, 0.5, 9.0};
    const double bad[3] = {0, (double)NAN, 0};
    const double moves[24] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0,
                              1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0};
    uint32_t faces[2];
    double distances[2], points[6], distance = 0.0;
    treeform_closest closest;
    OK(treeform_closest_point(a, queries, 2, 1.5, faces, distances, points));
    CHECK(faces[0] == 2 && distances[0] == 1.0 && points[2] == 1.0);
    CHECK(faces[1] == TREEFORM_NONE && distances[1] > 1e300 && isnan(points[3]));
    OK(treeform_closest_point(a, queries, 2, (double)INFINITY, NULL, distances, NULL));
    CHECK(distances[1] == 8.0);
    INVALID("point 0", treeform_closest_point(a, bad, 1, 1.0, faces, NULL, NULL));
    INVALID("", treeform_closest_point(a, queries, 1, -1.0, faces, NULL, NULL));
    INVALID("queries is null", treeform_closest_point(a, NULL, 1, 1.0, faces, NULL, NULL));
    OK(treeform_closest_pair(a, b, NULL, NULL, (double)INFINITY, &closest));
    CHECK(closest.distance == 2.0 && closest.on_a[0] == 1.0 && closest.on_b[0] == 3.0);
    OK(treeform_closest_pair(a, b, NULL, NULL, 1.0, &closest));
    CHECK(closest.face_a == TREEFORM_NONE && closest.distance > 1e300);
    OK(treeform_distance(a, b, moves, NULL, &distance));
    CHECK(distance == 1.0);
    OK(treeform_distance_poses(a, b, moves, NULL, 2, (double)INFINITY, distances));
    CHECK(distances[0] == 1.0 && distances[1] == 0.0);
    INVALID("distances is null", treeform_distance_poses(a, b, moves, NULL, 2, 1.0, NULL));
    treeform_free(a);
    treeform_free(b);
}

static void test_inside(void) {
    treeform_mesh* solid = cube(0, 0, 0, 1);
    treeform_mesh* open = NULL;
    const treeform_mesh* solids[1];
    const double points[9] = {0.5, 0.5, 0.5, 2, 2, 2, 1, 0.5, 0.5};
    const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1}, in_plane[4] = {0.5, 0.5, 2, 0};
    const uint32_t edges[8] = {0, 1, 1, 2, 2, 3, 3, 0};
    uint8_t where[3];
    int32_t winding[3];
    uint32_t on[3];
    uint64_t counts[3];
    OK(treeform_locate(solid, points, 3, where, winding, on));
    CHECK(where[0] == TREEFORM_INSIDE && where[1] == TREEFORM_OUTSIDE);
    CHECK(where[2] == TREEFORM_BOUNDARY && winding[0] == 1 && winding[2] == 0);
    CHECK(on[0] == TREEFORM_NONE && (on[2] == 10 || on[2] == 11));
    OK(treeform_contains(solid, points, 3, where));
    CHECK(where[0] == 1 && where[1] == 0 && where[2] == 1);
    OK(treeform_winding_number(solid, points, 3, winding));
    CHECK(winding[0] == 1 && winding[1] == 0);
    OK(treeform_count_inside_out(solid, counts));
    CHECK(counts[0] == 0);
    INVALID("result is null", treeform_count_inside_out(solid, NULL));
    solids[0] = solid;
    OK(treeform_count_sides(points, 3, solids, 1, counts));
    CHECK(counts[0] == 1 && counts[1] == 1 && counts[2] == 1);
    OK(treeform_mesh_create(cube_points, 8, cube_faces, 11, 0, &open));
    INVALID("open", treeform_contains(open, points, 3, where));
    INVALID("inside is null", treeform_contains(solid, points, 3, NULL));
    OK(treeform_locate_in_curves(square, 4, edges, 4, in_plane, 2, where, winding));
    CHECK(where[0] == TREEFORM_INSIDE && where[1] == TREEFORM_OUTSIDE && winding[0] == 1);
    INVALID("", treeform_locate_in_curves(square, 4, edges, 3, in_plane, 2, where, winding));
    treeform_free(open);
    treeform_free(solid);
}

static void test_rays(void) {
    treeform_mesh* mesh = cube(0, 0, 0, 1);
    treeform_ray rays[2];
    treeform_mesh_hit hits[2];
    treeform_hits* all = NULL;
    uint8_t any[2];
    memset(rays, 0, sizeof rays);
    rays[0].origin[0] = 0.25;
    rays[0].origin[1] = 0.5;
    rays[0].origin[2] = -1.0;
    rays[0].direction[2] = 1.0;
    rays[0].t_max = (double)INFINITY;
    rays[1] = rays[0];
    rays[1].direction[2] = -1.0;
    OK(treeform_raycast(mesh, rays, 2, hits));
    CHECK(hits[0].face == 0 && hits[0].t == 1.0 && hits[0].at == TREEFORM_AT_INTERIOR &&
          hits[0].coplanar == 0);
    CHECK(hits[1].face == TREEFORM_NONE);
    OK(treeform_raycast_any(mesh, rays, 2, any));
    CHECK(any[0] == 1 && any[1] == 0);
    OK(treeform_raycast_all(mesh, rays, 2, &all));
    CHECK(all->count == 2 && all->begin[1] == 2 && all->begin[2] == 2 && all->hits[1].t == 2.0);
    treeform_free(all);
    rays[1].direction[2] = 0.0;
    INVALID("ray 1", treeform_raycast(mesh, rays, 2, hits));
    treeform_free(mesh);
}

static void test_relations(void) {
    treeform_mesh* a = cube(0, 0, 0, 1);
    treeform_mesh* b = cube(0.75, 0, 0, 1);
    treeform_mesh* apart = cube(3, 0, 0, 1);
    treeform_measure_options options;
    treeform_relation_result* relation = NULL;
    treeform_mesh_relation how = 9;
    double depth = 0.0, move[3];
    treeform_search_effort effort;
    int calls = 0;
    OK(treeform_measure(a, apart, NULL, &relation));
    CHECK(relation->relation == TREEFORM_RELATION_DISJOINT && relation->distance == 2.0);
    CHECK(relation->on_a[0] == 1.0 &&
          near(relation->barycentric_a[0] + relation->barycentric_a[1] + relation->barycentric_a[2],
               1.0));
    treeform_free(relation);
    treeform_measure_options_init(&options, sizeof options);
    options.radius = 1.0;
    OK(treeform_measure(a, apart, &options, &relation));
    CHECK(relation == NULL);
    options.progress = stop;
    options.progress_data = &calls;
    ENDS(TREEFORM_CANCELLED, "", treeform_measure(a, b, &options, &relation));
    OK(treeform_relation(a, b, TREEFORM_BY_COORDINATES, &how));
    CHECK(how == TREEFORM_RELATION_PENETRATING);
    INVALID("vertices", treeform_relation(a, b, 2, &how));
    treeform_measure_options_init(&options, sizeof options);
    OK(treeform_penetration_depth(a, b, &options, &depth, move, &effort));
    CHECK(effort.pairs > 0 && effort.pairs < effort.bound && effort.skipped_candidates == 0);
    CHECK(near(depth, 0.25) && near(move[0], -0.25));
    OK(treeform_penetration_depth(a, apart, NULL, &depth, move, NULL));
    CHECK(depth == 0.0 && move[0] == 0.0);
    treeform_free(a);
    treeform_free(b);
    treeform_free(apart);
}

static void test_deviation(void) {
    treeform_mesh* solid = cube(0, 0, 0, 1);
    treeform_mesh* cloud = NULL;
    const treeform_mesh* fixed[1];
    const double points[9] = {0.5, 0.5, 1.25, 0.5, 0.5, 0.75, 0.5, 0.5, 1};
    treeform_deviation_options options;
    treeform_deviation_result* result = NULL;
    int calls = 0;
    size_t i;
    OK(treeform_mesh_create(points, 3, NULL, 0, 0, &cloud));
    fixed[0] = solid;
    treeform_deviation_options_init(&options, sizeof options);
    options.band_low = -0.1;
    options.band_high = 0.1;
    OK(treeform_deviation(cloud, fixed, 1, &options, &result));
    CHECK(result->count == 3 && result->is_signed == 1 && result->distances[0] == 0.25);
    CHECK(result->distances[1] == -0.25 && result->distances[2] == 0.0 && result->max == 0.25);
    for (i = 0; i < 3; ++i) CHECK(result->band_counts[i] == 1 && result->side_counts[i] == 1);
    CHECK(result->bins == 40 && near(result->max_bound, 0.25) && result->reverse_max > 0.0);
    treeform_free(result);
    options.band_low = 0.2;
    INVALID("", treeform_deviation(cloud, fixed, 1, &options, &result));
    treeform_deviation_options_init(&options, sizeof options);
    options.progress = stop;
    options.progress_data = &calls;
    ENDS(TREEFORM_CANCELLED, "", treeform_deviation(cloud, fixed, 1, &options, &result));
    OK(treeform_deviation(cloud, fixed, 0, NULL, &result));
    CHECK(result == NULL);
    treeform_free(cloud);
    treeform_free(solid);
}

void test_nearness(void) {
    test_distances();
    test_inside();
    test_rays();
    test_relations();
    test_deviation();
}
