#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/part_of_progress.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/repair/copies.hpp>
#include <libmesh/repair/fill_hole.hpp>
#include <libmesh/repair/greedy_vertex_cover.hpp>
#include <libmesh/repair/remove_faces.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

namespace treeform::detail::repair {
namespace {

constexpr std::size_t listed_pairs = 100;

/// A hole becomes wider by a ring of faces, by two when it has failed four times, and so on. In a
/// part that has a border, where a hole may stay, it is given up at the third time.
constexpr int tries_of_ring = 4;
constexpr int tries_with_border = 3;

enum class removal_outcome : std::uint8_t {
    stays,
    refilled,  ///< deleted, and the hole is filled
    gone       ///< deleted, and the hole stays
};

/// Points that no face has may be anything, and are left out in the end: here they are 0.
std::vector<point3> points_in_use(mesh_view mesh) {
    std::vector<point3> points(mesh.points.size());
    for (const std::uint32_t p : base::used_points(mesh.points.size(), mesh.faces))
        points[p] = mesh.points[p];
    return points;
}

/// Parts are faces linked by edges, patches linked faces that are to be refilled. Patches only
/// grow, and each time are refilled as a whole from what was given, so that nothing is made of what
/// has failed.
class remover {
  public:
    remover(mesh_view given, const resolve_options& options)
        : options_(options),
          given_{points_in_use(given), {given.faces.begin(), given.faces.end()}},
          outcomes_(given_.faces.size(), removal_outcome::stays),
          few_(given_.faces.size(), 0),
          tries_(given_.faces.size(), 0) {
        if (options.precision == precision::float32) to_floats();
    }

    repair_result run() {
        keep_all();
        // Beyond the range of float, or with nothing to be done.
        if (!std::isfinite(result_.certificate.max_displacement) || !look()) return finished();
        edges_ = directed_edges(given_.faces);
        find_parts();
        const int rounds = std::max(options_.removal_rounds, 0);
        for (int round = 0;; ++round) {
            build();
            if (!look() || round == rounds) return finished();
            choose();
            settle(round + 3 > rounds);
        }
    }

  private:
    [[nodiscard]] mesh_view now() const { return {given_.points, now_}; }

    void to_floats() {
        for (point3& p : given_.points) {
            const point3 rounded{base::nearest_float(p.x), base::nearest_float(p.y),
                                 base::nearest_float(p.z)};
            for (std::size_t k = 0; k < 3; ++k)
                result_.certificate.max_displacement =
                    std::max(result_.certificate.max_displacement, std::abs(rounded[k] - p[k]));
            p = rounded;
        }
    }

    /// Calls `with(u, v)` for each edge, as it runs.
    template <class With>
    static void for_edges(const face& f, const With& with) {
        for (std::size_t i = 0; i < 3; ++i) with(f[i], f[(i + 1) % 3]);
    }

    /// Of each edge of a face, the lowest one that runs along it, and the lowest against it.
    template <class With>
    void for_neighbors(std::uint32_t f, const With& with) const {
        for_edges(given_.faces[f], [&](std::uint32_t u, std::uint32_t v) {
            with(edges_.face_along(u, v));
            if (const std::uint32_t g = edges_.face_along(v, u); g != directed_edges::none) with(g);
        });
    }

    void find_parts() {
        const auto count = static_cast<std::uint32_t>(given_.faces.size());
        base::union_find parts(count);
        for (std::uint32_t f = 0; f < count; ++f)
            for_neighbors(f, [&](std::uint32_t g) { parts.join(f, g); });
        part_of_.resize(count);
        for (std::uint32_t f = 0; f < count; ++f) part_of_[f] = parts.root(f);
        const std::vector<std::uint8_t> deleted = copies_to_delete(given_.faces, part_of_, edges_);
        for (std::uint32_t f = 0; f < count; ++f)
            if (deleted[f] != 0) outcomes_[f] = removal_outcome::gone;
        build();
        std::vector<std::uint8_t> ends(count, 0);
        const directed_edges edges(now_);
        for (std::size_t i = 0; i < now_.size(); ++i)
            for_edges(now_[i], [&](std::uint32_t u, std::uint32_t v) {
                if (!edges.has(v, u)) ends[part_of_[result_.face_source[i]]] = 1;
            });
        is_closed_.resize(count);
        for (std::uint32_t f = 0; f < count; ++f) is_closed_[f] = ends[part_of_[f]] == 0;
    }

    void keep_all() {
        now_ = given_.faces;
        kept_ = now_.size();
        result_.face_source.resize(kept_);
        std::iota(result_.face_source.begin(), result_.face_source.end(), 0U);
    }

    /// The faces that stay, and those that fill the holes of patches.
    void build() {
        now_.clear();
        result_.face_source.clear();
        for (std::uint32_t f = 0; f < outcomes_.size(); ++f) {
            if (outcomes_[f] != removal_outcome::stays) continue;
            now_.push_back(given_.faces[f]);
            result_.face_source.push_back(f);
        }
        kept_ = now_.size();
        const directed_edges kept(now_);
        find_patches();
        is_hopeless_.assign(patches_.size(), 0);
        patch_of_fill_.clear();
        for (std::uint32_t p = 0; p < patches_.size(); ++p) {
            std::vector<face> turned;  // the hole that they leave is filled as they were
            for (const std::uint32_t f : patches_[p]) {
                const auto [a, b, c] = given_.faces[f];
                turned.push_back({a, c, b});
            }
            const auto rims = find_rims(turned, directed_edges(turned));
            is_hopeless_[p] = is_hopeless(p, rims, kept) ? 1 : 0;
            if (is_hopeless_[p] != 0) continue;
            for (const auto& rim : rims)
                for (const face& f : fill(given_.points, rim, kept)) {
                    now_.push_back(f);
                    result_.face_source.push_back(repair_result::none);
                    patch_of_fill_.push_back(p);
                }
        }
    }

    /// Where a patch reaches along a border, and what would fill it there would float in space or
    /// lie on what fills the rest; and where a whole part would go and leave nothing.
    [[nodiscard]] bool is_hopeless(std::uint32_t patch,
                                   const std::vector<std::vector<std::uint32_t>>& rims,
                                   const directed_edges& kept) const {
        if (is_closed_[patches_[patch].front()] != 0 || rims.size() == 1) return false;
        const auto has_neighbor = [&](std::span<const std::uint32_t> points) {
            for (std::size_t i = 0; i < points.size(); ++i) {
                const std::uint32_t u = points[i], v = points[(i + 1) % points.size()];
                if (kept.has(u, v) || kept.has(v, u)) return true;
            }
            return false;
        };
        if (!rims.empty()) return !std::ranges::all_of(rims, has_neighbor);
        return std::ranges::none_of(patches_[patch],
                                    [&](std::uint32_t f) { return has_neighbor(given_.faces[f]); });
    }

    /// In the order of their lowest faces.
    void find_patches() {
        constexpr std::uint32_t none = directed_edges::none;
        const auto count = static_cast<std::uint32_t>(outcomes_.size());
        base::union_find linked(count);
        for (std::uint32_t f = 0; f < count; ++f) {
            if (outcomes_[f] != removal_outcome::refilled) continue;
            for_neighbors(f, [&](std::uint32_t g) {
                if (outcomes_[g] == removal_outcome::refilled) linked.join(f, g);
            });
        }
        patches_.clear();
        std::vector<std::uint32_t> number(count, none);
        for (std::uint32_t f = 0; f < count; ++f) {
            if (outcomes_[f] != removal_outcome::refilled) continue;
            std::uint32_t& patch = number[linked.root(f)];
            if (patch == none) {
                patch = static_cast<std::uint32_t>(patches_.size());
                patches_.emplace_back();
            }
            patches_[patch].push_back(f);
        }
    }

    /// Finds what meets, is degenerate, or is not closed; whether there is any.
    bool look() {
        result_.certificate.meeting.clear();
        result_.certificate.meeting_count = 0;
        pairs_.clear();
        rings_.assign(patches_.size(), 0);
        places_.clear();
        const double done = std::exchange(done_, (done_ + 1.0) / 2.0);  // rounds are not known
        const auto found =
            self_intersections(now(), {.vertices = vertex_identity::by_index,
                                       .progress = base::part_of(options_.progress, done, done_)});
        if (found.status == treeform::status::cancelled)
            result_.certificate.status = status::cancelled;
        if (found.status == treeform::status::cancelled) return false;
        for (const std::uint32_t f : find_invalid_faces(now()).degenerate_faces) complain(f, f);
        for (const face_pair& pair : found.pairs)
            if (!is_let_be(pair)) complain(pair.a, pair.b);
        find_holes();
        return result_.certificate.meeting_count > 0 || has_hole_;
    }
    /// Of faces given: contact, and what meets a degenerate one, which is reported by itself.
    [[nodiscard]] bool is_let_be(const face_pair& pair) const {
        if (pair.a >= kept_ || pair.b >= kept_) return false;
        return pair.kind == pair_kind::degenerate ||
               (pair.kind == pair_kind::touching && !options_.touching);
    }
    void complain(std::uint32_t f, std::uint32_t g) {
        if (f < kept_ && g < kept_)
            pairs_.push_back({result_.face_source[f], result_.face_source[g]});
        for (const auto& [x, other] : {std::array{f, g}, std::array{g, f}}) {
            if (x < kept_) continue;
            const std::uint32_t patch = patch_of_fill_[x - kept_];
            fail(patch, now_[x]);
            if (other < kept_) blame(patch, result_.face_source[other]);
        }
        ++result_.certificate.meeting_count;
        if (result_.certificate.meeting.size() < listed_pairs)
            result_.certificate.meeting.push_back({f, g});
    }
    /// The hole is to become wider at these points.
    void fail(std::uint32_t patch, std::span<const std::uint32_t> points) {
        rings_[patch] = 1;
        for (const std::uint32_t p : points) places_.push_back({patch, p});
    }
    /// A face that stays meets what fills a hole: it is as much to blame in the same part or if
    /// both are closed, and goes at once if only it has a border.
    void blame(std::uint32_t patch, std::uint32_t f) {
        const std::uint32_t beside = patches_[patch].front();
        const bool both_closed = is_closed_[beside] != 0 && is_closed_[f] != 0;
        if (part_of_[f] == part_of_[beside] || both_closed) {
            fail(patch, given_.faces[f]);
        } else if (is_closed_[beside] != 0) {
            few_[f] = 1;
            outcomes_[f] = removal_outcome::refilled;
        }
    }
    /// Edges next to patches that have lost their second face.
    void find_holes() {
        has_hole_ = std::ranges::count(is_hopeless_, 1) > 0;
        if (patches_.empty()) return;
        const directed_edges edges(now_);
        for (std::uint32_t p = 0; p < patches_.size(); ++p)
            for (const std::uint32_t f : patches_[p])
                for_edges(given_.faces[f], [&](std::uint32_t u, std::uint32_t v) {
                    if (edges.has(u, v) || !edges.has(v, u)) return;
                    fail(p, std::array{u, v});
                    has_hole_ = true;
                });
    }

    /// Faces that meet are refilled, but those of closed parts that parts with a border pass
    /// through.
    void choose() {
        const std::vector<std::uint8_t> few = greedy_vertex_cover(pairs_, is_closed_);
        for (std::size_t f = 0; f < few.size(); ++f) {
            if (few[f] == 0) continue;
            few_[f] = 1;
            outcomes_[f] = removal_outcome::refilled;
        }
        for (const auto& [f, g] : pairs_)
            if (is_closed_[f] == is_closed_[g])
                outcomes_[f] = outcomes_[g] = removal_outcome::refilled;
    }

    /// Makes holes wider whose filling has failed. Where that does not help, or it is late, and the
    /// part has a border, few of the faces go and nothing fills the hole, as where it goes around
    /// the border.
    void settle(bool is_late) {
        for (std::uint32_t p = 0; p < patches_.size(); ++p) {
            if (rings_[p] == 0 && is_hopeless_[p] == 0) continue;
            int tries = is_hopeless_[p] != 0 ? tries_with_border : 0;
            for (const std::uint32_t f : patches_[p]) tries = std::max<int>(tries, tries_[f] + 1);
            for (const std::uint32_t f : patches_[p])
                tries_[f] = static_cast<std::uint8_t>(std::min(tries, 255));
            rings_[p] = static_cast<std::uint8_t>(1 + tries / tries_of_ring);
            const bool is_open = is_closed_[patches_[p].front()] == 0;
            if (!is_open || (tries < tries_with_border && !is_late)) continue;
            rings_[p] = 0;
            for (const std::uint32_t f : patches_[p])
                outcomes_[f] = few_[f] != 0 ? removal_outcome::gone : removal_outcome::stays;
        }
        widen();
    }
    /// Refills the faces around the places where filling has failed.
    void widen() {
        std::vector<std::uint8_t> rings(given_.points.size(), 0);  // still to go, by point
        for (const auto& [patch, point] : places_)
            rings[point] = std::max(rings[point], rings_[patch]);
        for (std::uint8_t most = *std::ranges::max_element(rings); most > 0; --most)
            for (std::uint32_t f = 0; f < outcomes_.size(); ++f) {
                const auto [a, b, c] = given_.faces[f];
                if (rings[a] != most && rings[b] != most && rings[c] != most) continue;
                if (outcomes_[f] == removal_outcome::stays)
                    outcomes_[f] = removal_outcome::refilled;
                for (const std::uint32_t p : given_.faces[f])
                    rings[p] = std::max(rings[p], static_cast<std::uint8_t>(most - 1));
            }
    }

    void count_left_open() {
        if (kept_ == given_.faces.size()) return;
        const directed_edges edges(now_);
        for (const face& f : now_)
            for_edges(f, [&](std::uint32_t u, std::uint32_t v) {
                result_.statistics.left_open += !edges.has(v, u) && edges_.has(v, u);
            });
    }

    /// Without the points that no face uses.
    repair_result finished() {
        certificate& known = result_.certificate;
        if (!std::isfinite(known.max_displacement))
            known.status = status::out_of_range;
        else if (known.status == status::ok && (known.meeting_count > 0 || has_hole_))
            known.status = status::not_certified;
        count_left_open();
        std::vector<std::uint32_t> number(given_.points.size(), repair_result::none);
        for (const face& f : now_)
            for (const std::uint32_t c : f) number[c] = 0;
        for (std::uint32_t p = 0; p < number.size(); ++p) {
            if (number[p] == repair_result::none) continue;
            number[p] = static_cast<std::uint32_t>(result_.vertex_source.size());
            result_.vertex_source.push_back(p);
            result_.mesh.points.push_back(given_.points[p]);
        }
        for (face& f : now_)
            for (std::uint32_t& c : f) c = number[c];
        result_.mesh.faces = std::move(now_);
        return std::move(result_);
    }

    const resolve_options& options_;
    mesh given_;
    directed_edges edges_{{}};               ///< of the faces given
    std::vector<std::uint32_t> part_of_;     ///< by face: the lowest face of its part
    std::vector<std::uint8_t> is_closed_;    ///< by face: whether its part has no border
    std::vector<removal_outcome> outcomes_;  ///< by face
    std::vector<std::uint8_t> few_;          ///< by face: without it and its like no pair is left
    std::vector<std::uint8_t> tries_;        ///< by face: to fill the hole
    std::vector<std::vector<std::uint32_t>> patches_{};

    std::vector<face> now_;                     ///< faces that stay, then those that fill
    std::size_t kept_ = 0;                      ///< of them, those that stay
    std::vector<std::uint32_t> patch_of_fill_;  ///< by face that fills
    std::vector<std::uint8_t> is_hopeless_;     ///< by patch: nothing sensible can fill it
    std::vector<std::uint8_t> rings_;           ///< by patch: to be added where it has failed
    std::vector<std::array<std::uint32_t, 2>> places_;  ///< patch and point: where it has failed
    std::vector<std::array<std::uint32_t, 2>> pairs_;   ///< of faces given, that stay and meet
    bool has_hole_ = false;
    double done_ = 0.0;
    repair_result result_{};
};

}  // namespace

repair_result remove_faces(mesh_view mesh, const resolve_options& options) {
    return remover(mesh, options).run();
}

}  // namespace treeform::detail::repair
