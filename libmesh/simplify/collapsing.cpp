#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/intersect/classify_pair.hpp>
#include <libmesh/simplify/collapsing.hpp>
#include <libmesh/simplify/distance_proof.hpp>
#include <libmesh/simplify/kept_chains.hpp>
#include <libmesh/simplify/quadric.hpp>
#include <libmesh/simplify/seen_along.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/simplify.hpp>
#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace treeform::detail::simplify {
namespace {

constexpr std::size_t most_places = 2;  ///< tried for an edge

[[nodiscard]] std::uint64_t edge_of(std::uint32_t p, std::uint32_t q) {
    return std::uint64_t{std::max(p, q)} << 32 | std::min(p, q);
}

struct candidate {
    bool anew = false;  ///< no step was proven: the input is to be looked at
    double cost = 0.0;
    std::uint32_t p = 0, q = 0;
    std::uint64_t version = 0;  ///< of both ends together
    friend bool operator>(const candidate& a, const candidate& b) {
        return std::tie(a.anew, a.cost, a.p, a.q) > std::tie(b.anew, b.cost, b.p, b.q);
    }
};

/// Where both ends may go.
struct place {
    double cost = 0.0;
    point3 at{};
    std::uint32_t source = no_face;  ///< vertex of the input that is there
};

/// What of the input a face comes from, as in the result.
struct origin {
    std::uint32_t face = no_face;
    treeform::face corners{};
};

class simplifying {
  public:
    simplifying(mesh_view given, connected_faces&& mesh, double distance,
                const simplify_options& options);
    simplify_result run();

  private:
    [[nodiscard]] triangle3 triangle_of(const face& f) const {
        return base::triangle_of(points_, f);
    }
    [[nodiscard]] aabb<double, 3> box_of(const face& f) const {
        aabb<double, 3> box;
        for (const std::uint32_t p : f) box.include(points_[p]);
        return box;
    }
    void add_quadrics();
    void put_neighbors(std::uint32_t p, ids& all) const;
    struct places_of_edge {
        std::array<place, most_places + 1> best{};  ///< the last for one too many
        std::size_t count = 0;
    };
    [[nodiscard]] places_of_edge places(std::uint32_t p, std::uint32_t q) const;
    void line_up(std::uint32_t p, std::uint32_t q);
    void collapse(candidate c);
    std::uint64_t* attempt(const candidate& c, const place& to);
    [[nodiscard]] bool meets();
    void apply(std::uint32_t p, std::uint32_t q, std::uint32_t gone, double chain,
               std::uint32_t source);
    [[nodiscard]] std::uint32_t group_of(std::uint32_t corner) const {
        if (corner == no_face) return no_face;
        return options_.corner_groups.empty() ? 0 : options_.corner_groups[corner];
    }
    void move_corners(std::uint32_t gone, std::uint32_t kept, bool is_new);
    [[nodiscard]] bool are_linked(std::uint32_t t, std::uint32_t u) const;
    [[nodiscard]] std::uint32_t nearest_given(std::uint32_t p) const;
    [[nodiscard]] std::uint32_t nearest_on_side(std::uint32_t p, double enough) const;
    simplify_result finish();

    const simplify_options& options_;
    double distance_;
    double largest_;  ///< no coordinate has a larger magnitude, nor shall
    kept_chains chains_;
    distance_proof proof_;
    std::vector<point3> points_;
    std::vector<face> faces_;
    std::vector<origin> origin_{};
    std::vector<ids> star_;
    ids source_{};  ///< of each vertex, as in the result
    std::vector<quadric> quadric_{};
    std::vector<std::uint64_t> version_{};
    point3 center_{};  ///< that quadrics are around
    dynamic_tree<3> tree_{};
    std::priority_queue<candidate, std::vector<candidate>, std::greater<>> next_{};
    change change_{};  ///< what the attempt is to make
    std::array<ids, 4> workspace_{};
    std::vector<face> made_{};                     ///< [kept] of it
    std::vector<aabb<double, 3>> boxes_{};         ///< [kept], of these
    std::unordered_set<std::uint64_t> shelved_{};  ///< edges to try again when faces at them change
    predicate_counters counters_{};
    simplify_result result_{};
};

[[nodiscard]] double largest_coordinate(const connected_faces& mesh) {
    double largest = 0.0;
    for (const face& f : mesh.faces)
        for (const std::uint32_t c : f)
            largest = std::max(largest, base::largest_of(mesh.points[c]));
    return largest;
}

simplifying::simplifying(mesh_view given, connected_faces&& mesh, double distance,
                         const simplify_options& options)
    : options_(options),
      distance_(distance),
      largest_(2.0 * largest_coordinate(mesh)),
      chains_(mesh, options),
      proof_(given, mesh, largest_, distance),
      points_(std::move(mesh.points)),
      faces_(std::move(mesh.faces)),
      star_(std::move(mesh.star)) {
    result_.fixed_vertices = chains_.locked();
    // Squares of distances have to be doubles, and what is lost of small ones no more than u.
    if (!(largest_ > 0x1p-400 && largest_ < 0x1p400)) distance_ = 0.0;
    quadric_.resize(points_.size());
    version_.resize(points_.size());
    source_.resize(points_.size());
    for (std::uint32_t p = 0; p < source_.size(); ++p) source_[p] = p;
    for (const std::uint32_t f : mesh.source) origin_.push_back({f, {3 * f, 3 * f + 1, 3 * f + 2}});
    tree_ = dynamic_tree<3>(faces_, [&](const face& f) { return box_of(f); });
    add_quadrics();
}

simplify_result simplifying::run() {
    base::work_progress progress(options_.progress);
    for (const face& f : faces_)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t p = f[i], q = f[(i + 1) % 3];
            if (p < q || chains_.has(p, q)) line_up(p, q);
        }
    const auto start = static_cast<double>(tree_.size());
    for (std::size_t steps = 0; !next_.empty() && tree_.size() > options_.target_faces; ++steps) {
        if (steps % 1024 == 0 && !progress.step(0.0, 1.0, steps, start)) break;
        const candidate c = next_.top();
        next_.pop();
        if (c.version == version_[c.p] + version_[c.q] && !star_[c.p].empty() &&
            !star_[c.q].empty())
            collapse(c);
    }
    return progress.cancelled() ? simplify_result{} : finish();
}

/// Of planes of faces, and of planes upright on them along borders.
void simplifying::add_quadrics() {
    if (!faces_.empty()) center_ = points_[faces_.front()[0]];
    const auto add = [&](std::uint32_t p, const point3& normal, const point3& at, double weight) {
        const point3 unit = unit_of(normal);
        quadric_[p].add_plane(unit, -base::dot(unit, base::minus(at, center_)), weight);
    };
    for (const face& f : faces_) {
        const point3 normal = normal_of(triangle_of(f));
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t p = f[i], q = f[(i + 1) % 3];
            add(p, normal, points_[p], std::sqrt(base::dot(normal, normal)));
            if (!chains_.has(p, q)) continue;
            const point3 way = base::minus(points_[q], points_[p]);
            for (const std::uint32_t end : {p, q})
                add(end, base::cross(way, normal), points_[p], base::dot(way, way));
        }
    }
}

/// Vertices of faces around `p`, ascending.
void simplifying::put_neighbors(std::uint32_t p, ids& all) const {
    all.clear();
    for (const std::uint32_t f : star_[p])
        for (const std::uint32_t c : faces_[f])
            if (c != p) all.push_back(c);
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
}

/// Where both ends may go, best first.
simplifying::places_of_edge simplifying::places(std::uint32_t p, std::uint32_t q) const {
    quadric sum = quadric_[p];
    sum.add(quadric_[q]);
    places_of_edge all;
    const auto put = [&](const point3& at, std::uint32_t source) {
        if (!base::is_finite(at) || base::largest_of(at) > largest_) return;
        const place one{std::max(0.0, sum.at(base::minus(at, center_))), at, source};
        std::size_t i = all.count++;
        for (; i > 0 && one.cost < all.best[i - 1].cost; --i) all.best[i] = all.best[i - 1];
        all.best[i] = one;
        all.count = std::min(all.count, most_places);
    };
    if (chains_.may_join(q, p)) put(points_[p], source_[p]);
    if (chains_.may_join(p, q)) put(points_[q], source_[q]);
    if (!chains_.is_free(p) || !chains_.is_free(q)) return all;
    for (point3 at : {base::plus(center_, sum.lowest()),
                      base::scaled(base::plus(points_[p], points_[q]), 0.5)}) {
        if (options_.precision == precision::float32)
            at = {base::nearest_float(at.x), base::nearest_float(at.y), base::nearest_float(at.z)};
        put(at, no_face);
    }
    return all;
}

void simplifying::line_up(std::uint32_t p, std::uint32_t q) {
    if (distance_ <= 0.0) return;
    const places_of_edge all = places(p, q);
    if (all.count == 0) return;
    const point3 way = base::minus(points_[p], points_[q]);
    const double short_first = 1e-9 * base::dot(way, way) * base::dot(way, way);
    next_.push({false, all.best[0].cost + short_first, std::min(p, q), std::max(p, q),
                version_[p] + version_[q]});
}

void simplifying::collapse(candidate c) {
    const std::uint32_t p = c.p, q = c.q;
    ids &common = workspace_[0], &gone = workspace_[1];
    common.clear();
    gone.clear();
    change_.clear();
    put_neighbors(p, workspace_[2]);
    put_neighbors(q, workspace_[3]);
    std::ranges::set_intersection(workspace_[2], workspace_[3], std::back_inserter(common));
    std::ranges::set_intersection(star_[p], star_[q], std::back_inserter(gone));
    std::ranges::set_union(star_[p], star_[q], std::back_inserter(change_.old));
    std::ranges::set_difference(change_.old, gone, std::back_inserter(change_.kept));
    if (gone.empty() || gone.size() > 2 || common.size() != gone.size() || change_.kept.empty()) {
        ++result_.refused_by_topology;
        shelved_.insert(edge_of(p, q));
        return;
    }
    for (const std::uint32_t f : change_.old) change_.before.push_back(triangle_of(faces_[f]));
    // Where an end of it lies on a border, the border moves.
    change_.same_rim = gone.size() == 2;
    const std::array<point3, 2> before{points_[p], points_[q]};
    std::uint64_t* refused = &result_.refused_by_distance;
    bool is_far = false;
    const places_of_edge all = places(p, q);
    for (std::size_t i = 0; i < all.count; ++i) {
        refused = attempt(c, all.best[i]);
        if (refused == nullptr) return;
        is_far = is_far || refused == &result_.refused_by_distance;
        points_[p] = before[0];
        points_[q] = before[1];
    }
    if (is_far && !std::exchange(c.anew, true)) {
        next_.push(c);
        return;
    }
    ++*refused;
    if (refused != &result_.refused_by_distance) shelved_.insert(edge_of(p, q));
}

/// Makes it, or returns the counter of what speaks against it.
std::uint64_t* simplifying::attempt(const candidate& c, const place& to) {
    const std::uint32_t p = c.p, q = c.q;
    const std::uint32_t gone = to.at == points_[p] ? q : p;
    std::optional<double> chain = 0.0;
    if (chains_.has(p, q)) {
        chain = chains_.bound(points_, gone, gone == p ? q : p);
        if (!chain || *chain > distance_) return &result_.refused_by_distance;
    }
    points_[p] = points_[q] = to.at;
    change_.after.clear();
    made_.clear();
    auto before = change_.before.begin();
    auto old = change_.old.begin();
    for (const std::uint32_t f : change_.kept) {
        face corners = faces_[f];
        std::ranges::replace(corners, q, p);
        made_.push_back(corners);
        change_.after.push_back(triangle_of(corners));
        while (*old != f) ++old, ++before;
        const point3 now = normal_of(change_.after.back()), then = normal_of(*before);
        const double both = base::dot(now, now) * base::dot(then, then);
        if (base::dot(then, then) > 0.0 && !(base::dot(now, then) > 0.2 * std::sqrt(both)))
            return &result_.refused_by_turning;
    }
    for (const triangle3& t : change_.after)
        if (collinear(t[0], t[1], t[2])) return &result_.refused_by_turning;
    if (!proof_.holds_by_step(change_) && !(c.anew && proof_.holds_anew(change_, tree_)))
        return &result_.refused_by_distance;
    if (meets()) return &result_.refused_by_contact;
    apply(p, q, gone, *chain, to.source);
    return nullptr;
}

/// Whether new faces meet each other or others, exactly.
bool simplifying::meets() {
    const auto meet = [&](const face& f, const face& g) {
        return intersect::classify_pair(points_, f, g, counters_).has_value();
    };
    boxes_.clear();
    aabb<double, 3> around;
    for (const face& f : made_) {
        boxes_.push_back(box_of(f));
        around.include(boxes_.back());
    }
    for (std::size_t i = 0; i < made_.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (meet(made_[i], made_[j])) return true;
    return search_any(tree_, around, [&](std::uint32_t g) {
        if (std::ranges::binary_search(change_.old, g)) return false;
        for (std::size_t i = 0; i < made_.size(); ++i)
            if (overlaps(boxes_[i], tree_.box(g)) && meet(made_[i], faces_[g])) return true;
        return false;
    });
}

void simplifying::apply(std::uint32_t p, std::uint32_t q, std::uint32_t gone, double chain,
                        std::uint32_t source) {
    ++result_.collapses;
    proof_.accept(change_);
    chains_.join(p, q, gone, chain);
    move_corners(gone, gone == p ? q : p, source == no_face);
    const ids& left_out = workspace_[1];
    for (const std::uint32_t f : left_out)
        for (const std::uint32_t c : faces_[f]) std::erase(star_[c], f);
    for (std::size_t i = 0; i < made_.size(); ++i) faces_[change_.kept[i]] = made_[i];
    tree_.remove(left_out);
    tree_.move(change_.kept, boxes_);
    star_[p] = change_.kept;
    star_[q].clear();
    source_[p] = source;
    quadric_[p].add(quadric_[q]);
    ++version_[p];
    ids& around = workspace_[2];
    put_neighbors(p, around);
    for (const std::uint32_t c : around) line_up(p, c);
    for (const face& f : made_)
        for (std::size_t i = 0; i < 3; ++i)
            if (const std::uint32_t a = f[i], b = f[(i + 1) % 3];
                a != p && b != p && shelved_.erase(edge_of(a, b)) > 0)
                line_up(a, b);
}

/// Gives corners at `gone` what faces that go have at `kept`, on the same side of borders.
void simplifying::move_corners(std::uint32_t gone, std::uint32_t kept, bool is_new) {
    for (const std::uint32_t f : change_.kept)
        for (std::size_t i = 0; i < 3; ++i) {
            std::uint32_t& corner = origin_[f].corners[i];
            if (faces_[f][i] != gone && !(is_new && faces_[f][i] == kept)) continue;
            std::uint32_t moved = no_face;
            for (const std::uint32_t g : workspace_[1]) {
                const face& at = origin_[g].corners;
                if (!is_new && (moved == no_face ||
                                group_of(at[corner_of(faces_[g], gone)]) == group_of(corner)))
                    moved = at[corner_of(faces_[g], kept)];
            }
            corner = moved;
        }
}

/// Whether no border is between two triangles of the input.
bool simplifying::are_linked(std::uint32_t t, std::uint32_t u) const {
    for (std::uint32_t i = 0; i < 3; ++i)
        for (std::uint32_t j = 0; j < 3; ++j)
            if (proof_.given(t)[i] == proof_.given(u)[j] &&
                group_of(3 * origin_[t].face + i) != group_of(3 * origin_[u].face + j))
                return false;
    return true;
}

/// Goes from the triangles that faces at `p` were across sides that are no borders, to the nearest
/// ones first, until one is near `enough` or no nearer one comes.
std::uint32_t simplifying::nearest_on_side(std::uint32_t p, double enough) const {
    constexpr std::size_t patience = 256;
    using reached = std::pair<double, std::uint32_t>;
    std::priority_queue<reached, std::vector<reached>, std::greater<>> next;
    std::unordered_set<std::uint32_t> seen;
    const auto put = [&](std::uint32_t t) {
        if (seen.insert(t).second)
            next.emplace(closest_point(proof_.given(t), points_[p]).squared_distance, t);
    };
    for (const std::uint32_t f : star_[p]) put(f);
    reached best = next.top();
    for (std::size_t tries = 0; !next.empty() && tries < patience && best.first > enough; ++tries) {
        const reached one = next.top();
        next.pop();
        if (one < best) best = one, tries = 0;
        for (const std::uint32_t mate : proof_.mates_of_given(one.second))
            if (mate != no_face && are_linked(one.second, mate)) put(mate);
    }
    return best.second;
}

/// The triangle of the input that is nearest to a vertex, of those in lists of its faces.
std::uint32_t simplifying::nearest_given(std::uint32_t p) const {
    std::uint32_t nearest = star_[p].front();
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t f : star_[p])
        for (const std::uint32_t t : proof_.near(f)) {
            if (squared_distance(proof_.box_of_given(t), points_[p]) > least) continue;
            const double d = closest_point(proof_.given(t), points_[p]).squared_distance;
            if (std::tie(d, t) < std::tie(least, nearest)) least = d, nearest = t;
        }
    return options_.corner_groups.empty() ? nearest : nearest_on_side(p, least);
}

simplify_result simplifying::finish() {
    ids number(points_.size(), no_face);
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
        if (star_[p].empty()) continue;
        number[p] = static_cast<std::uint32_t>(result_.mesh.points.size());
        result_.mesh.points.push_back(points_[p]);
        result_.vertex_source.push_back(source_[p]);
        result_.face_of_new_vertex.push_back(source_[p] == no_face ? origin_[nearest_given(p)].face
                                                                   : no_face);
    }
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        if (!tree_.contains(f)) continue;
        result_.input_to_result_bound = std::max(result_.input_to_result_bound, proof_.there(f));
        result_.result_to_input_bound = std::max(result_.result_to_input_bound, proof_.back(f));
        result_.mesh.faces.push_back(
            {number[faces_[f][0]], number[faces_[f][1]], number[faces_[f][2]]});
        result_.face_source.push_back(origin_[f].face);
        result_.corner_source.insert(result_.corner_source.end(), origin_[f].corners.begin(),
                                     origin_[f].corners.end());
    }
    return std::move(result_);
}

}  // namespace

simplify_result collapse_edges(mesh_view given, double distance, const simplify_options& options) {
    return simplifying(given, connected_faces(given, options.precision), distance, options).run();
}

}  // namespace treeform::detail::simplify
