#pragma once
/// \file
/// The outcome in words.

#include "tools/tf-place/move.hpp"
#include <treeform/tf.hpp>

#include <string>

namespace tools {

/// "closer-than-clearance", as in reports.
[[nodiscard]] const char* name_of(place_status status);

/// "dropped by 4.5; touching bed.stl (4 contacts)"
[[nodiscard]] std::string verdict(const body& moving, const placement& p, const surroundings& among,
                                  const place_settings& settings);

/// What -v adds.
void say_details(job& work, const placement& p, const surroundings& among);

/// "(0, 0, 1.5)"
[[nodiscard]] std::string in_words(const tf::point3& p);

}  // namespace tools
