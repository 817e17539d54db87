/* Where a mesh goes. */
#include "test.h"

#include <math.h>
#include <string.h>

static const double down[3] = {0, 0, -1};

/* A placed part is written in the coordinates that were checked, or not at all. */
static void test_writing_a_placement(void) {
    treeform_mesh* part = cube(0, 0, 4, 1);
    treeform_placement_options options;
    treeform_placement* low = NULL;
    treeform_mesh *there = NULL, *none = NULL, *other = NULL;
    treeform_arrays arrays;
    const char* const stl = path_in_work("low.stl");
    treeform_placement_options_init(&options, sizeof options);
    options.bed = 0.7; /* no float */
    OK(treeform_mesh_create(down, 1, NULL, 0, TREEFORM_COPY, &other));
    OK(treeform_drop(part, NULL, 0, NULL, &options, &low));
    OK(treeform_write_placement(path_in_work("low.ply"), part, low, NULL, NULL));
    ENDS(TREEFORM_FILE, "float32", treeform_write_placement(stl, part, low, NULL, NULL));
    OK(treeform_moved(low, part, &there));
    OK(treeform_mesh_arrays(there, &arrays));
    CHECK(arrays.face_count == 12 && arrays.point_count == low->point_count);
    CHECK(memcmp(arrays.points, low->points, 24 * low->point_count) == 0);
    INVALID("1 points, not 8", treeform_moved(low, other, &none));
    CHECK(none == NULL);
    treeform_free(there);
    treeform_free(other);
    treeform_free(low);
    options.precision = TREEFORM_FLOAT32;
    OK(treeform_drop(part, NULL, 0, NULL, &options, &low));
    OK(treeform_write_placement(stl, part, low, NULL, NULL));
    treeform_free(low);
    treeform_free(part);
}

static void test_moves(void) {
    treeform_mesh* moving = cube(0.25, 0.25, 5, 0.5);
    treeform_mesh* base = cube(0, 0, 0, 1);
    treeform_mesh* other = cube(4, 0, 0, 1);
    const treeform_mesh* fixed[2];
    const double zero[3] = {0, 0, 0};
    treeform_placement_options options;
    treeform_placement* placement = NULL;
    treeform_face_relations* faces = NULL;
    int calls = 0;
    fixed[0] = base;
    fixed[1] = other;
    OK(treeform_slide(moving, fixed, 2, down, NULL, &placement));
    CHECK(placement->outcome == TREEFORM_OUTCOME_CONTACT && placement->travel == 4.0);
    CHECK(placement->relation == TREEFORM_RELATION_TOUCHING && placement->points[2] == 1.0);
    CHECK(placement->nearest_fixed == 0 && placement->nearest->distance == 0.0);
    CHECK(placement->contact_listed > 0 && placement->contacts[0].fixed == 0);
    CHECK(placement->matrix[11] == -4.0 && is(placement->message, ""));
    CHECK(placement->point_count == 8 && isnan(placement->bed));
    OK(treeform_find_face_relations(moving, fixed, 2, placement, &faces));
    CHECK(faces->moving_count == 12 && faces->moving[0] == TREEFORM_RELATION_TOUCHING &&
          faces->moving[2] == TREEFORM_RELATION_DISJOINT);
    CHECK(faces->fixed_count == 2 && faces->fixed[1] == NULL &&
          faces->fixed[0][2] == TREEFORM_RELATION_TOUCHING);
    treeform_free(faces);
    INVALID("not of these meshes",
            treeform_find_face_relations(moving, fixed, 0, placement, &faces));
    treeform_free(placement);
    treeform_placement_options_init(&options, sizeof options);
    options.clearance = 0.125;
    OK(treeform_slide(moving, fixed, 2, down, &options, &placement));
    CHECK(near(placement->travel, 3.875) && placement->relation == TREEFORM_RELATION_CLEAR);
    treeform_free(placement);
    options.max_travel = 1.0;
    ENDS(TREEFORM_NO_PLACE, "", treeform_slide(moving, fixed, 2, down, &options, &placement));
    CHECK(placement && placement->certificate->status == TREEFORM_STATUS_NO_PLACEMENT);
    CHECK(placement && placement->message[0] != 0 &&
          placement->outcome == TREEFORM_OUTCOME_NOTHING_MET);
    treeform_free(placement);
    INVALID("", treeform_slide(moving, fixed, 2, zero, NULL, &placement));
    INVALID("direction is null", treeform_slide(moving, fixed, 2, NULL, NULL, &placement));
    INVALID("moving is null", treeform_slide(NULL, fixed, 2, down, NULL, &placement));
    treeform_placement_options_init(&options, sizeof options);
    options.progress = stop;
    options.progress_data = &calls;
    ENDS(TREEFORM_CANCELLED, "", treeform_slide(moving, fixed, 2, down, &options, &placement));
    CHECK(placement == NULL);
    treeform_free(moving);
    treeform_free(base);
    treeform_free(other);
}

static void test_other_moves(void) {
    treeform_mesh* moving = cube(0.25, 0.25, 5, 0.5);
    treeform_mesh* inside = cube(0.25, 0.25, 0.75, 0.5);
    treeform_mesh* base = cube(0, 0, 0, 1);
    const treeform_mesh* fixed[1];
    const double up[3] = {0, 0, 1};
    treeform_placement_options options;
    treeform_placement* placement = NULL;
    treeform_features* of_moving = NULL;
    treeform_features* of_fixed = NULL;
    fixed[0] = base;
    OK(treeform_drop(moving, NULL, 0, NULL, NULL, &placement));
    CHECK(placement->outcome == TREEFORM_OUTCOME_BED && placement->travel == 5.0 &&
          placement->bed == 0.0);
    treeform_free(placement);
    OK(treeform_drop(moving, fixed, 1, down, NULL, &placement));
    CHECK(placement->travel == 4.0 && placement->outcome == TREEFORM_OUTCOME_CONTACT);
    treeform_free(placement);
    INVALID("", treeform_drop(moving, NULL, 0, up, NULL, &placement));
    OK(treeform_mate(moving, fixed, 1, NULL, &placement));
    CHECK(near(placement->travel, 4.0) && placement->relation == TREEFORM_RELATION_TOUCHING);
    treeform_free(placement);
    treeform_placement_options_init(&options, sizeof options);
    options.clearance = 0.5;
    OK(treeform_separate(inside, fixed, 1, &options, &placement));
    CHECK(placement->outcome == TREEFORM_OUTCOME_MOVED_APART && placement->travel > 0.5);
    treeform_free(placement);
    OK(treeform_measure_in_place(inside, fixed, 1, NULL, &placement));
    CHECK(placement->relation == TREEFORM_RELATION_PENETRATING && placement->contact_count > 0);
    treeform_free(placement);
    OK(treeform_find_features(moving, TREEFORM_PLANE, NULL, &of_moving));
    OK(treeform_find_features(base, TREEFORM_PLANE, NULL, &of_fixed));
    OK(treeform_mate_features(moving, fixed, 1, of_moving->features, of_fixed->features, NULL,
                              &placement));
    CHECK(placement->relation == TREEFORM_RELATION_TOUCHING && near(placement->offset, 0.0));
    treeform_free(placement);
    INVALID("of_fixed is null",
            treeform_mate_features(moving, fixed, 1, of_moving->features, NULL, NULL, &placement));
    treeform_free(of_moving);
    treeform_free(of_fixed);
    treeform_free(moving);
    treeform_free(inside);
    treeform_free(base);
}

static void test_turn(void) {
    treeform_mesh* moving = cube(2, 0, 0, 1);
    treeform_mesh* wall = cube(-0.5, 2, 0, 1);
    const treeform_mesh* fixed[1];
    const double origin[3] = {0, 0, 0}, axis[3] = {0, 0, 2}, none[3] = {0, 0, 0};
    treeform_placement* placement = NULL;
    fixed[0] = wall;
    OK(treeform_turn(moving, fixed, 1, origin, axis, NULL, &placement));
    CHECK(placement->angle > 10.0 && placement->angle < 90.0 && placement->steps > 0);
    CHECK(placement->tolerance > 0.0 && placement->outcome == TREEFORM_OUTCOME_CONTACT);
    treeform_free(placement);
    INVALID("", treeform_turn(moving, fixed, 1, origin, none, NULL, &placement));
    treeform_free(moving);
    treeform_free(wall);
}

static void test_motion(void) {
    treeform_mesh* a = cube(0, 0, 0, 1);
    treeform_mesh* b = cube(5, 0, 0, 1);
    const double along[3] = {2, 0, 0}, away[3] = {-1, 0, 0};
    const double shift[12] = {1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0};
    treeform_impact_options options;
    treeform_impact* impact = NULL;
    treeform_impact_options_init(&options, sizeof options);
    options.limit = 1;
    OK(treeform_time_of_impact(a, b, along, &options, &impact));
    CHECK(impact->outcome == TREEFORM_OUTCOME_CONTACT && impact->time == 2.0 &&
          impact->contact_listed == 1);
    CHECK(impact->contact_count > 1 && impact->contacts[0].point[0] == 5.0);
    treeform_free(impact);
    options.transform_a = shift;
    OK(treeform_time_of_impact(a, b, along, &options, &impact));
    CHECK(impact->time == 1.0);
    treeform_free(impact);
    OK(treeform_time_to_distance(a, b, along, 1.0, &options, &impact));
    CHECK(near(impact->time, 0.5));
    treeform_free(impact);
    OK(treeform_time_of_impact(a, b, away, NULL, &impact));
    CHECK(impact->outcome == TREEFORM_OUTCOME_NOTHING_MET && isinf(impact->time));
    treeform_free(impact);
    OK(treeform_time_to_distance(a, b, along, 1.0, NULL, &impact));
    CHECK(near(impact->time, 1.5));
    treeform_free(impact);
    INVALID("", treeform_time_to_distance(a, b, along, 0.0, NULL, &impact));
    CHECK(impact == NULL);
    treeform_free(a);
    treeform_free(b);
}

void test_placement(void) {
    test_moves();
    test_writing_a_placement();
    test_other_moves();
    test_turn();
    test_motion();
}

static void test_lay_flat(void) {
    const double zero[3] = {0, 0, 0}, right[3] = {1, 0, 0};
    treeform_mesh* mesh = cube(0, 0, 3, 1);
    treeform_mesh* point = NULL;
    treeform_lay_flat_options options;
    treeform_laid_flat* laid = NULL;
    OK(treeform_lay_flat(mesh, NULL, &laid));
    CHECK(laid->side_count == 6 && laid->on_bed_count == 4 && laid->sides[0].area == 1.0);
    CHECK(laid->center_of_mass[2] == 3.5 && laid->mass_dimension == 3 &&
          laid->center_heights[0] == 0.5);
    CHECK(laid->certificate->status == TREEFORM_STATUS_OK && laid->point_count == 8);
    treeform_free(laid);
    treeform_lay_flat_options_init(&options, sizeof options);
    options.normal = zero;
    INVALID("", treeform_lay_flat(mesh, &options, &laid));
    options.normal = right;
    options.bed = 2.0;
    OK(treeform_lay_flat(mesh, &options, &laid));
    CHECK(laid->bed == 2.0 && laid->points[2] >= 2.0);
    treeform_free(laid);
    OK(treeform_mesh_create(cube_points, 1, NULL, 0, 0, &point));
    OK(treeform_lay_flat(point, NULL, &laid));
    CHECK(laid == NULL);
    treeform_free(point);
    treeform_free(mesh);
}

static void test_pack(void) {
    treeform_mesh* a = cube(0, 0, 0, 1);
    treeform_mesh* b = cube(7, 7, 7, 1);
    const treeform_mesh* parts[2];
    treeform_pack_options options;
    treeform_packing* packing = NULL;
    parts[0] = a;
    parts[1] = b;
    treeform_pack_options_init(&options, sizeof options);
    options.size[0] = 4.0;
    options.size[1] = 4.0;
    options.spacing = 0.5;
    OK(treeform_pack(parts, 2, &options, &packing));
    CHECK(packing->part_count == 2 && packing->plates_used == 1 && packing->not_placed_count == 0);
    CHECK(packing->parts[1].placed == 1 && packing->parts[1].point_count == 8);
    treeform_free(packing);
    options.size[0] = 1.5;
    options.size[1] = 1.5;
    options.tries = 1;
    ENDS(TREEFORM_NO_PLACE, "1 of 2", treeform_pack(parts, 2, &options, &packing));
    CHECK(packing && packing->not_placed_count == 1);
    treeform_free(packing);
    options.spacing = -1.0;
    INVALID("", treeform_pack(parts, 2, &options, &packing));
    treeform_free(a);
    treeform_free(b);
}

static void test_align(void) {
    treeform_mesh* fixed = model("data/sphere.ply");
    treeform_mesh* moving = NULL;
    treeform_mesh* nothing = NULL;
    treeform_arrays arrays;
    treeform_align_options options;
    treeform_align_result* result = NULL;
    double shift[12] = {1, 0, 0, 0.01, 0, 1, 0, 0, 0, 0, 1, 0};
    OK(treeform_mesh_arrays(fixed, &arrays));
    OK(treeform_mesh_create(arrays.points, arrays.point_count, NULL, 0, 0, &moving));
    treeform_align_options_init(&options, sizeof options);
    options.start = shift;
    OK(treeform_align(moving, fixed, &options, &result));
    CHECK(result->rms < 1e-6 && result->rms_at_start > 1e-4 && result->outcome == 0);
    CHECK(result->uncertainty < 1e-6);
    CHECK(result->freedom_count == 6 && result->freedoms[0].stiffness < 0.02);
    CHECK(result->point_count == arrays.point_count && near(result->scale, 1.0));
    treeform_free(result);
    OK(treeform_mesh_create(NULL, 0, NULL, 0, 0, &nothing));
    ENDS(TREEFORM_NO_PLACE, "not converged: nothing to align",
         treeform_align(nothing, fixed, NULL, &result));
    treeform_free(result);
    options.scale = 1;
    options.least_scale = 0.9;
    options.most_scale = 1.1;
    OK(treeform_align(moving, fixed, &options, &result));
    CHECK(near(result->scale, 1.0));
    treeform_free(result);
    options.least_scale = options.most_scale = 1.5;
    CHECK(treeform_align(moving, fixed, &options, &result) != TREEFORM_INVALID);
    CHECK(result->scale == 1.5);
    treeform_free(result);
    options.least_scale = 2.0;
    INVALID("scale", treeform_align(moving, fixed, &options, &result));
    options.least_scale = 0.0;
    options.overlap = 2.0;
    INVALID("", treeform_align(moving, fixed, &options, &result));
    treeform_free(nothing);
    treeform_free(moving);
    treeform_free(fixed);
}

void test_layouts(void) {
    test_lay_flat();
    test_pack();
    test_align();
}
