#include <libmesh/arrange/detail/cluster.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/detail/check_faces.hpp>
#include <libmesh/detail/stars.hpp>
#include <libmesh/detail/union_find.hpp>
#include <libmesh/exact/predicates.hpp>
#include <libmesh/intersect/detail/meetings.hpp>
#include <libmesh/intersect/detail/same_points.hpp>
#include <libmesh/intersect/self_intersections.hpp>
#include <libtree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace tf {
namespace {

using detail::cut_cluster;
using detail::meeting;
using detail::mesh_meetings;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t grain = std::size_t{1} << 14;
/// Beyond this, differences and the frames of clusters might overflow.
constexpr double largest_coordinate = 0x1p1000;

bool is_degenerate(mesh_view mesh, const face& f) {
    return !detail::has_three_corners(f) ||
           collinear(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]);
}

void check_points(mesh_view mesh) {
    for (const face& f : mesh.faces)
        for (const std::uint32_t c : f) {
            const point3& p = mesh.points[c];
            if (!(std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate &&
                  std::abs(p.z) <= largest_coordinate))
                throw std::invalid_argument("tf::arrange_faces: point " + std::to_string(c) +
                                            " is not finite or beyond 2^1000");
        }
}

/// The meetings of each face.
struct meetings_by_face {
    std::vector<std::size_t> begin;    ///< [F + 1]
    std::vector<std::uint32_t> which;  ///< face by face, ascending

    meetings_by_face(std::size_t face_count, const std::vector<meeting>& meetings)
        : begin(face_count + 1, 0), which(2 * meetings.size()) {
        for (const meeting& m : meetings) {
            ++begin[m.a + 1];
            ++begin[m.b + 1];
        }
        for (std::size_t f = 0; f < face_count; ++f) begin[f + 1] += begin[f];
        std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
        for (std::uint32_t i = 0; i < meetings.size(); ++i) {
            which[end[meetings[i].a]++] = i;
            which[end[meetings[i].b]++] = i;
        }
    }
};

/// Faces to be cut, those that overlap in one plane together.
struct clusters {
    std::vector<std::uint32_t> members;  ///< cluster by cluster, ascending within
    std::vector<std::size_t> begin{0};   ///< clusters ascend by their first member

    [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t i) const {
        return {members.data() + begin[i], begin[i + 1] - begin[i]};
    }
};

/// Whether a meeting leaves face `f` whole: it has no point but a corner of the face.
bool spares(const meeting& m, std::uint32_t f) {
    if (m.kind == overlap::area) return false;
    for (std::size_t k = 0; k < m.count; ++k)
        if ((m.a == f ? m.ends[k].on_a : m.ends[k].on_b) > feature::v2) return false;
    return true;
}

clusters gather(std::size_t face_count, const mesh_meetings& met, const meetings_by_face& by_face) {
    detail::union_find sets(face_count);
    for (const meeting& m : met.meetings)
        if (m.kind == overlap::area) sets.join(m.a, m.b);
    std::vector<std::array<std::uint32_t, 2>> rooted;
    for (std::uint32_t f = 0; f < face_count; ++f) {
        bool is_cut = false;
        for (std::size_t i = by_face.begin[f]; i < by_face.begin[f + 1] && !is_cut; ++i)
            is_cut = !spares(met.meetings[by_face.which[i]], f);
        if (is_cut) rooted.push_back({sets.root(f), f});
    }
    std::sort(rooted.begin(), rooted.end());
    clusters result;
    for (std::size_t i = 0; i < rooted.size(); ++i) {
        result.members.push_back(rooted[i][1]);
        if (i + 1 == rooted.size() || rooted[i + 1][0] != rooted[i][0])
            result.begin.push_back(i + 1);
    }
    return result;
}

/// Final numbers of the points of all clusters.
struct numbering {
    std::vector<constructed_point> constructed;
    std::vector<std::uint32_t> of_item;     ///< [named + made] final number
    std::vector<std::uint32_t> made_begin;  ///< [clusters] item of a cluster's first made point
};

numbering number_points(std::size_t given, const mesh_meetings& met,
                        const std::vector<cut_cluster>& cuts) {
    numbering result;
    std::vector<constructed_point> items = met.points;
    for (const cut_cluster& c : cuts) {
        result.made_begin.push_back(static_cast<std::uint32_t>(items.size()));
        items.insert(items.end(), c.made.begin(), c.made.end());
    }
    detail::union_find sets(items.size());
    std::vector<std::uint32_t> given_of(items.size(), none);
    std::vector<std::array<std::uint32_t, 2>> is_given;  // item, given point
    for (const cut_cluster& c : cuts)
        for (auto [a, b] : c.same) {
            if (a > b) std::swap(a, b);
            if (b < given)
                throw std::invalid_argument("tf::arrange_faces: points " + std::to_string(a) +
                                            " and " + std::to_string(b) + " are equal");
            const auto item = static_cast<std::uint32_t>(b - given);
            if (a < given)
                is_given.push_back({item, a});
            else
                sets.join(static_cast<std::uint32_t>(a - given), item);
        }
    for (const auto& [a, b] : detail::equal_pairs(items)) sets.join(a, b);
    for (const auto& [item, point] : is_given) given_of[sets.root(item)] = point;

    // Named points that no face kept (they are corners by another name, or lie in faces that a
    // lower name covers) take no number of their own: a set is numbered once.
    result.of_item.assign(items.size(), none);
    for (std::uint32_t i = 0; i < items.size(); ++i) {
        const std::uint32_t root = sets.root(i);
        if (given_of[root] != none) {
            result.of_item[i] = given_of[root];
        } else if (root == i) {
            result.of_item[i] = static_cast<std::uint32_t>(given + result.constructed.size());
            result.constructed.push_back(items[i]);
        } else {
            result.of_item[i] = result.of_item[root];  // roots are the lowest of their set
        }
    }
    return result;
}

void emit(mesh_view mesh, std::span<const std::uint32_t> whole,
          const std::vector<cut_cluster>& cuts, const numbering& numbers, mesh_arrangement& out) {
    const std::size_t given = mesh.points.size();
    struct piece {
        std::uint32_t first_cover;
        std::uint32_t cluster;  ///< or none
        std::uint32_t index;    ///< of a face in the cluster
    };
    std::vector<piece> pieces;
    for (std::uint32_t c = 0; c < cuts.size(); ++c)
        for (std::uint32_t i = 0; i < cuts[c].faces.size(); ++i)
            pieces.push_back({cuts[c].covers[cuts[c].faces[i].covers].face, c, i});
    std::sort(pieces.begin(), pieces.end(), [](const piece& p, const piece& q) {
        return p.first_cover != q.first_cover ? p.first_cover < q.first_cover : p.index < q.index;
    });
    const auto number = [&](std::uint32_t point, std::uint32_t cluster) {
        if (point < given) return point;
        const std::size_t item = point - given;
        if (item < numbers.made_begin[0]) return numbers.of_item[item];
        return numbers.of_item[item - numbers.made_begin[0] + numbers.made_begin[cluster]];
    };
    const std::size_t total = whole.size() + pieces.size();
    out.faces.reserve(total);
    out.cover_begin.reserve(total + 1);
    out.covers.reserve(total);
    auto next = pieces.begin();
    const auto emit_pieces_before = [&](std::size_t face) {
        for (; next != pieces.end() && next->first_cover < face; ++next) {
            const cut_cluster& c = cuts[next->cluster];
            const detail::cluster_face& f = c.faces[next->index];
            const std::size_t end = next->index + 1 < c.faces.size()
                                        ? c.faces[next->index + 1].covers
                                        : c.covers.size();
            out.cover_begin.push_back(out.covers.size());
            out.faces.push_back({number(f.corners[0], next->cluster),
                                 number(f.corners[1], next->cluster),
                                 number(f.corners[2], next->cluster)});
            out.covers.insert(out.covers.end(),
                              c.covers.begin() + static_cast<std::ptrdiff_t>(f.covers),
                              c.covers.begin() + static_cast<std::ptrdiff_t>(end));
        }
    };
    for (const std::uint32_t f : whole) {
        emit_pieces_before(f);
        out.cover_begin.push_back(out.covers.size());
        out.faces.push_back(mesh.faces[f]);
        out.covers.push_back({f, false});
    }
    emit_pieces_before(mesh.faces.size());
    out.cover_begin.push_back(out.covers.size());
}

}  // namespace

arrange_faces_result arrange_faces(mesh_view mesh, const arrange_faces_options& options) {
    detail::check_faces("tf::arrange_faces", mesh.points.size(), mesh.faces);
    check_points(mesh);
    arrange_faces_result result;
    const std::size_t count = mesh.faces.size();

    std::vector<char> is_left_out(count);
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f)
            is_left_out[f] = is_degenerate(mesh, mesh.faces[f]);
    });
    for (std::uint32_t f = 0; f < count; ++f)
        if (is_left_out[f]) result.degenerate.push_back(f);

    // Degenerate faces are shut out by hiding them: pairs are looked for among the others only.
    std::vector<face> kept;
    std::vector<std::uint32_t> kept_number;
    mesh_view usable = mesh;
    if (!result.degenerate.empty()) {
        for (std::uint32_t f = 0; f < count; ++f)
            if (!is_left_out[f]) {
                kept.push_back(mesh.faces[f]);
                kept_number.push_back(f);
            }
        usable.faces = kept;
    }
    self_intersection_options search;
    if (options.progress)
        search.progress = [&](double done) { return options.progress(0.5 * done); };
    self_intersection_result found = self_intersections(usable, search);
    result.cancelled = found.cancelled;
    if (result.cancelled) return result;
    if (!result.degenerate.empty())
        for (face_pair& pair : found.pairs) {
            pair.a = kept_number[pair.a];
            pair.b = kept_number[pair.b];
        }
    result.pairs = found.pairs.size();

    const mesh_meetings met = detail::meetings_of(mesh, found.pairs);
    const meetings_by_face by_face(count, met.meetings);
    const clusters groups = gather(count, met, by_face);
    result.cut_faces = groups.members.size();

    constexpr std::size_t clusters_a_chunk = 16;
    std::vector<cut_cluster> cuts(groups.size());
    for_chunks(
        groups.size(), clusters_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i)
                cuts[i] = detail::cut({mesh, &met, groups[i], &by_face.begin, &by_face.which});
        });
    if (options.progress && !options.progress(0.9)) {
        result.cancelled = true;
        return result;
    }

    numbering numbers = number_points(mesh.points.size(), met, cuts);
    std::vector<std::uint32_t> whole;
    for (const std::uint32_t f : groups.members) is_left_out[f] = 1;
    for (std::uint32_t f = 0; f < count; ++f)
        if (!is_left_out[f]) whole.push_back(f);
    emit(mesh, whole, cuts, numbers, result.cut);
    result.cut.given_points.assign(mesh.points.begin(), mesh.points.end());
    result.cut.constructed = std::move(numbers.constructed);
    if (options.progress) options.progress(1.0);
    return result;
}

}  // namespace tf
