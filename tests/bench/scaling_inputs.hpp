#pragma once
/// \file
/// What E8 measures on: inputs of any size that differ in nothing but their size.

#include "bench/tool_run.hpp"
#include "bench/workload.hpp"
#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <memory>
#include <string>

namespace treeform::bench {

/// A closed ring with a rippled surface, of about `faces` triangles, as dense one way as the other.
[[nodiscard]] mesh ring(std::size_t faces);

/// How far the second of two linked rings is moved; they pass through each other.
inline constexpr point3 link{0.31, 0.17, 0.23};

/// The files that tools read, in a folder that goes with its last user.
struct scaling_files {
    scratch folder;
    std::string first, second;  ///< PLY: linked rings of n / 2 triangles each
    std::string above;          ///< PLY: the first one, high above the second
    std::string both;           ///< PLY: the two as one mesh of n
    std::string soup;           ///< binary STL: a ring of n
    std::string cloud;          ///< PLY: n points in the unit cube, 30 % of them copies of others
    double reach = 0.0;         ///< of the cloud: a quarter of what n points have between them
    [[nodiscard]] std::string output(const std::string& name) const;
};
/// The files last made are kept while somebody uses them.
[[nodiscard]] std::shared_ptr<const scaling_files> files_of_size(const setting& setting,
                                                                 std::size_t n);

}  // namespace treeform::bench
