#pragma once
/// \file
/// Robots as URDF files describe them: links with meshes, joints between links, and where each link
/// is when the joints have given values.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/transform.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace treeform {

enum class urdf_joint_kind : std::uint8_t { fixed, revolute, continuous, prismatic };

/// A joint: the child's frame is that of the parent, times `origin`, times the motion of the joint.
struct urdf_joint {
    std::string name{};
    urdf_joint_kind kind = urdf_joint_kind::fixed;
    std::uint32_t parent = 0;  ///< numbers of links
    std::uint32_t child = 0;
    transform<3> origin{};
    point3 axis{1.0, 0.0, 0.0};                     ///< of length 1, in the joint's frame
    std::optional<std::array<double, 2>> limits{};  ///< of revolute and prismatic ones
    /// The joint that it follows, and by what: value = first * that of the other + second.
    std::string mimics{};
    std::array<double, 2> mimic_line{1.0, 0.0};
};

/// A mesh of a link: first `place` takes its points into the link's frame.
struct urdf_mesh {
    std::uint32_t link = 0;
    std::filesystem::path file{};
    transform<3> place{};  ///< the origin, and the scale of the mesh
};

struct urdf_robot {
    std::string name{};
    std::vector<std::string> links{};    ///< [L] names, in the order of the file
    std::vector<urdf_joint> joints{};    ///< parents ahead of their children
    std::vector<urdf_mesh> meshes{};     ///< by links
    std::vector<std::string> skipped{};  ///< what is no mesh, one sentence each

    /// Pairs of links that a joint connects, the lower number first, ascending.
    [[nodiscard]] TREEFORM_API std::vector<std::array<std::uint32_t, 2>> adjacent() const;
};

struct urdf_options {
    bool visual = false;  ///< the meshes that are for show, not those for collisions
    /// Where packages are: `package://name/rest` is FOLDER/name/rest or FOLDER/rest for one of
    /// these; else it is looked for in the file's folder and those above it in the same way.
    std::vector<std::filesystem::path> package_folders{};
};

/// Reads the robot at `path`. Joints are fixed, revolute, continuous or prismatic. Spheres,
/// cylinders and boxes are not meshes and are skipped, which `skipped` says. Meshes are not read,
/// but their files have to exist.
///
/// \throws io_error naming the path and the reason: no XML, no robot, a joint of another kind, a
///         link that is not there, has two parents or is its own ancestor, names that repeat, numbers
///         that are none, a mesh whose file is not found
[[nodiscard]] TREEFORM_API urdf_robot read_urdf(const std::filesystem::path& path,
                                                const urdf_options& options = {});

/// The value of a joint: an angle in radians, or a length.
struct joint_value {
    std::string joint{};
    double value = 0.0;
};

/// [L] Where each link is: from its own frame to that of the robot. Joints without a value are at
/// 0, fixed ones stay, and those that mimic another follow it unless they have a value of their own.
/// Limits are not looked at.
///
/// \throws std::invalid_argument for a joint that is not there or fixed, or a value that is not
///         finite
[[nodiscard]] TREEFORM_API std::vector<transform<3>> link_transforms(
    const urdf_robot& robot, std::span<const joint_value> values);

}  // namespace treeform
