#pragma once
/// \file
/// Where meshes meet, for reports and pictures.

#include "tools/tf-place/surroundings.hpp"
#include <treeform/mesh/slide.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace tools {

/// A place at which MOVING meets something, or keeps its clearance from it.
struct contact_row {
    tf::point3 point{};
    tf::point3 normal{};  ///< of length 1, from what is fixed to what moves; 0 where there is none
    std::uint32_t moving = 0;              ///< face of MOVING
    std::optional<std::uint32_t> fixed{};  ///< face of the part; none: the bed
    std::size_t part = 0;
};

/// Contacts that a slide has led to; `motion` is its direction.
[[nodiscard]] std::vector<contact_row> contacts_of(const body& moving,
                                                   const std::vector<body>& fixed,
                                                   const chosen_parts& parts,
                                                   const tf::slide_result& slid,
                                                   const tf::point3& motion);

/// Pairs of faces of `mesh`, which is MOVING at some place, that meet one of a part: at most
/// `limit` of each part. `count` gets the number of all.
[[nodiscard]] std::vector<contact_row> contacts_at(tf::mesh_view mesh, const tf::tree<3>& faces,
                                                   std::vector<body>& fixed, std::size_t limit,
                                                   std::uint64_t& count);

/// The lowest face with the lowest point of `mesh`; none without faces.
[[nodiscard]] std::optional<contact_row> contact_with_bed(tf::mesh_view mesh);

}  // namespace tools
