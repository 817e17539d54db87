#pragma once
/// \file
/// The arm of the Franka robot: its joint frames as published by its maker (Denavit-Hartenberg
/// parameters in Craig's convention; limits of the joints), as a URDF file.

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

namespace test {

inline constexpr std::array<std::array<double, 2>, 7> franka_limits{{{-2.8973, 2.8973},
                                                                     {-1.7628, 1.7628},
                                                                     {-2.8973, 2.8973},
                                                                     {-3.0718, -0.0698},
                                                                     {-2.8973, 2.8973},
                                                                     {-0.0175, 3.7525},
                                                                     {-2.8973, 2.8973}}};

/// Writes the robot to `path`, with the meshes `folder`/franka_link0.stl, ... and franka_hand.stl.
inline void write_franka(const std::filesystem::path& path, const std::filesystem::path& folder) {
    constexpr std::array<const char*, 7> frames{
        "xyz=\"0 0 0.333\" rpy=\"0 0 0\"",
        "xyz=\"0 0 0\" rpy=\"-1.5707963267948966 0 0\"",
        "xyz=\"0 -0.316 0\" rpy=\"1.5707963267948966 0 0\"",
        "xyz=\"0.0825 0 0\" rpy=\"1.5707963267948966 0 0\"",
        "xyz=\"-0.0825 0.384 0\" rpy=\"-1.5707963267948966 0 0\"",
        "xyz=\"0 0 0\" rpy=\"1.5707963267948966 0 0\"",
        "xyz=\"0.088 0 0\" rpy=\"1.5707963267948966 0 0\""};
    std::ofstream out(path);
    const auto link = [&](const std::string& name, const std::string& file) {
        out << "  <link name=\"" << name << "\">\n";
        if (!file.empty())
            out << "    <collision><geometry><mesh filename=\"" << (folder / file).string()
                << "\"/></geometry></collision>\n";
        out << "  </link>\n";
    };
    const auto joint = [&](const std::string& name, const std::string& type,
                           const std::string& from, const std::string& to,
                           const std::string& origin, const std::string& more) {
        out << "  <joint name=\"" << name << "\" type=\"" << type << "\">\n    <parent link=\""
            << from << "\"/><child link=\"" << to << "\"/><origin " << origin << "/>" << more
            << "\n  </joint>\n";
    };
    out << "<?xml version=\"1.0\"?>\n<robot name=\"franka\">\n";
    for (int i = 0; i <= 7; ++i)
        link("link" + std::to_string(i), "franka_link" + std::to_string(i) + ".stl");
    link("link8", "");
    link("hand", "franka_hand.stl");
    for (std::size_t i = 0; i < 7; ++i)
        joint("joint" + std::to_string(i + 1), "revolute", "link" + std::to_string(i),
              "link" + std::to_string(i + 1), frames[i],
              "<axis xyz=\"0 0 1\"/><limit lower=\"" + std::to_string(franka_limits[i][0]) +
                  "\" upper=\"" + std::to_string(franka_limits[i][1]) + "\"/>");
    joint("joint8", "fixed", "link7", "link8", "xyz=\"0 0 0.107\" rpy=\"0 0 0\"", "");
    joint("hand_joint", "fixed", "link8", "hand", "xyz=\"0 0 0\" rpy=\"0 0 -0.7853981633974483\"",
          "");
    out << "</robot>\n";
}

}  // namespace test
