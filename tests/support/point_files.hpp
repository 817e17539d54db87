#pragma once
/// \file
/// A cloud of any size, and the files of points that are read and written in blocks.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace test {

/// Points as a cloud has them: with properties of several types, NaN here and there.
inline tf::mesh_file cloud(std::size_t count, bool single) {
    std::mt19937_64 random(count);
    tf::mesh_file file;
    file.stored_as = single ? tf::precision::float32 : tf::precision::float64;
    std::vector<float> intensity;
    std::vector<std::uint8_t> red;
    std::vector<std::int32_t> id;
    for (std::size_t i = 0; i < count; ++i) {
        tf::point3 p;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = static_cast<double>(random() >> 11) * 0x1p-40 - 4000.0;
            p[axis] = single ? static_cast<double>(static_cast<float>(x)) : x;
        }
        file.mesh.points.push_back(p);
        intensity.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
        red.push_back(static_cast<std::uint8_t>(random()));
        id.push_back(static_cast<std::int32_t>(random()));
    }
    tf::element& e = file.attributes.find_or_add("vertex", count);
    e.columns.push_back(tf::column::of<float>("intensity", intensity));
    e.columns.push_back(tf::column::of<std::uint8_t>("red", red));
    e.columns.push_back(tf::column::of<std::int32_t>("id", id));
    file.attributes.comments = {"a cloud"};
    file.attributes.texture_files = {"a.png"};
    return file;
}

struct kind {
    const char* format;
    bool ascii;
    const char* read_as;  ///< for the byte order of PLY, and for compression
};

inline constexpr kind kinds[] = {
    {"ply", true, ""},  {"ply", false, ""}, {"ply", false, "ply-binary-be"},
    {"pcd", true, ""},  {"pcd", false, ""}, {"pcd", false, "pcd-binary-compressed"},
    {"csv", false, ""}, {"xyz", false, ""}};

}  // namespace test
