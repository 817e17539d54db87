/* Clouds from file to file, and block by block. */
#include "test.h"

#include <stdio.h>

static const char* write_grid(const char* name) {
    const char* const path = path_in_work(name);
    FILE* const out = fopen(path, "wb");
    int i;
    CHECK(out != NULL);
    for (i = 0; i < 1000; ++i) fprintf(out, "%d %d %g\n", i % 10, i / 10 % 10, i / 100 * 0.001);
    fclose(out);
    return path;
}

static void count_numbers(const uint64_t* numbers, size_t count, void* data) {
    uint64_t* const seen = data;
    size_t i;
    for (i = 0; i < count; ++i)
        if (numbers[i] < 100) ++*seen;
}

static void test_weld_files(void) {
    const char* inputs[1];
    const char* const output = path_in_work("thin.ply");
    treeform_weld_stream_options options;
    treeform_write_options write;
    treeform_weld_stream_result* result = NULL;
    treeform_file* made = NULL;
    treeform_file_view* view = NULL;
    uint64_t bytes = 0, more = 0, numbered = 0;
    int calls = 0;
    inputs[0] = write_grid("grid.xyz");
    treeform_weld_stream_options_init(&options, sizeof options);
    options.tolerance = 0.5;
    options.folder = path_in_work("weld_tiles");
    options.points_per_tile = 100;
    treeform_write_options_init(&write, sizeof write);
    write.ascii = 1;
    options.write = &write;
    options.map = count_numbers;
    options.map_data = &numbered;
    OK(treeform_weld_stream(inputs, 1, output, &options, &result));
    CHECK(numbered == 1000 && result->points == 1000 && result->kept == 100 &&
          result->groups == 100);
    CHECK(is(result->format, "ply-ascii") && result->tolerance == 0.5 && result->tiles > 1);
    treeform_free(result);
    OK(treeform_read(output, NULL, &made));
    OK(treeform_file_content(made, &view));
    CHECK(view->mesh.point_count == 100);
    treeform_free(view);
    OK(treeform_memory_to_weld(made, 1000, &bytes));
    OK(treeform_memory_to_weld(made, 2000, &more));
    CHECK(bytes > 0 && more > bytes);
    OK(treeform_memory_to_stream(made, 1000, &bytes));
    CHECK(bytes > 0 && treeform_default_memory() > (uint64_t)1 << 20);
    treeform_free(made);
    {
        treeform_mesh* const box = cube(0, 0, 0, 1);
        const char* const mesh = path_in_work("box.ply");
        treeform_weld_stream_options plain;
        treeform_weld_stream_options_init(&plain, sizeof plain);
        plain.tolerance = 2.0;
        plain.folder = options.folder;
        OK(treeform_write_mesh(mesh, box, NULL, NULL));
        OK(treeform_weld_stream(&mesh, 1, output, &plain, &result));
        CHECK(result->points == 8 && result->kept == 1 && result->faces == 0 &&
              result->collapsed == 12 && result->degenerate == 0 && result->flipped == 0);
        treeform_free(result);
        plain.keep_degenerate = 1;
        OK(treeform_weld_stream(&mesh, 1, output, &plain, &result));
        CHECK(result->faces == 12 && result->triangles == 12);
        treeform_free(result);
        treeform_free(box);
    }
    {
        const treeform_named_column turned[] = {{"x", "3"}, {"y", "2"}, {"z", "1"}};
        options.columns = turned;
        options.column_count = 3;
        OK(treeform_weld_stream(inputs, 1, output, &options, &result));
        treeform_free(result);
        OK(treeform_read(output, NULL, &made));
        OK(treeform_file_content(made, &view));
        CHECK(view->mesh.point_count == 100 && view->mesh.points[99 * 3 + 2] == 9.0);
        treeform_free(view);
        treeform_free(made);
        options.columns = NULL;
        INVALID("columns", treeform_weld_stream(inputs, 1, output, &options, &result));
        options.column_count = 0;
    }
    options.progress = stop;
    options.progress_data = &calls;
    ENDS(TREEFORM_CANCELLED, "", treeform_weld_stream(inputs, 1, output, &options, &result));
    INVALID("no inputs", treeform_weld_stream(inputs, 0, output, &options, &result));
    options.progress = NULL;
    options.tolerance = -1.0;
    INVALID("", treeform_weld_stream(inputs, 1, output, &options, &result));
    inputs[0] = "no_such.xyz";
    ENDS(TREEFORM_FILE, "no_such", treeform_weld_stream(inputs, 1, output, NULL, &result));
    CHECK(result == NULL);
}

/* A team of one, which hears itself; and one that fails. */
static int receive_own(const void* sent, size_t count, treeform_receive receive, void* listener,
                       void* calls) {
    ++*(int*)calls;
    receive(sent, count, listener);
    return 0;
}

static int fail(const void* sent, size_t count, treeform_receive receive, void* listener,
                void* calls) {
    (void)sent, (void)count, (void)receive, (void)listener;
    ++*(int*)calls;
    return 1;
}

static void test_teams(void) {
    const char* inputs[1];
    const char* const output = path_in_work("team.ply");
    treeform_weld_stream_options options;
    treeform_file_search_options search;
    treeform_weld_stream_result* result = NULL;
    treeform_file_search_result* found = NULL;
    int calls = 0;
    treeform_communicator team = {1, 2, fail, NULL};
    team.data = &calls;
    inputs[0] = write_grid("team.xyz");
    treeform_weld_stream_options_init(&options, sizeof options);
    CHECK(options.communicator == NULL);
    options.folder = path_in_work("team_tiles");
    options.communicator = &team;
    ENDS(TREEFORM_CANCELLED, "", treeform_weld_stream(inputs, 1, output, &options, &result));
    CHECK(calls == 1 && result == NULL);
    team.rank = 2;
    INVALID("2 processes; the rank is 2",
            treeform_weld_stream(inputs, 1, output, &options, &result));
    team.exchange = NULL;
    INVALID("exchange", treeform_weld_stream(inputs, 1, output, &options, &result));
    team.size = 1;
    team.rank = 0;
    team.exchange = receive_own; /* alone, there is nothing to tell */
    OK(treeform_weld_stream(inputs, 1, output, &options, &result));
    CHECK(calls == 1 && result->kept == 1000);
    treeform_free(result);
    treeform_file_search_options_init(&search, sizeof search);
    search.folder = path_in_work("team_search");
    search.communicator = &team;
    OK(treeform_self_intersections_of_file("data/two_spheres.stl", &search, &found));
    CHECK(found->found->count == 78 && calls == 1);
    treeform_free(found);
    team.size = 2;
    team.exchange = fail;
    ENDS(TREEFORM_CANCELLED, "",
         treeform_self_intersections_of_file("data/two_spheres.stl", &search, &found));
    CHECK(calls == 2);
}

static void test_shared_weld(void) {
    const char* inputs[1];
    const char* const output = path_in_work("shared.ply");
    treeform_weld_stream_options options;
    treeform_weld_stream_result* result = NULL;
    treeform_shared_weld* weld = NULL;
    treeform_indices* left = NULL;
    uint64_t numbered = 0;
    size_t tiles = 0, again = 0, t;
    int calls = 0;
    inputs[0] = write_grid("shared.xyz");
    treeform_weld_stream_options_init(&options, sizeof options);
    options.tolerance = 0.5;
    options.folder = path_in_work("shared_tiles");
    options.points_per_tile = 100;
    options.map = count_numbers;
    options.map_data = &numbered;
    OK(treeform_shared_weld_create(inputs, 1, &options, &weld));
    ENDS(TREEFORM_FILE, "tiles", treeform_shared_weld_tile(weld, 0));
    ENDS(TREEFORM_FILE, "tiles", treeform_shared_weld_tiles(weld, &tiles));
    ENDS(TREEFORM_FILE, "tiles", treeform_shared_weld_unfinished(weld, &left));
    ENDS(TREEFORM_FILE, "tiles", treeform_shared_weld_finish(weld, output, &result));
    treeform_free(weld);
    OK(treeform_shared_weld_create(inputs, 1, &options, &weld));
    OK(treeform_shared_weld_scatter(weld, &tiles));
    CHECK(tiles > 1);
    OK(treeform_shared_weld_tiles(weld, &again));
    CHECK(again == tiles);
    OK(treeform_shared_weld_unfinished(weld, &left));
    CHECK(left->count == tiles && left->values[tiles - 1] == tiles - 1);
    treeform_free(left);
    OK(treeform_shared_weld_scatter(weld, NULL));
    INVALID("result is null", treeform_shared_weld_tiles(weld, NULL));
    INVALID("", treeform_shared_weld_tile(weld, tiles));
    INVALID("weld is null", treeform_shared_weld_tile(NULL, 0));
    treeform_free(weld);
    for (t = 0; t < tiles; ++t) {
        OK(treeform_shared_weld_create(inputs, 1, &options, &weld));
        OK(treeform_shared_weld_tile(weld, t));
        treeform_free(weld);
    }
    OK(treeform_shared_weld_create(inputs, 1, &options, &weld));
    OK(treeform_shared_weld_finish(weld, output, &result));
    CHECK(result->points == 1000 && result->kept == 100 && result->tiles == tiles);
    CHECK(numbered == 1000);
    treeform_free(result);
    OK(treeform_shared_weld_remove_folder(weld));
    treeform_free(weld);
    OK(treeform_shared_weld_create(inputs, 1, &options, &weld));
    OK(treeform_shared_weld_scatter(weld, NULL));
    for (t = 0; t < tiles; ++t) OK(treeform_shared_weld_tile(weld, t));
    OK(treeform_shared_weld_finish(weld, output, NULL));
    OK(treeform_shared_weld_remove_folder(weld));
    treeform_free(weld);
    options.progress = stop;
    options.progress_data = &calls;
    OK(treeform_shared_weld_create(inputs, 1, &options, &weld));
    ENDS(TREEFORM_CANCELLED, "", treeform_shared_weld_scatter(weld, &tiles));
    treeform_free(weld);
    INVALID("no inputs", treeform_shared_weld_create(inputs, 0, NULL, &weld));
    CHECK(weld == NULL);
}

static void test_blocks(void) {
    treeform_point_reader* reader = NULL;
    treeform_point_writer* writer = NULL;
    treeform_file* header = NULL;
    treeform_file* block = NULL;
    treeform_file_view* view = NULL;
    treeform_written* written = NULL;
    uint64_t count = 0, blocks = 0, points = 0;
    OK(treeform_point_reader_create(write_grid("blocks.xyz"), NULL, &reader));
    OK(treeform_point_reader_header(reader, &header, &count));
    OK(treeform_point_writer_create(path_in_work("blocks.ply"), header, 1000, NULL, &writer));
    INVALID("most is 0", treeform_point_reader_next(reader, 0, &block));
    for (;;) {
        OK(treeform_point_reader_next(reader, 300, &block));
        if (!block) break;
        OK(treeform_point_writer_write(writer, block));
        OK(treeform_file_content(block, &view));
        points += view->mesh.point_count;
        ++blocks;
        treeform_free(view);
        treeform_free(block);
    }
    CHECK(blocks == 4 && points == 1000);
    OK(treeform_point_writer_commit(writer, &written));
    CHECK(is(written->format, "ply-binary-le"));
    treeform_free(written);
    treeform_free(writer);
    /* Fewer points than promised: no file. */
    OK(treeform_point_writer_create(path_in_work("short.ply"), header, 1000, NULL, &writer));
    ENDS(TREEFORM_FILE, "", treeform_point_writer_commit(writer, NULL));
    treeform_free(writer);
    ENDS(TREEFORM_FILE, "", treeform_read(path_in_work("short.ply"), NULL, &block));
    treeform_free(reader);
    ENDS(TREEFORM_FILE, "", treeform_point_reader_create("data/cube.stl", NULL, &reader));
    CHECK(reader == NULL);
    treeform_free(header);
}

void test_streams(void) {
    test_weld_files();
    test_teams();
    test_shared_weld();
    test_blocks();
}
