#include <libmesh/arrange/arrange_pairs.hpp>
#include <libmesh/arrange/cluster.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/arrange/point_numbering.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/checked_face_tree.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/face_boxes.hpp>
#include <libmesh/base/fill_stars.hpp>
#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/flattened.hpp>
#include <libmesh/base/parallel_invoke.hpp>
#include <libmesh/base/parallel_sort.hpp>
#include <libmesh/base/part_of_progress.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/base/running_sums.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/exact/filter.hpp>
#include <libmesh/intersect/meetings.hpp>
#include <libmesh/intersect/pairs_by_tree.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <memory_resource>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

using detail::arrange::cut_cluster;
using detail::arrange::point_numbering;
using detail::base::part_of;
using detail::intersect::meeting;
using detail::intersect::mesh_meetings;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
/// Beyond this, differences and the frames of clusters might overflow.
constexpr double largest_coordinate = 0x1p1000;
constexpr std::size_t clusters_a_chunk = 16;
constexpr std::size_t meetings_a_chunk = std::size_t{1} << 10;

bool is_degenerate(mesh_view mesh, const face& f) {
    if (!detail::base::has_three_corners(f)) return true;
    const auto& [a, b, c] = f;
    const int known =
        detail::exact::collinear_filter(mesh.points[a], mesh.points[b], mesh.points[c]);
    if (known != detail::exact::undecided) return known == 0;
    return collinear(mesh.points[a], mesh.points[b], mesh.points[c]);
}

bool can_be_used(const point3& p) {
    return std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate &&
           std::abs(p.z) <= largest_coordinate;
}

/// What `arrange_faces` refuses or leaves out, chunk by chunk.
struct unfit_faces {
    std::vector<std::uint32_t> corner;  ///< the first that cannot be used, or none
    std::vector<std::vector<std::uint32_t>> degenerate;
};

unfit_faces find_unfit(mesh_view mesh) {
    unfit_faces result;
    result.corner.resize(chunk_count(mesh.faces.size(), light_grain), none);
    result.degenerate.resize(result.corner.size());
    for_chunks(mesh.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t c) {
                   std::uint32_t unfit = none;
                   for (std::size_t f = begin; f < end && unfit == none; ++f) {
                       for (const std::uint32_t corner : mesh.faces[f])
                           if (unfit == none && !can_be_used(mesh.points[corner])) unfit = corner;
                       if (unfit == none && is_degenerate(mesh, mesh.faces[f]))
                           result.degenerate[c].push_back(static_cast<std::uint32_t>(f));
                   }
                   result.corner[c] = unfit;
               });
    return result;
}

/// \throws std::invalid_argument naming a corner that cannot be used
std::vector<std::uint32_t> degenerate_faces(mesh_view mesh) {
    unfit_faces unfit = find_unfit(mesh);
    for (const std::uint32_t corner : unfit.corner)
        if (corner != none)
            throw std::invalid_argument("treeform::arrange_faces: point " + std::to_string(corner) +
                                        " is not finite or beyond 2^1000");
    return detail::base::flattened(std::move(unfit.degenerate));
}

/// Faces to be cut, those that overlap in one plane together.
struct clusters {
    std::vector<std::uint32_t> members{};   ///< cluster by cluster, ascending within
    std::vector<std::size_t> begin{0};      ///< clusters ascend by their first member
    std::vector<std::uint8_t> is_member{};  ///< [F]

    [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t i) const {
        return {members.data() + begin[i], begin[i + 1] - begin[i]};
    }
};

/// Whether a meeting leaves face `f` whole: it has no point but a corner of the face. No meeting
/// leaves both faces whole: its points would be corners of both, and no two corners are equal.
bool spares(const meeting& m, std::uint32_t f) {
    if (m.count >= 3) return false;
    for (std::size_t k = 0; k < m.count; ++k)
        if ((m.a == f ? m.ends[k].on_a : m.ends[k].on_b) > triangle_feature::v2) return false;
    return true;
}

clusters gather(std::size_t face_count, const mesh_meetings& met) {
    detail::base::union_find sets(face_count);
    clusters result;
    detail::base::resize_all(face_count, result.is_member);
    for_chunks(
        met.meetings.size(), meetings_a_chunk,
        [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                const meeting& m = met.meetings[i];
                if (m.count >= 3) sets.join(m.a, m.b);
                for (const std::uint32_t f : {m.a, m.b})
                    if (!spares(m, f))
                        std::atomic_ref(result.is_member[f]).store(1, std::memory_order_relaxed);
            }
        });
    std::vector<std::array<std::uint32_t, 2>> rooted;
    detail::base::compact(
        face_count, [&](std::size_t f) { return result.is_member[f] != 0; },
        [&](std::size_t count) { rooted.resize(count); },
        [&](std::size_t i, std::size_t place) {
            const auto f = static_cast<std::uint32_t>(i);
            rooted[place] = {sets.root(f), f};
        });
    detail::base::parallel_sort(rooted);
    result.members.resize(rooted.size());
    detail::base::compact(
        rooted.size(),
        [&](std::size_t i) {
            result.members[i] = rooted[i][1];
            return i + 1 == rooted.size() || rooted[i + 1][0] != rooted[i][0];
        },
        [&](std::size_t count) { result.begin.resize(count + 1); },
        [&](std::size_t i, std::size_t place) { result.begin[place + 1] = i + 1; });
    return result;
}

/// A face of a cluster among all that are emitted.
struct piece {
    std::uint32_t first_cover;
    std::uint32_t cluster;
    std::uint32_t index;  ///< of a face in the cluster

    [[nodiscard]] std::span<const covering_face> covers(
        const std::vector<cut_cluster>& cuts) const {
        const cut_cluster& c = cuts[cluster];
        const std::size_t begin = c.faces[index].covers;
        const std::size_t end =
            index + 1 < c.faces.size() ? c.faces[index + 1].covers : c.covers.size();
        return {c.covers.data() + begin, end - begin};
    }
};

std::vector<piece> pieces_of(const std::vector<cut_cluster>& cuts) {
    const std::vector<std::size_t> first = detail::base::running_sums(
        cuts.size(), [&](std::size_t c) { return cuts[c].faces.size(); });
    std::vector<piece> pieces;
    detail::base::resize_all(first.back(), pieces);
    for_chunks(cuts.size(), clusters_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t c = begin; c < end; ++c)
            for (std::uint32_t i = 0; i < cuts[c].faces.size(); ++i)
                pieces[first[c] + i] = {cuts[c].covers[cuts[c].faces[i].covers].face,
                                        static_cast<std::uint32_t>(c), i};
    });
    const auto before = [](const piece& p, const piece& q) {
        return p.first_cover != q.first_cover ? p.first_cover < q.first_cover : p.index < q.index;
    };
    const auto falls = [&](std::size_t i) { return before(pieces[i + 1], pieces[i]); };
    if (!pieces.empty() &&  // where no faces overlap, they ascend
        detail::base::first_bad(pieces.size() - 1, falls) != pieces.size() - 1)
        detail::base::parallel_sort(pieces, before);
    return pieces;
}

/// Writes the faces of the arrangement in the order of their lowest input faces: those that are
/// whole, and the pieces in between.
class emitter {
  public:
    emitter(mesh_view mesh, const std::vector<std::uint8_t>& is_not_whole,
            const std::vector<cut_cluster>& cuts, const point_numbering& numbers)
        : mesh_(mesh),
          is_not_whole_(is_not_whole),
          cuts_(cuts),
          numbers_(numbers),
          pieces_(pieces_of(cuts)),
          begin_(chunk_count(mesh.faces.size(), light_grain) + 1) {
        place_chunks();
    }

    void write(mesh_arrangement& out) const {
        const std::size_t faces = begin_.back().face, covers = begin_.back().cover;
        detail::base::parallel_invoke(
            [&] { detail::base::resize_all(faces, out.faces, out.whole); },
            [&] { detail::base::resize_all(faces + 1, out.cover_begin); },
            [&] { detail::base::resize_all(covers, out.covers); });
        for_chunks(mesh_.faces.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t c) {
                       write(begin, end, begin_[c], out);
                   });
        out.cover_begin[faces] = covers;
    }

  private:
    /// How much lies before.
    struct piece_position {
        std::size_t face = 0;
        std::size_t cover = 0;
    };

    using piece_iterator = std::vector<piece>::const_iterator;

    [[nodiscard]] piece_iterator first_piece(std::size_t face) const {
        return std::lower_bound(pieces_.begin(), pieces_.end(), face,
                                [](const piece& p, std::size_t f) { return p.first_cover < f; });
    }

    void place_chunks() {
        for_chunks(mesh_.faces.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t c) {
                       piece_position size;
                       for (std::size_t f = begin; f < end; ++f)
                           size.face += is_not_whole_[f] == 0 ? 1 : 0;
                       size.cover = size.face;
                       const auto last = first_piece(end);
                       for (auto p = first_piece(begin); p != last; ++p) {
                           ++size.face;
                           size.cover += p->covers(cuts_).size();
                       }
                       begin_[c + 1] = size;
                   });
        for (std::size_t c = 1; c < begin_.size(); ++c) {
            begin_[c].face += begin_[c - 1].face;
            begin_[c].cover += begin_[c - 1].cover;
        }
    }

    void write(std::size_t begin, std::size_t end, piece_position at, mesh_arrangement& out) const {
        auto next = first_piece(begin);
        for (std::size_t f = begin; f < end; ++f) {
            if (is_not_whole_[f] == 0) {
                out.covers[at.cover] = {static_cast<std::uint32_t>(f), false};
                put(mesh_.faces[f], 1, 1, at, out);
            }
            for (; next != pieces_.end() && next->first_cover == f; ++next) {
                const auto covers = next->covers(cuts_);
                std::copy(covers.begin(), covers.end(),
                          out.covers.begin() + static_cast<std::ptrdiff_t>(at.cover));
                const auto& [a, b, c] = cuts_[next->cluster].faces[next->index].corners;
                put({number(a, next->cluster), number(b, next->cluster), number(c, next->cluster)},
                    covers.size(), 0, at, out);
            }
        }
    }

    static void put(const face& f, std::size_t covers, std::uint8_t whole, piece_position& at,
                    mesh_arrangement& out) {
        out.faces[at.face] = f;
        out.cover_begin[at.face] = at.cover;
        out.whole[at.face] = whole;
        ++at.face;
        at.cover += covers;
    }

    [[nodiscard]] std::uint32_t number(std::uint32_t point, std::uint32_t cluster) const {
        const std::size_t given = mesh_.points.size();
        if (point < given) return point;
        const std::size_t item = point - given;
        const std::size_t named = numbers_.made_begin[0];
        if (item < named) return numbers_.of_item[item];
        return numbers_.of_item[item - named + numbers_.made_begin[cluster]];
    }

    mesh_view mesh_;
    const std::vector<std::uint8_t>& is_not_whole_;
    const std::vector<cut_cluster>& cuts_;
    const point_numbering& numbers_;
    std::vector<piece> pieces_;
    std::vector<piece_position> begin_;  ///< [chunks + 1]
};

std::vector<cut_cluster> cut_clusters(mesh_view mesh, const mesh_meetings& met,
                                      const clusters& groups) {
    constexpr std::size_t memory_a_chunk = std::size_t{1} << 15;  // enough for nearly all clusters
    const detail::arrange::meetings_by_face by_face = detail::base::fill_stars<std::uint64_t>(
        mesh.faces.size(), met.meetings.size(), [&](std::size_t i, const auto& visit) {
            visit(met.meetings[i].a);
            visit(met.meetings[i].b);
        });
    std::vector<cut_cluster> cuts(groups.size());
    for_chunks(groups.size(), clusters_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   const auto first = std::make_unique_for_overwrite<std::byte[]>(memory_a_chunk);
                   std::pmr::monotonic_buffer_resource memory(first.get(), memory_a_chunk);
                   for (std::size_t i = begin; i < end; ++i) {
                       cuts[i] = detail::arrange::cut({mesh, &met, groups[i], &by_face, &memory});
                       memory.release();
                   }
               });
    return cuts;
}

/// `arrange_pairs` without the given points.
arrange_faces_result arrange_known(mesh_view mesh, std::span<const face_pair> pairs,
                                   std::vector<std::uint32_t> degenerate,
                                   const progress_callback& progress) {
    arrange_faces_result result;
    const std::size_t count = mesh.faces.size();
    mesh_meetings met = detail::intersect::meetings_of(mesh, pairs);
    result.pairs = met.meetings.size();
    clusters groups = gather(count, met);
    result.cut_faces = groups.members.size();
    std::vector<cut_cluster> cuts = cut_clusters(mesh, met, groups);
    std::vector<implicit_point> named = std::move(met.points);
    met = {};
    if (progress && !progress(0.8)) {
        result.cancelled = true;
        return result;
    }

    point_numbering numbers =
        detail::arrange::number_points(mesh.points.size(), std::move(named), cuts);
    std::vector<std::uint8_t>& is_not_whole = groups.is_member;
    for (const std::uint32_t f : degenerate) is_not_whole[f] = 1;
    emitter(mesh, is_not_whole, cuts, numbers).write(result.cut);
    for_chunks(cuts.size(), clusters_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t c = begin; c < end; ++c) cuts[c] = {};  // many small pieces of memory
    });
    result.cut.constructed = std::move(numbers.constructed);
    result.degenerate = std::move(degenerate);
    if (progress) progress(1.0);
    return result;
}

arrange_faces_result cancelled_result(std::vector<std::uint32_t> degenerate) {
    arrange_faces_result result;
    result.degenerate = std::move(degenerate);
    result.cancelled = true;
    return result;
}

void copy_points(mesh_view mesh, arrange_faces_result& result) {
    if (!result.cancelled) result.cut.given_points = detail::base::copied(mesh.points);
}

}  // namespace

arrange_faces_result detail::arrange::arrange_pairs(mesh_view mesh,
                                                    std::span<const face_pair> pairs,
                                                    std::vector<std::uint32_t> degenerate,
                                                    const progress_callback& progress) {
    arrange_faces_result result = arrange_known(mesh, pairs, std::move(degenerate), progress);
    copy_points(mesh, result);
    return result;
}

arrange_faces_result arrange_faces(mesh_view mesh, const arrange_faces_options& options) {
    detail::base::check_faces("arrange_faces", mesh.points.size(), mesh.faces);
    std::vector<std::uint32_t> degenerate = degenerate_faces(mesh);
    // Degenerate faces are shut out by hiding them: pairs are looked for among the others only.
    std::vector<face> kept;
    std::vector<std::uint32_t> kept_number;
    mesh_view usable = mesh;
    if (!degenerate.empty()) {
        auto hidden = degenerate.begin();
        for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
            if (hidden != degenerate.end() && *hidden == f) {
                ++hidden;
            } else {
                kept.push_back(mesh.faces[f]);
                kept_number.push_back(f);
            }
        usable.faces = kept;
    }
    face_pair_result found = detail::intersect::pairs_by_tree(
        usable, detail::base::checked_face_tree(usable),
        {.vertices = vertex_identity::by_index, .progress = part_of(options.progress, 0.0, 0.5)});
    if (found.status == treeform::status::cancelled) return cancelled_result(std::move(degenerate));
    if (!degenerate.empty())
        for (face_pair& pair : found.pairs) {
            pair.a = kept_number[pair.a];
            pair.b = kept_number[pair.b];
        }
    return detail::arrange::arrange_pairs(mesh, found.pairs, std::move(degenerate),
                                          part_of(options.progress, 0.5, 1.0));
}

}  // namespace treeform
