#include <libmesh/face_tree.hpp>
#include <libmesh/intersect/detail/join_outputs.hpp>
#include <libmesh/intersect/detail/pair_sieve.hpp>
#include <libmesh/intersect/self_intersections.hpp>
#include <libtree/parallel.hpp>
#include <libtree/search_self.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>

namespace tf {
namespace {

constexpr std::size_t grain = std::size_t{1} << 14;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Lowest i in [0, count) that `bad` holds for, or `count`.
template <class Bad>
std::size_t first_bad(std::size_t count, const Bad& bad) {
    std::vector<std::size_t> first(chunk_count(count, grain), count);
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t i = begin; i < end && first[chunk] == count; ++i)
            if (bad(i)) first[chunk] = i;
    });
    return first.empty() ? count : *std::min_element(first.begin(), first.end());
}

void check(mesh_view mesh, const self_intersection_options& options) {
    const auto refuse = [](const char* what, std::size_t i, const char* why) {
        throw std::invalid_argument(std::string("tf::self_intersections: ") + what + " " +
                                    std::to_string(i) + " " + why);
    };
    const std::size_t bad_face = first_bad(mesh.faces.size(), [&](std::size_t i) {
        const face& f = mesh.faces[i];
        return std::max({f[0], f[1], f[2]}) >= mesh.points.size();
    });
    if (bad_face != mesh.faces.size()) refuse("face", bad_face, "has a corner that is no point");
    const std::size_t bad_point = first_bad(mesh.points.size(), [&](std::size_t i) {
        const point3& p = mesh.points[i];
        return !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    });
    if (bad_point != mesh.points.size()) refuse("point", bad_point, "is not finite");
    const std::size_t labels = options.component_of_face.size();
    if (labels != mesh.faces.size() && (labels != 0 || options.between || options.within))
        throw std::invalid_argument("tf::self_intersections: " + std::to_string(labels) +
                                    " components for " + std::to_string(mesh.faces.size()) +
                                    " faces");
}

bool fits_filter(points_view points) {
    return first_bad(points.size(), [&](std::size_t i) {
               const point3& p = points[i];
               return !(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <=
                        detail::largest_filtered_coordinate);
           }) == points.size();
}

/// The faces in leaf order, so that candidates find theirs side by side.
detail::buffer<detail::numbered_face> leaf_order(mesh_view mesh, const tree<3>& tree) {
    detail::buffer<detail::numbered_face> faces(mesh.faces.size());
    for_chunks(mesh.faces.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t id = tree.ids()[i];
            const face& f = mesh.faces[id];
            faces[i] = {f[0], f[1], f[2], f[0], f[1], id};
        }
    });
    return faces;
}

}  // namespace

self_intersection_result self_intersections(mesh_view mesh,
                                            const self_intersection_options& options) {
    check(mesh, options);
    self_intersection_result result;
    const auto tree_start = std::chrono::steady_clock::now();
    const tree<3> tree = face_tree(mesh);
    result.tree_seconds = seconds_since(tree_start);

    const auto pair_start = std::chrono::steady_clock::now();
    const detail::buffer<detail::numbered_face> faces = leaf_order(mesh, tree);
    const detail::sieve_input input{mesh.points, faces.span(), &options, fits_filter(mesh.points)};
    const self_search<3> search(tree);
    std::vector<detail::sieve_output> found(search.chunks());
    detail::search_progress progress(options.progress, search.chunks());
    std::atomic<std::size_t> last{search.chunks()};  // the first chunk that found enough
    for_chunks(search.chunks(), 1, [&](std::size_t chunk, std::size_t, std::size_t) {
        const auto not_needed = [&] { return progress.cancelled() || chunk > last.load(); };
        const auto satisfied = [&] { return options.first_only && !found[chunk].pairs.empty(); };
        detail::pair_sieve sieve(input, found[chunk]);
        search.visit(chunk, [&](const candidate_block& block) {
            sieve.add(block);
            return !satisfied() && !not_needed();
        });
        if (satisfied()) detail::lower(last, chunk);
        progress.chunk_done();
    });
    if (options.first_only) detail::keep_first(found);
    detail::join_outputs(found, options.limit, result);
    result.cancelled = progress.cancelled();
    result.pair_seconds = seconds_since(pair_start);
    return result;
}

}  // namespace tf
