#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/parallel_invoke.hpp>
#include <libmesh/base/part_of_progress.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/boolean/finish_surface.hpp>
#include <libmesh/boolean/merged_cuts.hpp>
#include <libmesh/round/round_surface.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {
namespace {

/// Whether two faces are one, turned or not.
bool same_corners(const face& f, const face& g) { return f == g || f == face{g[0], g[2], g[1]}; }

}  // namespace

boolean_result with_counts(const arrange_faces_result& arranged) {
    boolean_result result;
    result.certificate.status = status::cancelled;
    result.statistics.pairs = arranged.pairs;
    result.statistics.cut_faces = arranged.cut_faces;
    result.statistics.degenerate = arranged.degenerate.size();
    return result;
}

void sort_by_source(std::vector<std::uint32_t>& source, std::vector<face>& faces) {
    const auto falls = [&](std::size_t i) { return source[i] > source[i + 1]; };
    if (source.empty() || base::first_bad(source.size() - 1, falls) == source.size() - 1) return;
    std::vector<std::uint32_t> order(source.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return source[i]; });
    std::vector<face> sorted(faces.size());
    for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = faces[order[i]];
    faces = std::move(sorted);
    std::ranges::sort(source);
}

void finish_surface(boolean_result& result, mesh_arrangement& cut, round::solid_faces chosen,
                    joined_operands& joined, bool solid, const boolean_options& options,
                    left_faces is_left) {
    std::vector<std::uint32_t> face_of = std::move(chosen.face_of);
    exact_surface exact{std::move(cut.given_points), std::move(cut.constructed),
                        std::move(chosen.faces), std::vector<std::uint8_t>(face_of.size())};
    for_chunks(face_of.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f) {
            const std::uint32_t source = cut.covers_of(face_of[f]).front().face;
            exact.sound[f] = cut.whole[face_of[f]] != 0 &&
                             same_corners(exact.faces[f], joined.all.faces[source]);
            face_of[f] = source;
        }
    });
    const std::size_t given = exact.given.size();
    face_origins origins;
    const std::vector<std::uint32_t> face_of_point =
        merge_cuts(exact, face_of, joined.all.faces,
                   groups_of(options, joined.number_of_face, joined.first_face.back()), options,
                   is_left == nullptr ? nullptr : &origins);
    result.statistics.exact_faces = face_of.size();
    cut = {};
    joined.all = {};
    rounded_surface r =
        round_surface(std::move(exact), {.precision = options.precision,
                                         .solid = solid,
                                         .max_displacement = options.max_displacement,
                                         .progress = base::part_of(options.progress, 0.7, 1.0)});
    result.certificate = std::move(r.certificate);
    if (result.certificate.status == status::cancelled) return;
    result.mesh = std::move(r.surface);
    result.statistics.rounding_rounds = r.rounds;
    result.statistics.slivers = r.slivers;
    result.vanished_components = r.vanished_components;
    result.vanished_reach = r.vanished_reach;
    result.vanished_at = std::move(r.vanished_at);
    origins.for_sources_in(r.face_of,
                           [&](std::uint32_t f) { (*is_left)[joined.face_source(f).index] = 1; });
    for_chunks(r.face_of.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f) r.face_of[f] = face_of[r.face_of[f]];
    });
    sort_by_source(r.face_of, result.mesh.faces);
    const std::size_t points = r.point_of.size();
    base::parallel_invoke(
        [&] { base::resize_all(r.face_of.size(), result.face_source); },
        [&] { base::resize_all(points, result.vertex_source); },
        [&] { base::resize_all(merges_faces(options) ? points : 0, result.face_of_cut_vertex); });
    for_chunks(r.face_of.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f)
            result.face_source[f] = joined.face_source(r.face_of[f]);
    });
    for_chunks(points, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            if (const std::uint32_t p = r.point_of[i]; p < given)
                result.vertex_source[i] = joined.point_source(p);
            else if (p != rounded_surface::none && merges_faces(options))
                result.face_of_cut_vertex[i] = joined.face_source(face_of_point[p - given]);
    });
}

}  // namespace treeform::detail::boolean
