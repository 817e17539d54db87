#pragma once
/// \file
/// The models that workloads share.

#include "bench/workload.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace treeform::bench {

/// A model of a wanted size, made from a smaller real one.
struct model {
    std::string base;           ///< in the models folder, "open/bunny_69k.obj"
    std::string size;           ///< as people say it, "1M"
    std::size_t triangles = 0;  ///< at least; at most two more unless the base is larger
};

/// A mesh and where it comes from. Shared by the contestants of a contest, freed after it.
using shared_mesh = std::shared_ptr<const tf::mesh>;

/// One or two models of about 50k, 200k and 1M triangles, on both sides of a power of four (4 to
/// the 8th, 9th and 10th), where trees get a level deeper. Fewer and smaller ones for less effort.
[[nodiscard]] std::vector<model> clean_models(const setting& setting);

/// What `load` makes the model from, and its size: "bunny_1M". Where the base is not to be had that
/// is the bunny, and where that is not either or is too large, a bumpy sphere.
[[nodiscard]] std::string name_of(const setting& setting, const model& model);

/// The model, made or taken from the cache; it has no self-intersections. Faces of the base that
/// meet others are left out.
[[nodiscard]] shared_mesh load(const setting& setting, const model& model);

/// A real model as it is, equal points joined; null when the models folder does not hold it.
[[nodiscard]] shared_mesh load_real(const setting& setting, const std::string& path);

/// What is made once and then found in the cache; `make` is called when `name` is not there.
[[nodiscard]] shared_mesh cached(const setting& setting, const std::string& name,
                                 const std::function<tf::mesh()>& make);

}  // namespace treeform::bench
