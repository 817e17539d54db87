#pragma once
/// \file
/// What is looked at again in surfaces that were rounded, and how often they were certified.

#include <libmesh/base/nearest_float.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solid_checks.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace test {

inline double area(tf::mesh_view mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.faces) {
        const auto& p = mesh.points;
        const tf::point3 u{p[b].x - p[a].x, p[b].y - p[a].y, p[b].z - p[a].z};
        const tf::point3 v{p[c].x - p[a].x, p[c].y - p[a].y, p[c].z - p[a].z};
        sum += std::hypot(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x) / 2;
    }
    return sum;
}

inline bool is_in_floats(const tf::mesh& mesh) {
    return std::ranges::all_of(mesh.points, [](const tf::point3& p) {
        return tf::detail::base::nearest_float(p.x) == p.x &&
               tf::detail::base::nearest_float(p.y) == p.y &&
               tf::detail::base::nearest_float(p.z) == p.z;
    });
}

/// No defects, and no two faces have more in common than corners and edges.
inline bool is_clean_complex(const tf::mesh& mesh) {
    const tf::invalid_faces defects = tf::find_invalid_faces(mesh);
    return defects.degenerate_faces.empty() && defects.nonfinite_points.empty() &&
           defects.out_of_range_faces.empty() && tf::self_intersections(mesh).pairs.empty();
}

/// Pairs of faces that meet, and degenerate faces.
inline std::uint64_t count_meeting(const tf::mesh& mesh) {
    return tf::find_invalid_faces(mesh).degenerate_faces.size() +
           tf::self_intersections(mesh).pairs.size();
}

/// A result of which nothing is left is known for certain, too.
inline bool is_certified(const tf::certificate& known) {
    return known || known.status == tf::status::vanished;
}

/// Results that were asked for, and how many were certified; the others by name.
class certified_tally {
  public:
    explicit certified_tally(std::string name) : name_(std::move(name)) {}

    void count(const tf::certificate& known, const std::string& what) {
        const bool certified = is_certified(known);
        const auto now = std::chrono::steady_clock::now();
        slowest_ = std::max(slowest_, std::chrono::duration<double>(now - last_).count());
        last_ = now;
        ++results_;
        certified_ += certified ? 1 : 0;
        if (!certified) uncertified_ += "\n    " + what;
    }
    /// Of several tallies.
    void add(const certified_tally& part) {
        results_ += part.results_;
        certified_ += part.certified_;
        slowest_ = std::max(slowest_, part.slowest_);
        uncertified_ += part.uncertified_;
    }
    /// What is promised: at least 99.5 % of them.
    [[nodiscard]] bool enough() const { return 1000 * certified_ >= 995 * results_; }
    [[nodiscard]] std::size_t results() const { return results_; }
    [[nodiscard]] std::string summary() const {
        return name_ + ": " + std::to_string(certified_) + " of " + std::to_string(results_) +
               " certified, the slowest with its checks in " + std::to_string(slowest_) + " s" +
               (uncertified_.empty() ? "" : "; not:" + uncertified_);
    }

  private:
    std::string name_, uncertified_;
    std::size_t results_ = 0, certified_ = 0;
    double slowest_ = 0.0;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace test
