#include <libmesh/arrange/winding_beside.hpp>
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/face_boxes.hpp>
#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/parallel_invoke.hpp>
#include <libmesh/base/part_of_progress.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/boolean/merged_cuts.hpp>
#include <libmesh/boolean/near_surface.hpp>
#include <libmesh/round/round_surface.hpp>
#include <libmesh/topology/is_manifold.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

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
using round::winding_of_rest;

/// Times that more faces are taken in around what was mended; then all are.
constexpr int most_steps = 3;
/// Where others are fewer than this share of what is near, nothing is mended without them.
constexpr std::size_t few_others = 8;

bool stays(disposition of) { return of == disposition::kept || of == disposition::turned; }

constexpr std::size_t write_grain = std::size_t{1} << 10;
/// Room for one more point in so many, for those that `split_nonmanifold` adds.
constexpr std::size_t slack = 64;

/// Puts together the faces that were cut and those that were not, of both bundles counted through.
class assembly {
  public:
    assembly(const bundles& operands, const interaction_zone& near,
             const buffer<disposition>& dispositions)
        : operands_(operands),
          near_(near),
          dispositions_(dispositions),
          faces_{0, meshes_[0].faces.size(), meshes_[0].faces.size() + meshes_[1].faces.size()},
          points_{0, meshes_[0].points.size(), meshes_[0].points.size() + meshes_[1].points.size()},
          number_(points_[2]) {}

    /// `source` are faces of operands, ascending, one for each face of `rounded`, whose points are
    /// those of `near_` and others. Returns the vertices of these in the result.
    ids write(const rounded_surface& rounded, const ids& source, bool names_cuts,
              boolean_result& result) {
        ids corner;
        std::size_t made = 0;
        base::resize_all(rounded.point_of.size(), corner);
        base::compact(
            corner.size(), [&](std::size_t p) { return is_made(rounded.point_of[p]); },
            [&](std::size_t count) { made = count; },
            [&](std::size_t p, std::size_t place) {
                corner[p] = static_cast<std::uint32_t>(place);
            });
        mark_points(rounded);
        const std::vector<std::size_t> first = first_faces(source);
        const auto make_room = [&](std::size_t given) {
            given_ = given;
            const std::size_t points = given + made;
            for (auto* sources : {&result.vertex_source, &result.face_of_cut_vertex})
                sources->reserve(points + points / slack);
            result.mesh.points.reserve(points + points / slack);
            base::parallel_invoke(
                [&] { base::resize_all(points, result.mesh.points, result.vertex_source); },
                [&] { base::resize_all(names_cuts ? points : 0, result.face_of_cut_vertex); },
                [&] { base::resize_all(first.back(), result.mesh.faces, result.face_source); });
        };
        base::compact(
            points_[2], [&](std::size_t p) { return number_[p] != 0; }, make_room,
            [&](std::size_t p, std::size_t next) {
                const std::size_t k = p < points_[1] ? 0 : 1;
                const auto index = static_cast<std::uint32_t>(p - points_[k]);
                number_[p] = static_cast<std::uint32_t>(next);
                result.mesh.points[next] = meshes_[k].points[index];
                result.vertex_source[next] = operands_[k].point_source(index);
            });
        for_chunks(
            corner.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
                for (std::size_t p = begin; p < end; ++p) {
                    const std::uint32_t local = rounded.point_of[p];
                    corner[p] = is_made(local) ? static_cast<std::uint32_t>(given_) + corner[p]
                                               : number_[near_.point_of[local]];
                    result.mesh.points[corner[p]] = rounded.surface.points[p];
                }
            });
        write_faces(rounded, corner, source, first, result);
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
        return meshes_[k].faces[face - faces_[k]];
    }

    /// Calls `visit(face)` for the faces from `begin` to `end` that were not cut and stay.
    template <class Visit>
    void for_far_faces(std::size_t begin, std::size_t end, const Visit& visit) const {
        for (std::size_t f = begin; f < end; ++f)
            if (stays(dispositions_[f])) visit(f);
    }

    /// Marks the points of operands that are in use.
    void mark_points(const rounded_surface& rounded) {
        const auto use = [&](std::size_t p) {
            std::atomic_ref(number_[p]).store(1, std::memory_order_relaxed);
        };
        for_chunks(points_[2], light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            std::fill(number_.data() + begin, number_.data() + end, 0U);
        });
        for_chunks(faces_[2], write_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for_far_faces(begin, end, [&](std::size_t f) {
                for (const std::uint32_t p : corners(f)) use(points_[operand_of(f)] + p);
            });
        });
        for_chunks(rounded.point_of.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t i = begin; i < end; ++i)
                           if (const std::uint32_t p = rounded.point_of[i]; !is_made(p))
                               use(near_.point_of[p]);
                   });
    }

    [[nodiscard]] static std::size_t pieces_before(const ids& source, std::size_t face) {
        return static_cast<std::size_t>(std::lower_bound(source.begin(), source.end(), face) -
                                        source.begin());
    }

    /// Where the faces of each chunk begin in the result.
    [[nodiscard]] std::vector<std::size_t> first_faces(const ids& source) const {
        std::vector<std::size_t> first(chunk_count(faces_[2], write_grain) + 1, 0);
        for_chunks(faces_[2], write_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
            std::size_t count = pieces_before(source, end) - pieces_before(source, begin);
            for_far_faces(begin, end, [&](std::size_t) { ++count; });
            first[c + 1] = count;
        });
        for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
        return first;
    }

    void write_faces(const rounded_surface& rounded, const ids& corner, const ids& source,
                     const std::vector<std::size_t>& first, boolean_result& result) const {
        std::vector<face>& faces = result.mesh.faces;
        for_chunks(faces_[2], write_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
            std::size_t next = first[c];
            const auto put = [&](std::size_t f, const face& corners) {
                const std::size_t k = operand_of(f);
                faces[next] = corners;
                result.face_source[next++] =
                    operands_[k].face_source(static_cast<std::uint32_t>(f - faces_[k]));
            };
            std::size_t piece = pieces_before(source, begin);
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
                put(f, dispositions_[f] == disposition::kept
                           ? face{number[p], number[q], number[r]}
                           : face{number[p], number[r], number[q]});
            });
            put_pieces_before(end);
        });
    }

    const bundles& operands_;
    std::array<mesh_view, 2> meshes_{operands_[0].view(), operands_[1].view()};
    const interaction_zone& near_;
    const buffer<disposition>& dispositions_;
    std::array<std::size_t, 3> faces_;   ///< where those of each operand begin
    std::array<std::size_t, 3> points_;  ///< likewise
    buffer<std::uint32_t> number_;       ///< of points of operands, in the result
    std::size_t given_ = 0;
};

/// Brings faces into the order of their sources, which is theirs but where rounded faces were cut.
void sort_by_source(ids& source, std::vector<face>& faces) {
    const auto falls = [&](std::size_t i) { return source[i] > source[i + 1]; };
    if (source.empty() || base::first_bad(source.size() - 1, falls) == source.size() - 1) return;
    ids order = base::numbers_below(source.size());
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return source[i]; });
    std::vector<face> sorted(faces.size());
    for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = faces[order[i]];
    faces = std::move(sorted);
    std::ranges::sort(source);
}

/// Puts a value of each piece where that is among `count` faces; others have none.
void spread(ids& of_piece, const ids& pieces, std::size_t count) {
    ids of_face(count, rounded_surface::none);
    for (std::size_t i = 0; i < pieces.size(); ++i) of_face[pieces[i]] = of_piece[i];
    of_piece = std::move(of_face);
}

/// Takes in faces that stay, if `wanted(f)`: then they are near, too. They have no origin.
template <class Wanted>
void take_in(const bundles& operands, interaction_zone& near, buffer<disposition>& dispositions,
             exact_surface& exact, ids& source, ids& face_of_point, ids& origin_of_face,
             const Wanted& wanted) {
    const std::array meshes{operands[0].view(), operands[1].view()};
    const std::size_t faces_of_a = meshes[0].faces.size(), points_of_a = meshes[0].points.size();
    ids number(points_of_a + meshes[1].points.size(), rounded_surface::none);
    for (std::uint32_t p = 0; p < near.point_of.size(); ++p) number[near.point_of[p]] = p;
    const std::size_t given = exact.given.size();

    interaction_zone more;
    more.point_of = std::move(near.point_of);
    std::vector<face>& faces = more.local.faces;
    std::vector<face> surface;
    std::vector<std::uint8_t> certified;
    ids surface_source, pieces, new_of_old(near.face_of.size());
    const auto take = [&](std::uint32_t f) {
        const std::size_t k = f < faces_of_a ? 0 : 1, first = k == 0 ? 0 : points_of_a;
        face corners = meshes[k].faces[f - (k == 0 ? 0 : faces_of_a)];
        for (std::uint32_t& p : corners) {
            std::uint32_t& local = number[first + p];
            if (local == rounded_surface::none) {
                local = static_cast<std::uint32_t>(exact.given.size());
                exact.given.push_back(meshes[k].points[p]);
                more.point_of.push_back(static_cast<std::uint32_t>(first + p));
            }
            p = local;
        }
        const bool kept = dispositions[f] == disposition::kept;
        surface.push_back(kept ? corners : face{corners[0], corners[2], corners[1]});
        certified.push_back(1);
        surface_source.push_back(static_cast<std::uint32_t>(faces.size()));
        faces.push_back(corners);
        more.face_of.push_back(f);
    };
    std::size_t old = 0, piece = 0;
    for (std::uint32_t f = 0; f < dispositions.size(); ++f) {
        if (old < near.face_of.size() && near.face_of[old] == f) {
            new_of_old[old] = static_cast<std::uint32_t>(faces.size());
            for (; piece < source.size() && source[piece] == old; ++piece) {
                pieces.push_back(static_cast<std::uint32_t>(surface.size()));
                surface.push_back(exact.faces[piece]);
                certified.push_back(exact.certified[piece]);
                surface_source.push_back(new_of_old[old]);
            }
            faces.push_back(near.local.faces[old++]);
            more.face_of.push_back(f);
        } else if (stays(dispositions[f]) && wanted(f)) {
            take(f);
            dispositions[f] = disposition::cut;
        }
    }
    for (const std::uint32_t f : pieces)
        for (std::uint32_t& p : surface[f])
            if (p >= given) p += static_cast<std::uint32_t>(exact.given.size() - given);
    if (!origin_of_face.empty()) spread(origin_of_face, pieces, surface.size());
    exact.faces = std::move(surface);
    exact.certified = std::move(certified);
    source = std::move(surface_source);
    for (std::uint32_t& f : face_of_point)
        if (f < new_of_old.size()) f = new_of_old[f];
    near = std::move(more);
}

/// The faces that stay as they are where they are.
class faces_left {
  public:
    faces_left(const bundles& operands, const buffer<disposition>& dispositions)
        : operands_(operands), dispositions_(dispositions) {
        for (std::size_t k = 0; k < 2; ++k) trees_[k] = &build_face_tree(*operands[k].mesh);
    }

    [[nodiscard]] std::int64_t winding_beside(const arrange::corner_line& line, bool ahead) const {
        const aabb<double, 3> way = arrange::way_along(line, ahead);
        std::int64_t winding = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            const mesh_view mesh = operands_[k].view();
            arrange::visit_beside(
                *trees_[k], [&](std::uint32_t f) { return base::triangle_of(mesh, f); }, line, way,
                ahead,
                [&](std::uint32_t f, int change) {
                    const disposition of = dispositions_[first(k) + f];
                    if (stays(of)) winding += of == disposition::kept ? change : -change;
                });
        }
        return winding;
    }

    /// Those whose boxes overlap that of a face of `rounded` that is not one of `exact`; ascending.
    [[nodiscard]] ids at_changes(const rounded_surface& rounded, const exact_surface& exact) const {
        ids found;
        if (rounded.slivers == 0) return found;
        for (std::size_t i = 0; i < rounded.face_of.size(); ++i) {
            const face& now = rounded.surface.faces[i];
            const face& before = exact.faces[rounded.face_of[i]];
            if (std::ranges::equal(now, before, {},
                                   [&](std::uint32_t p) { return rounded.point_of[p]; }))
                continue;
            const auto box = base::face_boxes(rounded.surface.points)(now);
            for (std::size_t k = 0; k < 2; ++k)
                search(*trees_[k], box, [&](std::uint32_t f) {
                    if (stays(dispositions_[first(k) + f]))
                        found.push_back(static_cast<std::uint32_t>(first(k) + f));
                });
        }
        std::ranges::sort(found);
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }

  private:
    [[nodiscard]] std::size_t first(std::size_t k) const {
        return k == 0 ? 0 : operands_[0].view().faces.size();
    }

    const bundles& operands_;
    const buffer<disposition>& dispositions_;
    std::array<const tree<3>*, 2> trees_{};
};

/// The chosen faces, and the local face that each is of, in `source`, where those of `cut` were.
exact_surface surface_of(mesh_arrangement& cut, std::vector<face>&& faces, ids& source) {
    exact_surface exact{std::move(cut.given_points), std::move(cut.constructed), std::move(faces)};
    exact.certified.resize(source.size());
    for_chunks(source.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f) {
            exact.certified[f] = cut.whole[source[f]];
            source[f] = cut.covers_of(source[f]).front().face;
        }
    });
    cut = {};
    return exact;
}

void keep_counts(const bundles& operands, const arrange_faces_result& arranged,
                 rounded_surface& rounded, boolean_result& result) {
    result.certificate = std::move(rounded.certificate);
    result.statistics.pairs = arranged.pairs;
    result.statistics.cut_faces = arranged.cut_faces;
    result.statistics.degenerate = operands[0].known->degenerate + operands[1].known->degenerate;
    result.statistics.rounding_rounds = rounded.rounds;
    result.statistics.rounding_repairs = rounded.slivers;
    result.vanished_components = rounded.vanished_components;
    result.vanished_distance = rounded.vanished_distance;
    result.vanished_at = std::move(rounded.vanished_at);
}

/// \param vertices [points of `rounded`] that they are in the result
void name_cut_vertices(const bundles& operands, const interaction_zone& near,
                       const rounded_surface& rounded, const ids& vertices,
                       const ids& face_of_point, boolean_result& result) {
    const std::size_t given = near.point_of.size();
    const auto faces_of_a = static_cast<std::uint32_t>(operands[0].view().faces.size());
    for_chunks(vertices.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t p = begin; p < end; ++p) {
            const std::uint32_t point = rounded.point_of[p];
            if (point < given || point == rounded_surface::none) continue;
            const std::uint32_t f = near.face_of[face_of_point[point - given]];
            result.face_of_cut_vertex[vertices[p]] = f < faces_of_a
                                                         ? operands[0].face_source(f)
                                                         : operands[1].face_source(f - faces_of_a);
        }
    });
}

/// The chosen faces of what is near, and what is to be known of them when they are rounded.
struct near_rounding {
    const bundles& operands;
    interaction_zone& near;
    buffer<disposition>& dispositions;
    const boolean_options& options;
    bool solid;
    exact_surface exact{};
    ids source{};            ///< [exact.faces] local faces
    ids face_of_point{};     ///< [exact.constructed] local faces
    face_origins origins{};  ///< of merged faces
    std::size_t others = 0;  ///< faces that stay and are not near
    bool is_all = false;     ///< all that stay are near

    template <class Wanted>
    void take_in_some(const Wanted& wanted) {
        take_in(operands, near, dispositions, exact, source, face_of_point, origins.of_face,
                wanted);
    }
    void take_in_all() {
        if (!std::exchange(is_all, true)) take_in_some([](std::uint32_t) { return true; });
    }

    /// Merges what was cut. \param keeps_origins whether `origins` are asked for
    void merge(bool keeps_origins) {
        const std::size_t count = operands[0].count_as_given() + operands[1].count_as_given();
        face_of_point =
            merge_cuts(exact, source, near.local.faces,
                       options.face_groups.empty()
                           ? ids()
                           : groups_of(options, numbers_as_given(operands, near), count),
                       options, keeps_origins ? &origins : nullptr);
        for (std::uint32_t& f : origins.source) f = near.face_of[f];
    }

    /// What was left out meets no box of what was cut, and so no piece of it either, rounded or
    /// not: rounding to nearest takes no coordinate out of a box of doubles. Nor is it to meet the
    /// box of a face that was mended.
    rounded_surface round() {
        double done = 0.7;
        const auto options_of = [&](double most, const winding_of_rest& rest) {
            const double from =
                std::exchange(done, (done + 0.95) / 2.0);  // nobody knows how many follow
            return round_options{.precision = options.precision,
                                 .solid = solid,
                                 .max_displacement = most,
                                 .rest = rest,
                                 .progress = base::part_of(options.progress, from, done)};
        };
        const faces_left left(operands, dispositions);
        const bool are_few = others < exact.faces.size() / few_others;
        const double most = are_few ? 0.0 : options.max_displacement;
        for (int i = 0; !is_all; ++i) {
            rounded_surface rounded = round_once(
                exact, options_of(most, [&](const arrange::corner_line& line, bool ahead) {
                    return left.winding_beside(line, ahead);
                }));
            if (rounded.certificate.status == status::cancelled) return rounded;
            const ids met = left.at_changes(rounded, exact);
            if (rounded.certificate && met.empty()) return rounded;
            if (!rounded.certificate || i == most_steps)
                take_in_all();
            else
                take_in_some([&](std::uint32_t f) { return std::ranges::binary_search(met, f); });
        }
        return round_surface(std::move(exact), options_of(options.max_displacement, {}));
    }
};

}  // namespace

near_result surface_of(const bundles& operands, interaction_zone& near,
                       arrange_faces_result& arranged, chosen_surface chosen,
                       const boolean_options& options, bool solid, left_faces is_kept) {
    near_result made;
    boolean_result& result = made.result;
    near_rounding work{operands, near, chosen.dispositions, options, solid};
    work.source = std::move(chosen.near.face_of);
    work.exact = surface_of(arranged.cut, std::move(chosen.near.faces), work.source);
    work.others = static_cast<std::size_t>(
        std::count_if(chosen.dispositions.data(),
                      chosen.dispositions.data() + chosen.dispositions.size(), stays));
    work.is_all = work.others == 0;
    if (options.merge_coplanar) work.take_in_all();
    work.merge(is_kept != nullptr);
    if (options.precision == precision::float32) work.take_in_all();
    rounded_surface rounded = work.round();
    const ids& source = work.source;
    keep_counts(operands, arranged, rounded, result);
    if (result.certificate.status == status::cancelled ||
        !made.may_continue(options.progress, 0.95))
        return made;
    work.origins.for_sources_in(rounded.face_of, [&](std::uint32_t f) {
        (*is_kept)[operands[0].face_source(f).index] = 1;
    });
    ids face_of_piece(rounded.face_of.size());
    for_chunks(face_of_piece.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t i = begin; i < end; ++i)
                       face_of_piece[i] = near.face_of[source[rounded.face_of[i]]];
               });
    sort_by_source(face_of_piece, rounded.surface.faces);
    const ids vertices = assembly(operands, near, chosen.dispositions)
                             .write(rounded, face_of_piece, merges_faces(options), result);
    // Faces that were not cut are as they were in their operand, all of those at a vertex or none.
    made.is_manifold = solid && !work.is_all && topology::is_manifold_at(vertices, result.mesh);
    result.statistics.exact_faces =
        result.mesh.faces.size() + (source.size() - face_of_piece.size());
    if (merges_faces(options))
        name_cut_vertices(operands, near, rounded, vertices, work.face_of_point, result);
    static_cast<void>(made.may_continue(options.progress, 1.0));
    return made;
}

}  // namespace treeform::detail::boolean
