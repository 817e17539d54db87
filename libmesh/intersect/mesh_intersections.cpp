#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/effort.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/intersect/block_candidates.hpp>
#include <libmesh/intersect/face_candidates.hpp>
#include <libmesh/intersect/join_outputs.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/intersect/narrow_phase.hpp>
#include <libmesh/intersect/overlap_trees.hpp>
#include <libmesh/nearness/bounding_cylinders.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search_pair.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform {
namespace {

void check_tree(const char* function, const char* which, mesh_view mesh, const tree<3>& tree) {
    if (tree.size() != mesh.faces.size())
        throw std::invalid_argument(std::string(function) + ": the tree of the " + which +
                                    " mesh has " + std::to_string(tree.size()) +
                                    " primitives, but the mesh has " +
                                    std::to_string(mesh.faces.size()) + " faces");
}

void check_faces_met(const char* function, const detail::intersect::bad_faces& bad) {
    const auto refuse = [&](const char* which, std::uint32_t face) {
        throw std::invalid_argument(std::string(function) + ": " + which + ": face " +
                                    std::to_string(face) +
                                    " has a corner out of range or not finite");
    };
    if (bad.in_a != detail::intersect::bad_faces::none) refuse("a", bad.in_a);
    if (bad.in_b != detail::intersect::bad_faces::none) refuse("b", bad.in_b);
}

void add(const detail::intersect::bad_faces& more, detail::intersect::bad_faces& bad) {
    bad.in_a = std::min(bad.in_a, more.in_a);
    bad.in_b = std::min(bad.in_b, more.in_b);
}

/// Pairs that the chunks of a search have looked at, of which there may be too many: those up to
/// the first chunk that found enough count, which is the same on any number of threads.
class tested_pairs {
  public:
    tested_pairs(std::size_t chunks, std::uint64_t most)
        : of_chunk_(most == unlimited ? 0 : chunks), most_(most) {}

    static constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

    /// False when the chunks up to this one have too many: what comes after them does not matter.
    bool add(std::size_t chunk, std::uint64_t pairs) {
        if (of_chunk_.empty()) return true;
        const std::uint64_t before = of_chunk_[chunk].fetch_add(pairs, std::memory_order_relaxed);
        const std::uint64_t step = most_ / 256 + 1;  // all chunks are asked now and then
        return before / step == (before + pairs) / step || up_to(chunk) <= most_;
    }
    [[nodiscard]] std::uint64_t up_to(std::size_t chunk) const {
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i <= chunk && i < of_chunk_.size(); ++i)
            sum += of_chunk_[i].load(std::memory_order_relaxed);
        return sum;
    }

  private:
    std::vector<std::atomic<std::uint64_t>> of_chunk_;
    std::uint64_t most_;
};

constexpr bool in_both_frames = true;  // boxes are also compared in the frame of a moved tree

/// What the chunks of a search give, in a narrow phase each.
template <class Source>
face_pair_result classified(const pair_search_chunks<3>& search,
                            const typename Source::input& meshes, const face_pair_options& options,
                            detail::base::effort* effort = nullptr) {
    const std::size_t chunks = search.chunks();
    tested_pairs looked(chunks, effort ? effort->allowance() : tested_pairs::unlimited);
    std::vector<detail::intersect::narrow_phase_output> found(chunks);
    std::vector<detail::intersect::bad_faces> bad(chunks);
    detail::intersect::search_progress progress(options.progress, chunks);
    std::atomic<std::size_t> last{chunks};  // the first chunk that found enough
    for_chunks(chunks, 1, [&](std::size_t chunk, std::size_t, std::size_t) {
        const auto not_needed = [&] { return progress.cancelled() || chunk > last.load(); };
        detail::intersect::narrow_phase_output mine;  // outputs of neighbors share cache lines
        bool too_many = false;
        const auto satisfied = [&] { return options.first_only && !mine.pairs.empty(); };
        detail::intersect::narrow_phase<Source> phase(options.kinds, mine, meshes, bad[chunk]);
        search.visit(chunk, [&](const candidate_block& block) {
            if (not_needed()) return false;
            phase.add(block);
            too_many = !looked.add(chunk, block.first.size());
            return !satisfied() && !too_many;
        });
        if (satisfied() || too_many) detail::lower(last, chunk);
        found[chunk] = std::move(mine);
        progress.chunk_done();
    });
    if (effort && !effort->spend(looked.up_to(last.load()))) {
        face_pair_result nothing;
        nothing.status = treeform::status::cancelled;
        return nothing;
    }
    detail::intersect::bad_faces met;
    face_pair_result result;
    for (std::size_t chunk = 0; chunk < std::min(last.load() + 1, chunks); ++chunk)
        add(bad[chunk], met);
    check_faces_met("treeform::mesh_intersections", met);
    if (options.first_only) detail::intersect::keep_first(found);
    detail::intersect::join_outputs(found, options.limit, result);
    if (progress.cancelled()) result.status = status::cancelled;
    return result;
}

/// \param moves what is still to be done to the trees
face_pair_result classified_by_faces(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                     const tree<3>& tree_b, const face_pair_options& options,
                                     const mesh_pair_options& moves,
                                     detail::base::effort* effort = nullptr) {
    const pair_search_chunks<3> search(transformed(tree_a, moves.transform_a),
                                       transformed(tree_b, moves.transform_b), in_both_frames);
    return classified<detail::intersect::face_candidates>(
        search, {{a, tree_a, options.transform_a}, {b, tree_b, options.transform_b}}, options,
        effort);
}

/// \param moves what is still to be done to the trees
bool any_meet(mesh_view a, const tree<3>& tree_a, mesh_view b, const tree<3>& tree_b,
              const mesh_pair_options& positions, const mesh_pair_options& moves) {
    face_pair_options all;
    const detail::intersect::face_candidates::input meshes{{a, tree_a, positions.transform_a},
                                                           {b, tree_b, positions.transform_b}};
    std::mutex mutex;  // taken for a bad face only
    detail::intersect::bad_faces bad;
    const bool found = detail::search_any_broad(
        transformed(tree_a, moves.transform_a), transformed(tree_b, moves.transform_b),
        [&](const candidate_block& block) {
            detail::intersect::narrow_phase_output output;
            detail::intersect::bad_faces met;
            detail::intersect::narrow_phase<detail::intersect::face_candidates>(all.kinds, output,
                                                                                meshes, met)
                .add(block);
            if (met.in_a != met.none || met.in_b != met.none) {
                const std::lock_guard lock(mutex);
                add(met, bad);
            }
            return !output.pairs.empty();
        },
        in_both_frames);
    check_faces_met("treeform::intersects", bad);
    return found;
}

}  // namespace

face_pair_result detail::intersect::mesh_intersections(mesh_view a, const tree<3>& tree_a,
                                                       mesh_view b, const tree<3>& tree_b,
                                                       const face_pair_options& options,
                                                       base::effort* effort) {
    check_tree("treeform::mesh_intersections", "first", a, tree_a);
    check_tree("treeform::mesh_intersections", "second", b, tree_b);
    return classified_by_faces(a, tree_a, b, tree_b, options,
                               {options.transform_a, options.transform_b}, effort);
}

namespace {

face_pair_result between_prepared(const prepared_mesh& a, const prepared_mesh& b,
                                  const face_pair_options& options) {
    const tree<3>& tree_a = build_face_tree(a, "mesh_intersections: a");
    const tree<3>& tree_b = build_face_tree(b, "mesh_intersections: b");
    const pair_search_chunks<3> search(transformed(tree_a, options.transform_a),
                                       transformed(tree_b, options.transform_b), in_both_frames);
    return classified<detail::intersect::block_candidates>(
        search,
        {{detail::nearness::face_blocks_of(a).triangles, tree_a, options.transform_a},
         {detail::nearness::face_blocks_of(b).triangles, tree_b, options.transform_b}},
        options);
}

}  // namespace

face_pair_result mesh_intersections(const mesh_ref& a, const mesh_ref& b,
                                    const face_pair_options& options) {
    if (detail::base::is_prepared_or_cloud(a, b))
        return between_prepared(detail::base::prepared_ref(a), detail::base::prepared_ref(b),
                                options);
    const auto [tree_a, tree_b] = detail::intersect::overlap_trees(
        "mesh_intersections", a.view(), b.view(), {options.transform_a, options.transform_b});
    return classified_by_faces(a.view(), tree_a, b.view(), tree_b, options, {});
}

bool detail::intersect::intersects(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                   const tree<3>& tree_b, const mesh_pair_options& positions) {
    return any_meet(a, tree_a, b, tree_b, positions, positions);
}

bool intersects(const mesh_ref& a, const mesh_ref& b, const mesh_pair_options& positions) {
    if (detail::base::is_prepared_or_cloud(a, b)) {
        const detail::base::prepared_ref of_a(a), of_b(b);
        return detail::intersect::intersects(of_a.view(), build_face_tree(of_a, "intersects: a"),
                                             of_b.view(), build_face_tree(of_b, "intersects: b"),
                                             positions);
    }
    const auto [tree_a, tree_b] =
        detail::intersect::overlap_trees("intersects", a.view(), b.view(), positions);
    return any_meet(a.view(), tree_a, b.view(), tree_b, positions, {});
}

}  // namespace treeform
