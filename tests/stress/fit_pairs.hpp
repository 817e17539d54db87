#pragma once
/// \file
/// Pairs of real clouds and meshes to fit, whose truth is known: each side thinned unevenly,
/// cropped and noised by a seed, and one of them moved by 10 degrees and a tenth of the size.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace test {

struct fit_pair {
    std::string name{};
    std::vector<tf::point3> moving{};
    tf::mesh fixed{};  ///< a cloud if it has no faces
    tf::transform<3> truth{};
    double right = 0.0;  ///< how far from the truth is right: root mean square of the moving points
    /// Or, if this is finite, how far the place of the scanner may be off, and `turn` by what
    /// angle.
    tf::point3 scanner{};
    double turn = std::numeric_limits<double>::infinity();

    /// 1 is as far from the truth as is right.
    [[nodiscard]] double error_of(const tf::transform<3>& found) const;
};

constexpr std::size_t variants_of_pair = 10;

/// The first `variants` pairs, up to 10, of each of 20 sources in the folders of models and clouds.
void for_fit_pairs(const std::filesystem::path& models, const std::filesystem::path& clouds,
                   std::size_t variants, const std::function<void(const fit_pair&)>& body);

/// Writes NUMBER_moving.ply, NUMBER_fixed.ply, and NUMBER.txt: the name, what is right, the truth.
void write_pair(const std::filesystem::path& folder, std::size_t number, const fit_pair& pair);

}  // namespace test
