#pragma once
/// \file
/// Attributes made in place, and read.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace test {

/// Attributes with one element "vertex" of double columns.
inline tf::attributes vertex_columns(
    const std::vector<std::pair<std::string, std::vector<double>>>& list) {
    tf::attributes a;
    tf::element& e = a.find_or_add("vertex", list.front().second.size());
    for (const auto& [name, values] : list)
        e.columns.push_back(tf::column::of<double>(name, values));
    return a;
}

/// The values of a column as whole numbers; none where there is no such column.
inline std::vector<int> whole_values(const tf::mesh_file& file, const char* element,
                                     const char* name) {
    const tf::element* const e = file.attributes.find(element);
    const tf::column* const c = e == nullptr ? nullptr : e->find(name);
    std::vector<int> all;
    for (std::size_t i = 0; c != nullptr && i < c->size(); ++i)
        all.push_back(static_cast<int>(c->number(i)));
    return all;
}

}  // namespace test
