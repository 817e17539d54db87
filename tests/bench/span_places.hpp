#pragma once
/// \file
/// Where in the sources samples of calls were taken.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace treeform::bench {

struct span_place {
    std::size_t samples = 0;
    std::string calls;  ///< function and line, then the lines that it was called from; or a line
};

/// The `most` lines with the most samples within what they call, and the `most` calls with the most
/// samples, those first. Only lines of libtree and libmesh are named;
/// there are some where addr2line is installed and the program was built with lines (-g1).
[[nodiscard]] std::vector<span_place> places_of(std::span<const std::vector<void*>> samples,
                                                std::size_t most);

}  // namespace treeform::bench
