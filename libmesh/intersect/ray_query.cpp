#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <libmesh/geometry/features.hpp>
#include <libmesh/intersect/ray_query.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/ray.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace treeform::detail::intersect {
namespace {

constexpr std::size_t ray_grain = 256;  // rays a chunk

void check(const ray3& ray, std::size_t number) {
    bool finite = true;
    bool directed = false;
    for (std::size_t k = 0; k < 3; ++k) {
        finite &= std::isfinite(ray.origin[k]) && std::isfinite(ray.direction[k]);
        directed |= ray.direction[k] != 0.0;
    }
    const char* why = !finite     ? " is not finite"
                      : !directed ? " has no direction"
                      : std::isnan(ray.t_min) || std::isnan(ray.t_max)
                          ? " has a parameter that is not a number"
                          : nullptr;
    if (why) throw std::invalid_argument("treeform::raycast: ray " + std::to_string(number) + why);
}

void check(std::span<const ray3> rays) {
    for (std::size_t i = 0; i < rays.size(); ++i) check(rays[i], i);
}

struct face_contact {
    std::uint32_t face;
    ray_contact contact;
};

/// The number of the point, or the numbers of both ends of the edge, that a contact names; nothing
/// else has equal ones.
std::array<std::uint32_t, 2> place_of(mesh_view mesh, const face_contact& c) {
    constexpr auto none = std::numeric_limits<std::uint32_t>::max();
    const face& f = mesh.faces[c.face];
    const auto i = static_cast<std::size_t>(geometry::index_of(c.contact.at));
    if (geometry::is_corner(c.contact.at)) return {f[i], f[i]};
    // In a plane, the ray may enter an edge anywhere on it.
    if (!geometry::is_edge(c.contact.at) || c.contact.coplanar) return {c.face, none};
    const std::uint32_t j = f[(i + 1) % 3];
    return {std::min(f[i], j), std::max(f[i], j)};
}

/// `compare`, with neighbors that meet the ray in what they share identified by its number.
int order(mesh_view mesh, const ray3& ray, const face_contact& a, const face_contact& b) {
    if (place_of(mesh, a) == place_of(mesh, b)) return 0;
    return compare(ray, a.contact, b.contact);
}

mesh_hit hit_of(const face_contact& c) {
    return {c.face, c.contact.at, c.contact.coplanar, c.contact.t, c.contact.t_end};
}

}  // namespace

ray_query::ray_query(mesh_view mesh, const tree<3>& tree) : mesh_(mesh), tree_(&tree) {
    if (tree.size() != mesh.faces.size())
        throw std::invalid_argument("treeform::ray_query: the tree has " +
                                    std::to_string(tree.size()) + " elements, but the mesh has " +
                                    std::to_string(mesh.faces.size()) + " faces");
}

triangle3 ray_query::corners(std::uint32_t id) const {
    const face& f = mesh_.faces[id];
    return {mesh_.points[f[0]], mesh_.points[f[1]], mesh_.points[f[2]]};
}

std::optional<mesh_hit> ray_query::first(const ray3& ray) const {
    check(ray, 0);
    std::optional<face_contact> best;
    visit_ray(*tree_, ray, [&](std::uint32_t id) {
        if (const auto contact = treeform::intersect(ray, corners(id))) {
            const face_contact found{id, *contact};
            const int after = best ? order(mesh_, ray, found, *best) : -1;
            if (after < 0 || (after == 0 && id < best->face)) best = found;
        }
        return best ? best->contact.t : ray.t_max;
    });
    return best ? std::optional(hit_of(*best)) : std::nullopt;
}

std::vector<mesh_hit> ray_query::all(const ray3& ray) const {
    check(ray, 0);
    std::vector<face_contact> found;
    visit_ray(*tree_, ray, [&](std::uint32_t id) {
        if (const auto contact = treeform::intersect(ray, corners(id)))
            found.push_back({id, *contact});
        return ray.t_max;
    });
    std::sort(found.begin(), found.end(), [&](const face_contact& a, const face_contact& b) {
        const int sign = order(mesh_, ray, a, b);
        return sign != 0 ? sign < 0 : a.face < b.face;
    });
    std::vector<mesh_hit> hits;
    hits.reserve(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        hits.push_back(hit_of(found[i]));
        if (i == 0) continue;
        // Rounded parameters follow the exact order: what moves to its neighbor's rounded one lies
        // between that and its own exact one, so that it errs no more than the neighbor did.
        const double before = hits[i - 1].t;
        const bool same = order(mesh_, ray, found[i - 1], found[i]) == 0;
        hits[i].t = same ? before : std::max(before, hits[i].t);
        if (!hits[i].coplanar) hits[i].t_end = hits[i].t;
        hits[i].t_end = std::max(hits[i].t, hits[i].t_end);
    }
    return hits;
}

bool ray_query::any(const ray3& ray) const {
    check(ray, 0);
    return any_hit(*tree_, ray, [&](std::uint32_t id) {
        return treeform::intersect(ray, corners(id)).has_value();
    });
}

std::vector<std::optional<mesh_hit>> ray_query::first(std::span<const ray3> rays) const {
    check(rays);
    std::vector<std::optional<mesh_hit>> found(rays.size());
    for_chunks(rays.size(), ray_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) found[i] = first(rays[i]);
    });
    return found;
}

answer_lists<mesh_hit> ray_query::all(std::span<const ray3> rays) const {
    check(rays);
    answer_lists<mesh_hit> result;
    result.begin.resize(rays.size() + 1);
    std::vector<std::vector<mesh_hit>> parts(chunk_count(rays.size(), ray_grain));
    for_chunks(rays.size(), ray_grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::vector<mesh_hit> hits = all(rays[i]);
            parts[chunk].insert(parts[chunk].end(), hits.begin(), hits.end());
            result.begin[i + 1] = hits.size();
        }
    });
    for (std::size_t i = 0; i < rays.size(); ++i) result.begin[i + 1] += result.begin[i];
    result.answers.reserve(result.begin.back());
    for (const auto& part : parts)
        result.answers.insert(result.answers.end(), part.begin(), part.end());
    return result;
}

std::vector<std::uint8_t> ray_query::any(std::span<const ray3> rays) const {
    check(rays);
    std::vector<std::uint8_t> found(rays.size());
    for_chunks(rays.size(), ray_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) found[i] = any(rays[i]);
    });
    return found;
}

}  // namespace treeform::detail::intersect

namespace treeform {

using detail::intersect::ray_query;

std::optional<mesh_hit> raycast(const mesh_ref& given_mesh, const ray3& ray) {
    const detail::base::prepared_ref mesh(given_mesh);
    return ray_query(mesh.view(), build_face_tree(mesh, "raycast")).first(ray);
}

std::vector<std::optional<mesh_hit>> raycast(const mesh_ref& given_mesh,
                                             std::span<const ray3> rays) {
    const detail::base::prepared_ref mesh(given_mesh);
    return ray_query(mesh.view(), build_face_tree(mesh, "raycast")).first(rays);
}

std::vector<mesh_hit> raycast_all(const mesh_ref& mesh, const ray3& ray) {
    return raycast_all(mesh, std::span(&ray, 1)).answers;
}

answer_lists<mesh_hit> raycast_all(const mesh_ref& given_mesh, std::span<const ray3> rays) {
    const detail::base::prepared_ref mesh(given_mesh);
    return ray_query(mesh.view(), build_face_tree(mesh, "raycast_all")).all(rays);
}

bool raycast_any(const mesh_ref& given_mesh, const ray3& ray) {
    const detail::base::prepared_ref mesh(given_mesh);
    return ray_query(mesh.view(), build_face_tree(mesh, "raycast_any")).any(ray);
}

std::vector<std::uint8_t> raycast_any(const mesh_ref& given_mesh, std::span<const ray3> rays) {
    const detail::base::prepared_ref mesh(given_mesh);
    return ray_query(mesh.view(), build_face_tree(mesh, "raycast_any")).any(rays);
}

}  // namespace treeform
