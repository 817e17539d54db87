#include <libmesh/repair/fill_hole.hpp>
#include <libmesh/repair/open_rims.hpp>
#include <libmesh/weld/edge_uses.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <span>

namespace treeform::detail::repair {
namespace {

/// An open edge, as what fills the hole runs along it.
struct rim_edge {
    std::uint32_t from, to;
    std::uint32_t face;  ///< that runs against it
    bool used = false;
};

std::uint32_t from_of(const rim_edge& e) { return e.from; }
std::uint32_t from_of(std::uint32_t from) { return from; }

std::vector<rim_edge> rim_edges_of(const working_mesh& mesh, rim_edges along) {
    const weld::edge_uses edges(mesh.points.size(), mesh.faces, weld::repeated_corners::left_out);
    std::vector<std::vector<rim_edge>> found(edges.chunks());
    edges.for_each([&](const weld::used_edge& edge, std::size_t chunk) {
        if (along == rim_edges::free && edge.uses.size() > 1) return;
        std::vector<std::uint32_t> up, down;  // faces that run from low to high, and against that
        for (std::size_t i = 0; i < edge.uses.size(); ++i) {
            const std::uint32_t f = edge.face(i);
            (runs_along(mesh.faces[f], edge.low, edge.high) ? up : down).push_back(f);
        }
        for (std::size_t i = down.size(); i < up.size(); ++i)
            found[chunk].push_back({edge.high, edge.low, up[i]});
        for (std::size_t i = up.size(); i < down.size(); ++i)
            found[chunk].push_back({edge.low, edge.high, down[i]});
    });
    std::vector<rim_edge> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    std::ranges::sort(all, {}, [](const rim_edge& e) { return std::array{e.from, e.to, e.face}; });
    return all;
}

class rim_walker {
  public:
    rim_walker(const working_mesh& mesh, rim_edges along)
        : mesh_(mesh), edges_(mesh.faces), rim_edges_(rim_edges_of(mesh, along)) {}

    std::vector<open_rim> run() {
        for (std::size_t e = 0; e < rim_edges_.size(); ++e)
            if (!rim_edges_[e].used) walk(e);
        return std::move(rims_);
    }

  private:
    /// Back at a point of the way, what lies between is a rim of its own.
    void walk(std::size_t first) {
        std::vector<rim_edge> way;
        std::map<std::uint32_t, std::size_t> begins;  // where on the way the edge from a point is
        for (std::optional<std::size_t> e = first; e; e = next(rim_edges_[*e])) {
            rim_edges_[*e].used = true;
            begins.emplace(rim_edges_[*e].from, way.size());
            way.push_back(rim_edges_[*e]);
            const auto seen = begins.find(rim_edges_[*e].to);
            if (seen == begins.end()) continue;
            const std::size_t begin = seen->second;
            open_rim& rim = rims_.emplace_back();
            for (std::size_t i = begin; i < way.size(); ++i) {
                rim.points.push_back(way[i].from);
                rim.faces.push_back(way[i].face);
                begins.erase(way[i].from);
            }
            way.resize(begin);
            if (way.empty()) return;
        }
    }

    /// The first open edge around the end of one, else the lowest that starts there.
    [[nodiscard]] std::optional<std::size_t> next(const rim_edge& e) const {
        const auto [begin, end] =
            std::equal_range(rim_edges_.begin(), rim_edges_.end(), e.to,
                             [](const auto& a, const auto& b) { return from_of(a) < from_of(b); });
        std::optional<std::size_t> lowest;
        std::size_t count = 0;
        for (auto at = begin; at != end; ++at) {
            if (at->used) continue;
            if (count++ == 0) lowest = static_cast<std::size_t>(at - rim_edges_.begin());
        }
        if (count < 2) return lowest;
        std::uint32_t f = e.face;
        std::uint32_t toward = e.from;
        for (std::size_t steps = 0; steps <= mesh_.faces.size(); ++steps) {
            toward = third_corner(mesh_.faces[f], e.to, toward);
            for (auto at = begin; at != end; ++at)
                if (!at->used && at->to == toward)
                    return static_cast<std::size_t>(at - rim_edges_.begin());
            f = edges_.face_along(e.to, toward);
            if (f == directed_edges::none) break;
        }
        return lowest;
    }

    const working_mesh& mesh_;
    directed_edges edges_;
    std::vector<rim_edge> rim_edges_;
    std::vector<open_rim> rims_{};
};

}  // namespace

std::vector<open_rim> open_rims(const working_mesh& mesh, rim_edges along) {
    return rim_walker(mesh, along).run();
}

}  // namespace treeform::detail::repair
