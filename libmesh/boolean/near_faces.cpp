#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/leaf_blocks.hpp>
#include <libmesh/boolean/near_faces.hpp>
#include <libmesh/intersect/classify_pair.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <libmesh/weld/few_equal_points.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search_pair.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>

namespace treeform::detail::boolean {
namespace {

using ids = std::vector<std::uint32_t>;

/// The blocks of two operands: which are near, and where the others are.
class block_places {
  public:
    explicit block_places(const prepared_pair& operands) : operands_(operands) {
        for (std::size_t k = 0; k < 2; ++k) {
            faces_[k] = &build_face_tree(*operands[k]);
            blocks_[k] = &leaf_blocks_of(*operands[k]);
            place_[k].assign(blocks_[k]->index.size(), face_place::outside);
        }
        for (const auto& part :
             search<std::vector<id_pair>>(blocks_[0]->index, blocks_[1]->index,
                                          [](std::vector<id_pair>&mine, std::uint32_t a,
                                             std::uint32_t b) { mine.emplace_back(a, b); }))
            for (const auto& [a, b] : part) place_[0][a] = place_[1][b] = face_place::near;
    }

    /// Blocks that overlap one with a face that is cut are near.
    void keep_around(const std::vector<face_pair>& pairs) {
        for (std::size_t k = 0; k < 2; ++k) {
            std::vector<std::uint8_t> is_cut(operands_[k]->view().faces.size(), 0);
            for (const face_pair& pair : pairs) is_cut[k == 0 ? pair.a : pair.b] = 1;
            std::vector<std::uint8_t> has_cut(place_[k].size(), 0);
            const std::span<const std::uint32_t> face_at = faces_[k]->ids();
            for (std::size_t place = 0; place < face_at.size(); ++place)
                has_cut[place / 8] |= is_cut[face_at[place]];
            for (const auto& part : blocks_[k]->overlaps)
                for (const auto& [x, y] : part) {
                    if (has_cut[x] != 0) place_[k][y] = face_place::near;
                    if (has_cut[y] != 0) place_[k][x] = face_place::near;
                }
        }
    }

    /// Tells of the other blocks whether they are inside: each set of those that overlap by a point.
    void settle() {
        for (std::size_t k = 0; k < 2; ++k) {
            base::union_find alike(place_[k].size());
            const auto is_far = [&](std::uint32_t b) { return place_[k][b] != face_place::near; };
            for (const auto& part : blocks_[k]->overlaps)
                for (const auto& [x, y] : part)
                    if (is_far(x) && is_far(y)) alike.join(x, y);
            const auto root = alike.take_roots();
            ids roots;
            std::vector<point3> asked;
            for (std::uint32_t b = 0; b < place_[k].size(); ++b) {
                if (!is_far(b) || root[b] != b) continue;
                const mesh_view mesh = operands_[k]->view();
                roots.push_back(b);
                asked.push_back(mesh.points[mesh.faces[faces_[k]->ids()[8 * b]][0]]);
            }
            const auto found =
                intersect::point_locator(operands_[1 - k]->view(), *faces_[1 - k]).locate(asked);
            for (std::size_t i = 0; i < roots.size(); ++i)
                if (found[i].where == location::inside) place_[k][roots[i]] = face_place::inside;
            for (std::uint32_t b = 0; b < place_[k].size(); ++b)
                if (is_far(b)) place_[k][b] = place_[k][root[b]];
        }
    }

    /// Of faces, counted through.
    [[nodiscard]] buffer<face_place> of_faces() const {
        buffer<face_place> result(faces_[0]->size() + faces_[1]->size());
        for (std::size_t k = 0, first = 0; k < 2; first += faces_[k++]->size()) {
            const std::span<const std::uint32_t> face_at = faces_[k]->ids();
            for_chunks(face_at.size(), light_grain,
                       [&](std::size_t begin, std::size_t end, std::size_t) {
                           for (std::size_t i = begin; i < end; ++i)
                               result[first + face_at[i]] = place_[k][i / 8];
                       });
        }
        return result;
    }

  private:
    prepared_pair operands_;
    std::array<const tree<3>*, 2> faces_{};
    std::array<const leaf_blocks*, 2> blocks_{};
    std::array<std::vector<face_place>, 2> place_{};
};

/// Appends the points of `faces`, ascending, and the faces in their numbers.
void append(mesh_view mesh, const ids& faces, std::uint32_t points_before,
            std::uint32_t faces_before, near_faces& result) {
    buffer<std::uint32_t> number(mesh.points.size());
    for_chunks(number.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::fill(number.data() + begin, number.data() + end, 0U);
    });
    for_chunks(faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            for (const std::uint32_t corner : mesh.faces[faces[i]])
                std::atomic_ref(number[corner]).store(1, std::memory_order_relaxed);
    });
    const std::size_t points = result.local.points.size();
    base::compact(
        number.size(), [&](std::size_t p) { return number[p] != 0; },
        [&](std::size_t count) {
            result.local.points.resize(points + count);
            result.point_of.resize(points + count);
        },
        [&](std::size_t p, std::size_t place) {
            number[p] = static_cast<std::uint32_t>(points + place);
            result.local.points[points + place] = mesh.points[p];
            result.point_of[points + place] = points_before + static_cast<std::uint32_t>(p);
        });
    const std::size_t first = result.local.faces.size();
    result.local.faces.resize(first + faces.size());
    result.face_of.resize(first + faces.size());
    for_chunks(faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& [a, b, c] = mesh.faces[faces[i]];
            result.local.faces[first + i] = {number[a], number[b], number[c]};
            result.face_of[first + i] = faces_before + faces[i];
        }
    });
}

/// Points of the second operand become those of the first that they are equal to.
void join_equal(near_faces& near) {
    mesh& local = near.local;
    const auto equal = weld::few_equal_points(local.points);
    if (!equal) return;
    const std::size_t count = equal->first_of_new.size();
    for (std::size_t p = 0; p < count; ++p) {
        local.points[p] = local.points[equal->first_of_new[p]];
        near.point_of[p] = near.point_of[equal->first_of_new[p]];
    }
    local.points.resize(count);
    near.point_of.resize(count);
    for (face& f : local.faces)
        for (std::uint32_t& corner : f) corner = equal->new_of_old[corner];
}

/// The pairs by local faces, without those that meet in shared corners only.
void keep_pairs(std::vector<face_pair>&& pairs, std::size_t faces_of_a, near_faces& near) {
    const auto local = [&](std::size_t face) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(near.face_of, face) -
                                          near.face_of.begin());
    };
    predicate_counters counters;
    std::size_t left = 0;
    for (face_pair pair : pairs) {
        pair.a = local(pair.a);
        pair.b = local(faces_of_a + pair.b);
        const face &f = near.local.faces[pair.a], &g = near.local.faces[pair.b];
        if (std::find_first_of(f.begin(), f.end(), g.begin(), g.end()) != f.end()) {
            const auto kind = intersect::classify_pair(near.local.points, f, g, counters);
            if (!kind) continue;
            pair.kind = *kind;
        }
        pairs[left++] = pair;
    }
    pairs.resize(left);
    near.pairs = std::move(pairs);
}

}  // namespace

near_faces find_near_faces(const prepared_pair& operands) {
    near_faces result;
    const std::size_t faces_of_a = operands[0]->view().faces.size();
    const std::size_t faces_of_b = operands[1]->view().faces.size();
    if (faces_of_a == 0 || faces_of_b == 0) {
        result.place.resize(faces_of_a + faces_of_b);
        std::fill_n(result.place.data(), result.place.size(), face_place::outside);
        return result;
    }
    block_places blocks(operands);
    std::vector<face_pair> pairs = mesh_intersections(*operands[0], *operands[1]).pairs;
    blocks.keep_around(pairs);
    blocks.settle();
    result.place = blocks.of_faces();
    std::size_t first_face = 0, first_point = 0;
    for (const prepared_mesh* operand : operands) {
        const mesh_view mesh = operand->view();
        ids near;
        base::compact(
            mesh.faces.size(),
            [&](std::size_t f) { return result.place[first_face + f] == face_place::near; },
            [&](std::size_t count) { near.resize(count); },
            [&](std::size_t f, std::size_t place) { near[place] = static_cast<std::uint32_t>(f); });
        if (first_face != 0)
            result.first_of_b = static_cast<std::uint32_t>(result.local.faces.size());
        append(mesh, near, static_cast<std::uint32_t>(first_point),
               static_cast<std::uint32_t>(first_face), result);
        first_face += mesh.faces.size();
        first_point += mesh.points.size();
    }
    join_equal(result);
    keep_pairs(std::move(pairs), faces_of_a, result);
    return result;
}

}  // namespace treeform::detail::boolean
