#pragma once
/// \file
/// Made by tools/bindings: fields of results, as reports have them.

#include "tools/picture/json.hpp"
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/tf.hpp>

namespace tools {

[[nodiscard]] json join_entry(const tf::repair_statistics& from);
[[nodiscard]] json orient_entry(const tf::repair_statistics& from);
[[nodiscard]] json fill_entry(const tf::repair_statistics& from);
[[nodiscard]] json cut_entry(const tf::repair_statistics& from);
[[nodiscard]] json detach_entry(const tf::repair_statistics& from);
[[nodiscard]] json effort_entry(const tf::search_effort& from);
[[nodiscard]] json deviations_entry(const tf::deviation_result& from);
[[nodiscard]] json freedom_entry(const tf::align_freedom& from);
[[nodiscard]] json fit_entry(const tf::align_result& from);

}  // namespace tools
