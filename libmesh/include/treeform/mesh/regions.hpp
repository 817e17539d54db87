#pragma once
/// \file
/// Intersecting pairs gathered into places one can look at.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/export.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform {

struct intersection_region {
    std::vector<std::uint32_t> faces;  ///< ascending
    point3 min;                        ///< box of these faces
    point3 max;
    std::uint64_t pairs = 0;  ///< pairs in this region
    friend bool operator==(const intersection_region&, const intersection_region&) = default;
};

struct intersection_regions {
    std::vector<intersection_region> regions;   ///< in the order of their lowest face
    std::vector<std::uint32_t> region_of_pair;  ///< [pairs]
    friend bool operator==(const intersection_regions&, const intersection_regions&) = default;
};

/// Groups the faces that meet in `pairs`: two are in one region when a pair or a shared corner
/// links them, at once or through others. Faces in no pair link nothing. No pairs, no regions.
///
/// \pre    coordinates of the faces in `pairs` are finite
/// \throws std::invalid_argument naming a pair with a face out of range, or the lowest face with a
///         corner that is no point
/// \cost   O(V + F + pairs) time but for an inverse Ackermann factor, about 8 bytes a face and 4 a
///         point
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API intersection_regions group_pairs(mesh_view mesh,
                                                            std::span<const face_pair> pairs);

}  // namespace treeform
