/* Trees over points and boxes, beside a loop over all. */
#include "test.h"

#include <math.h>
#include <stdlib.h>

enum { POINTS = 500 };

/* The same numbers on every machine. */
static double next_number(void) {
    static uint32_t state = 12345;
    state = state * 1664525u + 1013904223u;
    return (double)(state >> 8) / 16777216.0;
}

static double distance(const double* a, const double* b, uint32_t dimensions) {
    double sum = 0.0;
    uint32_t k;
    for (k = 0; k < dimensions; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sqrt(sum);
}

static void test_points(uint32_t dimensions) {
    static double points[POINTS * 3];
    treeform_point_tree* tree = NULL;
    treeform_neighbors* within = NULL;
    treeform_id_pairs* pairs = NULL;
    uint32_t ids[4];
    double distances[4];
    const double radius = dimensions == 2 ? 0.05 : 0.1;
    size_t i, j, count = 0, near_first = 0, all = 0;
    for (i = 0; i < POINTS * dimensions; ++i) points[i] = next_number();
    OK(treeform_point_tree_create(points, POINTS, dimensions, &tree));
    OK(treeform_point_tree_size(tree, &count));
    CHECK(count == POINTS);
    OK(treeform_point_tree_nearest(tree, points, 1, 4, (double)INFINITY, ids, distances));
    CHECK(ids[0] == 0 && distances[0] == 0.0 && distances[1] <= distances[2]);
    for (i = 0; i < POINTS; ++i) {
        const double d = distance(points, points + i * dimensions, dimensions);
        near_first += d < distances[2];
        count = 0;
        for (j = i + 1; j < POINTS; ++j)
            count +=
                distance(points + i * dimensions, points + j * dimensions, dimensions) <= radius;
        all += count;
    }
    CHECK(near_first == 2);
    OK(treeform_point_tree_nearest(tree, points, 1, 4, 0.0, ids, NULL));
    CHECK(ids[1] == TREEFORM_NONE);
    OK(treeform_point_tree_within(tree, points, POINTS, radius, &within));
    CHECK(within->count == POINTS && within->begin[POINTS] == POINTS + 2 * all);
    CHECK(within->neighbors[0].id == 0 && within->neighbors[0].distance == 0.0);
    treeform_free(within);
    OK(treeform_point_tree_pairs(tree, radius, &pairs));
    CHECK(pairs->count == all && all > 0 && pairs->pairs[0] < pairs->pairs[1]);
    treeform_free(pairs);
    INVALID("", treeform_point_tree_pairs(tree, -1.0, &pairs));
    INVALID("queries is null", treeform_point_tree_nearest(tree, NULL, 1, 1, 1.0, ids, NULL));
    CHECK(pairs == NULL);
    treeform_free(tree);
    points[dimensions * 7] = (double)NAN;
    INVALID("7", treeform_point_tree_create(points, POINTS, dimensions, &tree));
    INVALID("dimensions is 4", treeform_point_tree_create(points, POINTS, 4, &tree));
    CHECK(tree == NULL);
}

static int overlap(const double* low, const double* high, size_t a, size_t b, uint32_t dimensions) {
    uint32_t k;
    for (k = 0; k < dimensions; ++k)
        if (low[a * dimensions + k] > high[b * dimensions + k] ||
            low[b * dimensions + k] > high[a * dimensions + k])
            return 0;
    return 1;
}

static void test_boxes(uint32_t dimensions) {
    static double low[POINTS * 3], high[POINTS * 3];
    treeform_box_tree* tree = NULL;
    treeform_box_tree* flat = NULL;
    treeform_id_pairs* pairs = NULL;
    treeform_id_lists* lists = NULL;
    uint32_t ids[2];
    double distances[2];
    const double far_away[3] = {100, 0.5, 0.5}, origin[3] = {-1, 0, 0}, along[3] = {1, 0, 0};
    const double highest[3] = {(double)INFINITY, (double)INFINITY, (double)INFINITY};
    const double lowest[3] = {-highest[0], -highest[0], -highest[0]};
    const double no_number[3] = {(double)NAN, 0, 0};
    size_t i, j, count = 0, all = 0, with_first = 0;
    for (i = 0; i < POINTS * dimensions; ++i) {
        low[i] = next_number();
        high[i] = low[i] + 0.05;
    }
    OK(treeform_box_tree_create(low, high, POINTS, dimensions, &tree));
    OK(treeform_box_tree_size(tree, &count));
    CHECK(count == POINTS);
    for (i = 0; i < POINTS; ++i) {
        with_first += (size_t)overlap(low, high, 0, i, dimensions);
        for (j = i + 1; j < POINTS; ++j) all += (size_t)overlap(low, high, i, j, dimensions);
    }
    OK(treeform_box_tree_pairs(tree, &pairs));
    CHECK(pairs->count == all && all > 0);
    treeform_free(pairs);
    OK(treeform_box_tree_pairs_of(tree, tree, &pairs));
    CHECK(pairs->count == POINTS + 2 * all && pairs->pairs[0] == 0 && pairs->pairs[1] == 0);
    treeform_free(pairs);
    OK(treeform_box_tree_query(tree, low, high, 1, &lists));
    CHECK(lists->count == 1 && lists->begin[1] == with_first && lists->ids[0] == 0);
    treeform_free(lists);
    OK(treeform_box_tree_query(tree, lowest, highest, 1, &lists));
    CHECK(lists->begin[1] == POINTS);
    treeform_free(lists);
    OK(treeform_box_tree_query(tree, highest, lowest, 1, &lists));
    CHECK(lists->begin[1] == 0);
    treeform_free(lists);
    INVALID("NaN", treeform_box_tree_query(tree, no_number, highest, 1, &lists));
    OK(treeform_box_tree_rays(tree, low, along, 1, &lists));
    CHECK(lists->begin[1] >= 1 && lists->ids[0] == 0);
    treeform_free(lists);
    OK(treeform_box_tree_rays(tree, far_away, along, 1, &lists));
    CHECK(lists->begin[1] == 0);
    treeform_free(lists);
    OK(treeform_box_tree_nearest(tree, low, 1, 2, (double)INFINITY, ids, distances));
    CHECK(ids[0] == 0 && distances[0] == 0.0);
    OK(treeform_box_tree_nearest(tree, far_away, 1, 1, 1.0, ids, distances));
    CHECK(ids[0] == TREEFORM_NONE && distances[0] > 1e300);
    INVALID("", treeform_box_tree_nearest(tree, origin, 1, 1, -1.0, ids, NULL));
    OK(treeform_box_tree_create(low, high, 1, 5 - dimensions, &flat));
    INVALID("dimensions", treeform_box_tree_pairs_of(tree, flat, &pairs));
    treeform_free(flat);
    treeform_free(tree);
    high[dimensions * 9] = -1.0;
    INVALID("box of element 9", treeform_box_tree_create(low, high, POINTS, dimensions, &tree));
    CHECK(tree == NULL);
}

void test_trees(void) {
    treeform_point_tree* empty = NULL;
    treeform_id_pairs* pairs = NULL;
    test_points(2);
    test_points(3);
    test_boxes(2);
    test_boxes(3);
    OK(treeform_point_tree_create(NULL, 0, 3, &empty));
    OK(treeform_point_tree_pairs(empty, 1.0, &pairs));
    CHECK(pairs->count == 0);
    treeform_free(pairs);
    INVALID("", treeform_point_tree_pairs(empty, -1.0, &pairs));
    treeform_free(empty);
}
