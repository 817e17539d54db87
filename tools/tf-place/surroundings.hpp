#pragma once
/// \file
/// The fixed meshes, part by part: those that matter for a motion are indexed, no others.

#include "tools/tf-place/body.hpp"
#include "tools/tf-place/settings.hpp"
#include <treeform/mesh/counters.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/still_part.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/progress.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace tools {

/// What did not have to be looked at.
struct skipped_work {
    std::uint64_t parts_culled = 0;       ///< whose box told that they cannot matter
    std::uint64_t pairs_tested = 0;       ///< of faces in motion
    tf::predicate_counters predicates{};  ///< that these took
};

/// A part and how MOVING lies to it.
struct nearest_part {
    std::size_t part = 0;
    tf::mesh_measure how{};
};

/// A few of the parts, with their numbers among all.
struct chosen_parts {
    std::vector<tf::still_part> parts{};
    std::vector<std::size_t> number{};
};

class surroundings {
  public:
    explicit surroundings(std::vector<body>& all);

    /// By ascending files.
    [[nodiscard]] std::vector<body>& all() const { return all_; }
    /// Those whose boxes come within `reach` of `box` when it is moved by up to `latest` times
    /// `motion`; a little more is allowed for rounding.
    [[nodiscard]] chosen_parts on_the_way(const tf::box3& box, const tf::point3& motion,
                                          double latest, double reach) const;
    /// Those whose boxes come within `reach` of `box`, and a little more.
    [[nodiscard]] chosen_parts around(const tf::box3& box, double reach) const;
    /// Whether there are such beside those of `known`; none is indexed for this.
    [[nodiscard]] bool others_around(const tf::box3& box, double reach,
                                     const chosen_parts& known) const;
    /// The part that `mesh` penetrates, else one that it touches, else the nearest one; of several
    /// the lowest. None when there is no part within `radius`; those whose boxes are further away
    /// are not indexed for this.
    [[nodiscard]] std::optional<nearest_part> nearest(tf::mesh_view mesh, const tf::tree<3>& faces,
                                                      const tf::box3& box, double radius,
                                                      const tf::progress_callback& progress) const;
    [[nodiscard]] std::uint64_t indexed() const;

  private:
    [[nodiscard]] chosen_parts choose(const std::vector<std::uint32_t>& numbers) const;
    [[nodiscard]] std::vector<std::uint32_t> met_on_the_way(const tf::box3& box,
                                                            const tf::point3& motion, double latest,
                                                            double reach) const;

    std::vector<body>& all_;
    tf::tree<3> boxes_;  ///< of the parts
};

}  // namespace tools
