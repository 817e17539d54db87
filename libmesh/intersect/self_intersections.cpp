#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/checked_face_tree.hpp>
#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/intersect/height_field_nodes.hpp>
#include <libmesh/intersect/join_outputs.hpp>
#include <libmesh/intersect/narrow_phase.hpp>
#include <libmesh/intersect/own_candidates.hpp>
#include <libmesh/intersect/pairs_by_tree.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/detail/box_in_space.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <atomic>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void check(mesh_view mesh, const face_pair_options& options) {
    detail::base::check_faces("self_intersections", mesh.points.size(), mesh.faces);
    const std::size_t bad_point = detail::base::first_bad(mesh.points.size(), [&](std::size_t i) {
        return !detail::base::is_finite(mesh.points[i]);
    });
    if (bad_point != mesh.points.size())
        throw std::invalid_argument("treeform::self_intersections: point " +
                                    std::to_string(bad_point) + " is not finite");
    const std::size_t labels = options.component_of_face.size();
    if (labels != mesh.faces.size() && (labels != 0 || options.between || options.within))
        throw std::invalid_argument("treeform::self_intersections: " + std::to_string(labels) +
                                    " component numbers for " + std::to_string(mesh.faces.size()) +
                                    " faces");
    if (options.between && options.within)
        throw std::invalid_argument(
            "treeform::self_intersections: between and within exclude each other");
}

bool fits_filter(const tree<3>& tree) {
    const aabb<double, 3> box = detail::box_of_root(tree);
    constexpr double limit = detail::intersect::largest_filtered_coordinate;
    for (std::size_t k = 0; k < 3; ++k)
        if (!box.empty() && !(-limit <= box.min[k] && box.max[k] <= limit)) return false;
    return true;
}

/// The faces in leaf order, so that candidates find theirs side by side.
detail::buffer<detail::intersect::numbered_face> leaf_order(mesh_view mesh, const tree<3>& tree) {
    detail::buffer<detail::intersect::numbered_face> faces(mesh.faces.size());
    for_chunks(mesh.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t i = begin; i < end; ++i) {
                       const std::uint32_t id = tree.ids()[i];
                       const face& f = mesh.faces[id];
                       faces[i] = {f[0], f[1], f[2], id};
                   }
               });
    return faces;
}

constexpr std::size_t all_pairs = std::numeric_limits<std::size_t>::max();

/// Goes on until more pairs than `most` have been found; keeps those that are wanted.
face_pair_result find_pairs(mesh_view mesh, const tree<3>& tree, const face_pair_options& options,
                            std::size_t most = all_pairs,
                            const detail::intersect::wanted_pairs* wanted = nullptr) {
    face_pair_result result;
    const auto pair_start = std::chrono::steady_clock::now();
    const detail::buffer<detail::intersect::numbered_face> faces = leaf_order(mesh, tree);
    const detail::intersect::own_faces own{mesh.points, faces.span(), &options, fits_filter(tree)};
    const detail::node_marks<3> fields =
        own.filtered ? detail::intersect::find_height_fields(mesh.points, faces.span(), tree)
                     : detail::node_marks<3>(tree);
    const self_search_chunks<3> search(tree, fields);
    std::vector<detail::intersect::narrow_phase_output> found(search.chunks());
    detail::intersect::search_progress progress(options.progress, search.chunks());
    std::atomic<std::size_t> last{search.chunks()};  // the first chunk that found enough
    std::atomic<std::size_t> count{0};
    for_chunks(search.chunks(), 1, [&](std::size_t chunk, std::size_t, std::size_t) {
        const auto not_needed = [&] {
            return progress.cancelled() || chunk > last.load() || count.load() > most;
        };
        const auto satisfied = [&] { return options.first_only && !found[chunk].pairs.empty(); };
        detail::intersect::narrow_phase<detail::intersect::own_candidates> phase(options.kinds,
                                                                                 found[chunk], own);
        search.visit(chunk, [&](const candidate_block& block) {
            phase.add(block);
            return !satisfied() && !not_needed();
        });
        if (wanted != nullptr)
            std::erase_if(found[chunk].pairs,
                          [&](const face_pair& pair) { return !(*wanted)(pair); });
        if (satisfied()) detail::lower(last, chunk);
        count += found[chunk].pairs.size();
        progress.chunk_done();
    });
    if (options.first_only) detail::intersect::keep_first(found);
    detail::intersect::join_outputs(found, options.limit, result);
    if (progress.cancelled()) result.status = status::cancelled;
    result.pair_seconds = seconds_since(pair_start);
    return result;
}

}  // namespace

face_pair_result self_intersections(const mesh_ref& given, const face_pair_options& options) {
    const mesh_view mesh = given.view();
    check(mesh, options);
    if (given.prepared() != nullptr)
        return find_pairs(options.vertices == vertex_identity::by_coordinates
                              ? detail::weld::join_faces(*given.prepared()).of(mesh)
                              : mesh,
                          build_face_tree(*given.prepared()), options);
    detail::weld::joined_faces joined;
    if (options.vertices == vertex_identity::by_coordinates)
        joined = detail::weld::join_faces(mesh);
    const auto start = std::chrono::steady_clock::now();
    tree<3> tree = detail::base::checked_face_tree(mesh);
    const double seconds = seconds_since(start);
    face_pair_result result =
        detail::intersect::pairs_by_tree(joined.of(mesh), std::move(tree), options);
    result.tree_seconds = seconds;
    return result;
}

face_pair_result detail::intersect::pairs_by_tree(mesh_view mesh, tree<3>&& tree,
                                                  const face_pair_options& options) {
    const auto ours = std::move(tree);
    return find_pairs(mesh, ours, options);
}

face_pair_result detail::intersect::pairs_by_tree(mesh_view mesh, const tree<3>& tree,
                                                  const face_pair_options& options,
                                                  std::size_t most, const wanted_pairs* wanted) {
    return find_pairs(mesh, tree, options, most, wanted);
}

}  // namespace treeform
