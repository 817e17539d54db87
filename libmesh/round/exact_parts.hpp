#pragma once
/// \file
/// The components of an exact surface, to find those that vanish by rounding.

#include <libmesh/round/round_surface.hpp>
#include <treeform/mesh/properties.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::round {

class exact_parts {
  public:
    exact_parts() = default;
    /// \param place_of  returns the rounded position of a point of the surface
    template <class PlaceOf>
    exact_parts(const exact_surface& exact, const PlaceOf& place_of)
        : part_of_(face_components(exact.given.size() + exact.constructed.size(), exact.faces)) {
        for (std::size_t f = 0; f < part_of_.size(); ++f)
            if (part_of_[f] == place_of_part_.size())
                place_of_part_.push_back(place_of(exact.faces[f][0]));
    }

    /// Counts the components of which `result` has no face, and removes them from `before`, the
    /// surface that was rounded, since vanished components do not count as moved.
    void count_vanished(rounded_surface& result, mesh& before) const {
        constexpr std::size_t most_listed = 100;
        std::vector<std::uint8_t> is_kept(place_of_part_.size(), 0);
        if (!is_kept.empty())
            for (const std::uint32_t f : result.face_of) is_kept[part_of_[f]] = 1;
        for (std::size_t part = 0; part < is_kept.size(); ++part) {
            if (is_kept[part] != 0) continue;
            ++result.vanished_components;
            if (result.vanished_at.size() < most_listed)
                result.vanished_at.push_back(place_of_part_[part]);
        }
        if (result.vanished_components == 0 || before.faces.empty()) return;
        std::size_t f = 0;
        std::erase_if(before.faces, [&](const face&) { return is_kept[part_of_[f++]] == 0; });
    }

  private:
    /// [F] component of each face, in the order of their lowest faces; or empty.
    std::vector<std::uint32_t> part_of_{};
    std::vector<point3> place_of_part_{};
};

}  // namespace treeform::detail::round
