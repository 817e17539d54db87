#include <libmesh/repair/edge_parts.hpp>
#include <libmesh/repair/orient_faces.hpp>
#include <libmesh/topology/select_faces.hpp>
#include <libmesh/weld/edge_uses.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

namespace treeform::detail::repair {
namespace {

/// Sets of faces, each known to be turned against its set's root or not.
class turned_sets {
  public:
    explicit turned_sets(std::size_t count)
        : parent_(count), turned_(count, 0), one_sided_(count, 0) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }

    struct root_of_face {
        std::uint32_t root;
        bool turned;
    };

    [[nodiscard]] root_of_face find(std::uint32_t f) {
        std::uint32_t root = f;
        bool turned = false;
        while (parent_[root] != root) {
            turned ^= turned_[root] != 0;
            root = parent_[root];
        }
        for (bool rest = turned; parent_[f] != root && f != root;) {  // shortens the way
            const bool own = turned_[f] != 0;
            const std::uint32_t up = parent_[f];
            parent_[f] = root;
            turned_[f] = rest ? 1 : 0;
            rest ^= own;
            f = up;
        }
        return {root, turned};
    }

    void join(std::uint32_t f, std::uint32_t g, bool against) {
        const root_of_face a = find(f), b = find(g);
        const bool turned = a.turned ^ b.turned ^ against;
        if (a.root == b.root) {
            if (turned) one_sided_[a.root] = 1;
            return;
        }
        const auto [low, high] = std::minmax(a.root, b.root);
        parent_[high] = low;
        turned_[high] = turned ? 1 : 0;
        one_sided_[low] = std::max(one_sided_[low], one_sided_[high]);
    }

    [[nodiscard]] bool is_one_sided(std::uint32_t root) const { return one_sided_[root] != 0; }

  private:
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint8_t> turned_;  ///< against the parent
    std::vector<std::uint8_t> one_sided_;
};

box3 box_of(const working_mesh& mesh, const std::vector<std::uint32_t>& faces) {
    const point3& first = mesh.points[mesh.faces[faces[0]][0]];
    box3 box{first, first};
    for (const std::uint32_t f : faces)
        for (const std::uint32_t corner : mesh.faces[f])
            for (std::size_t k = 0; k < 3; ++k) {
                box.min[k] = std::min(box.min[k], mesh.points[corner][k]);
                box.max[k] = std::max(box.max[k], mesh.points[corner][k]);
            }
    return box;
}

bool holds(const box3& outer, const box3& inner) {
    for (std::size_t k = 0; k < 3; ++k)
        if (inner.min[k] < outer.min[k] || inner.max[k] > outer.max[k]) return false;
    return true;
}

bool overlap(const box3& a, const box3& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a.min[k] > b.max[k] || b.min[k] > a.max[k]) return false;
    return true;
}

/// [F] The parts by number, in the order of their lowest faces.
std::vector<std::uint32_t> numbered_parts(const working_mesh& mesh, turned_as_one what,
                                          edge_facts known) {
    // With one fan at each vertex, what vertices link is what edges link.
    if (known == edge_facts::manifold) return face_components(mesh.points.size(), mesh.faces);
    std::vector<std::uint32_t> part_of =
        what == turned_as_one::shell ? shells(mesh) : parts_by_edges(mesh);
    std::uint32_t count = 0;
    for (std::uint32_t f = 0; f < part_of.size(); ++f)
        part_of[f] = part_of[f] == f ? count++ : part_of[part_of[f]];
    return part_of;
}

/// [parts] The faces of each one.
std::vector<std::vector<std::uint32_t>> faces_of_parts(const std::vector<std::uint32_t>& part_of) {
    std::vector<std::uint32_t> sizes;
    for (const std::uint32_t part : part_of) {
        if (part == sizes.size()) sizes.push_back(0);
        ++sizes[part];
    }
    std::vector<std::vector<std::uint32_t>> faces(sizes.size());
    for (std::size_t part = 0; part < faces.size(); ++part) faces[part].reserve(sizes[part]);
    for (std::uint32_t f = 0; f < part_of.size(); ++f) faces[part_of[f]].push_back(f);
    return faces;
}

/// How often `other` winds around the first vertex of `part`.
int winding_around(const working_mesh& mesh, const closed_component& part,
                   closed_component& other) {
    if (!holds(other.box, part.box)) return 0;
    if (!other.surface) other.surface.emplace(select_faces(mesh.view(), other.faces));
    return winding_number(*other.surface, mesh.points[mesh.faces[part.faces[0]][0]]);
}

const prepared_mesh& given_surface(const working_mesh& mesh, closed_component& part) {
    if (part.given) return *part.given;
    std::vector<std::uint32_t> given;
    for (const std::uint32_t f : part.faces)
        if (mesh.source[f] != repair_result::none) given.push_back(f);
    return part.given.emplace(select_faces(mesh.view(), given));
}

/// With no vertex outside, and not with all on the other's surface: cavities may touch it. Where a
/// hole was filled, the filling may be on either side of what lies inside: then most vertices tell,
/// if what was given does not meet.
bool is_inside(const working_mesh& mesh, closed_component& part, closed_component& other) {
    if (!overlap(other.box, part.box)) return false;
    if (!other.surface) other.surface.emplace(select_faces(mesh.view(), other.faces));
    const point3& first = mesh.points[mesh.faces[part.faces[0]][0]];
    const bool is_out = locate(*other.surface, first).where == location::outside;
    if (is_out && !other.is_filled) return false;
    const mesh_view own = given_surface(mesh, part).indexed_view();
    const auto places = locate(*other.surface, own.points);
    const auto count = [&](location where) {
        return std::ranges::count(places, where, &point_location::where);
    };
    const auto inside = count(location::inside), outside = count(location::outside);
    if (outside == 0) return inside > 0;
    return other.is_filled && inside > outside &&
           !intersects(given_surface(mesh, other), given_surface(mesh, part));
}

/// What lies inside of an inward component, if with it every second one from outside is inward:
/// then all of it is inside out.
std::vector<closed_component*> turned_with(const working_mesh& mesh, closed_component& outer,
                                           std::vector<closed_component>& components) {
    std::vector<closed_component*> within;
    for (closed_component& part : components)
        if (&part != &outer && is_inside(mesh, part, outer)) within.push_back(&part);
    for (closed_component* part : within) {
        bool is_even = false;  // the number of those around it
        for (closed_component* other : within)
            is_even ^= other != part && is_inside(mesh, *part, *other);
        if ((part->volume < 0.0) != is_even) return {};
    }
    return within;
}

}  // namespace

std::uint64_t make_faces_agree(working_mesh& mesh) {
    const weld::edge_uses edges(mesh.points.size(), mesh.faces, weld::repeated_corners::left_out);
    struct link {
        std::uint32_t f, g;
        bool against;
    };
    std::vector<std::vector<link>> links(edges.chunks());
    edges.for_each([&](const weld::used_edge& edge, std::size_t chunk) {
        if (edge.uses.size() != 2) return;
        const std::uint32_t f = edge.face(0), g = edge.face(1);
        const bool along_f = runs_along(mesh.faces[f], edge.low, edge.high);
        const bool along_g = runs_along(mesh.faces[g], edge.low, edge.high);
        links[chunk].push_back({f, g, along_f == along_g});
    });
    turned_sets sets(mesh.faces.size());
    for (const auto& part : links)
        for (const link& l : part) sets.join(l.f, l.g, l.against);
    std::vector<std::int64_t> majority(mesh.faces.size(), 0);  // by root: as it is, less turned
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const auto [root, turned] = sets.find(f);
        majority[root] += turned ? -1 : 1;
    }
    std::uint64_t flipped = 0;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const auto [root, turned] = sets.find(f);
        if (sets.is_one_sided(root) || turned != (majority[root] >= 0)) continue;
        mesh.faces[f] = repair::turned(mesh.faces[f]);
        ++flipped;
    }
    return flipped;
}

closed_components::closed_components(working_mesh& mesh, turned_as_one what, edge_facts known)
    : mesh_(mesh) {
    const std::vector<std::uint32_t> part_of = numbered_parts(mesh, what, known);
    std::vector<std::vector<std::uint32_t>> parts = faces_of_parts(part_of);
    if (known == edge_facts::unknown) {
        std::vector<std::uint8_t> is_open(parts.size(), 0);
        for (const std::uint32_t f : faces_at_unbalanced_edges(mesh)) is_open[part_of[f]] = 1;
        std::erase_if(parts, [&](const auto& faces) { return is_open[part_of[faces[0]]] != 0; });
    }
    std::vector<face> faces;
    for (std::vector<std::uint32_t>& part : parts) {
        closed_component& added = all_.emplace_back();
        added.faces = std::move(part);
        const bool is_all = added.faces.size() == mesh.faces.size();
        if (!is_all) {
            faces.clear();
            for (const std::uint32_t f : added.faces) faces.push_back(mesh.faces[f]);
        }
        added.volume = signed_volume({mesh.points, is_all ? mesh.faces : faces});
        if (!is_all)
            added.box = box_of(mesh, added.faces);  // which nobody asks for of a single one
        added.is_filled = std::ranges::any_of(
            added.faces, [&](std::uint32_t f) { return mesh.source[f] == repair_result::none; });
    }
}

std::uint64_t closed_components::turn_outward() {
    std::vector<closed_component*> inward;
    for (closed_component& part : all_) {
        if (!(part.volume < 0.0)) continue;
        const bool is_cavity = std::ranges::any_of(all_, [&](closed_component& other) {
            return &other != &part && is_inside(mesh_, part, other);
        });
        if (!is_cavity) inward.push_back(&part);
    }
    std::vector<closed_component*> turning = inward;
    for (closed_component* part : inward)
        for (closed_component* other : turned_with(mesh_, *part, all_))
            if (std::ranges::find(turning, other) == turning.end()) turning.push_back(other);
    for (closed_component* part : turning) {
        for (const std::uint32_t f : part->faces) mesh_.faces[f] = turned(mesh_.faces[f]);
        part->volume = -part->volume;
        part->surface.reset();
        part->given.reset();
    }
    return turning.size();
}

bool closed_components::is_outward() const {
    return std::ranges::all_of(all_,
                               [](const closed_component& part) { return part.volume > 0.0; });
}

double closed_components::volume() const {
    double sum = 0.0;
    for (const closed_component& part : all_) sum += part.volume;
    return sum;
}

bool closed_components::is_well_nested() {
    return std::ranges::all_of(all_, [&](const closed_component& part) {
        int around = 0;
        for (closed_component& other : all_)
            if (&other != &part) around += winding_around(mesh_, part, other);
        return around == (part.volume < 0.0 ? 1 : 0);
    });
}

}  // namespace treeform::detail::repair
