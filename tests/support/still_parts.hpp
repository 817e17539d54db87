#pragma once
/// \file
/// Meshes that stand still, as what moves among them takes them.

#include <libmesh/place/shape.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <deque>
#include <vector>

namespace test {

struct still_parts {
    std::deque<tf::mesh> meshes;
    std::vector<tf::prepared_mesh> prepared;

    void add(const tf::mesh& mesh) {
        meshes.push_back(mesh);
        prepared.push_back(tf::prepared_mesh::borrow(meshes.back()));
    }
    /// As the functions inside the library take them. \pre nothing is added while they live
    [[nodiscard]] std::vector<tf::detail::place::shape> parts() const {
        return {prepared.begin(), prepared.end()};
    }
};

}  // namespace test
