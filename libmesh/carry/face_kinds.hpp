#pragma once
/// \file
/// Which faces of the inputs look alike.

#include <treeform/mesh/carry.hpp>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace treeform::detail::carry {

/// Materials, and what corners have. Faces whose corners have one and the same value are alike
/// where these are; one whose corners differ is like no other.
class face_kinds {
  public:
    /// `inputs` must outlive this.
    face_kinds(std::span<const carry_source> inputs, bool by_corners);

    /// Whether there is nothing by which faces could differ.
    [[nodiscard]] bool empty() const { return materials_.empty() && !has_corner_values_; }

    /// Appends numbers to `values`, as many for each face, that are equal for faces that are alike.
    void append(std::uint32_t input, std::uint32_t face, std::vector<double>& values) const;

  private:
    std::span<const carry_source> inputs_;
    std::map<std::string, double> materials_{};  ///< numbers from 1
    bool has_corner_values_ = false;
};

/// What faces of a group have in common.
struct common_of_group {
    bool values = true;   ///< as of `carry_sources::face_groups`
    bool input = false;   ///< as there
    bool corners = true;  ///< with `values`, also what corners have
};

/// As `carry_sources::face_groups`.
[[nodiscard]] std::vector<std::uint32_t> groups_of_faces(std::span<const carry_source> inputs,
                                                         const common_of_group& by);

}  // namespace treeform::detail::carry
