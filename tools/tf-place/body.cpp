#include "tools/tf-place/body.hpp"

#include "tools/common/console.hpp"
#include <libmesh/base/face_tree.hpp>
#include <libmesh/base/finite.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <treeform/mesh/equal_points.hpp>
#include <treeform/mesh/point_faces.hpp>
#include <treeform/mesh/scene_parts.hpp>
#include <treeform/mesh/select_faces.hpp>
#include <treeform/mesh/validate.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <utility>

namespace tools {
namespace {

tf::point3 rounded(const tf::point3& p) {
    using tf::detail::base::nearest_float;
    return {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
}

/// The numbers of the faces that can be computed with.
std::vector<std::uint32_t> usable_faces(const tf::mesh& mesh) {
    const tf::mesh_defects defects = tf::find_defects(mesh);
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

std::vector<std::uint32_t> finite_points(const tf::mesh& mesh) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < mesh.points.size(); ++i)
        if (tf::detail::base::is_finite(mesh.points[i])) numbers.push_back(i);
    return numbers;
}

tf::mesh cloud_of(const tf::mesh& mesh, const std::vector<std::uint32_t>& numbers) {
    tf::mesh cloud{{}, tf::point_faces(numbers.size())};
    for (const std::uint32_t i : numbers) cloud.points.push_back(mesh.points[i]);
    return cloud;
}

}  // namespace

tf::still_part body::still() {
    if (whole) {
        mesh = tf::select_faces(*whole, faces_of_whole);
        whole.reset();
        faces_of_whole = {};
    }
    if (!tree) tree = std::make_unique<tf::tree<3>>(tf::face_tree(mesh));
    return {mesh, tree.get()};
}

std::string body::name() const {
    return path == "-" ? "stdin" : std::filesystem::path(path).filename().string();
}

std::string body::label() const {
    const std::string file_name = name_of_input(path);
    return part.empty() ? file_name : file_name + ": " + part;
}

body make_body(job& work, const std::string& path, tf::mesh_file file) {
    body b;
    b.path = path;
    *b.file = std::move(file);
    b.cloud = b.file->mesh.faces.empty();
    const auto timing = work.time("prepare");
    std::vector<std::uint32_t> usable =
        b.cloud ? finite_points(b.file->mesh) : usable_faces(b.file->mesh);
    const std::size_t all = b.cloud ? b.file->mesh.points.size() : b.file->mesh.faces.size();
    b.non_finite = all - usable.size();
    if (b.non_finite > 0)
        work.warn("non-finite", b.label() + ": " +
                                    (b.cloud ? counted(b.non_finite, "point", "points")
                                             : counted(b.non_finite, "face", "faces")) +
                                    " with a NaN or infinite coordinate left out");
    b.mesh = b.cloud ? cloud_of(b.file->mesh, usable)
                     : tf::join_equal_points(tf::select_faces(b.file->mesh, usable));
    if (usable.size() < all) b.triangle_of_face = std::move(usable);
    if (b.mesh.points.empty())
        throw failure(bad_input, "no-triangles",
                      b.label() + ": no triangle with finite coordinates (" +
                          counted(b.file->mesh.points.size(), "point", "points") + ")");
    b.box = tf::bounding_box(b.mesh.points);
    return b;
}

std::vector<body> make_parts(job& work, const std::string& path, tf::mesh_file file) {
    std::vector<body> bodies;
    bodies.push_back(make_body(work, path, std::move(file)));
    const body& all = bodies.front();
    const auto timing = work.time("prepare");
    if (all.cloud || all.file->attributes.parts.size() < 2) return bodies;
    std::vector<std::uint32_t> number;
    for (std::uint32_t f = 0; f < all.mesh.faces.size(); ++f) number.push_back(all.stored_face(f));
    std::vector<tf::scene_part> parts =
        tf::scene_parts(all.mesh, all.file->attributes.parts, number);
    if (parts.size() < 2) return bodies;
    body before = std::move(bodies.front());
    const auto whole = std::make_shared<const tf::mesh>(std::move(before.mesh));
    bodies.clear();
    for (tf::scene_part& one : parts) {
        body& b = bodies.emplace_back();
        b.path = path;
        b.part = one.name.empty() ? "part " + std::to_string(bodies.size() - 1) : one.name;
        b.file = before.file;
        b.box = one.box;
        if (bodies.size() == 1) b.non_finite = before.non_finite;
        for (const std::uint32_t f : one.faces) b.triangle_of_face.push_back(before.triangle(f));
        b.whole = whole;
        b.faces_of_whole = std::move(one.faces);
    }
    return bodies;
}

void take_places(body& b, const std::vector<tf::point3>& placed, const tf::transform<3>& matrix,
                 bool to_single) {
    auto& points = b.file->mesh.points;
    for (tf::point3& p : points) {
        p = matrix(p);
        if (to_single) p = rounded(p);
    }
    for (std::uint32_t f = 0; f < b.mesh.faces.size(); ++f) {
        const std::uint32_t t = b.triangle(f);
        if (b.cloud) points[t] = placed[f];
        for (std::size_t i = 0; i < 3 && !b.cloud; ++i)
            points[b.file->mesh.faces[t][i]] = placed[b.mesh.faces[f][i]];
    }
}

double round_to_single(tf::mesh_file& file) {
    double largest = 0.0;
    for (tf::point3& p : file.mesh.points) {
        const tf::point3 before = std::exchange(p, rounded(p));
        for (std::size_t k = 0; k < 3 && tf::detail::base::is_finite(before); ++k)
            largest = std::max(largest, std::abs(p[k] - before[k]));
    }
    return largest;
}

}  // namespace tools
