#pragma once
/// \file
/// Real models that bound solids.

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/models.hpp>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>

namespace test {

/// Calls `visit(mesh)` for each file with a row in TRUTH.csv, no larger than `most` bytes, that has
/// faces.
template <class Visit>
void for_each_model(std::uintmax_t most, const Visit& visit) {
    for (const std::string& file : files_with_truth(models_folder())) {
        const std::filesystem::path path = models_folder() / file;
        if (std::filesystem::file_size(path) > most) continue;
        tf::mesh mesh;
        try {
            mesh = tf::read_mesh(path).mesh;
        } catch (const std::exception&) {
            continue;
        }
        CAPTURE(file);
        if (!mesh.faces.empty()) visit(mesh);
    }
}

/// The same, of those that bound a solid as they are.
template <class Visit>
void for_each_solid(std::uintmax_t most, const Visit& visit) {
    for_each_model(most, [&](const tf::mesh& mesh) {
        if (!tf::find_solid_defects(mesh).any()) visit(mesh);
    });
}

}  // namespace test
