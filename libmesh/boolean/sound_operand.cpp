#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/part_of_progress.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/operand_edges.hpp>
#include <libmesh/boolean/sound_operand.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <libmesh/exact/filter.hpp>
#include <libmesh/intersect/pairs_by_tree.hpp>
#include <libmesh/topology/is_manifold.hpp>
#include <libmesh/weld/few_equal_points.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {
namespace {

/// Where more pairs meet, most faces are near one, and little is gained by looking at these alone.
constexpr std::size_t faces_of_a_pair = 16;

/// Whether a point can be computed with, as `boolean` asks for.
bool is_usable(const point3& p) { return base::largest_of(p) <= 0x1p1000; }

bool has_area(mesh_view mesh, const face& f) {
    const point3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
    return exact::collinear_filter(a, b, c) == 1 || !collinear(a, b, c);
}

/// Whether all faces hang together.
bool is_connected(mesh_view mesh) {
    base::union_find linked(mesh.points.size());
    for_chunks(mesh.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t f = begin; f < end; ++f) {
                       linked.join(mesh.faces[f][0], mesh.faces[f][1]);
                       linked.join(mesh.faces[f][0], mesh.faces[f][2]);
                   }
               });
    const auto root = linked.take_roots();
    return base::first_bad(root.size(), [&](std::size_t p) { return root[p] != 0; }) == root.size();
}

/// Whether what is behind the faces of closed components that do not meet is inside, and what is in
/// front is outside: each is in no other one, or inside out in one.
bool faces_outward(mesh_view mesh) {
    if (mesh.faces.empty()) return true;
    if (is_connected(mesh)) return sign_of_volume(mesh) > 0;
    const std::vector<std::uint32_t> one_operand(mesh.faces.size(), 0);
    const surface_components components(mesh, one_operand, find_operand_edges(mesh, one_operand),
                                        false);
    return base::first_bad(components.size(), [&](std::size_t c) {
               const int sign = components.sign_of_volume(c);
               const point3& corner = mesh.points[mesh.faces[components.faces(c)[0]][0]];
               return sign == 0 || components.winding_of_others(c, corner) != (sign > 0 ? 0 : 1);
           }) == components.size();
}

examined_operand find_out(const prepared_mesh& prepared, const progress_callback& progress) {
    using kind = examined_operand::kind;
    check_operands("boolean", std::array{prepared.view()});
    // As the faces, but without points that none uses: these may be anything.
    mesh_view mesh = prepared.view();
    joined_operands joined;
    const auto used = base::used_points(mesh.points.size(), mesh.faces);
    if (used.size() != mesh.points.size()) {
        joined = join_operands(std::array{mesh});
        mesh = joined.all;
        if (mesh.points.size() != used.size()) return {};  // two are equal
    }
    const auto all_of = [](std::size_t count, const auto& holds) {
        return base::first_bad(count, [&](std::size_t i) { return !holds(i); }) == count;
    };
    if (!all_of(mesh.points.size(), [&](std::size_t p) { return is_usable(mesh.points[p]); }))
        return {};  // the general way says which
    if (!topology::is_manifold(mesh) || weld::few_equal_points(mesh.points)) return {};
    if (!all_of(mesh.faces.size(), [&](std::size_t f) { return has_area(mesh, mesh.faces[f]); }))
        return {};
    const std::size_t few = mesh.faces.size() / faces_of_a_pair;
    self_intersection_result met = intersect::pairs_by_tree(
        mesh, build_face_tree(prepared),
        {.vertices = vertex_identity::by_index, .progress = base::part_of(progress, 0.1, 0.9)},
        few);
    if (met.cancelled) throw stopped{};
    if (met.pairs.size() > few) return {};
    const bool sound = met.pairs.empty() && faces_outward(mesh);
    return {sound ? kind::sound : kind::manifold, std::move(met.pairs)};
}

}  // namespace

const examined_operand& examine_operand(const prepared_mesh& mesh,
                                        const progress_callback& progress) {
    constexpr base::slot<examined_operand> slot{base::slot_name::examined_operand};
    return base::prepared_slots::get(mesh, slot, [&] { return find_out(mesh, progress); });
}

}  // namespace treeform::detail::boolean
