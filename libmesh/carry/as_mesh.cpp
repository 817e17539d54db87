#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/topology/select_faces.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

namespace treeform {
namespace {

std::vector<std::uint32_t> unusable_faces(const invalid_faces& defects) {
    std::vector<std::uint32_t> unusable;
    std::merge(defects.nonfinite_faces.begin(), defects.nonfinite_faces.end(),
               defects.out_of_range_faces.begin(), defects.out_of_range_faces.end(),
               std::back_inserter(unusable));
    return unusable;
}

/// The numbers below `count` that are not listed, both ascending.
std::vector<std::uint32_t> all_but(std::size_t count, const std::vector<std::uint32_t>& listed) {
    std::vector<std::uint32_t> all(count), rest;
    std::iota(all.begin(), all.end(), 0U);
    rest.reserve(count - listed.size());
    std::set_difference(all.begin(), all.end(), listed.begin(), listed.end(),
                        std::back_inserter(rest));
    return rest;
}

/// Only the faces listed, ascending, and their points.
void keep_faces(usable_mesh& part, std::vector<std::uint32_t> faces) {
    part.mesh = select_faces(part.mesh, faces);
    if (!part.component.empty()) {
        for (std::size_t f = 0; f < faces.size(); ++f) part.component[f] = part.component[faces[f]];
        part.component.resize(faces.size());
    }
    if (!part.triangle_of_face.empty())
        for (std::uint32_t& f : faces) f = part.triangle_of_face[f];
    part.triangle_of_face = std::move(faces);
}

void join_points(usable_mesh& part, const usable_options& options) {
    if (options.vertices == vertex_identity::by_coordinates || options.tolerance > 0.0) {
        part.mesh = join_equal_points(part.mesh);
        part.distinct = part.mesh.points.size();
    } else if (options.details) {
        part.distinct = find_equal_points(part.mesh.points).first_of_group.size();
    }
    if (!(options.tolerance > 0.0)) return;
    const std::size_t before = part.mesh.points.size();
    part.mesh = group_points(part.mesh.points, {.tolerance = options.tolerance}).joined(part.mesh);
    part.joined = before - part.mesh.points.size();
}

/// Of a cloud, drops the points that are not finite. Returns their number.
std::size_t drop_non_finite_points(mesh& cloud) {
    return std::erase_if(cloud.points, [](const point3& p) { return !detail::base::is_finite(p); });
}

}  // namespace

std::vector<std::uint32_t> drop_unusable_faces(mesh& mesh) {
    const std::vector<std::uint32_t> unusable = unusable_faces(find_invalid_faces(mesh));
    if (unusable.empty()) return {};
    std::vector<std::uint32_t> kept = all_but(mesh.faces.size(), unusable);
    for (std::size_t f = 0; f < kept.size(); ++f) mesh.faces[f] = mesh.faces[kept[f]];
    mesh.faces.resize(kept.size());
    return kept;
}

prepared_mesh::prepared_mesh(usable_mesh&& owned) : prepared_mesh(std::move(owned.mesh)) {}

mesh_ref::mesh_ref(const usable_mesh& mesh) : view_(mesh.mesh) {}

usable_mesh read_mesh(const std::filesystem::path& path) { return as_mesh(read(path)); }

usable_mesh as_mesh(mesh_file file) {
    detail::base::check_faces("as_mesh", file.mesh.points.size(), file.mesh.faces);
    usable_mesh result;
    result.warnings = std::move(file.warnings);
    if (file.mesh.faces.empty()) {
        result.non_finite = drop_non_finite_points(file.mesh);
        result.mesh = std::move(file.mesh);
        return result;
    }
    const std::size_t before = file.mesh.faces.size();
    result.triangle_of_face = drop_unusable_faces(file.mesh);
    result.non_finite = before - file.mesh.faces.size();
    detail::weld::joined_faces joined = detail::weld::join_faces(file.mesh);
    if (joined.changed) file.mesh.faces = std::move(joined.faces);
    // Behind the join. A copy of another point, so that boxes and distances are as without it.
    const auto is_finite = [](const point3& p) { return detail::base::is_finite(p); };
    const auto first = std::ranges::find_if(file.mesh.points, is_finite);
    const point3 instead = first == file.mesh.points.end() ? point3{} : *first;
    for (point3& p : file.mesh.points)
        if (!is_finite(p)) p = instead;
    result.mesh = std::move(file.mesh);
    result.face_of_triangle = std::move(file.face_of_triangle);
    return result;
}

usable_mesh usable_faces(mesh given, std::vector<std::uint32_t> face_of_triangle,
                         const usable_options& options) {
    usable_mesh part{.mesh = std::move(given), .face_of_triangle = std::move(face_of_triangle)};
    if (part.mesh.faces.empty()) {
        part.non_finite = drop_non_finite_points(part.mesh);
        return part;
    }
    const invalid_faces defects = find_invalid_faces(part.mesh);
    const std::vector<std::uint32_t> unusable = unusable_faces(defects);
    part.degenerate = defects.degenerate_faces.size();
    part.non_finite = unusable.size();
    if (!unusable.empty() || !defects.nonfinite_points.empty())
        keep_faces(part, all_but(part.mesh.faces.size(), unusable));
    if (part.mesh.faces.empty()) return part;
    join_points(part, options);
    if (options.details) part.component = face_components(part.mesh.points.size(), part.mesh.faces);
    if (options.box) keep_faces(part, faces_in_box(part.mesh, options.box->min, options.box->max));
    return part;
}

mesh join_meshes(std::span<const mesh_view> meshes) {
    mesh all;
    for (const mesh_view& one : meshes) {
        const auto offset = static_cast<std::uint32_t>(all.points.size());
        const bool is_cloud = mesh_ref(one).is_cloud();
        for (const point3& p : one.points)
            if (detail::base::is_finite(p))
                all.points.push_back(p);
            else if (!is_cloud)
                all.points.emplace_back();
        for (const auto& [a, b, c] : one.faces)
            all.faces.push_back({a + offset, b + offset, c + offset});
    }
    return join_equal_points(all);
}

}  // namespace treeform
