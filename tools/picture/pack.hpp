#pragma once
/// \file
/// A scene packed for its page. For looking at only: points are moved to a fine grid, and where
/// there is too much context it is thinned out.

#include "tools/picture/scene.hpp"
#include <treeform/tf.hpp>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>

namespace tools {

/// Of context. What was found is never left out.
struct scene_limits {
    std::size_t faces = 200'000;
    std::size_t dots = 500'000;
};

struct packed_scene {
    nlohmann::ordered_json header{};
    std::string geometry{};  ///< base64
};

/// \cost O(V + F) time
[[nodiscard]] packed_scene pack(const scene& shown, const scene_limits& limits = {});

}  // namespace tools
