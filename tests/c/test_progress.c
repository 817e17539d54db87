/* Progress of calls without options: the same answers in pieces, a stop, elements by their
   numbers. */
#include "test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COUNT = 3000, NEAREST = 3, CALLS = 14 };

/* The arrays that calls ask with, and those that they answer into. */
static double queries[COUNT * 3], highs[COUNT * 3], moves[COUNT * 12];
static double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
static uint32_t square_edges[8] = {0, 1, 1, 2, 2, 3, 3, 0};
static treeform_ray rays[COUNT];

typedef struct answers {
    uint32_t ids[COUNT * NEAREST];
    double distances[COUNT * NEAREST];
    double points[COUNT * 3];
    uint8_t where[COUNT];
    int32_t winding[COUNT];
    treeform_mesh_hit hits[COUNT];
    size_t begin[COUNT + 1];
    size_t listed;
    unsigned char list[COUNT * 400];
} answers;

static treeform_mesh* mesh;
static treeform_mesh* other;
static treeform_point_tree* points;
static treeform_box_tree* boxes;

static void keep(answers* to, const size_t* begin, const void* list, size_t size) {
    memcpy(to->begin, begin, sizeof to->begin);
    to->listed = begin[COUNT] * size;
    CHECK(to->listed <= sizeof to->list);
    memcpy(to->list, list, to->listed);
}

static treeform_code lists(int which, answers* to) {
    treeform_neighbors* near_points = NULL;
    treeform_id_lists* ids = NULL;
    treeform_hits* hits = NULL;
    treeform_code code = TREEFORM_OK;
    if (which == 0) {
        code = treeform_point_tree_within(points, queries, COUNT, 0.1, &near_points);
        if (near_points) /* a neighbor has four bytes that nobody sets */
            to->listed = near_points->begin[COUNT],
            memcpy(to->begin, near_points->begin, sizeof to->begin);
    } else if (which == 3) {
        code = treeform_raycast_all(mesh, rays, COUNT, &hits);
        if (hits) to->listed = hits->begin[COUNT], memcpy(to->begin, hits->begin, sizeof to->begin);
    } else {
        code = which == 1 ? treeform_box_tree_query(boxes, queries, highs, COUNT, &ids)
                          : treeform_box_tree_rays(boxes, queries, highs, COUNT, &ids);
        if (ids) keep(to, ids->begin, ids->ids, sizeof *ids->ids);
    }
    treeform_free(near_points);
    treeform_free(ids);
    treeform_free(hits);
    return code;
}

static treeform_code ask(int call, answers* to) {
    treeform_id_pairs* pairs = NULL;
    treeform_code code;
    switch (call) {
        case 0:
            return treeform_closest_point(mesh, queries, COUNT, 0.5, to->ids, to->distances,
                                          to->points);
        case 1:
            return treeform_locate(mesh, queries, COUNT, to->where, to->winding, to->ids);
        case 2:
            return treeform_contains(mesh, queries, COUNT, to->where);
        case 3:
            return treeform_winding_number(mesh, queries, COUNT, to->winding);
        case 4:
            return treeform_raycast(mesh, rays, COUNT, to->hits);
        case 5:
            return treeform_raycast_any(mesh, rays, COUNT, to->where);
        case 6:
            return treeform_distance_poses(mesh, other, moves, NULL, COUNT, 1.0, to->distances);
        case 7:
            return treeform_intersects_poses(mesh, other, NULL, moves, COUNT, to->where);
        case 8:
            return treeform_point_tree_nearest(points, queries, COUNT, NEAREST, 0.2, to->ids,
                                               to->distances);
        case 9:
            return treeform_box_tree_nearest(boxes, queries, COUNT, NEAREST, 0.2, to->ids,
                                             to->distances);
        case 10:
        case 11:
        case 12:
            return lists(call - 10, to);
        case 13:
            return lists(3, to);
        default:
            code = treeform_point_tree_pairs(points, 0.05, &pairs);
            if (pairs) to->listed = pairs->count;
            treeform_free(pairs);
            return code;
    }
}

static int count(double done, void* calls) {
    CHECK(done >= 0.0 && done <= 1.0);
    ++*(int*)calls;
    return 0;
}

static void fill(void) {
    uint32_t state = 1;
    size_t i, k;
    for (i = 0; i < COUNT * 3; ++i) {
        state = state * 1664525u + 1013904223u;
        queries[i] = (double)(state >> 8) / 16777216.0 * 1.5;
        highs[i] = queries[i] + 0.05;
    }
    memset(rays, 0, sizeof rays);
    for (i = 0; i < COUNT; ++i) {
        for (k = 0; k < 3; ++k) rays[i].origin[k] = queries[3 * i + k] - (k == 2 ? 3.0 : 0.0);
        rays[i].direction[2] = 1.0;
        rays[i].t_max = (double)INFINITY;
        for (k = 0; k < 3; ++k) {
            moves[12 * i + 5 * k] = 1.0;
            moves[12 * i + 4 * k + 3] = queries[3 * i + k];
        }
    }
}

void test_progress(void) {
    answers* const whole = calloc(1, sizeof *whole);
    answers* const pieces = calloc(1, sizeof *pieces);
    const double safe = queries[0];
    int call, calls = 0;
    uint8_t where[2];
    fill();
    mesh = cube(0, 0, 0, 1);
    other = cube(2, 0, 0, 1);
    OK(treeform_point_tree_create(queries, COUNT, 3, &points));
    OK(treeform_box_tree_create(queries, highs, COUNT, 3, &boxes));
    for (call = 0; call <= CALLS; ++call) {
        memset(whole, 0, sizeof *whole);
        memset(pieces, 0, sizeof *pieces);
        OK(ask(call, whole));
        calls = 0;
        treeform_set_progress(count, &calls);
        OK(ask(call, pieces));
        CHECK(calls >= (call == CALLS ? 1 : 2));
        CHECK(memcmp(whole, pieces, sizeof *whole) == 0);
        treeform_set_progress(stop, &calls);
        ENDS(TREEFORM_CANCELLED, "", ask(call, pieces));
        treeform_set_progress(count, &calls);
    }
    /* The number is that of the whole, whichever piece it is in. */
    queries[3 * 2500] = (double)NAN;
    INVALID("point 2500 is", ask(0, pieces));
    INVALID("point 2500 is", ask(1, pieces));
    INVALID("query 2500 is", ask(8, pieces));
    queries[3 * 2500] = safe;
    rays[2600].direction[2] = 0.0;
    INVALID("ray 2600 has", ask(4, pieces));
    /* In the plane; and null is none again. */
    calls = 0;
    OK(treeform_locate_in_curves(square, 4, square_edges, 4, queries, 2, where, NULL));
    CHECK(calls == 1);
    {
        treeform_features* features = NULL;
        calls = 0;
        treeform_set_progress(count, &calls);
        OK(treeform_find_features(mesh, TREEFORM_PLANE, NULL, &features));
        CHECK(calls == 1 && features->count == 6);
        treeform_free(features);
        treeform_set_progress(stop, &calls);
        ENDS(TREEFORM_CANCELLED, "", treeform_find_features(mesh, TREEFORM_PLANE, NULL, &features));
        CHECK(features == NULL);
    }
    calls = 0;
    treeform_set_progress(NULL, NULL);
    OK(treeform_locate_in_curves(square, 4, square_edges, 4, queries, 2, where, NULL));
    CHECK(calls == 0);
    treeform_free(points);
    treeform_free(boxes);
    treeform_free(mesh);
    treeform_free(other);
    free(whole);
    free(pieces);
}
