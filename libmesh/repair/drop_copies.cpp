#include <libmesh/base/union_find.hpp>
#include <libmesh/repair/copies.hpp>
#include <libmesh/repair/drop_copies.hpp>
#include <libmesh/repair/edge_parts.hpp>
#include <treeform/mesh/properties.hpp>

#include <algorithm>
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

/// Faces with the same corners, where there are several.
std::vector<std::vector<std::uint32_t>> groups_of_copies(const std::vector<face>& faces) {
    std::vector<std::pair<face, std::uint32_t>> sorted;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        sorted.emplace_back(faces[f], f);
        std::ranges::sort(sorted.back().first);
    }
    std::ranges::sort(sorted);
    std::vector<std::vector<std::uint32_t>> groups;
    for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
        while (end < sorted.size() && sorted[end].first == sorted[begin].first) ++end;
        if (end - begin < 2) continue;
        groups.emplace_back();
        for (std::size_t i = begin; i < end; ++i) groups.back().push_back(sorted[i].second);
    }
    return groups;
}

}  // namespace

std::uint64_t drop_degenerate(working_mesh& mesh) {
    const mesh_defects defects = find_defects(mesh.view());
    const std::vector<std::uint32_t>& list = defects.degenerate_faces;
    if (list.empty()) return 0;
    return mesh.drop([&](std::uint32_t f) { return std::ranges::binary_search(list, f); });
}

std::uint64_t drop_copies(working_mesh& mesh) {
    std::vector<std::uint8_t> deleted =
        copies_to_delete(mesh.faces, parts_by_edges(mesh), directed_edges(mesh.faces));
    std::uint64_t dropped = mesh.drop([&](std::uint32_t f) { return deleted[f] != 0; });
    const std::vector<std::vector<std::uint32_t>> groups = groups_of_copies(mesh.faces);
    if (groups.empty()) return dropped;

    std::map<edge_ends, int> balance;  // of edges of copies: the signed count of faces
    for (const auto& group : groups)
        for_edges_and_ways(mesh.faces[group[0]], [&](const edge_ends& e, int) { balance[e] = 0; });
    for (const face& f : mesh.faces)
        for_edges_and_ways(f, [&](const edge_ends& e, int way) {
            if (const auto known = balance.find(e); known != balance.end()) known->second += way;
        });
    deleted.assign(mesh.faces.size(), 0);
    const auto is_surplus = [&](std::uint32_t f) {
        bool surplus = true;
        for_edges_and_ways(mesh.faces[f], [&](const edge_ends& e, int way) {
            surplus = surplus && balance[e] * way > 0;
        });
        return surplus;
    };
    for (const auto& group : groups) {
        std::size_t left = group.size();
        for (auto f = group.rbegin(); f != group.rend() && left > 1; ++f) {  // the lowest stays
            if (!is_surplus(*f)) continue;
            for_edges_and_ways(mesh.faces[*f],
                               [&](const edge_ends& e, int way) { balance[e] -= way; });
            deleted[*f] = 1;
            --left;
        }
    }
    return dropped + mesh.drop([&](std::uint32_t f) { return deleted[f] != 0; });
}

}  // namespace treeform::detail::repair
