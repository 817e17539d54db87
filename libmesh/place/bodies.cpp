#include <libmesh/attributes/scene_parts.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/topology/select_faces.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/weld.hpp>

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
    const invalid_faces defects = find_invalid_faces(mesh);
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
    return prepared_mesh(treeform::mesh{std::move(points)});
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

body_file& body_set::add(mesh_file content, std::string label, std::string name) {
    body_file& file = files.emplace_back();
    file.cloud = content.mesh.faces.empty();
    file.label = std::move(label);
    file.name = std::move(name);
    std::vector<std::uint32_t> usable =
        file.cloud ? finite_points(content.mesh) : usable_faces(content.mesh);
    const std::size_t all = file.cloud ? content.mesh.points.size() : content.mesh.faces.size();
    file.non_finite = all - usable.size();
    if (!usable.empty()) {
        shapes.push_back(
            file.cloud ? cloud_of(content.mesh, usable)
                       : prepared_mesh(join_equal_points(select_faces(content.mesh, usable))));
        file.box = bounding_box(shapes.back().indexed_view().points);
        bodies_.push_back({.file = files.size() - 1});
        if (usable.size() < all) bodies_.back().triangle_of_face = std::move(usable);
    }
    file.content = std::move(content);
    return file;
}

body_file& body_set::add_parts(mesh_file content, std::string label, std::string name) {
    body_file& file = add(std::move(content), std::move(label), std::move(name));
    const std::vector<named_faces>& names = file.content.attributes.parts;
    if (!file.box || file.cloud || names.size() < 2) return file;
    const mesh_view mesh = shapes.back().indexed_view();
    std::vector<std::uint32_t> number;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        number.push_back(face_in_file(bodies_.size() - 1, f));
    const std::vector<scene_part> parts = scene_parts(mesh, names, number);
    if (parts.size() < 2) return file;
    std::vector<prepared_mesh> split = split_up(mesh, parts);
    shapes.pop_back();
    std::move(split.begin(), split.end(), std::back_inserter(shapes));
    std::vector<std::uint32_t> triangle;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        triangle.push_back(this->triangle(bodies_.size() - 1, f));
    bodies_.pop_back();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        body& one = bodies_.emplace_back();
        one.file = files.size() - 1;
        one.part = parts[i].name.empty() ? "part " + std::to_string(i) : parts[i].name;
        for (const std::uint32_t f : parts[i].faces) one.triangle_of_face.push_back(triangle[f]);
    }
    return file;
}

const body_file& body_set::file_of(std::size_t body) const { return files[bodies_[body].file]; }

std::size_t body_set::file_number(std::size_t body) const { return bodies_[body].file; }

const std::string& body_set::part_name(std::size_t body) const { return bodies_[body].part; }

std::uint32_t body_set::triangle(std::size_t body, std::uint32_t f) const {
    const std::vector<std::uint32_t>& triangles = bodies_[body].triangle_of_face;
    return triangles.empty() ? f : triangles[f];
}

std::uint32_t body_set::face_in_file(std::size_t body, std::uint32_t f) const {
    const std::vector<std::uint32_t>& stored = file_of(body).content.face_of_triangle;
    const std::uint32_t t = triangle(body, f);
    return stored.empty() ? t : stored[t];
}

std::string body_set::label(std::size_t body) const {
    const std::string& part = part_name(body);
    return part.empty() ? file_of(body).label : file_of(body).label + ": " + part;
}

std::vector<std::string> body_set::labels() const {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < bodies_.size(); ++i) all.push_back(label(i));
    return all;
}

void body_set::move_in_file(std::size_t number, points_view placed, const transform<3>& matrix,
                            precision written_as) {
    const prepared_mesh& shape = shapes[number];
    mesh& file = files[file_number(number)].content.mesh;
    for (point3& p : file.points) {
        p = matrix(p);
        if (written_as == precision::float32) p = rounded(p);
    }
    const std::span<const face> faces = shape.indexed_view().faces;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const std::uint32_t t = triangle(number, f);
        if (shape.is_cloud()) {
            file.points[t] = placed[f];
            continue;
        }
        for (std::size_t i = 0; i < 3; ++i) file.points[file.faces[t][i]] = placed[faces[f][i]];
    }
}

double mesh_file::round_to_float32() {
    mesh_file& file = *this;
    double largest = 0.0;
    for (point3& p : file.mesh.points) {
        const point3 before = std::exchange(p, rounded(p));
        for (std::size_t k = 0; k < 3 && detail::base::is_finite(before); ++k)
            largest = std::max(largest, std::abs(p[k] - before[k]));
    }
    return largest;
}

}  // namespace treeform
