#include <treeform/mesh/self_intersections.hpp>

#include <tools/c/glue.hpp>
#include <tools/c/made/structs.hpp>

namespace tf = treeform;

struct treeform_search {
    void* owner;
    std::optional<treeform::stream_search> steps;
};

namespace {

tf::stream_search& steps(treeform_search* search) { return *glue::need(search, "search").steps; }

}  // namespace

treeform_code treeform_search_create(const char* path, const treeform_search_file_options* options,
                                     treeform_search** search) {
    return glue::guard([&] {
        glue::start(search);
        auto made = glue::make<treeform_search>();
        made->value.steps.emplace(&glue::need(path, "path"), glue::read(options));
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
        return glue::give(std::vector<std::uint32_t>(found.begin(), found.end()), tiles);
    });
}

treeform_code treeform_search_tile(treeform_search* search, size_t tile) {
    return glue::guard([&] { glue::check(steps(search).search_tile(tile)); });
}

treeform_code treeform_search_finish(treeform_search* search, treeform_search_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(steps(search).finish(), result);
    });
}

treeform_code treeform_search_remove_folder(treeform_search* search) {
    return glue::guard([&] { steps(search).remove_folder(); });
}
