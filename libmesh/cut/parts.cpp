#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/topology/select_faces.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/weld.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace treeform {
namespace {

/// The parts of faces with equal labels, [0, count). No point has faces of two labels.
std::vector<mesh_part> labeled_parts(mesh_view mesh, std::span<const std::uint32_t> label,
                                     std::size_t count) {
    std::vector<mesh_part> parts(count);
    constexpr std::uint32_t unused = 0xffffffffU;
    std::vector<std::uint32_t> number(mesh.points.size(), unused), part_of(mesh.points.size(), 0);
    for (std::size_t f = 0; f < label.size(); ++f)
        for (const std::uint32_t corner : mesh.faces[f]) {
            number[corner] = 0;
            part_of[corner] = label[f];
        }
    for (std::uint32_t v = 0; v < number.size(); ++v) {
        if (number[v] == unused) continue;
        mesh_part& part = parts[part_of[v]];
        number[v] = static_cast<std::uint32_t>(part.mesh.points.size());
        part.mesh.points.push_back(mesh.points[v]);
        part.vertex_source.push_back(v);
    }
    for (std::uint32_t f = 0; f < label.size(); ++f) {
        const auto [a, b, c] = mesh.faces[f];
        parts[label[f]].mesh.faces.push_back({number[a], number[b], number[c]});
        parts[label[f]].face_source.push_back(f);
    }
    return parts;
}

void measure(std::vector<mesh_part>& parts) {
    for (mesh_part& part : parts) {
        part.volume = signed_volume(part.mesh);
        part.area = surface_area(part.mesh);
    }
}

bool is_closed(const mesh_part& part) { return !find_open_edge(join_equal_points(part.mesh)); }

bool holds(const box3& outer, const box3& inner) {
    for (std::size_t i = 0; i < 3; ++i)
        if (inner.min[i] < outer.min[i] || inner.max[i] > outer.max[i]) return false;
    return true;
}

/// For each part, the one that it goes with: of a cavity, the smallest around it.
std::vector<std::uint32_t> hosts_of(const std::vector<mesh_part>& parts) {
    std::vector<std::uint32_t> host(parts.size());
    std::iota(host.begin(), host.end(), 0U);
    const auto is_cavity = [](const mesh_part& p) { return p.volume < 0.0; };
    if (std::ranges::none_of(parts, is_cavity)) return host;
    std::vector<std::optional<box3>> boxes;
    for (const mesh_part& part : parts) boxes.push_back(bounding_box(part.mesh.points));
    std::vector<std::uint32_t> by_volume = host;
    std::ranges::stable_sort(by_volume, {}, [&](std::uint32_t i) { return parts[i].volume; });
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        if (!is_cavity(parts[i]) || !is_closed(parts[i])) continue;
        for (const std::uint32_t j : by_volume) {
            if (parts[j].volume <= -parts[i].volume || !holds(*boxes[j], *boxes[i])) continue;
            if (!is_closed(parts[j]) || !contains(parts[j].mesh, parts[i].mesh.points[0])) continue;
            host[i] = j;
            break;
        }
    }
    return host;
}

/// Keeps the parts that are asked for.
void choose(std::vector<mesh_part>& parts, double min_volume, std::size_t largest) {
    if (min_volume <= 0.0 && (largest == 0 || largest >= parts.size())) return;
    std::vector<double> volume;
    for (const mesh_part& part : parts)
        volume.push_back(is_closed(part) ? std::abs(part.volume) : 0.0);
    std::vector<std::uint32_t> order(parts.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, [&](std::uint32_t i, std::uint32_t j) {
        return volume[i] != volume[j] ? volume[i] > volume[j] : parts[i].area > parts[j].area;
    });
    std::erase_if(order, [&](std::uint32_t i) { return volume[i] < min_volume; });
    if (largest != 0 && order.size() > largest) order.resize(largest);
    std::ranges::sort(order);
    for (std::size_t i = 0; i < order.size(); ++i)
        if (order[i] != i) parts[i] = std::move(parts[order[i]]);
    parts.resize(order.size());
}

}  // namespace

std::vector<mesh_part> components(const mesh_ref& given, double min_volume, std::size_t largest) {
    const mesh_view mesh = given.view();
    detail::base::check_faces("components", mesh.points.size(), mesh.faces);
    if (!(min_volume >= 0.0))
        throw std::invalid_argument("treeform::components: min_volume is negative or NaN");
    const detail::weld::joined_faces joined = detail::weld::join_faces(mesh);
    std::vector<std::uint32_t> label = face_components(mesh.points.size(), joined.of(mesh).faces);
    const std::size_t count = label.empty() ? 0 : *std::ranges::max_element(label) + std::size_t{1};
    std::vector<mesh_part> parts = labeled_parts(mesh, label, count);
    measure(parts);
    const std::vector<std::uint32_t> host = hosts_of(parts);
    std::vector<std::uint32_t> number(count);
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < count; ++i)
        if (host[i] == i) number[i] = kept++;
    if (kept < count) {
        for (std::uint32_t& l : label) l = number[host[l]];
        parts = labeled_parts(mesh, label, kept);
        measure(parts);
    }
    choose(parts, min_volume, largest);
    return parts;
}

mesh_part submesh(const mesh_ref& given, std::span<const std::uint32_t> faces) {
    const mesh_view mesh = given.view();
    mesh_part part;
    part.mesh = select_faces(mesh, faces);
    part.face_source.assign(faces.begin(), faces.end());
    std::vector<face> chosen;
    for (const std::uint32_t f : faces) chosen.push_back(mesh.faces[f]);
    part.vertex_source = detail::base::used_points(mesh.points.size(), chosen);
    part.volume = signed_volume(part.mesh);
    part.area = surface_area(part.mesh);
    return part;
}

mesh concatenate(const mesh_refs& meshes) {
    mesh all;
    for (const mesh_ref& given : meshes) {
        const mesh_view one = given.view();
        if (all.points.size() + one.points.size() > 0xffffffffU ||
            all.faces.size() + one.faces.size() > 0xffffffffU)
            throw std::length_error(
                "treeform::concatenate: more elements than 32-bit numbers can name");
        const auto first = static_cast<std::uint32_t>(all.points.size());
        all.points.insert(all.points.end(), one.points.begin(), one.points.end());
        for (const auto& [a, b, c] : one.faces)
            all.faces.push_back({a + first, b + first, c + first});
    }
    return all;
}

mesh transform_mesh(const mesh_ref& given, const transform<3>& by) {
    const mesh_view mesh = given.view();
    treeform::mesh made{{mesh.points.begin(), mesh.points.end()},
                        {mesh.faces.begin(), mesh.faces.end()}};
    for (point3& p : made.points) p = by(p);
    if (by.mirrors())
        for (face& f : made.faces) std::swap(f[1], f[2]);
    return made;
}

}  // namespace treeform
