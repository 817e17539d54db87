#pragma once
/// \file
/// How the peers are called in tables.

#include <string>

namespace tf::bench {

[[nodiscard]] std::string cgal_name();    ///< "CGAL 5.5.1"
[[nodiscard]] std::string assimp_name();  ///< "assimp 5.2.5"

}  // namespace tf::bench
