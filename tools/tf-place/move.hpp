#pragma once
/// \file
/// Where MOVING goes: the modes drop, lay, slide, mate, clear, measure and fit.

#include "tools/tf-place/body.hpp"
#include "tools/tf-place/settings.hpp"
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/lay_flat.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tf.hpp>

#include <optional>
#include <string>

namespace tools {

/// What the library has found, in one form for all modes.
struct outcome {
    tf::placement at{};
    std::optional<tf::laid_flat> laid{};
    double flatness = 0.0;  ///< of `lay`
    std::optional<tf::align_result> aligned{};
    std::string reason{};  ///< why there is no place, in words

    /// Whether all is as wished: of `fit`, that it converged.
    [[nodiscard]] bool complete() const { return at && (!aligned || aligned->converged); }
};

/// \throws failure (bad_usage) where the height is none that can be written
void check_bed(double level, tf::precision precision);

/// Finds the place of the one body of `moving`.
[[nodiscard]] outcome place(job& work, const body_set& moving, const body_set& fixed,
                            const place_settings& settings, tf::precision precision);

/// "closer-than-clearance", as in reports.
[[nodiscard]] const char* name_of(tf::standing standing);

/// "dropped by 4.5; touching bed.stl (4 contacts)"
[[nodiscard]] std::string verdict(const body& moving, const outcome& found, const body_set& fixed,
                                  const place_settings& settings);

/// What -v adds.
void say_details(job& work, const outcome& found, const body_set& fixed);

}  // namespace tools
