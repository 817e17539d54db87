#include <libmesh/boolean/merged_cuts.hpp>
#include <libmesh/boolean/pair_surface.hpp>
#include <libmesh/round/round_surface.hpp>
#include <libmesh/topology/is_manifold.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {
namespace {

using ids = std::vector<std::uint32_t>;

/// Puts together the faces that were cut and those that were not, of both operands counted through.
class assembly {
  public:
    assembly(std::span<const mesh_view, 2> operands, const near_faces& near,
             const buffer<fate>& fates)
        : operands_(operands),
          near_(near),
          fates_(fates),
          faces_{0, operands[0].faces.size(), operands[0].faces.size() + operands[1].faces.size()},
          points_{0, operands[0].points.size(),
                  operands[0].points.size() + operands[1].points.size()},
          number_(points_[2]) {}

    /// `source` are faces of operands, ascending, one for each face of `rounded`, whose points are
    /// those of `near_` and others. Returns the vertices of these in the result.
    ids write(const rounded_surface& rounded, const ids& source, boolean_result& result) {
        number_points(rounded, result);
        ids corner(rounded.point_of.size());
        const auto first_made = static_cast<std::uint32_t>(given_);
        for (std::size_t p = 0, made = 0; p < corner.size(); ++p)
            corner[p] = is_made(rounded.point_of[p])
                            ? first_made + static_cast<std::uint32_t>(made++)
                            : number_[near_.point_of[rounded.point_of[p]]];
        write_faces(rounded, corner, source, result);
        return corner;
    }

  private:
    [[nodiscard]] bool is_made(std::uint32_t local_point) const {
        return local_point >= near_.point_of.size();
    }
    [[nodiscard]] std::size_t operand_of(std::size_t face) const {
        return face < faces_[1] ? 0 : 1;
    }
    [[nodiscard]] const face& corners(std::size_t face) const {
        const std::size_t k = operand_of(face);
        return operands_[k].faces[face - faces_[k]];
    }

    /// Calls `visit(face)` for the faces from `begin` to `end` that were not cut and stay.
    template <class Visit>
    void for_far_faces(std::size_t begin, std::size_t end, const Visit& visit) const {
        for (std::size_t f = begin; f < end; ++f)
            if (fates_[f] == fate::kept || fates_[f] == fate::turned) visit(f);
    }

    /// Numbers the points in use, those of operands first.
    void number_points(const rounded_surface& rounded, boolean_result& result) {
        const auto use = [&](std::size_t p) {
            std::atomic_ref(number_[p]).store(1, std::memory_order_relaxed);
        };
        for_chunks(points_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            std::fill(number_.data() + begin, number_.data() + end, 0U);
        });
        for_chunks(faces_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for_far_faces(begin, end, [&](std::size_t f) {
                for (const std::uint32_t p : corners(f)) use(points_[operand_of(f)] + p);
            });
        });
        std::size_t made = 0;
        for (const std::uint32_t p : rounded.point_of)
            if (is_made(p))
                ++made;
            else
                number_[near_.point_of[p]] = 1;

        std::vector<std::size_t> first(chunk_count(points_[2], light_grain) + 1, 0);
        for_chunks(points_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
            for (std::size_t p = begin; p < end; ++p) first[c + 1] += number_[p];
        });
        for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
        given_ = first.back();
        std::vector<point3>& points = result.mesh.points;
        points.resize(given_ + made);
        result.vertex_source.resize(given_ + made);
        for_chunks(points_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
            std::size_t next = first[c];
            for (std::size_t p = begin; p < end; ++p) {
                if (number_[p] == 0) continue;
                const std::size_t k = p < points_[1] ? 0 : 1;
                const auto index = static_cast<std::uint32_t>(p - points_[k]);
                number_[p] = static_cast<std::uint32_t>(next);
                points[next] = operands_[k].points[index];
                result.vertex_source[next++] = {static_cast<std::uint32_t>(k), index};
            }
        });
        std::size_t next = given_;
        for (std::size_t p = 0; p < rounded.point_of.size(); ++p)
            if (is_made(rounded.point_of[p])) points[next++] = rounded.surface.points[p];
    }

    void write_faces(const rounded_surface& rounded, const ids& corner, const ids& source,
                     boolean_result& result) const {
        const auto pieces_before = [&](std::size_t face) {
            return static_cast<std::size_t>(std::lower_bound(source.begin(), source.end(), face) -
                                            source.begin());
        };
        std::vector<std::size_t> first(chunk_count(faces_[2], light_grain) + 1, 0);
        for_chunks(faces_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
            std::size_t count = pieces_before(end) - pieces_before(begin);
            for_far_faces(begin, end, [&](std::size_t) { ++count; });
            first[c + 1] = count;
        });
        for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
        std::vector<face>& faces = result.mesh.faces;
        faces.resize(first.back());
        result.face_source.resize(first.back());
        for_chunks(faces_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
            std::size_t next = first[c];
            const auto put = [&](std::size_t f, const face& corners) {
                const std::size_t k = operand_of(f);
                faces[next] = corners;
                result.face_source[next++] = {static_cast<std::uint32_t>(k),
                                              static_cast<std::uint32_t>(f - faces_[k])};
            };
            std::size_t piece = pieces_before(begin);
            const auto put_pieces_before = [&](std::size_t f) {
                for (; piece < source.size() && source[piece] < f; ++piece) {
                    const auto& [p, q, r] = rounded.surface.faces[piece];
                    put(source[piece], {corner[p], corner[q], corner[r]});
                }
            };
            for_far_faces(begin, end, [&](std::size_t f) {
                put_pieces_before(f);
                const std::size_t k = operand_of(f);
                const std::uint32_t* const number = number_.data() + points_[k];
                const auto& [p, q, r] = corners(f);
                put(f, fates_[f] == fate::kept ? face{number[p], number[q], number[r]}
                                               : face{number[p], number[r], number[q]});
            });
            put_pieces_before(end);
        });
    }

    std::span<const mesh_view, 2> operands_;
    const near_faces& near_;
    const buffer<fate>& fates_;
    std::array<std::size_t, 3> faces_;   ///< where those of each operand begin
    std::array<std::size_t, 3> points_;  ///< likewise
    buffer<std::uint32_t> number_;       ///< of points of operands, in the result
    std::size_t given_ = 0;
};

}  // namespace

bool can_be_counted_through(const prepared_pair& operands) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max() / 4;
    const mesh_view a = operands[0]->view(), b = operands[1]->view();
    return a.points.size() + b.points.size() < most && a.faces.size() + b.faces.size() < most;
}

std::optional<pair_result> surface_of_pair(const prepared_pair& pair, const near_faces& near,
                                           arrange_faces_result& arranged,
                                           round::solid_faces chosen, const buffer<fate>& fates,
                                           const boolean_options& options) {
    pair_result made;
    boolean_result& result = made.result;
    mesh_arrangement& cut = arranged.cut;
    exact_surface exact{std::move(cut.given_points), std::move(cut.constructed),
                        std::move(chosen.faces)};
    exact.sound.resize(chosen.face_of.size());
    for_chunks(chosen.face_of.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t f = begin; f < end; ++f) {  // local faces from here on
                       exact.sound[f] = cut.whole[chosen.face_of[f]];
                       chosen.face_of[f] = cut.covers_of(chosen.face_of[f]).front().face;
                   }
               });
    cut = {};
    const ids face_of_point =
        merge_cuts(exact, chosen.face_of, near.local.faces,
                   groups_of(options, near.face_of, near.place.size()), options);
    const std::size_t exact_faces = chosen.face_of.size();
    // What was left out meets no box of what was cut, and so no piece of it either, rounded or not:
    // rounding to nearest takes no coordinate out of a box of doubles.
    rounded_surface rounded = round_surface(std::move(exact), {.mends = false});
    if (!rounded.certificate || rounded.vanished_components > 0) return std::nullopt;
    if (options.progress && !options.progress(0.8)) {
        result.certificate.status = status::cancelled;
        return made;
    }
    ids source(rounded.face_of.size());
    for_chunks(source.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            source[i] = near.face_of[chosen.face_of[rounded.face_of[i]]];
    });
    const std::array operands{pair[0]->view(), pair[1]->view()};
    const ids near_vertices = assembly(operands, near, fates).write(rounded, source, result);
    // Faces that were not cut are as they were in their operand, all of those at a vertex or none.
    made.is_manifold = topology::is_manifold_at(near_vertices, result.mesh);
    if (merges_faces(options)) {
        result.face_of_cut_vertex.resize(result.mesh.points.size());
        const std::size_t given = near.point_of.size(), faces_of_a = operands[0].faces.size();
        for (std::size_t p = 0; p < near_vertices.size(); ++p) {
            if (rounded.point_of[p] < given) continue;
            const std::uint32_t f = near.face_of[face_of_point[rounded.point_of[p] - given]];
            result.face_of_cut_vertex[near_vertices[p]] =
                f < faces_of_a ? operand_element{0, f}
                               : operand_element{1, static_cast<std::uint32_t>(f - faces_of_a)};
        }
    }
    result.certificate = std::move(rounded.certificate);
    result.statistics.pairs = arranged.pairs;
    result.statistics.cut_faces = arranged.cut_faces;
    result.statistics.exact_faces = result.mesh.faces.size() + (exact_faces - source.size());
    if (options.progress && !options.progress(1.0)) result.certificate.status = status::cancelled;
    return made;
}

}  // namespace treeform::detail::boolean
