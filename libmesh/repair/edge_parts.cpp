#include <libmesh/base/union_find.hpp>
#include <libmesh/repair/edge_parts.hpp>
#include <libmesh/weld/edge_uses.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <cstddef>
#include <map>

namespace treeform::detail::repair {
namespace {

weld::edge_uses edges_of(const working_mesh& mesh) {
    return {mesh.points.size(), mesh.faces, weld::repeated_corners::left_out};
}

/// How many of the faces at an edge run from its lower point to the higher one.
std::size_t count_along(const working_mesh& mesh, const weld::used_edge& edge) {
    std::size_t along = 0;
    for (std::size_t i = 0; i < edge.uses.size(); ++i)
        along += runs_along(mesh.faces[edge.face(i)], edge.low, edge.high) ? 1 : 0;
    return along;
}

template <class Links>
std::vector<std::uint32_t> linked_faces(const working_mesh& mesh, const Links& links) {
    base::union_find linked(mesh.faces.size());
    edges_of(mesh).for_each([&](const weld::used_edge& edge, std::size_t) {
        if (!links(edge.uses.size())) return;
        for (std::size_t i = 1; i < edge.uses.size(); ++i) linked.join(edge.face(0), edge.face(i));
    });
    const buffer<std::uint32_t> roots = linked.take_roots();
    return {roots.data(), roots.data() + roots.size()};
}

}  // namespace

edge_tally tally_edges(const working_mesh& mesh) {
    const weld::edge_uses edges = edges_of(mesh);
    std::vector<edge_tally> found(edges.chunks());
    edges.for_each([&](const weld::used_edge& edge, std::size_t chunk) {
        const std::size_t count = edge.uses.size();
        const std::size_t along = count_along(mesh, edge);
        edge_tally& tally = found[chunk];
        tally.border += count == 1;
        tally.misoriented += count == 2 && along != 1;
        tally.nonmanifold += count > 2;
        tally.unbalanced += 2 * along != count;
    });
    edge_tally all;
    for (const edge_tally& part : found) {
        all.border += part.border;
        all.misoriented += part.misoriented;
        all.nonmanifold += part.nonmanifold;
        all.unbalanced += part.unbalanced;
    }
    return all;
}

std::vector<std::uint32_t> faces_at_unbalanced_edges(const working_mesh& mesh) {
    const weld::edge_uses edges = edges_of(mesh);
    std::vector<std::vector<std::uint32_t>> found(edges.chunks());
    edges.for_each([&](const weld::used_edge& edge, std::size_t chunk) {
        if (2 * count_along(mesh, edge) == edge.uses.size()) return;
        for (std::size_t i = 0; i < edge.uses.size(); ++i) found[chunk].push_back(edge.face(i));
    });
    std::vector<std::uint32_t> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    return all;
}

std::vector<std::uint32_t> parts_by_edges(const working_mesh& mesh) {
    return linked_faces(mesh, [](std::size_t) { return true; });
}

std::vector<std::uint32_t> shells(const working_mesh& mesh) {
    const std::vector<std::uint32_t> patch_of = patches(mesh);
    base::union_find linked(mesh.faces.size());
    for (std::uint32_t f = 0; f < patch_of.size(); ++f) linked.join(f, patch_of[f]);
    edges_of(mesh).for_each([&](const weld::used_edge& edge, std::size_t) {
        if (edge.uses.size() <= 2) return;
        std::map<std::uint32_t, int> ways;
        for (std::size_t i = 0; i < edge.uses.size(); ++i) {
            const std::uint32_t f = edge.face(i);
            ways[patch_of[f]] += runs_along(mesh.faces[f], edge.low, edge.high) ? 1 : -1;
        }
        std::erase_if(ways, [](const auto& patch) { return patch.second == 0; });
        for (const auto& [patch, way] : ways) linked.join(ways.begin()->first, patch);
    });
    const buffer<std::uint32_t> roots = linked.take_roots();
    return {roots.data(), roots.data() + roots.size()};
}

std::vector<std::uint32_t> patches(const working_mesh& mesh) {
    return linked_faces(mesh, [](std::size_t count) { return count == 2; });
}

}  // namespace treeform::detail::repair
