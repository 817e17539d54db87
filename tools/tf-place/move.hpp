#pragma once
/// \file
/// Where MOVING goes: the modes drop, lay, slide, mate, clear, measure and fit.

#include "tools/tf-place/contacts.hpp"
#include "tools/tf-place/settings.hpp"
#include "tools/tf-place/surroundings.hpp"
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/fit.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/transform.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tools {

enum class place_status { separate, touching, penetrating, closer_than_clearance, clear };

/// Height of the bed as typed and as written; the latter is a float32 where these are written.
struct bed_level {
    double given = 0.0;
    double used = 0.0;
};

/// What came of it. "At the place" is where MOVING goes, or where it is if it goes nowhere.
struct placement {
    bool complete = true;                          ///< of `fit`: it converged
    bool placed = false;                           ///< a place was found; always for `measure`
    std::string reason{};                          ///< why not, in words
    place_status status = place_status::separate;  ///< at the place
    place_status status_at_start = place_status::separate;
    double clearance = 0.0;
    std::optional<bed_level> bed{};
    bool on_bed = false;     ///< it was the bed that stopped it
    tf::point3 direction{};  ///< of the travel; 0 when there is none
    double travel = 0.0;
    tf::transform<3> matrix{};              ///< of the move
    unsigned backed_off = 0;                ///< steps taken back from what rounding made penetrate
    std::vector<tf::point3> points{};       ///< of MOVING's mesh at the place; as they are written
    std::optional<nearest_part> nearest{};  ///< at the place
    std::vector<contact_row> contacts{};
    std::uint64_t contact_count = 0;
    std::vector<tf::hull_side> sides{};  ///< of `lay`: what there was to choose from
    std::optional<tf::fit_result> fit{};
    std::size_t chosen = 0;  ///< of `sides`
    double tolerance = 0.0;  ///< of `lay`
    double corrected = 0.0;  ///< by `lay`, beyond the rotation
    skipped_work skipped{};
};

/// Height of the bed that can be written. \throws failure (bad_usage) where none can
[[nodiscard]] double bed_to_write(double given, bool to_single);

/// Finds the place. `to_single`: what is written is float32.
[[nodiscard]] placement place(job& work, body& moving, const surroundings& among,
                              const place_settings& settings, bool to_single);

}  // namespace tools
