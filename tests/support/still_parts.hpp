#pragma once
/// \file
/// Meshes that stand still, as what moves among them takes them.

#include <libmesh/base/face_tree.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/still_part.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/tree.hpp>

#include <deque>
#include <vector>

namespace test {

/// Parts and their trees, kept together.
struct still_parts {
    std::deque<tf::mesh> meshes;
    std::deque<tf::tree<3>> trees;
    std::vector<tf::still_part> parts;

    void add(const tf::mesh& mesh) {
        meshes.push_back(mesh);
        trees.push_back(tf::face_tree(meshes.back()));
        parts.push_back({meshes.back(), &trees.back()});
    }
};

}  // namespace test
