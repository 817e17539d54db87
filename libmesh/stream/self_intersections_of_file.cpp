#include <libmesh/stream/tile_search.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <utility>

namespace treeform {

namespace fs = std::filesystem;

stream_search_result self_intersections_of_file(const std::filesystem::path& input,
                                                const stream_search_options& options) {
    detail::stream::pacer pace(options.progress);
    detail::stream::work_folder folder(options.folder.empty() ? fs::path(input.string() + ".tiles")
                                                              : options.folder);
    detail::stream::tile_search search(pace, folder, input, options);
    stream_search_result result;
    try {
        search.scatter();
        result = search.search();
    } catch (const detail::stream::cancelled&) {
        result.found.cancelled = true;
        return result;
    }
    folder.remove();
    return result;
}

}  // namespace treeform
