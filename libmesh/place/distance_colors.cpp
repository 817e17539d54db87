#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/deviation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace treeform {
namespace {

using rgb = std::array<double, 3>;

constexpr rgb lowest{33.0, 102.0, 172.0}, zero{247.0, 247.0, 247.0}, highest{178.0, 24.0, 43.0};
constexpr rgb unknown{128.0, 128.0, 128.0};

rgb color_of(double d, double low, double high) {
    if (std::isnan(d)) return unknown;
    const double end = d < 0.0 ? low : high;
    const double share = d == 0.0 ? 0.0 : end == 0.0 ? 1.0 : std::min(d / end, 1.0);
    rgb mixed{};
    for (std::size_t k = 0; k < 3; ++k)
        mixed[k] = zero[k] + share * ((d < 0.0 ? lowest : highest)[k] - zero[k]);
    return mixed;
}

}  // namespace

std::vector<double> body_set::distances_in_file(std::size_t number,
                                                std::span<const double> distances) const {
    const prepared_mesh& shape = shapes[number];
    const mesh& file = file_of(number).content.mesh;
    std::vector<double> all(file.points.size(), std::nan(""));
    const std::span<const face> faces = shape.view().faces;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const std::uint32_t t = triangle(number, f);
        if (shape.is_cloud())
            all[t] = distances[f];
        else
            for (std::size_t i = 0; i < 3; ++i) all[file.faces[t][i]] = distances[faces[f][i]];
    }
    return all;
}

void deviation_result::color(mesh_file& file, std::span<const double> distances, double low,
                             double high) {
    if (distances.size() != file.mesh.points.size())
        throw std::invalid_argument(
            "treeform::deviation_result::color: expected one distance for each point");
    if (!(low <= 0.0 && 0.0 <= high))
        throw std::invalid_argument(
            "treeform::deviation_result::color: 0 is not between low and high");
    element& rows = file.attributes.find_or_add("vertex", distances.size());
    std::array<std::vector<std::uint8_t>, 3> channels;
    for (auto& one : channels) one.reserve(distances.size());
    for (const double d : distances) {
        const rgb mixed = color_of(d, low, high);
        for (std::size_t k = 0; k < 3; ++k)
            channels[k].push_back(static_cast<std::uint8_t>(std::lround(mixed[k])));
    }
    constexpr const char* names[] = {"red", "green", "blue"};
    for (std::size_t k = 0; k < 3; ++k) rows.set(column::of<std::uint8_t>(names[k], channels[k]));
    rows.set(column::of<double>("distance", distances));
}

}  // namespace treeform
