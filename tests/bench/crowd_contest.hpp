#pragma once
/// \file
/// Set operations of many solids, beside what cannot be had for less: to read the input and to
/// write the result once.

#include "bench/crowds.hpp"
#include "bench/page.hpp"
#include "bench/workload.hpp"
#include <treeform/mesh/boolean.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace treeform::bench {

struct crowd_question {
    std::string name;  ///< a family and a number behind a slash, "spheres/500"
    crowd solids;
    boolean_expression (*expression)(std::size_t operands) = boolean_expression::union_of;
    bool also_in_one_mesh = false;  ///< ask of one mesh with all of them, too: a union alone
    bool also_by_peer = false;      ///< one after the other, by CGAL: a union alone
    bool is_open = false;           ///< to say that there is no solid is right, all else is wrong
};

[[nodiscard]] contest contest_of(const crowd_question& question);

/// For each family, time and peak memory by the number of faces.
[[nodiscard]] section drawn_by_family(const std::vector<outcome>& outcomes,
                                      const std::string& workload, const std::string& machine);

}  // namespace treeform::bench
