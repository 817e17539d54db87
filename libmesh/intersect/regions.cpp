#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/union_find.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

namespace treeform {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

void check(mesh_view mesh, std::span<const face_pair> pairs) {
    detail::base::check_faces("group_pairs", mesh.points.size(), mesh.faces);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (std::max(pairs[i].a, pairs[i].b) >= mesh.faces.size())
            throw std::invalid_argument("treeform::group_pairs: pair " + std::to_string(i) +
                                        " has a face that is not in the mesh");
}

/// Numbers of the faces in `pairs`, ascending.
std::vector<std::uint32_t> faces_of(std::span<const face_pair> pairs, std::size_t face_count) {
    std::vector<bool> used(face_count, false);
    for (const face_pair& pair : pairs) used[pair.a] = used[pair.b] = true;
    std::vector<std::uint32_t> faces;
    for (std::uint32_t i = 0; i < face_count; ++i)
        if (used[i]) faces.push_back(i);
    return faces;
}

void include(intersection_region& region, const point3& p) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        region.min[axis] = std::min(region.min[axis], p[axis]);
        region.max[axis] = std::max(region.max[axis], p[axis]);
    }
}

}  // namespace

std::vector<intersection_region> group_pairs(mesh_view mesh, std::span<const face_pair> pairs) {
    check(mesh, pairs);
    if (pairs.empty()) return {};
    const std::vector<std::uint32_t> faces = faces_of(pairs, mesh.faces.size());
    detail::base::union_find linked(mesh.faces.size());
    for (const face_pair& pair : pairs) linked.join(pair.a, pair.b);
    std::vector<std::uint32_t> face_at(mesh.points.size(), nobody);
    for (const std::uint32_t f : faces)
        for (const std::uint32_t corner : mesh.faces[f]) {
            if (face_at[corner] == nobody) face_at[corner] = f;
            linked.join(face_at[corner], f);
        }

    std::vector<intersection_region> regions;
    std::vector<std::uint32_t> region_of_root(mesh.faces.size());
    for (const std::uint32_t f : faces) {
        const std::uint32_t root = linked.root(f);
        if (root == f) {  // the lowest of its region
            region_of_root[f] = static_cast<std::uint32_t>(regions.size());
            const point3& corner = mesh.points[mesh.faces[f][0]];
            regions.push_back({{}, corner, corner, {}});
        }
        intersection_region& region = regions[region_of_root[root]];
        region.faces.push_back(f);
        for (const std::uint32_t corner : mesh.faces[f]) include(region, mesh.points[corner]);
    }
    for (std::uint32_t i = 0; i < pairs.size(); ++i)
        regions[region_of_root[linked.root(pairs[i].a)]].pairs.push_back(i);
    return regions;
}

}  // namespace treeform
