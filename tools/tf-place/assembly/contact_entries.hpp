#pragma once
/// \file
/// Contacts and nearest points of a placement, as reports have them.

#include "tools/shell/entries.hpp"
#include <treeform/mesh/placement.hpp>
#include <treeform/tf.hpp>

#include <string>
#include <vector>

namespace tools {

/// How the one body of `moving` lies to what is nearest to it; `files` are the paths of `fixed`.
/// \pre there is something near
void enter_nearest(json& entry, const tf::body_set& moving, const tf::body_set& fixed,
                   const std::vector<std::string>& files, const tf::placement& at);

[[nodiscard]] json contact_entry(const tf::body_set& moving, const tf::body_set& fixed,
                                 const tf::placement_contact& c);

/// "; the search ended after 12,345 pairs of faces: a shorter way may exist", if candidates were
/// skipped.
[[nodiscard]] std::string skipped_in_words(const tf::search_effort& effort);

}  // namespace tools
