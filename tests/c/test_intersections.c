/* Which faces meet, and where. */
#include "test.h"

#include <stdio.h>
#include <string.h>

static void test_of_one(void) {
    treeform_mesh* mesh = model("data/two_spheres.stl");
    treeform_face_pair_options options;
    treeform_face_pair_result* pairs = NULL;
    treeform_regions* regions = NULL;
    treeform_segments* segments = NULL;
    treeform_curve_network* paths = NULL;
    treeform_face_pair wrong;
    int calls = 0;
    OK(treeform_self_intersections(mesh, NULL, &pairs));
    CHECK(pairs->count == 78 && pairs->counts[TREEFORM_CROSSING] == 78);
    CHECK(pairs->pairs[0].a < pairs->pairs[0].b && pairs->pairs[77].kind == TREEFORM_CROSSING);
    OK(treeform_group_pairs(mesh, pairs->pairs, pairs->count, &regions));
    CHECK(regions->count == 1 && regions->regions[0].pair_count == 78 &&
          regions->regions[0].pairs[77] == 77);
    OK(treeform_intersection_curves(mesh, pairs->pairs, pairs->count, &segments));
    CHECK(segments->count == 78 && segments->begin[5] == 5 && segments->begin[78] == 78);
    OK(treeform_intersection_paths(mesh, pairs->pairs, pairs->count, &paths));
    CHECK(paths->path_count == 1 && paths->paths[0].closed == 1);
    CHECK(paths->paths[0].count == paths->point_count);
    OK(treeform_write_curves(path_in_work("curves.obj"), mesh, pairs->pairs, pairs->count, NULL));
    ENDS(TREEFORM_FILE, "",
         treeform_write_curves(path_in_work("curves.xyz"), mesh, pairs->pairs, 1, NULL));
    treeform_free(paths);
    memset(&wrong, 0, sizeof wrong);
    wrong.b = 1;
    wrong.kind = TREEFORM_DEGENERATE;
    OK(treeform_intersection_paths(mesh, &wrong, 1, &paths));
    CHECK(paths->path_count == 0);
    wrong.kind = TREEFORM_CROSSING;
    wrong.b = 640;
    treeform_free(segments);
    INVALID("pair 0", treeform_intersection_curves(mesh, &wrong, 1, &segments));
    treeform_free(regions);
    INVALID("pair 0", treeform_group_pairs(mesh, &wrong, 1, &regions));
    wrong.b = 1;
    wrong.kind = 7;
    INVALID("kind is 7", treeform_intersection_curves(mesh, &wrong, 1, &segments));
    treeform_free(paths);
    treeform_free(pairs);
    treeform_face_pair_options_init(&options, sizeof options);
    options.limit = 3;
    OK(treeform_self_intersections(mesh, &options, &pairs));
    CHECK(pairs->count == 3 && pairs->counts[TREEFORM_CROSSING] == 78);
    treeform_free(pairs);
    options.kinds = TREEFORM_ALL_KINDS - (1u << TREEFORM_CROSSING);
    OK(treeform_self_intersections(mesh, &options, &pairs));
    CHECK(pairs->count == 0);
    treeform_free(pairs);
    options.kinds = 128;
    INVALID("kinds is 128", treeform_self_intersections(mesh, &options, &pairs));
    options.kinds = TREEFORM_ALL_KINDS;
    options.within = 1;
    options.between = 1;
    INVALID("", treeform_self_intersections(mesh, &options, &pairs));
    treeform_face_pair_options_init(&options, sizeof options);
    options.progress = stop;
    options.progress_data = &calls;
    ENDS(TREEFORM_CANCELLED, "cancelled", treeform_self_intersections(mesh, &options, &pairs));
    CHECK(pairs == NULL && calls > 0);
    treeform_free(mesh);
}

static void test_of_two(void) {
    treeform_mesh* a = cube(0, 0, 0, 1);
    treeform_mesh* b = cube(0.5, 0.5, 0.5, 1);
    double moves[24] = {1, 0, 0, 9, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    treeform_face_pair_options options;
    treeform_face_pair_result* pairs = NULL;
    treeform_indices* faces = NULL;
    treeform_box box = {{-1, -1, 0.5}, {2, 2, 0.6}};
    int32_t meet = 7;
    uint8_t meets[2] = {7, 7};
    OK(treeform_mesh_intersections(a, b, NULL, &pairs));
    CHECK(strcmp(treeform_pair_kind_name(TREEFORM_FOLD), "fold") == 0);
    CHECK(strcmp(treeform_pair_kind_name(7), "unknown") == 0);
    CHECK(strcmp(treeform_align_outcome_name(TREEFORM_ALIGN_DOUBTFUL), "doubtful") == 0);
    CHECK(strcmp(treeform_location_name(TREEFORM_OUTSIDE), "outside") == 0);
    CHECK(strcmp(treeform_mesh_relation_name(TREEFORM_RELATION_TOUCHING), "touching") == 0);
    CHECK(strcmp(treeform_placement_outcome_name(TREEFORM_OUTCOME_BED), "bed") == 0);
    CHECK(strcmp(treeform_status_name(-1), "unknown") == 0);
    CHECK(strcmp(treeform_status_name(TREEFORM_STATUS_OPEN_INPUT), "open-input") == 0);
    CHECK(pairs->count > 0 && pairs->count == pairs->counts[0] + pairs->counts[5]);
    treeform_free(pairs);
    treeform_face_pair_options_init(&options, sizeof options);
    options.transform_b = moves;
    OK(treeform_mesh_intersections(a, b, &options, &pairs));
    CHECK(pairs->count == 0);
    treeform_free(pairs);
    OK(treeform_intersects(a, b, NULL, NULL, &meet));
    CHECK(meet == 1);
    OK(treeform_intersects(a, b, moves, NULL, &meet));
    CHECK(meet == 0);
    OK(treeform_intersects_poses(a, b, NULL, moves, 2, meets));
    CHECK(meets[0] == 0 && meets[1] == 1);
    moves[0] = moves[0] / 0.0;
    INVALID("", treeform_intersects(a, b, moves, NULL, &meet));
    OK(treeform_faces_in_box(a, &box, &faces));
    CHECK(faces->count == 8 && faces->values[0] == 4);
    treeform_free(faces);
    box.min[0] = 5;
    INVALID("", treeform_faces_in_box(a, &box, &faces));
    treeform_free(a);
    treeform_free(b);
}

static void test_colored(void) {
    treeform_file* file = NULL;
    treeform_usable_mesh* part = NULL;
    treeform_mesh* mesh = NULL;
    treeform_face_pair_result* pairs = NULL;
    treeform_file_view* view = NULL;
    OK(treeform_read("data/two_spheres.stl", NULL, &file));
    OK(treeform_usable_faces(file, NULL, &part));
    OK(treeform_mesh_of(&part->mesh, 0, &mesh));
    OK(treeform_self_intersections(mesh, NULL, &pairs));
    OK(treeform_color_pairs(file, part, pairs->pairs, pairs->count));
    OK(treeform_file_content(file, &view));
    CHECK(view->element_count == 2);
    treeform_free(view);
    treeform_free(pairs);
    treeform_free(mesh);
    treeform_free(part);
    treeform_free(file);
}

void test_intersections(void) {
    test_of_one();
    test_of_two();
    test_colored();
}

void test_search(void) {
    const char* const path = "data/two_spheres.stl";
    treeform_file_search_options options;
    treeform_file_search_result* result = NULL;
    treeform_shared_search* search = NULL;
    treeform_indices* unfinished = NULL;
    size_t tiles = 0, again = 0, t;
    int32_t is_searched = 0;
    int calls = 0;
    treeform_file_search_options_init(&options, sizeof options);
    options.folder = path_in_work("tiles");
    options.faces_per_tile = 100;
    OK(treeform_is_searched_in_tiles(path, NULL, &is_searched));
    CHECK(is_searched == 1);
    OK(treeform_self_intersections_of_file(path, &options, &result));
    CHECK(result->found->count == 78 && result->stored_faces == 640 && result->tiles > 1);
    CHECK(result->mesh.face_count > 0 && result->face_in_file[0] < 640);
    treeform_free(result);
    OK(treeform_shared_search_create(path, &options, &search));
    INVALID("", treeform_shared_search_tile(NULL, 0));
    ENDS(TREEFORM_FILE, "", treeform_shared_search_finish(search, &result));
    treeform_free(search); /* a step too early ends the search */
    OK(treeform_shared_search_create(path, &options, &search));
    OK(treeform_shared_search_scatter(search, &tiles));
    OK(treeform_shared_search_tiles(search, &again));
    CHECK(again == tiles);
    CHECK(tiles > 1);
    INVALID("", treeform_shared_search_tile(search, tiles));
    OK(treeform_shared_search_unfinished(search, &unfinished));
    CHECK(unfinished->count == tiles && unfinished->values[tiles - 1] == tiles - 1);
    treeform_free(unfinished);
    for (t = 0; t < tiles; ++t) OK(treeform_shared_search_tile(search, t));
    OK(treeform_shared_search_unfinished(search, &unfinished));
    CHECK(unfinished->count == 0);
    treeform_free(unfinished);
    OK(treeform_shared_search_finish(search, &result));
    CHECK(result->found->count == 78 && result->searched == 640);
    treeform_free(result);
    OK(treeform_shared_search_remove_folder(search));
    treeform_free(search);
    options.progress = stop;
    options.progress_data = &calls;
    options.folder = path_in_work("more_tiles");
    ENDS(TREEFORM_CANCELLED, "", treeform_self_intersections_of_file(path, &options, &result));
    ENDS(TREEFORM_FILE, "", treeform_self_intersections_of_file("no_such", NULL, &result));
    CHECK(result == NULL);
}
