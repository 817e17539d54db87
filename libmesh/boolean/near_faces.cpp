#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/face_boxes.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/leaf_blocks.hpp>
#include <libmesh/boolean/near_faces.hpp>
#include <libmesh/intersect/classify_pair.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <libmesh/weld/few_equal_points.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search_pair.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>

namespace treeform::detail::boolean {
namespace {

using ids = std::vector<std::uint32_t>;

using marks = std::vector<std::uint8_t>;

void mark(std::uint8_t& mark) { std::atomic_ref(mark).store(1, std::memory_order_relaxed); }
bool is_marked(std::uint8_t& mark) {
    return std::atomic_ref(mark).load(std::memory_order_relaxed) != 0;
}

/// Leaf blocks of each operand whose boxes overlap one of the other operand's.
std::array<marks, 2> find_reached(const std::array<const leaf_blocks*, 2>& blocks) {
    std::array reached{marks(blocks[0]->index.size()), marks(blocks[1]->index.size())};
    for (const auto& part :
         search<std::vector<id_pair>>(blocks[0]->index, blocks[1]->index,
                                      [](std::vector<id_pair>&mine, std::uint32_t a,
                                         std::uint32_t b) { mine.emplace_back(a, b); }))
        for (const auto& [a, b] : part) reached[0][a] = reached[1][b] = 1;
    return reached;
}

/// Faces of each operand whose boxes overlap that of a face of `across` or `own`, by leaf order.
std::array<marks, 2> find_near(const prepared_pair& operands,
                               const std::array<const tree<3>*, 2>& trees,
                               const std::vector<face_pair>& across, const own_pairs& own) {
    std::vector<aabb<double, 3>> cut;
    for (std::size_t k = 0; k < 2; ++k) {
        const mesh_view mesh = operands[k]->view();
        ids met;
        for (const face_pair& pair : across) met.push_back(k == 0 ? pair.a : pair.b);
        for (const face_pair& pair : own[k]) met.insert(met.end(), {pair.a, pair.b});
        std::sort(met.begin(), met.end());
        met.erase(std::unique(met.begin(), met.end()), met.end());
        for (const std::uint32_t f : met)
            cut.push_back(base::face_boxes(mesh.points)(mesh.faces[f]));
    }
    const tree<3> around = build(cut, [](const aabb<double, 3>& box) { return box; });
    std::array<marks, 2> near;
    for (std::size_t k = 0; k < 2; ++k) {
        near[k].resize(trees[k]->size());
        (void)search_broad<int>(*trees[k], around, [&](int&, const candidate_block& block) {
            for (const std::uint32_t place : block.first) mark(near[k][place]);
        });
    }
    return near;
}

/// Where the faces of one operand are, of which some are near and the others not cut. Those of a
/// block that is not reached are alike, and so are those at a point, and those of blocks that
/// overlap, as long as they are not near or reached.
class far_places {
  public:
    far_places(mesh_view mesh, const tree<3>& faces, const leaf_blocks& blocks,
               const marks& reached, const marks& near)
        : mesh_(mesh),
          face_at_(faces.ids()),
          reached_(reached),
          near_(near),
          alike_(reached.size() + mesh.points.size()) {
        join(blocks);
        root_ = alike_.take_roots();
    }

    /// A point of each set, by its root.
    [[nodiscard]] std::pair<ids, std::vector<point3>> sets() const {
        marks is_root(root_.size());
        for_blocks([&](std::size_t b, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (near_[i] != 0) continue;
                const std::uint32_t root = root_[element(i)];
                if (!is_marked(is_root[root])) mark(is_root[root]);
                if (reached_[b] == 0) break;  // the others are alike
            }
        });
        std::pair<ids, std::vector<point3>> result;
        for (std::uint32_t e = 0; e < is_root.size(); ++e) {
            if (is_root[e] == 0) continue;
            result.first.push_back(e);
            result.second.push_back(
                mesh_.points[e < reached_.size() ? mesh_.faces[face_at_[8 * e]][0]
                                                 : e - reached_.size()]);
        }
        return result;
    }

    /// Writes the place of each face. \param inside  [elements] of the roots
    void write(const marks& inside, face_place* place_of_face) const {
        const auto place_of = [&](std::uint32_t element) {
            return inside[root_[element]] != 0 ? face_place::inside : face_place::outside;
        };
        for_blocks([&](std::size_t b, std::size_t begin, std::size_t end) {
            const face_place of_block = place_of(static_cast<std::uint32_t>(b));
            for (std::size_t i = begin; i < end; ++i)
                place_of_face[face_at_[i]] = near_[i] != 0      ? face_place::near
                                             : reached_[b] != 0 ? place_of(element(i))
                                                                : of_block;
        });
    }

  private:
    /// Of the face at a place that is not near: its block, or in a reached one its first corner.
    [[nodiscard]] std::uint32_t element(std::size_t place) const {
        return reached_[place / 8] == 0 ? static_cast<std::uint32_t>(place / 8)
                                        : of_point(mesh_.faces[face_at_[place]][0]);
    }
    [[nodiscard]] std::uint32_t of_point(std::uint32_t p) const {
        return static_cast<std::uint32_t>(reached_.size() + p);
    }

    void join(const leaf_blocks& blocks) {
        marks is_beside(reached_.size());  // blocks that are not reached, but overlap one that is
        for_chunks(blocks.overlaps.size(), 1, [&](std::size_t part, std::size_t, std::size_t) {
            for (const auto& [x, y] : blocks.overlaps[part])
                if (reached_[x] == 0 && reached_[y] == 0)
                    alike_.join(x, y);
                else if (reached_[x] == 0 || reached_[y] == 0)
                    mark(is_beside[reached_[x] == 0 ? x : y]);
        });
        marks is_met(mesh_.points.size());  // points of faces in blocks that are reached
        for_faces_of(reached_, [&](std::size_t i, std::uint32_t p) {
            mark(is_met[p]);
            alike_.join(element(i), of_point(p));
        });
        for_faces_of(is_beside, [&](std::size_t i, std::uint32_t p) {
            if (is_met[p] != 0) alike_.join(element(i), of_point(p));
        });
    }

    /// Each block, and where its places begin and end.
    template <class Visit>
    void for_blocks(const Visit& visit) const {
        for_chunks(reached_.size(), light_grain / 8,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t b = begin; b < end; ++b)
                           visit(b, 8 * b, std::min(8 * b + 8, face_at_.size()));
                   });
    }
    /// The places and corners of faces that are not near, in the blocks of a set.
    template <class Visit>
    void for_faces_of(const marks& blocks, const Visit& visit) const {
        for_blocks([&](std::size_t b, std::size_t begin, std::size_t end) {
            if (blocks[b] == 0) return;
            for (std::size_t i = begin; i < end; ++i)
                if (near_[i] == 0)
                    for (const std::uint32_t p : mesh_.faces[face_at_[i]]) visit(i, p);
        });
    }

    mesh_view mesh_;
    std::span<const std::uint32_t> face_at_;
    const marks& reached_;
    const marks& near_;
    base::union_find alike_;  ///< of blocks, then points
    buffer<std::uint32_t> root_;
};

/// Of faces of both operands, counted through.
buffer<face_place> find_places(const prepared_pair& operands, const std::vector<face_pair>& pairs) {
    const std::array trees{&build_face_tree(*operands[0]), &build_face_tree(*operands[1])};
    const std::array blocks{&leaf_blocks_of(*operands[0]), &leaf_blocks_of(*operands[1])};
    const auto reached = find_reached(blocks);
    const auto near = find_near(operands, trees, pairs, {});
    buffer<face_place> result(trees[0]->size() + trees[1]->size());
    for (std::size_t k = 0, first = 0; k < 2; first += trees[k++]->size()) {
        const far_places places(operands[k]->view(), *trees[k], *blocks[k], reached[k], near[k]);
        const auto [sets, points] = places.sets();
        const auto found =
            intersect::point_locator(operands[1 - k]->view(), *trees[1 - k]).locate(points);
        marks inside(reached[k].size() + operands[k]->view().points.size());
        for (std::size_t i = 0; i < sets.size(); ++i)
            inside[sets[i]] = found[i].where == location::inside ? 1 : 0;
        places.write(inside, result.data() + first);
    }
    return result;
}

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

/// The pairs by local faces, ascending, without those that meet in shared corners only.
void keep_pairs(std::vector<face_pair>&& pairs, const own_pairs& own, std::size_t faces_of_a,
                near_faces& near) {
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
    for (std::size_t k = 0; k < 2; ++k)
        for (const auto& [a, b, kind] : own[k])
            pairs.push_back(
                {local((k == 0 ? 0 : faces_of_a) + a), local((k == 0 ? 0 : faces_of_a) + b), kind});
    if (pairs.size() > left) std::sort(pairs.begin(), pairs.end());
    near.pairs = std::move(pairs);
}

std::vector<face_pair> pairs_across(const prepared_pair& operands, bool once) {
    const prepared_mesh &a = *operands[0], &b = *operands[1];
    if (a.view().faces.empty() || b.view().faces.empty()) return {};
    if (!once) return treeform::mesh_intersections(a, b).pairs;
    return intersect::mesh_intersections(a.view(), build_face_tree(a), b.view(), build_face_tree(b))
        .pairs;
}

/// The faces that are near, and those that have a point with one of them in common: what is rounded
/// is then known to hang together with faces that meet no box of it. Of the others nothing is asked.
buffer<face_place> find_near_places(const prepared_pair& operands,
                                    const std::vector<face_pair>& across, const own_pairs& own) {
    const std::array trees{&build_face_tree(*operands[0]), &build_face_tree(*operands[1])};
    const auto near = find_near(operands, trees, across, own);
    buffer<face_place> result(trees[0]->size() + trees[1]->size());
    for (std::size_t k = 0, first = 0; k < 2; first += trees[k++]->size()) {
        const mesh_view mesh = operands[k]->view();
        marks is_near(mesh.points.size());
        for_chunks(near[k].size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t i = begin; i < end; ++i)
                           if (near[k][i] != 0)
                               for (const std::uint32_t p : mesh.faces[trees[k]->ids()[i]])
                                   mark(is_near[p]);
                   });
        for_chunks(mesh.faces.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t f = begin; f < end; ++f) {
                           const auto& [a, b, c] = mesh.faces[f];
                           result[first + f] = (is_near[a] | is_near[b] | is_near[c]) != 0
                                                   ? face_place::near
                                                   : face_place::outside;
                       }
                   });
    }
    return result;
}

/// Puts together those that are near by their places.
void collect_near(const prepared_pair& operands, std::vector<face_pair>&& across,
                  const own_pairs& own, near_faces& result) {
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
    keep_pairs(std::move(across), own, operands[0]->view().faces.size(), result);
}

}  // namespace

near_faces find_near_faces(const prepared_pair& operands, bool once) {
    near_faces result;
    const std::size_t faces_of_a = operands[0]->view().faces.size();
    const std::size_t faces_of_b = operands[1]->view().faces.size();
    if (faces_of_a == 0 || faces_of_b == 0) {
        result.place.resize(faces_of_a + faces_of_b);
        std::fill_n(result.place.data(), result.place.size(), face_place::outside);
        return result;
    }
    std::vector<face_pair> across = pairs_across(operands, once);
    result.place = find_places(operands, across);
    collect_near(operands, std::move(across), {}, result);
    return result;
}

near_faces find_near_faces(const prepared_pair& operands, const own_pairs& own, bool once) {
    near_faces result;
    std::vector<face_pair> across = pairs_across(operands, once);
    result.place = find_near_places(operands, across, own);
    collect_near(operands, std::move(across), own, result);
    return result;
}

}  // namespace treeform::detail::boolean
