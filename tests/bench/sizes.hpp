#pragma once
/// \file
/// One model at the sizes of the paper's figures 2 and 5.

#include "bench/models.hpp"

namespace treeform::bench {

/// 50k, 125k, 250k, 500k, 750k and 1M triangles; the smaller ones for less effort.
[[nodiscard]] inline std::vector<model> one_model_by_size(const setting& setting) {
    if (setting.effort == effort::tiny) return {{"", "2k", 2'000}, {"", "3k", 3'000}};
    const char* base = "clean/armadillo_29k.obj";
    std::vector<model> all{{base, "50k", 50'000},   {base, "125k", 125'000},
                           {base, "250k", 250'000}, {base, "500k", 500'000},
                           {base, "750k", 750'000}, {base, "1M", 1'000'000}};
    if (setting.effort == effort::quick) all.resize(3);
    return all;
}

}  // namespace treeform::bench
