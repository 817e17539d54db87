#pragma once
/// \file
/// Small meshes full of trouble, the same for the same random source.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <support/random.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace test {

inline tf::triangle3 triangle_of(const tf::mesh& mesh, std::size_t i) {
    const tf::face& f = mesh.faces[i];
    return {mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]};
}

/// Triangles of about `size` at random places of the unit cube; no shared corners.
inline tf::mesh random_soup(random& source, std::size_t faces, double size) {
    tf::mesh mesh;
    for (std::uint32_t i = 0; i < faces; ++i) {
        const tf::point3 at{source.unit(), source.unit(), source.unit()};
        for (int k = 0; k < 3; ++k)
            mesh.points.push_back({at.x + source.in(-size, size), at.y + source.in(-size, size),
                                   at.z + source.in(-size, size)});
        mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

/// Faces with random corners among `points` random points of the lattice {0 ... side - 1}^3: equal
/// points, repeated and shared corners, collinear and coplanar ones, duplicates, all in plenty.
inline tf::mesh lattice_soup(random& source, std::size_t faces, std::size_t points,
                             std::size_t side) {
    const auto whole = [&] { return static_cast<double>(source.below(side)); };
    const auto corner = [&] { return static_cast<std::uint32_t>(source.below(points)); };
    tf::mesh mesh;
    for (std::size_t i = 0; i < points; ++i) mesh.points.push_back({whole(), whole(), whole()});
    for (std::size_t i = 0; i < faces; ++i) mesh.faces.push_back({corner(), corner(), corner()});
    return mesh;
}

/// Faces around one point, each sharing an edge with the next, the rim at random: they fold over
/// and pass through each other.
inline tf::mesh fan(random& source, std::size_t faces) {
    tf::mesh mesh;
    mesh.points.push_back({});
    for (std::uint32_t i = 0; i < faces; ++i) {
        mesh.points.push_back({source.in(-1, 1), source.in(-1, 1), source.in(-0.1, 0.1)});
        mesh.faces.push_back({0, 1 + i, 1 + (i + 1) % static_cast<std::uint32_t>(faces)});
    }
    return mesh;
}

/// A flat sheet of side x side squares in two triangles each, all faces and edges fitting.
inline tf::mesh grid(std::uint32_t side) {
    tf::mesh mesh;
    for (std::uint32_t y = 0; y <= side; ++y)
        for (std::uint32_t x = 0; x <= side; ++x)
            mesh.points.push_back({static_cast<double>(x), static_cast<double>(y), 0.0});
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t at = y * (side + 1) + x;
            const std::uint32_t up = at + side + 1;
            mesh.faces.push_back({at, at + 1, up + 1});
            mesh.faces.push_back({at, up + 1, up});
        }
    return mesh;
}

/// Both meshes side by side in one, sharing nothing.
inline tf::mesh together(tf::mesh a, const tf::mesh& b) {
    const auto offset = static_cast<std::uint32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const tf::face& f : b.faces)
        a.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
    return a;
}

inline tf::mesh moved(tf::mesh mesh, const tf::point3& by) {
    for (tf::point3& p : mesh.points) p = {p.x + by.x, p.y + by.y, p.z + by.z};
    return mesh;
}

inline tf::mesh scaled(tf::mesh mesh, double by) {
    for (tf::point3& p : mesh.points) p = {p.x * by, p.y * by, p.z * by};
    return mesh;
}

/// Turned about an axis through the origin, in doubles.
inline tf::mesh turned(tf::mesh mesh, const tf::point3& axis, double angle) {
    const double length = std::hypot(axis.x, axis.y, axis.z);
    const tf::point3 u{axis.x / length, axis.y / length, axis.z / length};
    const double c = std::cos(angle), s = std::sin(angle);
    for (tf::point3& p : mesh.points) {
        const double along = (u.x * p.x + u.y * p.y + u.z * p.z) * (1 - c);
        p = {p.x * c + (u.y * p.z - u.z * p.y) * s + u.x * along,
             p.y * c + (u.z * p.x - u.x * p.z) * s + u.y * along,
             p.z * c + (u.x * p.y - u.y * p.x) * s + u.z * along};
    }
    return mesh;
}

/// Each face with corners of its own, as STL has them.
inline tf::mesh unjoined(const tf::mesh& mesh) {
    tf::mesh result;
    for (const tf::face& f : mesh.faces) {
        const auto first = static_cast<std::uint32_t>(result.points.size());
        for (const std::uint32_t corner : f) result.points.push_back(mesh.points[corner]);
        result.faces.push_back({first, first + 1, first + 2});
    }
    return result;
}

/// With what was inside outside: each face the other way round.
inline tf::mesh inside_out(tf::mesh mesh) {
    for (tf::face& f : mesh.faces) std::swap(f[1], f[2]);
    return mesh;
}

/// The same triangles with points, faces and corners in another order; `old_of_new` says which
/// face each was.
struct shuffled_mesh {
    tf::mesh mesh;
    std::vector<std::uint32_t> old_of_new;
};
inline shuffled_mesh shuffled(random& source, const tf::mesh& mesh) {
    const auto permutation = [&](std::size_t count) {
        std::vector<std::uint32_t> ids(count);
        for (std::size_t i = 0; i < count; ++i) ids[i] = static_cast<std::uint32_t>(i);
        source.shuffle(ids);
        return ids;
    };
    shuffled_mesh result{mesh, permutation(mesh.faces.size())};
    const std::vector<std::uint32_t> new_point = permutation(mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        result.mesh.points[new_point[i]] = mesh.points[i];
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        const tf::face& f = mesh.faces[result.old_of_new[i]];
        const std::size_t turn = source.below(3);
        for (std::size_t k = 0; k < 3; ++k) result.mesh.faces[i][k] = new_point[f[(k + turn) % 3]];
    }
    return result;
}

}  // namespace test
