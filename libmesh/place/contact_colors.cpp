#include <libmesh/attributes/class_colors.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/topology/select_faces.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/properties.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

namespace treeform {
namespace {

using row_classes = std::vector<std::uint8_t>;

/// Of none, penetrating, touching, near: gray, red, yellow, cyan; then tints of these three.
constexpr std::array<const char*, 7> colors_of_classes{"#b4bac2", "#e02020", "#ecd000", "#00a0c0",
                                                       "#ee9a9a", "#f6ec94", "#90d2e2"};
constexpr std::uint8_t tint = 3;
constexpr std::array<std::uint8_t, 5> class_of{0, 2, 1, 3, 0};  ///< by `mesh_relation`

/// Whether no edge is longer than this, which a NaN is.
bool is_small(const std::array<point3, 3>& t, double longest) {
    for (std::size_t i = 0; i < 3; ++i) {
        const point3 edge = detail::base::minus(t[(i + 1) % 3], t[i]);
        if (!(std::hypot(edge.x, edge.y, edge.z) <= longest)) return false;
    }
    return true;
}

/// Gives small triangles without a class whose corners are all within `halo` of triangles with one
/// the tint of what is nearest to the first: as a class beyond all.
void add_halo(const mesh& mesh, double halo, row_classes& triangles) {
    std::vector<std::uint32_t> marked, others;
    for (std::uint32_t f = 0; f < triangles.size(); ++f) {
        const bool classed = triangles[f] != 0;
        const double longest = classed ? std::numeric_limits<double>::max() : 2.0 * halo;
        if (is_small(detail::base::triangle_of(mesh, f), longest))
            (classed ? marked : others).push_back(f);
    }
    if (marked.empty() || others.empty()) return;
    std::vector<point3> asked;
    asked.reserve(3 * others.size());
    for (const std::uint32_t f : others)
        for (const point3& corner : detail::base::triangle_of(mesh, f)) asked.push_back(corner);
    const auto near = closest_point(select_faces(mesh, marked), asked, halo);
    for (std::size_t i = 0; i < others.size(); ++i)
        if (near[3 * i] && near[3 * i + 1] && near[3 * i + 2])
            triangles[others[i]] =
                static_cast<std::uint8_t>(triangles[marked[near[3 * i]->face]] + tint);
}

/// The gravest class of the triangles of each face as stored.
row_classes by_stored_face(const mesh_file& file, const row_classes& triangles) {
    if (file.face_of_triangle.empty()) return triangles;
    row_classes stored(file.stored_faces);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        std::uint8_t& present = stored[file.face_of_triangle[t]];
        if (triangles[t] != 0 && (present == 0 || triangles[t] < present)) present = triangles[t];
    }
    return stored;
}

bool has_colors(const mesh_file& file) {
    const auto& elements = file.attributes.elements;
    return std::any_of(elements.begin(), elements.end(),
                       [](const element& e) { return e.find("red") != nullptr; });
}

using rgb = std::array<double, 3>;

constexpr rgb lowest{33.0, 102.0, 172.0}, zero{247.0, 247.0, 247.0}, highest{178.0, 24.0, 43.0};
constexpr rgb unknown{128.0, 128.0, 128.0};

rgb color_of(double d, double low, double high) {
    if (std::isnan(d)) return unknown;
    const double end = d < 0.0 ? low : high;
    const double share = d == 0.0 ? 0.0 : end == 0.0 ? 1.0 : std::min(d / end, 1.0);
    rgb mixed{};
    for (std::size_t k = 0; k < 3; ++k)
        mixed[k] = zero[k] + share * ((d < 0.0 ? lowest : highest)[k] - zero[k]);
    return mixed;
}

}  // namespace

std::vector<mesh_relation> body_set::relations_in_files(
    std::span<const std::vector<mesh_relation>> relations, bool clouds) const {
    std::vector<mesh_relation> all;
    std::size_t first = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const body_file& file = file_of(i);
        if (file.cloud && !clouds) continue;
        if (i == 0 || file_number(i) != file_number(i - 1)) {
            first = all.size();
            const mesh& content = file.content.mesh;
            all.resize(first + (file.cloud ? content.points.size() : content.faces.size()));
        }
        for (std::uint32_t f = 0; f < relations[i].size(); ++f)
            all[first + triangle(i, f)] = relations[i][f];
    }
    return all;
}

void placement::color(mesh_file& file, std::span<const mesh_relation> relations, double halo,
                      bool keep_colors) {
    const bool cloud = file.mesh.faces.empty() && !relations.empty();
    if (relations.size() != (cloud ? file.mesh.points.size() : file.mesh.faces.size()))
        throw std::invalid_argument(
            "treeform::placement::color: expected one relation for each triangle");
    row_classes of_row;
    for (const mesh_relation how : relations)
        of_row.push_back(class_of[static_cast<std::size_t>(how)]);
    const bool colors = !(keep_colors && has_colors(file));
    if (!cloud && colors && halo > 0.0) add_halo(file.mesh, halo, of_row);
    if (!cloud) of_row = by_stored_face(file, of_row);
    element& rows = file.attributes.find_or_add(cloud ? "vertex" : "face", of_row.size());
    if (colors) detail::attribute::set_colors(rows, of_row, colors_of_classes);
    std::vector<std::int32_t> numbers;
    for (const std::uint8_t row : of_row) numbers.push_back(row > tint ? 0 : row);
    rows.set(column::of<std::int32_t>("tf_class", numbers));
}

std::vector<double> body_set::distances_in_file(std::size_t number,
                                                std::span<const double> distances) const {
    const prepared_mesh& shape = shapes[number];
    const mesh& file = file_of(number).content.mesh;
    std::vector<double> all(file.points.size(), std::nan(""));
    const std::span<const face> faces = shape.indexed_view().faces;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const std::uint32_t t = triangle(number, f);
        if (shape.is_cloud())
            all[t] = distances[f];
        else
            for (std::size_t i = 0; i < 3; ++i) all[file.faces[t][i]] = distances[faces[f][i]];
    }
    return all;
}

void deviation_result::color(mesh_file& file, std::span<const double> distances, double low,
                             double high) {
    if (distances.size() != file.mesh.points.size())
        throw std::invalid_argument(
            "treeform::deviation_result::color: expected one distance for each point");
    if (!(low <= 0.0 && 0.0 <= high))
        throw std::invalid_argument(
            "treeform::deviation_result::color: 0 is not between low and high");
    element& rows = file.attributes.find_or_add("vertex", distances.size());
    std::array<std::vector<std::uint8_t>, 3> channels;
    for (auto& one : channels) one.reserve(distances.size());
    for (const double d : distances) {
        const rgb mixed = color_of(d, low, high);
        for (std::size_t k = 0; k < 3; ++k)
            channels[k].push_back(static_cast<std::uint8_t>(std::lround(mixed[k])));
    }
    constexpr const char* names[] = {"red", "green", "blue"};
    for (std::size_t k = 0; k < 3; ++k) rows.set(column::of<std::uint8_t>(names[k], channels[k]));
    rows.set(column::of<double>("distance", distances));
}

void deviation_result::color(mesh_file& file) const {
    const double scale = p99 > 0.0 ? p99 : max;
    color(file, distances, -scale, scale);
}

}  // namespace treeform
