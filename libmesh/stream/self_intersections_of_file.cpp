#include <libmesh/io/detect.hpp>
#include <libmesh/io/point_rows.hpp>
#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/tile_search.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <utility>

namespace treeform {

namespace fs = std::filesystem;
using detail::stream::held_alone;
using detail::stream::work_folder;

namespace {

fs::path folder_of(const fs::path& input, const file_search_options& options) {
    return options.folder.empty() ? fs::path(input.string() + ".search-tiles") : options.folder;
}

}  // namespace

struct shared_search::state {
    state(const fs::path& input, const file_search_options& options)
        : pace(options.progress),
          folder(folder_of(input, options), "search", work_folder::use::shared),
          search(pace, folder, lone, input, options) {}

    /// Where the work is cancelled, says so.
    template <class Work>
    [[nodiscard]] static status until_cancelled(const Work& work) {
        try {
            work();
        } catch (const detail::stream::cancelled&) {
            return status::cancelled;
        }
        return status::ok;
    }

    detail::stream::communicator lone{treeform::communicator{}};
    detail::stream::cancellable_progress pace;
    work_folder folder;
    detail::stream::tile_search search;
};

shared_search::shared_search(fs::path input, file_search_options options)
    : state_(std::make_unique<state>(input, options)) {}
shared_search::~shared_search() = default;
shared_search::shared_search(shared_search&&) noexcept = default;
shared_search& shared_search::operator=(shared_search&&) noexcept = default;

status shared_search::scatter() {
    state& s = *state_;
    return state::until_cancelled([&] {
        if (s.search.has_tiles()) return;
        const held_alone lock(s.folder, s.pace);
        if (s.search.has_tiles()) return;  // another process was quicker
        if (s.search.has_plan()) s.folder.fail_with_other_tiles();
        s.search.scatter();
    });
}

std::size_t shared_search::tiles() {
    state& s = *state_;
    if (!s.search.has_tiles()) s.folder.fail_without_tiles();
    return s.search.tiles();
}

std::vector<std::size_t> shared_search::unfinished() {
    static_cast<void>(tiles());
    return state_->search.unfinished();
}

status shared_search::search_tile(std::size_t tile) {
    const std::size_t all = tiles();
    return state::until_cancelled([&] { state_->search.search(tile, tile, all); });
}

file_search_result shared_search::finish() {
    static_cast<void>(tiles());
    return state_->search.finish();
}

void shared_search::remove_folder() { state_->folder.remove(); }

bool shared_search::accepts(const fs::path& input, std::string_view format) {
    const auto in = detail::io::source::open(input);
    const auto found = detail::io::detect(in, detail::io::plain_extension(format),
                                          detail::io::extension_of(input));
    return found.kind == detail::io::file_kind::stl_binary ||
           (found.kind == detail::io::file_kind::ply && detail::io::has_readable_rows(in));
}

file_search_result self_intersections_of_file(const fs::path& input,
                                              const file_search_options& options) {
    detail::stream::cancellable_progress pace(options.progress);
    const detail::stream::communicator all(options.communicator);
    if (!all.is_root()) all.barrier();  // the first one makes the folder
    work_folder folder(folder_of(input, options), "search",
                       all.is_root() ? work_folder::use::alone : work_folder::use::member);
    if (all.is_root()) all.barrier();
    all.barrier();  // or one would make again what the first one has removed
    detail::stream::tile_search search(pace, folder, all, input, options);
    file_search_result result;
    try {
        search.scatter();
        for (std::size_t t = all.rank(); t < search.tiles(); t += all.size()) {
            search.search(t, t, search.tiles());
            search.drop_faces(t);
        }
        all.barrier();
        if (!all.is_root()) return result;
        result = search.finish();
    } catch (const detail::stream::cancelled&) {
        result.found.status = treeform::status::cancelled;
        return result;
    }
    folder.remove();
    return result;
}

}  // namespace treeform
