#include <libmesh/base/point_math.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/repair/border_edges.hpp>
#include <libmesh/repair/close_cracks.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace treeform::detail::repair {
namespace {

constexpr int most_passes = 8;
constexpr double widest_share = 0.25;  // of the edges beside a crack

double distance(const point3& a, const point3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// Of one pass: what is closed moves borders, so that the next one may close more.
class crack_closer {
  public:
    crack_closer(working_mesh& mesh, double gap, closed_cracks& done)
        : mesh_(mesh),
          gap_(gap),
          done_(done),
          borders_(border_edges(mesh.points.size(), mesh.faces)) {
        std::vector<aabb<double, 3>> boxes;
        for (const border_edge& e : borders_) boxes.push_back(box_of(e, 0.0));
        tree_ = build(boxes, [](const aabb<double, 3>& box) { return box; });
    }

    [[nodiscard]] std::size_t open_edges() const { return borders_.size(); }

    /// Whether a pair was closed.
    bool zip() {
        const std::vector<zipper> zippers = find_zippers();
        if (zippers.empty()) return false;
        find_faces_at_borders();
        base::union_find merged(mesh_.points.size());
        std::uint64_t closed = 0;
        for (const zipper& z : zippers) closed += try_to_zip(z, merged);
        if (closed == 0) return false;
        for (face& f : mesh_.faces)
            for (std::uint32_t& corner : f) corner = merged.root(corner);
        done_.closed_edges += closed;
        return true;
    }

    /// Whether an edge was split.
    bool split() {
        std::set<std::pair<std::uint32_t, std::uint32_t>> ends;
        for (const border_edge& e : borders_) ends.insert(std::minmax(e.from, e.to));
        std::set<std::uint32_t> touched;  // faces whose edges are no longer what they were
        std::uint64_t splits = 0;
        for (const border_edge& e : borders_) {
            if (touched.contains(e.face)) continue;
            const std::vector<std::uint32_t> chain = chain_of(e, ends);
            if (chain.size() == 2) continue;
            const face f = mesh_.faces[e.face];
            const std::uint32_t apex = third_corner(f, e.from, e.to);
            const std::uint32_t source = mesh_.source[e.face];
            mesh_.faces[e.face] = {chain[0], chain[1], apex};
            for (std::size_t i = 1; i + 1 < chain.size(); ++i)
                mesh_.append({chain[i], chain[i + 1], apex}, source);
            touched.insert(e.face);
            ++splits;
        }
        done_.split_edges += splits;
        return splits > 0;
    }

  private:
    struct zipper {
        double width;
        std::uint32_t a, b;  ///< of `borders_`
        friend auto operator<=>(const zipper&, const zipper&) = default;
    };

    [[nodiscard]] const point3& at(std::uint32_t p) const { return mesh_.points[p]; }

    [[nodiscard]] aabb<double, 3> box_of(const border_edge& e, double margin) const {
        aabb<double, 3> box{};
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] = std::min(at(e.from)[k], at(e.to)[k]) - margin;
            box.max[k] = std::max(at(e.from)[k], at(e.to)[k]) + margin;
        }
        return box;
    }

    /// How far the ends of two edges are apart, and whether the edges run opposite ways, as those
    /// of faces that agree; none where they are no crack.
    [[nodiscard]] std::optional<std::pair<double, bool>> width(const border_edge& a,
                                                               const border_edge& b) const {
        if (a.face == b.face) return {};
        const double across =
            std::max(distance(at(a.from), at(b.to)), distance(at(a.to), at(b.from)));
        const double beside =
            std::max(distance(at(a.from), at(b.from)), distance(at(a.to), at(b.to)));
        const double wide = std::min(across, beside);
        const double shorter =
            std::min(distance(at(a.from), at(a.to)), distance(at(b.from), at(b.to)));
        if (!(wide <= gap_) || !(wide < widest_share * shorter)) return {};
        return std::pair(wide, across <= beside);
    }

    [[nodiscard]] std::vector<zipper> find_zippers() const {
        constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::pair<double, std::uint32_t>> nearest(borders_.size(), {0.0, none});
        for_chunks(borders_.size(), 256, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i)
                search(tree_, box_of(borders_[i], gap_), [&](std::uint32_t j) {
                    const auto wide = i == j ? std::nullopt : width(borders_[i], borders_[j]);
                    if (!wide) return;
                    const std::pair candidate(wide->first, j);
                    if (nearest[i].second == none || candidate < nearest[i]) nearest[i] = candidate;
                });
        });
        std::vector<zipper> found;
        for (std::uint32_t i = 0; i < nearest.size(); ++i) {
            const auto [wide, j] = nearest[i];
            if (j != none && i < j && nearest[j].second == i) found.push_back({wide, i, j});
        }
        std::ranges::sort(found);
        return found;
    }

    /// Faces may only get corners in one point where they have a point of a border.
    void find_faces_at_borders() {
        for (const border_edge& e : borders_) faces_at_[e.from] = faces_at_[e.to] = {};
        for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f)
            for (const std::uint32_t corner : mesh_.faces[f])
                if (const auto found = faces_at_.find(corner); found != faces_at_.end())
                    found->second.push_back(f);
    }

    /// Merges two points unless a face has both.
    bool try_to_merge(std::uint32_t p, std::uint32_t q, base::union_find& merged) {
        const std::uint32_t a = merged.root(p), b = merged.root(q);
        const auto [low, high] = std::minmax(a, b);
        if (low == high) return true;
        for (const std::uint32_t f : faces_at_[high])
            for (const std::uint32_t corner : mesh_.faces[f])
                if (merged.root(corner) == low) return false;
        merged.join(low, high);
        std::vector<std::uint32_t>& more = faces_at_[high];
        faces_at_[low].insert(faces_at_[low].end(), more.begin(), more.end());
        more.clear();
        return true;
    }

    bool try_to_zip(const zipper& z, base::union_find& merged) {
        const border_edge& a = borders_[z.a];
        border_edge b = borders_[z.b];
        if (!width(a, b)->second) std::swap(b.from, b.to);
        if (!try_to_merge(a.from, b.to, merged) || !try_to_merge(a.to, b.from, merged))
            return false;
        done_.widest = std::max(done_.widest, z.width);
        return true;
    }

    /// Where on the edge the point is nearest, as a share of it, if that is inside the edge and
    /// near enough for the edge's face.
    [[nodiscard]] std::optional<double> share_on(const border_edge& e, std::uint32_t p) const {
        const point3 along = base::minus(at(e.to), at(e.from));
        const double square = base::dot(along, along);
        const auto foot = [&](const point3& q) {
            return base::dot(base::minus(q, at(e.from)), along) / square;
        };
        const auto off = [&](const point3& q) {
            return distance(q, base::plus(at(e.from), base::scaled(along, foot(q))));
        };
        const double share = foot(at(p)), away = off(at(p));
        const double length = std::sqrt(square);
        const double nearer_end = std::min(share, 1.0 - share) * length;
        const double height = off(at(third_corner(mesh_.faces[e.face], e.from, e.to)));
        if (!(away <= gap_) || !(away < widest_share * std::min(nearer_end, height))) return {};
        return share;
    }

    /// The points from one end of the edge to the other at which to split it: those that a border
    /// edge links to the one before or after.
    [[nodiscard]] std::vector<std::uint32_t> chain_of(
        const border_edge& e, const std::set<std::pair<std::uint32_t, std::uint32_t>>& ends) const {
        std::vector<std::pair<double, std::uint32_t>> inside;
        const std::uint32_t apex = third_corner(mesh_.faces[e.face], e.from, e.to);
        search(tree_, box_of(e, gap_), [&](std::uint32_t j) {
            for (const std::uint32_t p : {borders_[j].from, borders_[j].to}) {
                if (p == e.from || p == e.to || p == apex) continue;
                if (const auto share = share_on(e, p)) inside.emplace_back(*share, p);
            }
        });
        std::ranges::sort(inside);
        std::vector<std::uint32_t> all{e.from};
        for (const auto& [share, p] : inside)
            if (all.back() != p) all.push_back(p);
        all.push_back(e.to);
        std::vector<std::uint32_t> chain{e.from};
        for (std::size_t i = 1; i + 1 < all.size(); ++i)
            if (ends.contains(std::minmax(all[i], all[i - 1])) ||
                ends.contains(std::minmax(all[i], all[i + 1])))
                chain.push_back(all[i]);
        chain.push_back(e.to);
        return chain;
    }

    working_mesh& mesh_;
    double gap_;
    closed_cracks& done_;
    std::vector<border_edge> borders_;
    tree<3> tree_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> faces_at_{};
};

}  // namespace

closed_cracks close_cracks(working_mesh& mesh, double gap) {
    closed_cracks done;
    for (int pass = 0; pass < most_passes; ++pass) {
        crack_closer closer(mesh, gap, done);
        if (closer.open_edges() == 0) break;
        if (!closer.zip() && !closer.split()) break;
    }
    done.open_edges = border_edges(mesh.points.size(), mesh.faces).size();
    return done;
}

}  // namespace treeform::detail::repair
