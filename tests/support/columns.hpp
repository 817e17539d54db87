#pragma once
/// \file
/// Attributes made in place.

#include <treeform/mesh/attributes.hpp>
#include <treeform/tf.hpp>

#include <string>
#include <utility>
#include <vector>

namespace test {

/// Attributes with one element "vertex" of double columns.
inline tf::attributes vertex_columns(
    const std::vector<std::pair<std::string, std::vector<double>>>& list) {
    tf::attributes a;
    tf::element& e = tf::obtain_element(a, "vertex", list.front().second.size());
    for (const auto& [name, values] : list)
        e.columns.push_back(tf::make_column<double>(name, values));
    return a;
}

}  // namespace test
