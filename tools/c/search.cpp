#include <treeform/mesh/self_intersections.hpp>

#include <tools/c/glue.hpp>
#include <tools/c/pairs.hpp>

namespace tf = treeform;

struct treeform_search {
    void* owner;
    std::optional<treeform::stream_search> steps;
};

namespace {

tf::stream_search_options options_of(const treeform_search_file_options* options) {
    const auto o = glue::chosen(options, treeform_search_file_options_init);
    tf::stream_search_options how;
    if (o.vertices != -1) how.vertices = glue::vertices(o.vertices);
    how.kinds = glue::kinds(o.kinds);
    if (o.box) how.box = glue::box(*o.box);
    how.format = glue::text(o.format);
    how.memory = o.memory;
    how.folder = glue::text(o.folder);
    how.faces_per_tile = o.faces_per_tile;
    how.team = glue::team(o.team);
    if (o.progress)
        how.progress = [call = o.progress, data = o.progress_data](std::string_view, double done) {
            return call(done, data) == 0;
        };
    return how;
}

void give_found(tf::stream_search_result from, treeform_search_result** out) {
    if (from.found.status == tf::status::cancelled) throw glue::cancelled{};
    auto made = glue::make<treeform_search_result>();
    const tf::stream_search_result& kept = made->keep(std::move(from));
    treeform_search_result& r = made->value;
    treeform_pairs pairs{};
    glue::fill(pairs, kept.found);
    r.found = &made->keep(pairs);
    r.mesh = glue::arrays(kept.part.mesh);
    std::vector<std::uint32_t> in_file(kept.part.mesh.faces.size());
    for (std::uint32_t f = 0; f < in_file.size(); ++f) in_file[f] = kept.part.face_in_file(f);
    r.face_in_file = made->keep(std::move(in_file)).data();
    r.stored_faces = kept.stored_faces;
    r.triangles = kept.triangles;
    r.searched = kept.searched;
    r.points = kept.points;
    r.degenerate = kept.part.degenerate;
    r.dropped = kept.part.dropped;
    r.tiles = kept.tiles;
    r.finished_tiles = kept.finished_tiles;
    glue::give(std::move(made), out);
}

tf::stream_search& steps(treeform_search* search) { return *glue::need(search, "search").steps; }

}  // namespace

void treeform_search_file_options_init(treeform_search_file_options* options, size_t size) {
    treeform_search_file_options defaults{};
    defaults.vertices = -1;
    defaults.kinds = TREEFORM_ALL_KINDS;
    glue::init(options, size, defaults);
}

treeform_code treeform_self_intersections_of_file(const char* path,
                                                  const treeform_search_file_options* options,
                                                  treeform_search_result** result) {
    return glue::guard([&] {
        glue::start(result);
        give_found(tf::self_intersections_of_file(&glue::need(path, "path"), options_of(options)),
                   result);
    });
}

treeform_code treeform_is_searched_in_tiles(const char* path, const char* format, int32_t* is) {
    return glue::guard([&] {
        glue::need(is, "is") =
            tf::is_searched_in_tiles(&glue::need(path, "path"), glue::text(format));
    });
}

treeform_code treeform_search_create(const char* path, const treeform_search_file_options* options,
                                     treeform_search** search) {
    return glue::guard([&] {
        glue::start(search);
        auto made = glue::make<treeform_search>();
        made->value.steps.emplace(&glue::need(path, "path"), options_of(options));
        glue::give(std::move(made), search);
    });
}

treeform_code treeform_search_scatter(treeform_search* search, size_t* tiles) {
    return glue::guard([&] {
        (void)glue::need(tiles, "tiles");
        glue::check(steps(search).scatter());
        *tiles = steps(search).tiles();
    });
}

treeform_code treeform_search_unfinished(treeform_search* search, treeform_indices** tiles) {
    return glue::guard([&] {
        glue::start(tiles);
        const auto found = steps(search).unfinished();
        auto made = glue::make<treeform_indices>();
        made->value.values =
            made->keep(std::vector<std::uint32_t>(found.begin(), found.end())).data();
        made->value.count = found.size();
        glue::give(std::move(made), tiles);
    });
}

treeform_code treeform_search_tile(treeform_search* search, size_t tile) {
    return glue::guard([&] { glue::check(steps(search).search_tile(tile)); });
}

treeform_code treeform_search_finish(treeform_search* search, treeform_search_result** result) {
    return glue::guard([&] {
        glue::start(result);
        give_found(steps(search).finish(), result);
    });
}

treeform_code treeform_search_remove_folder(treeform_search* search) {
    return glue::guard([&] { steps(search).remove_folder(); });
}
