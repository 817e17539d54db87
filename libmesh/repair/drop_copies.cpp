#include <libmesh/base/point_math.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/repair/copies.hpp>
#include <libmesh/repair/drop_copies.hpp>
#include <libmesh/repair/edge_parts.hpp>
#include <treeform/mesh/properties.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace treeform::detail::repair {
namespace {

using edge_ends = std::pair<std::uint32_t, std::uint32_t>;

/// Calls `visit(ends, way)` for each edge of a face; `way` is 1 where it runs to the higher point,
/// else -1.
template <class Visit>
void for_edges_and_ways(const face& f, const Visit& visit) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = f[i], to = f[(i + 1) % 3];
        visit(edge_ends(std::minmax(from, to)), from < to ? 1 : -1);
    }
}

/// Whether the least height is below the step of float32 at the largest coordinate. Rounded: it
/// decides what is worth keeping, not what meets.
bool is_sliver(const std::array<point3, 3>& t) {
    using namespace base;
    const std::array<point3, 3> edges{minus(t[1], t[0]), minus(t[2], t[1]), minus(t[0], t[2])};
    const point3 normal = cross(edges[0], edges[1]);
    const double longest =
        std::max({dot(edges[0], edges[0]), dot(edges[1], edges[1]), dot(edges[2], edges[2])});
    const double largest = std::max({largest_of(t[0]), largest_of(t[1]), largest_of(t[2])});
    constexpr double step = 0x1p-23;  // of a number between 1 and 2
    return dot(normal, normal) < step * step * largest * largest * longest;
}

using copy_groups = std::vector<std::vector<std::uint32_t>>;

/// Faces with the same corners, where there are several.
copy_groups groups_of_copies(const std::vector<face>& faces) {
    std::vector<std::pair<face, std::uint32_t>> sorted;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        sorted.emplace_back(faces[f], f);
        std::ranges::sort(sorted.back().first);
    }
    std::ranges::sort(sorted);
    copy_groups groups;
    for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
        while (end < sorted.size() && sorted[end].first == sorted[begin].first) ++end;
        if (end - begin < 2) continue;
        groups.emplace_back();
        for (std::size_t i = begin; i < end; ++i) groups.back().push_back(sorted[i].second);
    }
    return groups;
}

/// The edges of copies, and which copies to delete so that these edges have as many faces one way
/// as the other, or at least an even number.
class tally_of_copies {
  public:
    tally_of_copies(const std::vector<face>& faces, const copy_groups& groups)
        : faces_(faces), groups_(groups) {
        for (const auto& group : groups)
            for_edges_and_ways(faces[group[0]],
                               [&](const edge_ends& e, int) { edges_.try_emplace(e); });
        for (const face& f : faces) add(f, 1);
    }

    void choose(std::vector<std::uint8_t>& deleted) {
        std::vector<std::uint8_t> is_settled(groups_.size(), 0);
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            std::size_t left = groups_[g].size();
            for (auto f = groups_[g].rbegin(); f != groups_[g].rend() && left > 1; ++f) {
                if (!is_surplus(faces_[*f])) continue;  // the lowest stays
                add(faces_[*f], -1);
                deleted[*f] = 1;
                --left;
            }
            is_settled[g] = left == 1 ? 1 : 0;
        }
        for (const auto& region : regions(is_settled)) choose_for(region, deleted);
    }

  private:
    struct tally {
        int balance = 0;  ///< the signed count of faces
        int count = 0;
    };

    void add(const face& f, int times) {
        for_edges_and_ways(f, [&](const edge_ends& e, int way) {
            const auto known = edges_.find(e);
            if (known == edges_.end()) return;
            known->second.balance += times * way;
            known->second.count += times;
        });
    }

    [[nodiscard]] bool is_surplus(const face& f) const {
        bool surplus = true;
        for_edges_and_ways(f, [&](const edge_ends& e, int way) {
            surplus = surplus && edges_.at(e).balance * way > 0;
        });
        return surplus;
    }

    /// Groups that share edges, of those that are not settled.
    [[nodiscard]] std::vector<std::vector<std::size_t>> regions(
        const std::vector<std::uint8_t>& is_settled) const {
        base::union_find linked(groups_.size());
        std::map<edge_ends, std::uint32_t> first;
        for (std::uint32_t g = 0; g < groups_.size(); ++g)
            if (is_settled[g] == 0)
                for_edges_and_ways(faces_[groups_[g][0]], [&](const edge_ends& e, int) {
                    linked.join(first.try_emplace(e, g).first->second, g);
                });
        std::map<std::uint32_t, std::vector<std::size_t>> by_root;
        for (std::uint32_t g = 0; g < groups_.size(); ++g)
            if (is_settled[g] == 0) by_root[linked.root(g)].push_back(g);
        std::vector<std::vector<std::size_t>> all;
        all.reserve(by_root.size());
        for (auto& [root, region] : by_root) all.push_back(std::move(region));
        return all;
    }

    /// One of each group is left where that leaves fewer edges with an odd number of faces.
    void choose_for(const std::vector<std::size_t>& region, std::vector<std::uint8_t>& deleted) {
        const std::size_t before = odd_edges(region);
        for (const int times : {-1, 1}) {
            for (const std::size_t g : region)
                for (std::size_t i = 1; i < groups_[g].size(); ++i)
                    if (deleted[groups_[g][i]] == 0) add(faces_[groups_[g][i]], times);
            if (times == -1 && odd_edges(region) < before) break;
            if (times == 1) return;
        }
        for (const std::size_t g : region)
            for (std::size_t i = 1; i < groups_[g].size(); ++i) deleted[groups_[g][i]] = 1;
    }

    [[nodiscard]] std::size_t odd_edges(const std::vector<std::size_t>& region) const {
        std::size_t odd = 0;
        for (const std::size_t g : region)
            for_edges_and_ways(faces_[groups_[g][0]], [&](const edge_ends& e, int) {
                odd += edges_.at(e).count % 2 != 0 ? 1 : 0;
            });
        return odd;
    }

    const std::vector<face>& faces_;
    const copy_groups& groups_;
    std::map<edge_ends, tally> edges_{};
};

}  // namespace

std::uint64_t drop_degenerate(working_mesh& mesh) {
    const invalid_faces defects = find_invalid_faces(mesh.view());
    const std::vector<std::uint32_t>& list = defects.degenerate_faces;
    if (list.empty()) return 0;
    return mesh.drop([&](std::uint32_t f) { return std::ranges::binary_search(list, f); });
}

std::uint64_t drop_degenerate_and_slivers(working_mesh& mesh) {
    const std::uint64_t dropped = drop_degenerate(mesh);
    if (dropped == 0) return 0;
    std::vector<std::uint8_t> is_thin(mesh.faces.size());
    for (std::size_t f = 0; f < is_thin.size(); ++f)
        is_thin[f] = is_sliver(base::triangle_of(mesh.points, mesh.faces[f])) ? 1 : 0;
    constexpr std::uint64_t as_likely = 4;
    const auto slivers = static_cast<std::uint64_t>(std::ranges::count(is_thin, 1));
    if (slivers > as_likely * dropped) return dropped;
    return dropped + mesh.drop([&](std::uint32_t f) { return is_thin[f] != 0; });
}

std::uint64_t drop_copies(working_mesh& mesh) {
    std::vector<std::uint8_t> deleted =
        copies_to_delete(mesh.faces, parts_by_edges(mesh), directed_edges(mesh.faces));
    std::uint64_t dropped = mesh.drop([&](std::uint32_t f) { return deleted[f] != 0; });
    const copy_groups groups = groups_of_copies(mesh.faces);
    if (groups.empty()) return dropped;

    deleted.assign(mesh.faces.size(), 0);
    tally_of_copies(mesh.faces, groups).choose(deleted);
    return dropped + mesh.drop([&](std::uint32_t f) { return deleted[f] != 0; });
}

}  // namespace treeform::detail::repair
