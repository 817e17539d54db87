// Made by tools/bindings of intersections.h and the headers of C++: see its README.
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <tools/c/intersections.hpp>
#include <tools/c/made/structs.hpp>

namespace tf = treeform;

static_assert(TREEFORM_CROSSING == static_cast<int>(tf::pair_kind::crossing));
static_assert(TREEFORM_OVERLAP == static_cast<int>(tf::pair_kind::overlap));
static_assert(TREEFORM_FOLD == static_cast<int>(tf::pair_kind::fold));
static_assert(TREEFORM_DUPLICATE == static_cast<int>(tf::pair_kind::duplicate));
static_assert(TREEFORM_PIERCE == static_cast<int>(tf::pair_kind::pierce));
static_assert(TREEFORM_TOUCHING == static_cast<int>(tf::pair_kind::touching));
static_assert(TREEFORM_DEGENERATE == static_cast<int>(tf::pair_kind::degenerate));

static_assert(sizeof(treeform_face_pair) == sizeof(tf::face_pair));
static_assert(offsetof(treeform_face_pair, a) == offsetof(tf::face_pair, a));
static_assert(offsetof(treeform_face_pair, b) == offsetof(tf::face_pair, b));
static_assert(offsetof(treeform_face_pair, kind) == offsetof(tf::face_pair, kind));

void glue::fill(keeper&, const tf::intersection_result& from, treeform_pairs& to) {
    to.pairs = same<treeform_face_pair>(from.pairs);
    to.count = from.pairs.size();
    std::copy(from.counts.begin(), from.counts.end(), to.counts);
    to.box_pairs = from.box_pairs;
}

tf::intersection_options glue::read(const treeform_intersections_options* options) {
    return read(chosen(options, treeform_intersections_options_init));
}
tf::intersection_options glue::read(const treeform_intersections_options& o) {
    tf::intersection_options how;
    how.vertices = choice<tf::vertex_identity>(o.vertices, 2, "vertices");
    how.move_a = matrix(o.move_a);
    how.move_b = matrix(o.move_b);
    how.first_only = o.first_only != 0;
    how.kinds = kinds(o.kinds);

    how.between = o.between != 0;
    how.within = o.within != 0;
    how.limit = limit(o.limit);
    how.progress = progress(o);

    return how;
}

void treeform_intersections_options_init(treeform_intersections_options* options, size_t size) {
    treeform_intersections_options to{};
    const tf::intersection_options from;
    to.vertices = static_cast<treeform_vertices>(from.vertices);
    to.first_only = from.first_only;
    to.kinds = TREEFORM_ALL_KINDS;
    to.between = from.between;
    to.within = from.within;
    to.limit = from.limit;
    glue::init(options, size, to);
}

void glue::fill(keeper&, const tf::intersection_region& from, treeform_region& to) {
    to.faces = or_null(from.faces);
    to.face_count = from.faces.size();
    copy(from.min, to.min);
    copy(from.max, to.max);
    to.pairs = or_null(from.pairs);
    to.pair_count = from.pairs.size();
}

void glue::fill(keeper&, const tf::curve_path& from, treeform_path& to) {
    to.points = or_null(from.points);
    to.count = from.points.size();
    to.closed = from.closed;
}

void glue::fill(keeper& kept, const tf::curve_network& from, treeform_paths& to) {
    to.points = positions_of(kept, from.points);
    to.point_count = from.points.size();
    to.paths = list<treeform_path>(kept, from.paths);
    to.path_count = from.paths.size();
}

tf::stream_search_options glue::read(const treeform_stream_search_options* options) {
    return read(chosen(options, treeform_stream_search_options_init));
}
tf::stream_search_options glue::read(const treeform_stream_search_options& o) {
    tf::stream_search_options how;
    if (o.vertices != -1) how.vertices = choice<tf::vertex_identity>(o.vertices, 2, "vertices");
    how.kinds = kinds(o.kinds);
    how.box = box(o.box);
    how.format = text(o.format);
    how.memory = o.memory;
    how.folder = text(o.folder);
    how.faces_per_tile = o.faces_per_tile;
    how.communicator = communicator_of(o.communicator);
    how.progress = step_progress(o);

    return how;
}

void treeform_stream_search_options_init(treeform_stream_search_options* options, size_t size) {
    treeform_stream_search_options to{};
    const tf::stream_search_options from;
    to.vertices = -1;
    to.kinds = TREEFORM_ALL_KINDS;
    to.memory = from.memory;
    to.faces_per_tile = from.faces_per_tile;
    glue::init(options, size, to);
}

void glue::fill(keeper& kept, const tf::stream_search_result& from,
                treeform_stream_search_result& to) {
    to.mesh = arrays(from.part.mesh);
    to.face_in_file = faces_in_file(kept, from.part).data();
    to.degenerate = from.part.degenerate;
    to.non_finite = from.part.non_finite;
    to.found = &filled<treeform_pairs>(kept, from.found);
    to.stored_faces = from.stored_faces;
    to.triangles = from.triangles;
    to.searched = from.searched;
    to.points = from.points;
    to.tiles = from.tiles;
    to.finished_tiles = from.finished_tiles;
}

void glue::fill(keeper& kept, const std::vector<tf::intersection_region>& from,
                treeform_regions& to) {
    to.regions = list<treeform_region>(kept, from);
    to.count = from.size();
}

treeform_code treeform_self_intersections(const treeform_mesh* mesh,
                                          const treeform_intersections_options* options,
                                          treeform_pairs** pairs) {
    return glue::guard([&] {
        glue::start(pairs);
        return glue::give(glue::self_intersections(glue::ref(mesh, "mesh"), options), pairs);
    });
}

treeform_code treeform_group_pairs(const treeform_mesh* mesh, const treeform_face_pair* pairs,
                                   size_t count, treeform_regions** regions) {
    return glue::guard([&] {
        glue::start(regions);
        return glue::give(tf::group_pairs(glue::view(mesh), glue::pairs_of(mesh, pairs, count)),
                          regions);
    });
}

treeform_code treeform_intersections(const treeform_mesh* a, const treeform_mesh* b,
                                     const treeform_intersections_options* options,
                                     treeform_pairs** pairs) {
    return glue::guard([&] {
        glue::start(pairs);
        return glue::give(
            tf::mesh_intersections(glue::ref(a, "a"), glue::ref(b, "b"), glue::read(options)),
            pairs);
    });
}

treeform_code treeform_intersects(const treeform_mesh* a, const treeform_mesh* b,
                                  const double* move_a, const double* move_b, int32_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::intersects(glue::ref(a, "a"), glue::ref(b, "b"), glue::matrix(move_a),
                                   glue::matrix(move_b));
    });
}

treeform_code treeform_intersects_poses(const treeform_mesh* a, const treeform_mesh* b,
                                        const double* moves_a, const double* moves_b, size_t count,
                                        uint8_t* meet) {
    return glue::guard([&] { glue::intersects_poses(a, b, moves_a, moves_b, count, meet); });
}

treeform_code treeform_faces_in_box(const treeform_mesh* mesh, const treeform_box* box,
                                    treeform_indices** indices) {
    return glue::guard([&] {
        glue::start(indices);
        return glue::give(glue::faces_in_box(mesh, glue::box(glue::need(box, "box"))), indices);
    });
}

treeform_code treeform_intersection_curves(const treeform_mesh* mesh,
                                           const treeform_face_pair* pairs, size_t count,
                                           treeform_segments** segments) {
    return glue::guard([&] {
        glue::start(segments);
        return glue::give(
            glue::intersection_curves(glue::view(mesh), glue::pairs_of(mesh, pairs, count)),
            segments);
    });
}

treeform_code treeform_intersection_paths(const treeform_mesh* mesh,
                                          const treeform_face_pair* pairs, size_t count,
                                          treeform_paths** paths) {
    return glue::guard([&] {
        glue::start(paths);
        return glue::give(
            tf::intersection_paths(glue::view(mesh), glue::pairs_of(mesh, pairs, count)), paths);
    });
}

treeform_code treeform_write_curves(const char* path, const treeform_mesh* mesh,
                                    const treeform_face_pair* pairs, size_t count,
                                    const char* format) {
    return glue::guard([&] {
        glue::write_curves(std::string(&glue::need(path, "path")), glue::view(mesh),
                           glue::pairs_of(mesh, pairs, count), glue::text(format));
    });
}

treeform_code treeform_color_pairs(treeform_file* file, const treeform_part* part,
                                   const treeform_face_pair* pairs, size_t count) {
    return glue::guard([&] { glue::color_pairs(glue::content(file, "file"), part, pairs, count); });
}

treeform_code treeform_self_intersections_of_file(const char* input,
                                                  const treeform_stream_search_options* options,
                                                  treeform_stream_search_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(tf::self_intersections_of_file(std::string(&glue::need(input, "input")),
                                                         glue::read(options)),
                          result);
    });
}

treeform_code treeform_is_searched_in_tiles(const char* path, const char* format, int32_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result =
            glue::is_searched_in_tiles(std::string(&glue::need(path, "path")), glue::text(format));
    });
}

treeform_code treeform_shared_search_create(const char* path,
                                            const treeform_stream_search_options* options,
                                            treeform_shared_search** search) {
    return glue::guard([&] {
        glue::start(search);
        return glue::give(
            glue::shared_search_create(std::string(&glue::need(path, "path")), glue::read(options)),
            search);
    });
}

treeform_code treeform_shared_search_scatter(treeform_shared_search* search, size_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::shared_search_scatter(glue::content(search, "search"));
    });
}

treeform_code treeform_shared_search_unfinished(treeform_shared_search* search,
                                                treeform_indices** indices) {
    return glue::guard([&] {
        glue::start(indices);
        return glue::give(glue::shared_search_unfinished(glue::content(search, "search")), indices);
    });
}

treeform_code treeform_shared_search_tile(treeform_shared_search* search, size_t tile) {
    return glue::guard([&] { glue::shared_search_tile(glue::content(search, "search"), tile); });
}

treeform_code treeform_shared_search_finish(treeform_shared_search* search,
                                            treeform_stream_search_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(glue::shared_search_finish(glue::content(search, "search")), result);
    });
}

treeform_code treeform_shared_search_remove_folder(treeform_shared_search* search) {
    return glue::guard([&] { glue::shared_search_remove_folder(glue::content(search, "search")); });
}
