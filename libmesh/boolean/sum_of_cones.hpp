#pragma once
/// \file
/// Volumes behind oriented triangles.

#include <libmesh/base/double_double.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <vector>

namespace treeform::detail::boolean {

/// The sum of `cone(f)`, determinants of three points, six times a volume: one below `faces` each.
/// All in twice the precision of double, as parts of a closed surface far from the origin cancel.
///
/// \same on any number of threads
template <class Cone>
[[nodiscard]] base::double_double sum_of_cones(std::size_t faces, const Cone& cone) {
    constexpr std::size_t grain = std::size_t{1} << 14;
    std::vector<base::double_double> parts(chunk_count(faces, grain));
    for_chunks(faces, grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t f = begin; f < end; ++f) parts[c] = parts[c] + cone(f);
    });
    base::double_double all;
    for (const base::double_double& part : parts) all = all + part;
    return all;
}

}  // namespace treeform::detail::boolean
