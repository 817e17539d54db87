#pragma once
/// \file
/// The outcome in words.

#include "tools/tf-boolean/settings.hpp"
#include "tools/tf-boolean/solids.hpp"
#include <treeform/tf.hpp>

#include <string>

namespace tools {

/// "union: 1,234 faces, volume 1.875, moved by 1.1e-16 at most"
[[nodiscard]] std::string verdict(const job& work, const boolean_settings& settings,
                                  const tf::boolean_result& result);

/// What users may trip over.
void warn_of_surprises(job& work, const boolean_settings& settings,
                       const std::vector<solid>& solids, const tf::boolean_result& result);

/// Why nothing is written, and what may help.
void warn_of_failure(job& work, const tf::boolean_result& result, const std::string& remedy);

/// What -v adds.
void say_details(job& work, const tf::boolean_result& result);

}  // namespace tools
