#pragma once
/// \file
/// Groups faces of the inputs with the same appearance.

#include <treeform/mesh/carry.hpp>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace treeform::detail::carry {

/// Compares faces by material and corner values. Faces whose three corners share one value are
/// alike if these values are equal; a face with different corner values is like no other face.
class face_kinds {
  public:
    /// `inputs` must outlive this.
    face_kinds(std::span<const carry_source> inputs, bool by_corners);

    /// Whether the inputs have no property by which faces could differ.
    [[nodiscard]] bool empty() const { return materials_.empty() && !has_corner_values_; }

    /// Appends a key to `values`: the same number of values for every face, equal for faces that
    /// are alike.
    void append(std::uint32_t input, std::uint32_t face, std::vector<double>& values) const;

  private:
    std::span<const carry_source> inputs_;
    std::map<std::string, double> materials_{};  ///< numbers from 1
    bool has_corner_values_ = false;
};

/// The criteria for faces of a group.
struct common_of_group {
    bool values = true;   ///< as for `carry_sources::face_groups`
    bool input = false;   ///< as for `carry_sources::face_groups`
    bool corners = true;  ///< with `values`, also corner values
};

/// As `carry_sources::face_groups`.
[[nodiscard]] std::vector<std::uint32_t> groups_of_faces(std::span<const carry_source> inputs,
                                                         const common_of_group& by);

}  // namespace treeform::detail::carry
