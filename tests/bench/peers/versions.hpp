#pragma once
/// \file
/// How the peers are called in tables.

#include <string>

namespace treeform::bench {

[[nodiscard]] std::string cgal_name();       ///< "CGAL 5.5.1"
[[nodiscard]] std::string assimp_name();     ///< "assimp 5.2.5"
[[nodiscard]] std::string fcl_name();        ///< "FCL 0.7.0"
[[nodiscard]] std::string nanoflann_name();  ///< "nanoflann 1.4.2"

}  // namespace treeform::bench
