#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/properties.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace treeform {
namespace {

point3 rounded(const point3& p) {
    using detail::base::nearest_float;
    return {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
}

/// The numbers of the faces that can be computed with.
std::vector<std::uint32_t> usable_faces(const mesh& mesh) {
    const mesh_defects defects = find_defects(mesh);
    std::vector<std::uint32_t> unusable;
    std::merge(defects.nonfinite_faces.begin(), defects.nonfinite_faces.end(),
               defects.out_of_range_faces.begin(), defects.out_of_range_faces.end(),
               std::back_inserter(unusable));
    std::vector<std::uint32_t> all(mesh.faces.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<std::uint32_t> usable;
    std::set_difference(all.begin(), all.end(), unusable.begin(), unusable.end(),
                        std::back_inserter(usable));
    return usable;
}

std::vector<std::uint32_t> finite_points(const mesh& mesh) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < mesh.points.size(); ++i)
        if (detail::base::is_finite(mesh.points[i])) numbers.push_back(i);
    return numbers;
}

prepared_mesh cloud_of(const mesh& mesh, const std::vector<std::uint32_t>& numbers) {
    std::vector<point3> points;
    points.reserve(numbers.size());
    for (const std::uint32_t i : numbers) points.push_back(mesh.points[i]);
    return prepared_mesh::cloud(std::move(points));
}

/// The parts of `whole`, which have no point in common, as `select_faces` gives each.
std::vector<prepared_mesh> split_up(mesh_view whole, const std::vector<scene_part>& parts) {
    constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> part_of(whole.points.size(), nobody);
    for (std::uint32_t i = 0; i < parts.size(); ++i)
        for (const std::uint32_t f : parts[i].faces)
            for (const std::uint32_t corner : whole.faces[f]) part_of[corner] = i;
    std::vector<mesh> split(parts.size());
    std::vector<std::uint32_t> new_of_old(whole.points.size());
    for (std::size_t v = 0; v < whole.points.size(); ++v) {
        if (part_of[v] == nobody) continue;
        std::vector<point3>& points = split[part_of[v]].points;
        new_of_old[v] = static_cast<std::uint32_t>(points.size());
        points.push_back(whole.points[v]);
    }
    std::vector<prepared_mesh> result;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (const std::uint32_t f : parts[i].faces) {
            const auto& [a, b, c] = whole.faces[f];
            split[i].faces.push_back({new_of_old[a], new_of_old[b], new_of_old[c]});
        }
        result.emplace_back(std::move(split[i]));
    }
    return result;
}

}  // namespace

file_bodies whole_body(const mesh_file& file) {
    file_bodies found;
    found.cloud = file.mesh.faces.empty();
    std::vector<std::uint32_t> usable =
        found.cloud ? finite_points(file.mesh) : usable_faces(file.mesh);
    const std::size_t all = found.cloud ? file.mesh.points.size() : file.mesh.faces.size();
    found.left_out = all - usable.size();
    if (usable.empty()) return found;
    file_body& body = found.bodies.emplace_back();
    found.shapes.push_back(found.cloud
                               ? cloud_of(file.mesh, usable)
                               : prepared_mesh(join_equal_points(select_faces(file.mesh, usable))));
    if (usable.size() < all) body.triangle_of_face = std::move(usable);
    return found;
}

file_bodies bodies_of(const mesh_file& file) {
    file_bodies found = whole_body(file);
    if (found.bodies.empty() || found.cloud || file.attributes.parts.size() < 2) return found;
    const file_body& whole = found.bodies.front();
    const mesh_view mesh = found.shapes.front().view();
    std::vector<std::uint32_t> number;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        number.push_back(whole.stored_face(file, f));
    const std::vector<scene_part> parts = scene_parts(mesh, file.attributes.parts, number);
    if (parts.size() < 2) return found;
    std::vector<prepared_mesh> shapes = split_up(mesh, parts);
    std::vector<file_body> bodies(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        file_body& body = bodies[i];
        body.name = parts[i].name.empty() ? "part " + std::to_string(i) : parts[i].name;
        for (const std::uint32_t f : parts[i].faces)
            body.triangle_of_face.push_back(whole.triangle(f));
    }
    found.bodies = std::move(bodies);
    found.shapes = std::move(shapes);
    return found;
}

void put_back(mesh_file& file, const file_body& body, const prepared_mesh& shape,
              points_view placed, const transform<3>& matrix, precision written_as) {
    std::vector<point3>& points = file.mesh.points;
    for (point3& p : points) {
        p = matrix(p);
        if (written_as == precision::float32) p = rounded(p);
    }
    const std::span<const face> faces = shape.view().faces;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const std::uint32_t t = body.triangle(f);
        if (shape.is_cloud()) {
            points[t] = placed[f];
            continue;
        }
        for (std::size_t i = 0; i < 3; ++i) points[file.mesh.faces[t][i]] = placed[faces[f][i]];
    }
}

double round_to_float32(mesh_file& file) {
    double largest = 0.0;
    for (point3& p : file.mesh.points) {
        const point3 before = std::exchange(p, rounded(p));
        for (std::size_t k = 0; k < 3 && detail::base::is_finite(before); ++k)
            largest = std::max(largest, std::abs(p[k] - before[k]));
    }
    return largest;
}

}  // namespace treeform
