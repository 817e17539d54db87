#pragma once
/// \file
/// Pictures of run time against error: one dot for each method and setting.

#include "bench/chart.hpp"

#include <string>
#include <vector>

namespace treeform::bench {

struct error_point {
    double time = 0.0;      ///< greater than 0
    double error = 0.0;     ///< 0: drawn below the axis, where each exact method has a line
    std::string setting{};  ///< in the dot's tooltip: a family, a tolerance
};

/// A method: dots of one color and one shape.
struct error_series {
    std::string name;
    std::vector<error_point> points{};
    int tone = 1;
    int shape = 0;        ///< as `drawing::shape`
    bool joined = false;  ///< a setting that is swept: dots are joined in their order
};

/// Both axes are logarithmic. A dot that is not finite is left out. Where dots of several methods
/// would cover each other, they stand side by side; their tooltips have the values.
struct error_chart {
    bench::caption caption;
    std::string time_label;
    std::string error_label;
    std::vector<error_series> series{};
    std::string exact_label = "exact";  ///< of the lines for error 0
};

[[nodiscard]] std::string svg(const error_chart& chart);

}  // namespace treeform::bench
