#include "tools/tf-selfintersect/in_tiles.hpp"

#include "tools/shell/console.hpp"
#include "tools/shell/shared_digests.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace tools {
namespace {

/// What needs the whole mesh; empty where tiles will do.
std::string what_needs_memory(const job& work, const search_settings& settings, bool changes_mesh) {
    if (changes_mesh) return "a mesh to write";
    if (settings.between) return "--between";
    if (settings.within) return "--within";
    if (settings.first) return "--first";
    if (settings.tolerance.value > 0.0) return "-t";
    if (work.path == "-") return "standard input";
    if (is_read_once(work.path)) return "a pipe";
    try {
        if (!tf::shared_search::accepts(work.path, work.options.format))
            return "a file that is neither a binary STL nor a PLY";
    } catch (const tf::io_error&) {
        return {};  // the reader names the fault
    }
    return {};
}

void enter_source(job& work, const tf::mesh_file& header, const std::string& sum) {
    work.entry["format"] = header.format;
    work.entry["sha256"] = sum.empty() ? json(nullptr) : json(sum);
    work.entry["precision_in"] = name_of(header.stored_as);
    work.warn(header.warnings);
}

findings findings_of(tf::file_search_result&& r) {
    findings result;
    result.part = std::move(r.part);
    result.found = std::move(r.found);
    result.box = r.bounds;
    result.faces_stored = r.stored_faces;
    result.triangles = r.triangles;
    result.searched = r.searched;
    result.points_stored = r.points;
    return result;
}

}  // namespace

bool needs_tiles(job& work, const search_settings& settings, const tile_options& tiles,
                 bool changes_mesh) {
    // By measure: of faces, points and tree in memory, for each byte of a file.
    constexpr std::uint64_t bytes_per_byte = 4;
    const bool asked = tiles.is_asked();
    const std::uint64_t allowed =
        work.options.memory > 0 ? work.options.memory : tf::weld_stream_options::default_memory();
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(work.path, error);
    const std::uint64_t program = std::min(allowed / 2, std::uint64_t{24} << 20);
    if (!asked && (error || size < (allowed - program) / bytes_per_byte)) {
        const std::string remark = remark_on_folder(tiles);
        if (!remark.empty()) work.warn("in-memory", remark);
        return false;
    }
    const std::string why = what_needs_memory(work, settings, changes_mesh);
    constexpr std::uint64_t least = 48;  // MB, by measure; some 40 even with a tile of 1000 faces
    if (why.empty() && allowed < least << 20) {
        // A face takes 13 bytes of a file at least, and 250 in a tile; some tiles get more of them.
        const std::uint64_t of_tile = std::min(tiles.per_tile, size / 13) * 320 >> 20;
        throw failure(stopped, "memory",
                      work.name + ": --memory " + std::to_string(allowed >> 20) +
                          "M is too little; the search in tiles needs about " +
                          std::to_string(least + of_tile) + "M, and memory for the pairs found");
    }
    if (why.empty()) return true;
    std::string text = why + " needs the whole mesh in memory";
    if (!error) text += ", about " + grouped(size * bytes_per_byte / 1000000 + 1) + " MB";
    if (asked) throw failure(bad_usage, "usage", text);
    if (work.options.memory > 0) work.warn("in-memory", text + "; --memory may not be enough");
    return false;
}

namespace {

tf::file_search_options library_options(job& work, const search_settings& settings,
                                        const tile_options& tiles,
                                        const std::filesystem::path& folder) {
    tf::file_search_options options;
    options.vertices = settings.vertices;
    options.kinds = settings.looked_for();
    options.box = settings.box;
    options.format = work.options.format;
    options.memory = work.options.memory;
    options.folder = folder;
    options.faces_per_tile = tiles.per_tile;
    options.communicator = tiles.communicator;
    options.progress = [&work](std::string_view step, double share) {
        return work.progress(step)(share);
    };
    options.step_done = tiles.step_done();
    return options;
}

/// A step of the library's work.
template <class Step>
auto take(job& work, const Step& step) {
    try {
        return step();
    } catch (const tf::io_error& error) {
        if (error.why() == tf::io_error::kind::file) throw;
        throw failure_of(work, error);
    }
}

}  // namespace

void share_search(job& work, const search_settings& settings, const tile_options& tiles) {
    const std::string folder = tiles.folder.string();
    take(work, [&] {
        const job::timer timing = work.time(tiles.plan ? "read" : "pairs");
        tf::shared_search search(work.path, library_options(work, settings, tiles, folder));
        if (tiles.plan) {
            work.call_ended(search.scatter() == tf::status::cancelled);
            enter_tiles(work, search.tiles(), folder, search.unfinished());
            say_tiles(work);
            return;
        }
        if (*tiles.tile >= search.tiles())
            throw failure(bad_usage, "usage",
                          "--tile " + std::to_string(*tiles.tile) + ": there are only " +
                              counted(search.tiles(), "tile", "tiles") + " in " + folder);
        work.call_ended(search.search_tile(*tiles.tile) == tf::status::cancelled);
        work.out.result(work.name + ": tile " + std::to_string(*tiles.tile) + " of " +
                        grouped(search.tiles()) + " done");
    });
}

findings search_in_tiles(job& work, const search_settings& settings, const tile_options& tiles,
                         const std::filesystem::path& folder) {
    const auto options = library_options(work, settings, tiles, folder);
    const double before = work.seconds["read"];
    tf::file_search_result r = take(work, [&] {
        const job::timer timing = work.time("read");
        if (!tiles.finish) return tf::self_intersections_of_file(work.path, options);
        tf::shared_search search(work.path, options);
        return search.finish();
    });
    work.call_ended(r.found.status == tf::status::cancelled);
    const std::string sum = digests_for_report({work.path}, tiles).front();
    if (tiles.communicator.rank > 0) return {};
    work.seconds["tree"] += r.found.tree_seconds;
    work.seconds["pairs"] += r.found.pair_seconds;
    work.seconds["read"] =
        std::max(before, work.seconds["read"] - r.found.tree_seconds - r.found.pair_seconds);
    enter_source(work, r.header, sum);
    if (r.part.non_finite == r.triangles) throw no_triangles(work.name, r.triangles, r.points);
    work.warn_of_non_finite(r.part.non_finite, "face", "faces");
    if (r.started_anew)
        work.warn("started-anew", folder.string() +
                                      ": the tiles there are not of this input and these options; "
                                      "started again");
    work.out.info(
        work.name + ": searched in " + counted(r.tiles, "tile", "tiles") + " in " +
        folder.string() +
        (r.finished_tiles > 0 ? ", " + grouped(r.finished_tiles) + " finished earlier" : ""));
    enter_tiles(work, r.tiles, folder, {});
    findings result = findings_of(std::move(r));
    group_findings(work, result, settings);
    return result;
}

}  // namespace tools
