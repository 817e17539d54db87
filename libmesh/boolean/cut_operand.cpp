#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/parallel_invoke.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/boolean/cut_operand.hpp>
#include <libmesh/boolean/operand_edges.hpp>
#include <libmesh/exact/filter.hpp>
#include <libmesh/topology/is_manifold.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <limits>
#include <stdexcept>
#include <utility>

namespace treeform::detail::boolean {
namespace {

using ids = std::vector<std::uint32_t>;

/// Where more pairs meet, parts may hide each other.
constexpr std::size_t faces_of_a_pair = 16;

bool has_area(mesh_view mesh, const face& f) {
    const point3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
    return exact::collinear_filter(a, b, c) == 1 || !collinear(a, b, c);
}

/// The numbers below `count` that are not `good`, ascending.
template <class Good>
ids all_but(std::size_t count, const Good& good) {
    ids found;
    base::compact(
        count, [&](std::size_t i) { return !good(i); }, [&](std::size_t bad) { found.resize(bad); },
        [&](std::size_t i, std::size_t place) { found[place] = static_cast<std::uint32_t>(i); });
    return found;
}

void check_usable(points_view points) {
    if (base::first_bad(points.size(), [&](std::size_t p) {
            return !(base::largest_of(points[p]) <= 0x1p1000);
        }) != points.size())
        throw std::invalid_argument("treeform::boolean: a coordinate");
}

/// Where surfaces end: at edges both ends of which lack a fan.
///
/// \param operand_of_face empty where there is one operand
open_input_edges find_open(mesh_view mesh, const ids& without_fan,
                           const std::vector<std::uint32_t>& operand_of_face) {
    if (without_fan.empty()) return {};
    std::vector<std::uint8_t> lacks_fan(mesh.points.size(), 0);
    for (const std::uint32_t p : without_fan) lacks_fan[p] = 1;
    const ids at = all_but(mesh.faces.size(), [&](std::size_t f) {
        const auto& [a, b, c] = mesh.faces[f];
        return lacks_fan[a] + lacks_fan[b] + lacks_fan[c] < 2;
    });
    std::vector<face> faces;
    ids operand;
    for (const std::uint32_t f : at) {
        faces.push_back(mesh.faces[f]);
        operand.push_back(operand_of_face.empty() ? 0 : operand_of_face[f]);
    }
    operand_edges edges = find_operand_edges({mesh.points, faces}, operand);
    std::erase_if(edges.unbalanced, [&](const unbalanced_edge& e) {
        return lacks_fan[e.ends[0]] == 0 || lacks_fan[e.ends[1]] == 0;
    });
    for (unbalanced_edge& e : edges.unbalanced) e.face = at[e.face];
    return find_open_input_edges(mesh.points, edges.unbalanced);
}

void leave_out(const ids& degenerate, joined_operands& joined) {
    std::vector<face>& faces = joined.all.faces;
    ids left;
    left.reserve(faces.size() - degenerate.size());
    for (std::uint32_t f = 0, next = 0; f < faces.size(); ++f) {
        if (next < degenerate.size() && degenerate[next] == f) {
            ++next;
            continue;
        }
        faces[left.size()] = faces[f];
        left.push_back(joined.number_of_face.empty() ? f : joined.number_of_face[f]);
    }
    faces.resize(left.size());
    joined.number_of_face = std::move(left);
}

ids degenerate_of(mesh_view mesh) {
    return all_but(mesh.faces.size(), [&](std::size_t f) { return has_area(mesh, mesh.faces[f]); });
}

struct known_pairs {
    std::vector<face_pair> pairs;
    bool are_all = true;
};

/// Those that were asked for first.
constexpr base::slot<known_pairs> first_found{base::slot_name::few_own_pairs};

known_pairs find_pairs(const prepared_mesh& mesh, const progress_callback& progress,
                       std::size_t most, const intersect::wanted_pairs* wanted = nullptr) {
    if (mesh.indexed_view().faces.empty()) return {};
    face_pair_result met = intersect::pairs_by_tree(
        mesh.indexed_view(), build_face_tree(mesh),
        {.vertices = vertex_identity::by_index, .progress = progress}, most, wanted);
    if (met.status == treeform::status::cancelled) throw stopped{};
    if (met.pairs.size() > most) return {{}, false};
    return {std::move(met.pairs), true};
}

}  // namespace

cut_operand cut_operand_of(joined_operands&& joined, bool is_closed) {
    cut_operand result;
    result.joined = std::move(joined);
    mesh& all = result.joined.all;
    check_usable(all.points);
    result.without_fan = topology::points_without_fan(all);
    if (!is_closed)
        result.open = find_open(all, result.without_fan, result.joined.operand_of_face());
    if (const ids degenerate = degenerate_of(all); !degenerate.empty()) {
        result.degenerate = degenerate.size();
        leave_out(degenerate, result.joined);
        result.without_fan = topology::points_without_fan(all);
    }
    result.own = base::prepared_slots::of_faces(all);
    return result;
}

const cut_operand& cut_operand_of(const prepared_mesh& mesh) {
    constexpr base::slot<cut_operand> slot{base::slot_name::cut_operand};
    return base::prepared_slots::get(mesh, slot, [&] {
        const mesh_view view = mesh.indexed_view();
        const auto join = [&] { return cut_operand_of(join_operands(std::array{view}), false); };
        // Points that none uses may be anything.
        if (base::used_points(view.points.size(), view.faces).size() != view.points.size())
            return join();
        check_usable(view.points);
        if (weld::few_equal_points(view.points) || !degenerate_of(view).empty()) return join();
        cut_operand result;
        base::parallel_invoke(
            [&] {
                result.without_fan = topology::points_without_fan(view);
                result.open = find_open(view, result.without_fan, {});
            },
            [&] { static_cast<void>(build_face_tree(mesh)); });  // asked for next
        return result;
    });
}

std::optional<std::span<const face_pair>> few_own_pairs(const prepared_mesh& mesh,
                                                        const progress_callback& progress) {
    const std::size_t most = mesh.indexed_view().faces.size() / faces_of_a_pair;
    const known_pairs& known = base::prepared_slots::get(
        mesh, first_found, [&] { return find_pairs(mesh, progress, most); });
    if (!known.are_all || known.pairs.size() > most) return std::nullopt;
    return known.pairs;
}

std::span<const face_pair> own_pairs(const prepared_mesh& mesh, const progress_callback& progress) {
    const auto find_all = [&] {
        return find_pairs(mesh, progress, std::numeric_limits<std::size_t>::max());
    };
    const known_pairs& first = base::prepared_slots::get(mesh, first_found, find_all);
    if (first.are_all) return first.pairs;
    constexpr base::slot<known_pairs> all{base::slot_name::own_pairs};
    return base::prepared_slots::get(mesh, all, find_all).pairs;
}

std::vector<face_pair> own_pairs(const prepared_mesh& mesh, const intersect::wanted_pairs& wanted,
                                 const progress_callback& progress) {
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    return find_pairs(mesh, progress, most, &wanted).pairs;
}

}  // namespace treeform::detail::boolean
