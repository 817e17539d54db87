#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/intersect/classify_pair.hpp>
#include <libmesh/simplify/covering.hpp>
#include <libmesh/weld/equal_firsts.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/simplify.hpp>
#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace treeform {
namespace detail::simplify {
namespace {

using ids = std::vector<std::uint32_t>;

/// Of the largest coordinate: what a proof in double may be wrong by, 64 u.
constexpr double proof_error = 0x1p-47;

void insert(ids& into, std::uint32_t value) {
    const auto place = std::ranges::lower_bound(into, value);
    if (place == into.end() || *place != value) into.insert(place, value);
}

void erase(ids& from, std::uint32_t value) {
    const auto place = std::ranges::lower_bound(from, value);
    if (place != from.end() && *place == value) from.erase(place);
}

[[nodiscard]] bool contains(const ids& all, std::uint32_t value) {
    return std::ranges::binary_search(all, value);
}

/// Sum of squared distances from planes, weighted by area: symmetric, 4 x 4.
struct quadric {
    std::array<double, 10> of{};

    void add(const quadric& other) {
        for (std::size_t i = 0; i < of.size(); ++i) of[i] += other.of[i];
    }
    void add_plane(const point3& n, double d, double weight) {
        const std::array<double, 4> v{n.x, n.y, n.z, d};
        for (std::size_t i = 0, k = 0; i < 4; ++i)
            for (std::size_t j = i; j < 4; ++j) of[k++] += weight * v[i] * v[j];
    }
    [[nodiscard]] double at(const point3& p) const {
        return p.x * (of[0] * p.x + 2 * (of[1] * p.y + of[2] * p.z + of[3])) +
               p.y * (of[4] * p.y + 2 * (of[5] * p.z + of[6])) + p.z * (of[7] * p.z + 2 * of[8]) +
               of[9];
    }
    /// Where it is least; not finite where that is no single point.
    [[nodiscard]] point3 lowest() const {
        const point3 a{of[0], of[1], of[2]}, b{of[1], of[4], of[5]}, c{of[2], of[5], of[7]};
        const point3 bc = base::cross(b, c), ca = base::cross(c, a), ab = base::cross(a, b);
        const double all = base::dot(a, bc), trace = of[0] + of[4] + of[7];
        if (!(all > 1e-6 * trace * trace * trace)) return {std::nan(""), 0.0, 0.0};
        return base::scaled(
            base::plus(base::scaled(bc, of[3]),
                       base::plus(base::scaled(ca, of[6]), base::scaled(ab, of[8]))),
            -1.0 / all);
    }
};

struct candidate {
    double cost = 0.0;
    std::uint32_t p = 0, q = 0;
    std::uint64_t version = 0;  ///< of both ends together
    friend bool operator>(const candidate& a, const candidate& b) {
        return std::tie(a.cost, a.p, a.q) > std::tie(b.cost, b.p, b.q);
    }
};

class simplifying {
  public:
    simplifying(mesh_view given, double distance, const simplify_options& options)
        : options_(options), points_(given.points.begin(), given.points.end()) {
        const ids first = weld::equal_firsts(given.points, {});
        for (std::uint32_t f = 0; f < given.faces.size(); ++f) {
            face corners = given.faces[f];
            for (std::uint32_t& c : corners) {
                c = first[c];
                scale_ = std::max(scale_, base::largest_of(points_[c]));
            }
            if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
                continue;
            faces_.push_back(corners);
            source_.push_back(f);
        }
        slack_ = proof_error * (scale_ + distance);
        limit_ = distance - slack_;
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            given_.push_back(base::triangle_of(points_, faces_[f]));
            near_given_.push_back({f});
            near_.push_back({f});
        }
        there_.assign(faces_.size(), 0.0);
        back_ = there_;
        star_.resize(points_.size());
        quadric_.resize(points_.size());
        version_.resize(points_.size());
        locked_.resize(points_.size());
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            for (const std::uint32_t c : faces_[f]) star_[c].push_back(f);
        tree_ = dynamic_tree<3>(faces_, [&](const face& f) { return box_of(f); });
        add_quadrics();
        lock();
    }

    simplify_result run() {
        base::work_progress progress(options_.progress);
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            for (std::size_t i = 0; i < 3; ++i)
                if (faces_[f][i] < faces_[f][(i + 1) % 3])
                    line_up(faces_[f][i], faces_[f][(i + 1) % 3]);
        const auto start = static_cast<double>(tree_.size());
        for (std::size_t steps = 0; !next_.empty() && tree_.size() > options_.target_faces;
             ++steps) {
            if (steps % 1024 == 0 && !progress.step(0.0, 1.0, steps, start)) break;
            const candidate c = next_.top();
            next_.pop();
            if (c.version == version_[c.p] + version_[c.q] && !star_[c.p].empty() &&
                !star_[c.q].empty())
                collapse(c.p, c.q);
        }
        if (progress.cancelled()) {
            result_ = {};
            result_.certificate.status = status::cancelled;
            return std::move(result_);
        }
        return finish();
    }

  private:
    [[nodiscard]] aabb<double, 3> box_of(const face& f) const {
        aabb<double, 3> box;
        for (const std::uint32_t p : f) box.include(points_[p]);
        return box;
    }
    [[nodiscard]] point3 normal_of(const face& f) const {
        return base::cross(base::minus(points_[f[1]], points_[f[0]]),
                           base::minus(points_[f[2]], points_[f[0]]));
    }

    void add_quadrics() {
        for (const face& f : faces_) {
            const point3 n = normal_of(f);
            const double length = std::sqrt(base::dot(n, n));
            if (!(length > 0.0)) continue;
            const point3 unit = base::scaled(n, 1.0 / length);
            for (const std::uint32_t c : f)
                quadric_[c].add_plane(unit, -base::dot(unit, points_[f[0]]), length);
        }
    }

    /// Locks the ends of edges that stay, and vertices whose faces are no fan.
    void lock() {
        std::map<std::pair<std::uint32_t, std::uint32_t>, ids> at_edge;
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            for (std::size_t i = 0; i < 3; ++i)
                at_edge[std::minmax(faces_[f][i], faces_[f][(i + 1) % 3])].push_back(f);
        const double cosine = std::cos(options_.feature_angle * std::numbers::pi / 180.0);
        for (const auto& [edge, at] : at_edge)
            if (at.size() != 2 || !is_smooth(edge.first, edge.second, at[0], at[1], cosine))
                locked_[edge.first] = locked_[edge.second] = 1;
        for (std::uint32_t p = 0; p < star_.size(); ++p)
            if (locked_[p] == 0 && !star_[p].empty() && !is_fan(p)) locked_[p] = 1;
    }

    [[nodiscard]] bool runs(std::uint32_t f, std::uint32_t p, std::uint32_t q) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (faces_[f][i] == p && faces_[f][(i + 1) % 3] == q) return true;
        return false;
    }
    [[nodiscard]] bool is_smooth(std::uint32_t p, std::uint32_t q, std::uint32_t f, std::uint32_t g,
                                 double cosine) const {
        if (runs(f, p, q) == runs(g, p, q)) return false;
        const auto& groups = options_.face_groups;
        if (!groups.empty() && groups[source_[f]] != groups[source_[g]]) return false;
        const point3 m = normal_of(faces_[f]), n = normal_of(faces_[g]);
        return options_.feature_angle >= 180.0 ||
               base::dot(m, n) >= cosine * std::sqrt(base::dot(m, m) * base::dot(n, n));
    }
    /// \pre each edge at `p` has two faces
    [[nodiscard]] bool is_fan(std::uint32_t p) const {
        std::uint32_t f = star_[p].front();
        std::size_t count = 0;
        do {
            const std::uint32_t along = *(std::ranges::find(faces_[f], p) == faces_[f].begin() + 2
                                              ? faces_[f].begin()
                                              : std::ranges::find(faces_[f], p) + 1);
            const auto next =
                std::ranges::find_if(star_[p], [&](std::uint32_t g) { return runs(g, along, p); });
            if (next == star_[p].end()) return false;
            f = *next;
        } while (++count < star_[p].size() && f != star_[p].front());
        return count == star_[p].size() && f == star_[p].front();
    }

    [[nodiscard]] ids neighbors(std::uint32_t p) const {
        ids all;
        for (const std::uint32_t f : star_[p])
            for (const std::uint32_t c : faces_[f])
                if (c != p) insert(all, c);
        return all;
    }

    /// Where both ends may go, best first.
    [[nodiscard]] std::vector<std::pair<double, point3>> places(std::uint32_t p,
                                                                std::uint32_t q) const {
        quadric sum = quadric_[p];
        sum.add(quadric_[q]);
        std::vector<std::pair<double, point3>> all;
        const auto put = [&](const point3& at) {
            if (base::is_finite(at)) all.emplace_back(std::max(0.0, sum.at(at)), at);
        };
        if (locked_[q] == 0) put(points_[p]);
        if (locked_[p] == 0) put(points_[q]);
        if (locked_[p] == 0 && locked_[q] == 0) {
            for (point3 at :
                 {sum.lowest(), base::scaled(base::plus(points_[p], points_[q]), 0.5)}) {
                if (options_.precision == precision::float32)
                    at = {base::nearest_float(at.x), base::nearest_float(at.y),
                          base::nearest_float(at.z)};
                put(at);
            }
        }
        std::ranges::stable_sort(all, {}, [](const auto& place) { return place.first; });
        return all;
    }

    void line_up(std::uint32_t p, std::uint32_t q) {
        if (limit_ <= 0.0 || (locked_[p] != 0 && locked_[q] != 0)) return;
        const point3 way = base::minus(points_[p], points_[q]);
        const double short_first = 1e-9 * base::dot(way, way) * base::dot(way, way);
        next_.push({places(p, q).front().first + short_first, std::min(p, q), std::max(p, q),
                    version_[p] + version_[q]});
    }

    void collapse(std::uint32_t p, std::uint32_t q) {
        ids common, old;
        std::ranges::set_intersection(neighbors(p), neighbors(q), std::back_inserter(common));
        std::ranges::set_union(star_[p], star_[q], std::back_inserter(old));
        ids gone;
        std::ranges::set_intersection(star_[p], star_[q], std::back_inserter(gone));
        if (gone.size() != 2 || common.size() != 2 || old.size() <= 4) {
            ++result_.refused_by_topology;
            return;
        }
        ids kept;
        std::ranges::set_difference(old, gone, std::back_inserter(kept));
        const std::array<point3, 2> before{points_[p], points_[q]};
        std::uint64_t* refused = nullptr;
        for (const auto& [cost, at] : places(p, q)) {
            points_[p] = points_[q] = at;
            refused = attempt(p, q, before, old, kept);
            if (refused == nullptr) break;
            points_[p] = before[0];
            points_[q] = before[1];
        }
        if (refused != nullptr)
            ++*refused;
        else
            apply(p, q, gone, kept);
    }

    /// The counter of what speaks against it, if anything.
    std::uint64_t* attempt(std::uint32_t p, std::uint32_t q, const std::array<point3, 2>& before,
                           const ids& old, const ids& kept) {
        made_.clear();
        for (const std::uint32_t f : kept) {
            const point3 now = normal_of(faces_[f]);
            std::array<point3, 3> t = base::triangle_of(points_, faces_[f]);
            for (std::size_t i = 0; i < 3; ++i) {
                if (faces_[f][i] == p) t[i] = before[0];
                if (faces_[f][i] == q) t[i] = before[1];
            }
            const point3 then = base::cross(base::minus(t[1], t[0]), base::minus(t[2], t[0]));
            if (!(base::dot(now, then) >
                  0.2 * std::sqrt(base::dot(now, now) * base::dot(then, then))))
                return &result_.refused_by_turning;
            face corners = faces_[f];
            std::ranges::replace(corners, q, p);
            if (collinear(points_[corners[0]], points_[corners[1]], points_[corners[2]]))
                return &result_.refused_by_turning;
            made_.push_back(corners);
        }
        if (!is_near(old, kept)) return &result_.refused_by_distance;
        return meets(old) ? &result_.refused_by_contact : nullptr;
    }

    [[nodiscard]] bool is_near(const ids& old, const ids& kept) {
        affected_.clear();
        for (const std::uint32_t f : old)
            affected_.insert(affected_.end(), near_[f].begin(), near_[f].end());
        std::ranges::sort(affected_);
        affected_.erase(std::unique(affected_.begin(), affected_.end()), affected_.end());
        covers_there_.clear();
        covers_back_.clear();
        std::vector<triangle3> by;
        for (const std::uint32_t t : affected_) {
            by.clear();
            for (const face& f : made_) by.push_back(base::triangle_of(points_, f));
            for (const std::uint32_t f : near_given_[t])
                if (!contains(old, f)) by.push_back(base::triangle_of(points_, faces_[f]));
            covers_there_.push_back(cover(given_[t], by, limit_));
            if (!covers_there_.back().proven) return false;
        }
        by.clear();
        for (const std::uint32_t t : affected_) by.push_back(given_[t]);
        for (std::size_t i = 0; i < kept.size(); ++i) {
            covers_back_.push_back(cover(base::triangle_of(points_, made_[i]), by, limit_));
            if (!covers_back_.back().proven) return false;
        }
        return true;
    }

    [[nodiscard]] bool meets(const ids& old) {
        for (std::size_t i = 0; i < made_.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j)
                if (intersect::classify_pair(points_, made_[i], made_[j], counters_)) return true;
            bool found = false;
            search(tree_, box_of(made_[i]), [&](std::uint32_t g) {
                found =
                    found || (!contains(old, g) &&
                              intersect::classify_pair(points_, made_[i], faces_[g], counters_));
            });
            if (found) return true;
        }
        return false;
    }

    void apply(std::uint32_t p, std::uint32_t q, const ids& gone, const ids& kept) {
        ++result_.collapses;
        for (const ids* some : {&gone, &kept})
            for (const std::uint32_t f : *some) {
                for (const std::uint32_t t : near_[f]) erase(near_given_[t], f);
                near_[f].clear();
            }
        for (const std::uint32_t f : gone)
            for (const std::uint32_t c : faces_[f]) erase(star_[c], f);
        std::vector<aabb<double, 3>> boxes;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            faces_[kept[i]] = made_[i];
            boxes.push_back(box_of(made_[i]));
            back_[kept[i]] = covers_back_[i].at_most;
            for (const std::uint32_t t : covers_back_[i].used) relate(kept[i], affected_[t]);
        }
        for (std::size_t i = 0; i < affected_.size(); ++i) {
            there_[affected_[i]] = covers_there_[i].at_most;
            for (const std::uint32_t f : covers_there_[i].used)
                if (f < kept.size()) relate(kept[f], affected_[i]);
        }
        tree_.remove(gone);
        tree_.move(kept, boxes);
        star_[p] = kept;
        star_[q].clear();
        quadric_[p].add(quadric_[q]);
        if (locked_[q] != 0) locked_[p] = 1;
        const ids around = neighbors(p);
        ++version_[p];
        for (const std::uint32_t c : around) line_up(p, c);
    }

    void relate(std::uint32_t f, std::uint32_t t) {
        insert(near_[f], t);
        insert(near_given_[t], f);
    }

    simplify_result finish() {
        ids number(points_.size(), std::numeric_limits<std::uint32_t>::max());
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            result_.there_at_most = std::max(result_.there_at_most, there_[f]);
            if (!tree_.contains(f)) continue;
            result_.back_at_most = std::max(result_.back_at_most, back_[f]);
            face corners = faces_[f];
            for (std::uint32_t& c : corners) {
                if (number[c] == std::numeric_limits<std::uint32_t>::max()) {
                    number[c] = static_cast<std::uint32_t>(result_.mesh.points.size());
                    result_.mesh.points.push_back(points_[c]);
                }
                c = number[c];
            }
            result_.mesh.faces.push_back(corners);
            result_.face_source.push_back(source_[f]);
        }
        if (result_.collapses > 0) {
            result_.there_at_most += slack_;
            result_.back_at_most += slack_;
        }
        return std::move(result_);
    }

    const simplify_options& options_;
    std::vector<point3> points_;
    std::vector<face> faces_{};
    ids source_{};
    std::vector<triangle3> given_{};
    std::vector<ids> near_{};        ///< by face: faces of the input that it is near
    std::vector<ids> near_given_{};  ///< and the other way round
    std::vector<double> there_{}, back_{};
    std::vector<ids> star_{};
    std::vector<quadric> quadric_{};
    std::vector<std::uint64_t> version_{};
    std::vector<std::uint8_t> locked_{};
    dynamic_tree<3> tree_{};
    double scale_ = 0.0, slack_ = 0.0, limit_ = 0.0;
    std::priority_queue<candidate, std::vector<candidate>, std::greater<>> next_{};
    std::vector<face> made_{};  ///< what the attempt makes of the faces that it keeps
    ids affected_{};            ///< faces of the input that it has to be near
    std::vector<covering> covers_there_{}, covers_back_{};
    predicate_counters counters_{};
    simplify_result result_{};
};

}  // namespace
}  // namespace detail::simplify

namespace {

bool has_more(const solid_defects& after, const solid_defects& before) {
    return after.degenerate > before.degenerate || after.repeated > before.repeated ||
           after.open_edges > before.open_edges ||
           after.nonmanifold_edges > before.nonmanifold_edges ||
           after.misoriented_edges > before.misoriented_edges ||
           after.nonmanifold_vertices > before.nonmanifold_vertices ||
           after.meeting_pairs > before.meeting_pairs || after.inverted > before.inverted ||
           (after.wrongly_nested && !before.wrongly_nested);
}

}  // namespace

simplify_result simplify(const mesh_ref& mesh, double max_distance,
                         const simplify_options& options) {
    if (!(max_distance >= 0.0 && max_distance <= std::numeric_limits<double>::max()))
        throw std::invalid_argument("simplify: max_distance has to be finite and not negative");
    const mesh_view view = mesh.view();
    detail::base::check_faces("simplify", view.points.size(), view.faces);
    detail::base::check_finite_faces("simplify", view);
    if (!options.face_groups.empty() && options.face_groups.size() != view.faces.size())
        throw std::invalid_argument("simplify: face_groups needs one for each face");
    simplify_result result = detail::simplify::simplifying(view, max_distance, options).run();
    result.certificate.precision = options.precision;
    if (result.certificate.status == status::cancelled) return result;
    const solid_defects before = find_solid_defects(view), after = find_solid_defects(result.mesh);
    if (has_more(after, before)) {
        result.certificate.status = status::not_certified;
        result.certificate.meeting_count = after.meeting_pairs;
    }
    return result;
}

}  // namespace treeform
